"""Doors that are drawn open are closed first, whoever states their joints; all others stay as they are drawn."""

from dataclasses import replace
from math import pi, radians

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import Asset, Part
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.transform import from_rotation, rotation_matrix
from grafu.joints.closing import closed_plan
from grafu.joints.config import RealizationConfig
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.plan import RealizationPlan
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType
from small_scenes import box, hinged, scene

CASE = (
    box("side_left", (-0.42, -0.25, 0.0), (-0.4, 0.25, 0.7)),
    box("side_right", (0.4, -0.25, 0.0), (0.42, 0.25, 0.7)),
    box("bottom", (-0.4, -0.25, 0.0), (0.4, 0.25, 0.02)),
    box("top", (-0.42, -0.25, 0.7), (0.42, 0.25, 0.72)),
    box("back", (-0.42, 0.25, 0.0), (0.42, 0.26, 0.72)),
)
LEFT = Axis(vec3(-0.397, -0.25, 0.0), vec3(0.0, 0.0, -1.0))
OVERLAY = Axis(vec3(-0.42, -0.25, 0.0), vec3(0.0, 0.0, -1.0))
RIGHT = Axis(vec3(0.397, -0.25, 0.0), vec3(0.0, 0.0, 1.0))
TOLERANCE = radians(0.5)
UPRIGHT = vec3(0.0, 0.0, 1.0)


def turned(part: Part, T: np.ndarray) -> Part:
    return replace(part, surfaces=tuple(surface.transformed(T) for surface in part.surfaces))


def drawn(part: Part, axis: Axis, angle: float) -> Part:
    return turned(part, motion_kind(JointType.REVOLUTE).transform(axis, angle))


def inset(angle: float) -> Asset:
    door = box("door", (-0.397, -0.25, 0.023), (0.397, -0.23, 0.697))
    return scene(*CASE, drawn(door, LEFT, angle), joints=(hinged(axis=LEFT),))


def overlay(angle: float) -> Asset:
    door = box("door", (-0.42, -0.27, 0.0), (0.42, -0.25, 0.72))
    return scene(*CASE, drawn(door, OVERLAY, angle), joints=(hinged(axis=OVERLAY),))


def pair(left: float, right: float) -> Asset:
    doors = (
        drawn(box("door", (-0.397, -0.25, 0.023), (-0.001, -0.23, 0.697)), LEFT, left),
        drawn(box("door_2", (0.001, -0.25, 0.023), (0.397, -0.23, 0.697)), RIGHT, right),
    )
    return scene(*CASE, *doors, joints=(hinged(axis=LEFT), hinged("door_2", RIGHT)))


def angles(asset: Asset) -> dict[str, float]:
    """How far the doors are found to be drawn open, radians."""
    plan = closed_plan(plan_from_annotation(asset), asset, RealizationConfig())
    return {request.moving: request.drawn_at for request in plan.joints}


@pytest.mark.parametrize("door", [inset, overlay], ids=["inset", "overlay"])
@settings(max_examples=20)
@given(angle=st.floats(radians(6), radians(130)))
def test_an_open_door_is_closed_where_it_fits(door, angle: float):
    assert angles(door(angle))["door"] == pytest.approx(angle, abs=TOLERANCE)


@pytest.mark.parametrize("door", [inset, overlay], ids=["inset", "overlay"])
@pytest.mark.parametrize("angle", [0.0, radians(1)])
def test_a_closed_door_stays(door, angle: float):
    asset = door(angle)
    plan = plan_from_annotation(asset)
    assert closed_plan(plan, asset, RealizationConfig()) is plan


def sheet(name: str, low: tuple[float, float, float], high: tuple[float, float, float]) -> Part:
    """Returns a wall without thickness: the lower of the two broad faces of a box."""
    part = box(name, low, high)
    thin = int(np.argmin(np.subtract(high, low)))
    level = np.isclose(part.mesh.triangles[:, :, thin], low[thin]).all(axis=1)
    return replace(part, surfaces=(replace(part.surfaces[0], mesh=part.mesh.with_faces(np.flatnonzero(level))),))


@pytest.mark.parametrize("angle", [0.0, radians(60)])
def test_doors_that_lie_on_walls_without_thickness_are_closed(angle: float):
    walls = [
        sheet("left", (-0.42, -0.25, 0.0), (-0.41, 0.25, 0.72)),
        sheet("right", (0.42, -0.25, 0.0), (0.43, 0.25, 0.72)),
        sheet("bottom", (-0.42, -0.25, 0.0), (0.42, 0.25, 0.01)),
        sheet("top", (-0.42, -0.25, 0.72), (0.42, 0.25, 0.73)),
        sheet("back", (-0.42, 0.25, 0.0), (0.42, 0.26, 0.72)),
    ]
    axes = (OVERLAY, Axis(vec3(0.42, -0.25, 0.0), UPRIGHT))
    ends = (-0.42, -0.002), (0.002, 0.42)
    doors = [box(f"door_{k}", (x0, -0.27, 0.0), (x1, -0.25, 0.72)) for k, (x0, x1) in enumerate(ends)]
    doors = [drawn(door, axis, angle) for door, axis in zip(doors, axes, strict=True)]
    asset = scene(*walls, *doors, joints=tuple(hinged(f"door_{k}", axis) for k, axis in enumerate(axes)))
    assert angles(asset) == pytest.approx({"door_0": angle, "door_1": angle}, abs=TOLERANCE)


@pytest.mark.parametrize("count", [1, 2])
def test_faces_side_by_side_in_one_plane_are_closed_as_they_are_drawn(count: int):
    """Drawn without thickness, and with gaps below and above, a front alone would fit along the side of its case."""
    walls = [
        sheet("left", (-0.42, -0.25, 0.0), (-0.41, 0.25, 0.72)),
        sheet("bottom", (-0.42, -0.25, 0.0), (0.42, 0.25, 0.01)),
        sheet("top", (-0.42, -0.25, 0.72), (0.42, 0.25, 0.73)),
        sheet("back", (-0.42, 0.25, 0.0), (0.42, 0.26, 0.72)),
    ]
    ends = ((-0.42, -0.002), (0.002, 0.42))[:count]
    doors = [sheet(f"door_{k}", (x0, -0.25, 0.035), (x1, -0.24, 0.685)) for k, (x0, x1) in enumerate(ends)]
    axes = (OVERLAY, Axis(vec3(0.42, -0.25, 0.0), UPRIGHT))[:count]
    asset = scene(*walls, *doors, joints=tuple(hinged(f"door_{k}", axis) for k, axis in enumerate(axes)))
    assert (max(angles(asset).values()) > 0) == (count == 1)


@pytest.mark.parametrize(("left", "right"), [(0.5, 0.0), (0.4, 1.2), (pi / 2, pi / 2)])
def test_each_door_of_a_pair_is_closed_by_itself(left: float, right: float):
    assert angles(pair(left, right)) == pytest.approx({"door": left, "door_2": right}, abs=TOLERANCE)


@pytest.mark.parametrize("turn", [0.3, pi / 4, 2.0])
def test_furniture_may_stand_at_any_angle(turn: float):
    T = from_rotation(rotation_matrix(UPRIGHT, turn))
    asset = inset(0.6)
    joints = (hinged(axis=LEFT.transformed(T)),)
    askew = scene(*(turned(part, T) for part in asset.parts), joints=joints)
    assert angles(askew)["door"] == pytest.approx(0.6, abs=TOLERANCE)


def test_the_front_of_a_corner_cabinet_stays_at_its_angle():
    """A door across the corner between two sides of different depth."""
    across = radians(45)
    T = from_rotation(rotation_matrix(UPRIGHT, across))
    asset = inset(0.0)
    door = turned(asset.part("door"), T)
    case = tuple(turned(part, T) for part in CASE)
    wall = box("wall", (-0.9, 0.6, 0.0), (0.9, 0.62, 1.4))  # most of what stands is not turned
    joints = (hinged(axis=LEFT.transformed(T)),)
    assert angles(scene(*case, wall, door, joints=joints)) == {"door": 0.0}


def test_what_lies_in_the_way_leaves_it_open():
    stop = box("stop", (0.1, -0.4, 0.3), (0.2, -0.2, 0.4))
    asset = inset(1.2)
    assert angles(replace(asset, parts=(*asset.parts, stop)))["door"] == 0.0


def test_a_wing_that_closes_nothing_stays():
    panels = [box(f"panel_{k}", (x, -0.01, 0.0), (x + 0.02, 0.01, 1.5)) for k, x in ((1, -0.02), (2, -0.5))]
    wing = drawn(box("door", (0.0, -0.01, 0.0), (0.5, 0.01, 1.5)), Axis(vec3(0.0, 0.0, 0.0), UPRIGHT), 0.7)
    asset = scene(*panels, wing, joints=(hinged(axis=Axis(vec3(0.0, 0.0, 0.0), UPRIGHT)),))
    assert angles(asset) == {"door": 0.0}


@pytest.mark.parametrize("source", [MotionSource.RULE, MotionSource.NETWORK, MotionSource.ANNOTATION])
def test_every_source_of_motions_has_it_closed_first(source: MotionSource):
    made = functionalize(overlay(0.5), source, builtin_gallery())
    (installed,) = made.report.installed
    (closed,) = (step for step in installed.clearances if step.kind == "closed")
    assert closed.amount == pytest.approx(0.5, abs=TOLERANCE)
    (visual,) = (visual for visual in made.object.link("door").visuals if visual.name == "door")
    assert visual.mesh.box.size[1] == pytest.approx(0.02, abs=2e-3)
    assert installed.axis.direction[2] < 0


FLAP = Axis(vec3(0.0, -0.25, 0.02), vec3(1.0, 0.0, 0.0))
LID = Axis(vec3(0.0, 0.26, 0.7), vec3(-1.0, 0.0, 0.0))
TUB = (
    *CASE[:3],
    box("front", (-0.42, -0.26, 0.0), (0.42, -0.25, 0.7)),
    box("back", (-0.42, 0.25, 0.0), (0.42, 0.26, 0.7)),
)


def flap(angle: float) -> Asset:
    """A case whose door drops."""
    door = box("door", (-0.397, -0.25, 0.023), (0.397, -0.23, 0.697))
    return scene(*CASE, drawn(door, FLAP, angle), joints=(hinged(axis=FLAP),))


def chest(angle: float) -> Asset:
    """A tub with a lid on it."""
    lid = box("door", (-0.43, -0.27, 0.701), (0.43, 0.26, 0.72))
    return scene(*TUB, drawn(lid, LID, angle), joints=(hinged(axis=LID),))


@pytest.mark.parametrize("leaf", [flap, chest])
@settings(max_examples=20)
@given(angle=st.floats(radians(6), radians(100)))
def test_a_flap_and_a_lid_that_stand_open_are_closed(leaf, angle: float):
    assert angles(leaf(angle))["door"] == pytest.approx(angle, abs=TOLERANCE)


@pytest.mark.parametrize("leaf", [flap, chest])
def test_a_closed_flap_and_a_closed_lid_stay(leaf):
    assert angles(leaf(0.0)) == {"door": 0.0}


def test_a_flap_before_an_open_case_is_not_turned_into_it():
    """It would fit on the floor of the case, where the boards above cover it."""
    case = (
        *(part for part in CASE if part.id in ("bottom", "back")),
        box("shelf", (-0.4, -0.25, 0.6), (0.4, 0.25, 0.62)),
    )
    leaf = box("door", (-0.397, -0.25, 0.023), (0.397, -0.23, 0.5))
    assert angles(scene(*case, leaf, joints=(hinged(axis=FLAP),))) == {"door": 0.0}


def test_a_leaf_that_hangs_at_a_table_stays():
    top = box("top", (-0.4, -0.25, 0.7), (0.4, 0.25, 0.72))
    legs = [box(f"leg_{k}", (x, -0.2, 0.0), (x + 0.05, 0.2, 0.7)) for k, x in enumerate((-0.35, 0.3))]
    leaf = box("door", (0.402, -0.25, 0.4), (0.422, 0.25, 0.7))
    axis = Axis(vec3(0.41, 0.0, 0.71), vec3(0.0, -1.0, 0.0))
    assert angles(scene(top, *legs, leaf, joints=(hinged(axis=axis),))) == {"door": 0.0}


def test_a_door_that_was_taken_to_open_the_other_way_is_closed_too():
    asset = inset(1.2)
    (request,) = plan_from_annotation(asset).joints
    asked = RealizationPlan((replace(request, axis=request.axis.reversed()),), ())
    (made,) = closed_plan(asked, asset, RealizationConfig()).joints
    assert made.drawn_at == pytest.approx(1.2, abs=TOLERANCE)
    assert made.axis.direction[2] < 0
