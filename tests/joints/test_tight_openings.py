"""Leaves that are thick, fill their openings, or lap one another open without collisions, and lose little."""

import numpy as np
import pytest

from building_scenes import frame, knob, leaf
from grafu.geometry.axis import Axis
from grafu.joints.clearance.carve import Path
from grafu.joints.clearance.make import shrink
from grafu.joints.config import RealizationConfig
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.nesting import bodies_of
from grafu.joints.realize import realize
from grafu.metrics.collision import CollisionConfig, collision_shares
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.scene.scene import Scene
from grafu.templates.gallery import builtin_gallery
from judging import GALLERY
from small_scenes import DOOR, box, cylinder, hinged, scene

TOUCHING = CollisionConfig(poses=40, tolerance=0.0005)


def trims(made) -> list[float]:
    return [c.amount for outcome in made.report.installed for c in outcome.clearances if c.kind == "trimmed"]


@pytest.mark.parametrize(("thick", "least", "most"), [(0.12, 0.006, 0.013), (0.08, 0.002, 0.006), (0.04, 0.0, 0.005)])
def test_a_thick_leaf_that_fills_its_opening_gets_the_gap_that_its_far_edge_needs(thick, least, most):
    """The far edge of its back is that much farther from the pin; a thin leaf needs less."""
    panel = leaf((-0.06, -0.06 + thick), (0.05, 0.85))
    made = functionalize(scene(frame(0.14), panel, knob()), MotionSource.NETWORK, builtin_gallery())
    (joint,) = made.object.joints
    assert joint.limits.upper > 1.5
    assert collision_shares(made.object, TOUCHING) == {joint.id: 0.0}
    assert least <= max(trims(made), default=0.0) <= most


def mullioned():
    """Two leaves that open to the front, nearly flush with their frame, and the post between that they meet tightly."""
    leaves = [
        box("door_1", (-0.5, -0.12, 0.05), (-0.011, -0.06, 1.25)),
        box("door_2", (0.011, -0.12, 0.05), (0.5, -0.06, 1.25)),
    ]
    post = [
        box("post", (-0.0105, -0.12, 0.04), (0.0105, -0.06, 1.26)),
        box("rail", (-0.02, -0.06, 0.04), (0.02, -0.05, 1.26)),
    ]
    jambs = [box(f"jamb_{k}", (x, -0.13, 0.0), (x + 0.06, 0.1, 1.3)) for k, x in enumerate((-0.5625, 0.5025))]
    sills = [box(f"sill_{k}", (-0.5025, -0.13, z), (0.5025, 0.1, z + 0.0475)) for k, z in enumerate((0.0, 1.2525))]
    stops = [box(f"stop_{k}", (x, -0.058, 0.0475), (x + 0.02, 0.1, 1.2525)) for k, x in enumerate((-0.5025, 0.4825))]
    joints = tuple(
        hinged(name, Axis(np.array((x, -0.12, 0.65)), np.array((0.0, 0.0, sign))))
        for name, x, sign in (("door_1", -0.5, -1.0), ("door_2", 0.5, 1.0))
    )
    return scene(*leaves, *post, *jambs, *sills, *stops, joints=joints)


def test_where_no_pin_leaves_a_leaf_free_the_border_that_was_asked_for_is_cleared_too():
    asset = mullioned()
    made = realize(plan_from_annotation(asset), asset, GALLERY)
    assert {joint.child for joint in made.object.joints} == {"door_1", "door_2"}
    assert all(joint.limits.upper > 1.5 for joint in made.object.joints)
    assert not any(collision_shares(made.object, TOUCHING).values())


def rebated(lap: float):
    """Two leaves on drawn barrels, of which the left one laps the other by some metres, in a frame behind them."""
    left = [box("door_1", (-0.6, -0.06, 0.0), (0.0, 0.0, 1.2))]
    right = box("door_2", (0.004, -0.06, 0.0), (0.6, 0.0, 1.2))
    strip = box("strip", (-0.02, -0.075, 0.0), (lap, -0.061, 1.2), carried_by="door_1")
    jambs = [box(f"jamb_{k}", (x, -0.06, 0.0), (x + 0.06, 0.1, 1.2)) for k, x in enumerate((-0.665, 0.605))]
    barrels = [
        cylinder(f"barrel_{k}_{low}", ((x, -0.062, low), (x, -0.062, low + 0.06)), 0.005)
        for k, x in enumerate((-0.602, 0.602))
        for low in (0.2, 0.9)
    ]
    joints = tuple(
        hinged(name, Axis(np.array((x, -0.062, 0.6)), np.array((0.0, 0.0, sign))))
        for name, x, sign in (("door_1", -0.602, -1.0), ("door_2", 0.602, 1.0))
    )
    return scene(*left, right, strip, *jambs, *barrels, joints=joints)


@pytest.mark.parametrize(("lap", "waits"), [(0.03, ("door_1_joint",)), (0.002, ())])
def test_a_leaf_on_drawn_hinges_that_another_one_laps_opens_after_it(lap, waits):
    asset = rebated(lap)
    made = realize(plan_from_annotation(asset), asset, GALLERY)
    found = {outcome.moving: outcome for outcome in made.report.installed}
    assert {name: outcome.template for name, outcome in found.items()} == {"door_1": "drawn", "door_2": "drawn"}
    assert found["door_2"].after == waits
    assert found["door_1"].after == ()


def test_what_stands_beside_a_leaf_is_eased_and_a_frame_around_it_is_not():
    """Its opening would become smaller."""
    beside = box("beside", (0.6, -0.2, 0.0), (0.8, 0.2, 0.6))
    around = scene(frame()).parts[0]
    asset = scene(DOOR, beside, around, joints=(hinged(),))
    held = Scene({p.id: p for p in asset.parts}, bodies_of(plan_from_annotation(asset).joints), asset.extent)
    axis = asset.joints[0].axis
    path = Path("door", axis.rotation, 1.5, np.eye(3), True)
    wide = held.replaced([box("door", (0.1, -0.02, 0.1), (0.5, 0.0, 0.7))])
    _, eased = shrink(1.0, wide, path, ["beside", "frame"], RealizationConfig())
    assert [clearance.part for clearance in eased] == ["beside"]
