"""Fronts drawn a few millimetres one into the other both open: the first gives way; others stay as they are."""

from dataclasses import replace

import pytest

from grafu.asset.part import Part
from grafu.metrics.collision import CollisionConfig, collision_shares
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.templates.gallery import builtin_gallery
from small_scenes import BASE_CASE, Point, box, scene

ALL = CollisionConfig(poses=40, tolerance=0.0005, hardware=True, moving_bodies=True)
FLAP = box("door", (0.002, -0.026, 0.252), (0.598, -0.001, 0.76))
GRIP = box("handle", (0.2, -0.06, 0.7), (0.4, -0.026, 0.71), "door")


def drawer(name: str, low: Point, high: Point) -> Part:
    """A drawer: a front of 19 mm between two corners, and a solid box of 0.45 m behind it."""
    front = box(name, (low[0], -0.02, low[2]), (high[0], -0.001, high[2]))
    body = box(name, (low[0] + 0.04, -0.001, low[2] + 0.03), (high[0] - 0.04, 0.45, high[2] - 0.04))
    return replace(front, surfaces=(*front.surfaces, *body.surfaces))


def drawer_up_to(height: float) -> Part:
    """A drawer below the flap whose front reaches up to a height, metres."""
    return drawer("drawer", (0.002, 0.0, 0.102), (0.598, 0.0, height))


def made_with(*parts, config: PipelineConfig = PipelineConfig()):
    return functionalize(scene(*BASE_CASE, *parts), MotionSource.NETWORK, builtin_gallery(), config)


def trimmed(made) -> dict[str, float]:
    found = (outcome for outcome in made.report.installed)
    return {c.part: c.amount for outcome in found for c in outcome.clearances if c.kind == "trimmed"}


@pytest.mark.parametrize("lap", [0.002, 0.004])
def test_a_flap_and_the_drawer_that_it_is_drawn_into_both_open(lap):
    made = made_with(FLAP, GRIP, drawer_up_to(0.252 + lap))
    uppers = {joint.child: joint.limits.upper for joint in made.object.joints}
    assert uppers["door"] > 1.4
    assert uppers["drawer"] > 0.2
    assert collision_shares(made.object, ALL) == {joint.id: 0.0 for joint in made.object.joints}
    assert lap < trimmed(made)["door"] < lap + 0.004


def test_of_two_drawers_drawn_into_one_another_the_first_gives_way():
    lower, upper = (
        drawer(name, (0.002, 0.0, z), (0.598, 0.0, z + 0.253)) for name, z in (("drawer_1", 0.102), ("drawer_2", 0.352))
    )
    made = made_with(lower, upper)
    assert {joint.child for joint in made.object.joints if joint.limits.upper > 0.2} == {"drawer_1", "drawer_2"}
    assert list(trimmed(made)) == ["drawer_1"]


@pytest.mark.parametrize("top", [0.249, 0.252])
def test_fronts_with_a_gap_and_fronts_that_touch_stay_whole(top):
    assert trimmed(made_with(FLAP, GRIP, drawer_up_to(top))) == {}


def test_a_front_drawn_far_into_another_stays_whole():
    assert "door" not in trimmed(made_with(FLAP, GRIP, drawer_up_to(0.28)))


def test_nothing_is_taken_where_that_is_not_wanted():
    config = PipelineConfig(Settings(trim=False))
    assert trimmed(made_with(FLAP, GRIP, drawer_up_to(0.255), config=config)) == {}


def bank_beside_a_door(gap: float):
    """A door that hangs on a divider, and three drawers beside it: their fronts are apart by a gap, metres."""
    middle, panel = 0.5, 0.018
    case = [
        box("left", (0.0, 0.0, 0.0), (panel, 0.55, 0.82)),
        box("right", (1.0 - panel, 0.0, 0.0), (1.0, 0.55, 0.82)),
        box("floor", (panel, 0.0, 0.08), (1.0 - panel, 0.55, 0.1)),
        box("top", (panel, 0.0, 0.8), (1.0 - panel, 0.55, 0.82)),
        box("back", (panel, 0.53, 0.1), (1.0 - panel, 0.55, 0.8)),
        box("divider", (middle - panel / 2, 0.0, 0.1), (middle + panel / 2, 0.53, 0.8)),
    ]
    leaf = box("door", (middle + gap / 2, -0.02, 0.102), (0.998, -0.001, 0.818))
    grip = box("handle", (0.94, -0.05, 0.4), (0.95, -0.02, 0.5), "door")
    heights = ((0.102, 0.33), (0.333, 0.57), (0.573, 0.818))
    bank = [drawer(f"drawer_{k}", (0.002, 0.0, a), (middle - gap / 2, 0.0, b)) for k, (a, b) in enumerate(heights)]
    made = functionalize(scene(*case, leaf, grip, *bank), MotionSource.NETWORK, builtin_gallery(), PipelineConfig())
    return {outcome.moving: outcome for outcome in made.report.installed}


@pytest.mark.parametrize(("gap", "hinge"), [(0.001, "cup"), (0.004, "butt")])
def test_a_door_hangs_so_that_the_drawers_beside_its_hinges_slide_past_them(gap, hinge):
    """In a seam of a millimetre every barrel would stand before the drawers, which have no other way."""
    installed = bank_beside_a_door(gap)
    assert set(installed) == {"door", "drawer_0", "drawer_1", "drawer_2"}
    assert installed["door"].template == hinge
    assert {installed[f"drawer_{k}"].collision_share for k in range(3)} == {0.0}
