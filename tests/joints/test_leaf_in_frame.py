"""A leaf whose edges are drawn in the frame around it is cut to the opening, and the frame keeps what is cut off."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.part import Asset
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.joints.clearance.in_frame import leaf_in_frame
from grafu.joints.config import RealizationConfig
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.nesting import bodies_of
from grafu.scene.border import part_axes
from grafu.scene.scene import Scene
from judging import installed, realized, swept_collisions
from small_scenes import box, hinged, scene

JAMB = 0.05
WIDTH, HEIGHT = 0.9, 2.1


def door(lap: float, y=(-0.02, 0.02), depth=0.12) -> Asset:
    """A leaf that reaches so far into both jambs and the head; nothing stands below it."""
    half = depth / 2
    pieces = [
        box("a", (0.0, -half, 0.0), (JAMB, half, HEIGHT)),
        box("b", (WIDTH - JAMB, -half, 0.0), (WIDTH, half, HEIGHT)),
        box("c", (JAMB, -half, HEIGHT - JAMB), (WIDTH - JAMB, half, HEIGHT)),
    ]
    frame = replace(box("frame", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), surfaces=tuple(p.surfaces[0] for p in pieces))
    leaf = box("door", (JAMB - lap, y[0], 0.005), (WIDTH - JAMB + lap, y[1], HEIGHT - JAMB + lap))
    axis = Axis(vec3(JAMB, y[0], 0.0), vec3(0.0, 0.0, -1.0))
    return scene(frame, leaf, joints=(hinged(axis=axis),))


def area(part) -> float:
    return sum(surface.mesh.area for surface in part.surfaces)


@pytest.mark.parametrize("lap", [0.008, 0.016])
def test_a_leaf_that_ends_in_its_frame_is_cut_to_the_opening_and_works(lap):
    asset = door(lap)
    result = realized(asset)
    outcome = installed(result)["door"]
    assert outcome.collision_share == 0.0
    assert not outcome.restricted
    assert swept_collisions(result.object, result.object.joints[0], 25) == {}
    (cut,) = [c for c in outcome.clearances if c.part == "door"]
    assert cut.kind == "trimmed"
    assert lap < cut.amount <= lap + 0.006
    after = {v.name: v for link in result.object.links for v in link.visuals}
    size = after["door"].mesh.box.size
    assert np.all(size[[0, 2]] <= np.array([WIDTH - 2 * JAMB, HEIGHT - JAMB]))
    assert size[1] == pytest.approx(0.04)
    assert area(after["frame"]) > area(asset.part("frame"))  # it keeps the edges


def test_a_leaf_that_reaches_into_one_post_alone_is_cut_on_that_side():
    """A post that stands before a cabinet's side, and a door in it by 13 mm: with nothing cut it collides at rest."""
    side = box("side", (0.36, 0.0, 0.0), (0.38, 0.4, 0.6))
    post = box("post", (0.36, -0.05, 0.0), (0.4, 0.0, 0.6))
    leaf = box("door", (0.0, -0.03, 0.02), (0.373, -0.01, 0.58))
    axis = Axis(vec3(0.373, -0.03, 0.0), vec3(0.0, 0.0, 1.0))
    result = realized(scene(side, post, leaf, joints=(hinged(axis=axis),)))
    outcome = installed(result)["door"]
    assert (outcome.collision_share, outcome.restricted) == (0.0, False)
    (cut,) = [c for c in outcome.clearances if c.part == "door"]
    assert (cut.kind, cut.why) == ("trimmed", "its edges lay in post, which keeps them")
    assert 0.013 < cut.amount <= 0.019


def test_nothing_is_cut_off_where_no_material_may_be_taken():
    outcome = installed(realized(door(0.016), RealizationConfig(trim=False))).get("door")
    assert outcome is None or (outcome.clearances == () and outcome.collision_share > 0)


@pytest.mark.parametrize(
    ("asset", "why"),
    [(door(0.03), "too deep"), (door(0.016, y=(-0.075, -0.055)), "it lies on its frame, sunk into it a little")],
    ids=["too deep", "on the frame"],
)
def test_other_leaves_keep_their_edges(asset, why):
    result = realized(asset)
    after = {v.name: v for link in result.object.links for v in link.visuals}
    lost = asset.part("door").box.size[[0, 2]] - after["door"].mesh.box.size[[0, 2]]
    assert np.all(lost <= 0.02 * asset.part("door").box.size[[0, 2]]), why
    assert area(after["frame"]) <= area(asset.part("frame")) * 1.02


def test_hardware_of_another_door_that_a_leaf_cuts_into_is_no_frame():
    asset = door(0.008)
    before = Scene({p.id: p for p in asset.parts}, bodies_of(plan_from_annotation(asset).joints), asset.extent)
    config, axes = RealizationConfig(), part_axes(asset.part("door").mesh)
    alone = [clearances for _, clearances in leaf_in_frame(before, "door", axes, ("frame",), config)]

    assert [c for _, c in leaf_in_frame(before, "door", axes, ("hinge_other_0", "frame"), config)] == alone != []
    assert list(leaf_in_frame(before, "door", axes, ("hinge_other_0",), config)) == []
