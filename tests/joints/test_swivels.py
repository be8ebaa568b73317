"""What is called a swivel part, and what stands on one column above wheels, turns about the upright line below it."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.part import PartSource
from grafu.joints.swivels import swivels
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType, PartLabel
from small_scenes import box, cylinder, scene


def called(part, name):
    return replace(part, source=PartSource(name), label=PartLabel.UNKNOWN)


def chair(wheels=5, shelf=False):
    """An office chair: a seat with its back on a column, which stands on a star with wheels."""
    parts = [
        called(box("seat", (-0.23, -0.23, 0.46), (0.23, 0.23, 0.54)), "seat"),
        called(box("back", (-0.2, 0.2, 0.5), (0.2, 0.25, 1.0)), "back"),
        called(cylinder("column", ((0, 0, 0.1), (0, 0, 0.45)), 0.025), "gas_lift"),
        called(box("star", (-0.3, -0.03, 0.07), (0.3, 0.03, 0.1)), "star"),
    ]
    angles = np.arange(wheels) * 2 * np.pi / max(wheels, 1)
    spots = [(0.28 * np.cos(a), 0.28 * np.sin(a)) for a in angles]
    parts += [
        called(
            box(f"w{k}", (float(x - 0.02), float(y - 0.02), 0.0), (float(x + 0.02), float(y + 0.02), 0.06)),
            f"wheel_{k}",
        )
        for k, (x, y) in enumerate(spots)
    ]
    return [*parts, called(box("shelf", (-0.3, 0.3, 0.3), (0.3, 0.5, 0.6)), "tray")] if shelf else parts


def joints(*parts):
    made = functionalize(scene(*parts), MotionSource.NETWORK, builtin_gallery()).object
    return made, {joint.child: joint for joint in made.joints}


def test_a_chair_turns_on_its_column():
    made, found = joints(*chair())
    assert {name: joint.type for name, joint in found.items()} == {"seat": JointType.CONTINUOUS}
    assert np.allclose(np.abs(found["seat"].axis.direction), (0, 0, 1))
    assert {"seat", "back", "column"} <= {visual.name for visual in made.link("seat").visuals}
    assert "star" in {visual.name for visual in made.link(made.root).visuals}


def stand(name="swivel_top", label=PartLabel.TOP_PANEL):
    """A plate on a round bearing on a block, with a screen on the plate."""
    return [
        replace(called(box("plate", (-0.4, -0.2, 0.3), (0.4, 0.2, 0.33)), name), label=label),
        called(cylinder("bearing", ((0.05, 0, 0.27), (0.05, 0, 0.3)), 0.15), "disc"),
        called(box("block", (-0.38, -0.19, 0.0), (0.38, 0.19, 0.27)), "block"),
        called(box("screen", (-0.3, -0.02, 0.33), (0.3, 0.02, 0.8)), "screen"),
    ]


def test_what_is_called_so_turns_about_the_round_part_below_it_with_what_stands_on_it():
    made, found = joints(*stand())
    assert found["plate"].type is JointType.CONTINUOUS
    assert np.allclose(found["plate"].axis.point[:2], (0.05, 0.0), atol=1e-3)
    assert {"plate", "screen"} == {visual.name for visual in made.link("plate").visuals}


OTHERS = {
    "a chair without wheels": chair(wheels=0),
    "two wheels": chair(wheels=2),
    "what stands beside the column": chair(shelf=True),
    "a top of another name": stand("table_top"),
    "a caster": stand("swivel_caster"),
    "a door": stand("swivel_lid", PartLabel.DOOR),
    "what stands on the floor": [called(box("plate", (-0.4, -0.2, 0.0), (0.4, 0.2, 0.03)), "swivel_base")],
    "a cart": [
        called(box("box", (-0.3, -0.2, 0.1), (0.3, 0.2, 0.8)), "body"),
        *(p for p in chair() if p.id.startswith("w")),
    ],
}


@pytest.mark.parametrize("what", OTHERS)
def test_others_do_not_turn(what):
    assert not swivels(scene(*OTHERS[what]))


def test_the_casters_below_a_seat_still_swivel():
    parts = [part for part in chair(wheels=0) if part.id != "star"]
    star = called(box("star", (-0.32, -0.32, 0.08), (0.32, 0.32, 0.11)), "star")
    spots = [(x, y) for x in (-0.27, 0.27) for y in (-0.27, 0.27)]
    casters = []
    for k, (x, y) in enumerate(spots):
        casters += [
            called(cylinder(f"wheel_{k}", ((x - 0.015, y, 0.03), (x + 0.015, y, 0.03)), 0.03), f"wheel_{k}"),
            called(cylinder(f"stem_{k}", ((x, y, 0.05), (x, y, 0.09)), 0.01), f"caster_{k}"),
        ]
    config = PipelineConfig(Settings(small_parts=True))
    made = functionalize(scene(*parts, star, *casters), MotionSource.NETWORK, builtin_gallery(), config).object
    assert set(made.joint_of) >= {"seat", *(f"stem_{k}" for k in range(4))}
