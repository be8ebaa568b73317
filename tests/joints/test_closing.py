"""Drawers that are drawn open are closed first, whoever states their joints; all others stay as they are drawn."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.asset.part import Asset, Part
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.transform import from_rotation, rotation_matrix, translation
from grafu.joints.closing import closed_plan
from grafu.joints.config import RealizationConfig
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.plan import JointChoice, RealizationPlan
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.templates.gallery import builtin_gallery
from small_scenes import box, hinged, scene, sliding

FORWARD = (0.0, -1.0, 0.0)
CASE = (
    box("side_left", (-0.23, -0.25, 0.0), (-0.21, 0.25, 0.4)),
    box("side_right", (0.21, -0.25, 0.0), (0.23, 0.25, 0.4)),
    box("bottom", (-0.21, -0.25, 0.0), (0.21, 0.25, 0.02)),
    box("shelf", (-0.21, -0.25, 0.19), (0.21, 0.25, 0.21)),
    box("top", (-0.23, -0.25, 0.4), (0.23, 0.25, 0.42)),
    box("back", (-0.23, 0.25, 0.0), (0.23, 0.26, 0.42)),
)
TOLERANCE = 2e-3  # metres


def drawer(name: str, low: float, opened: float, front: float = 0.0) -> Part:
    """A drawer whose front is level with the case; with a `front` it overlays the case by its thickness."""
    body = box(name, (-0.2, -0.25, low), (0.2, 0.2, low + 0.15))
    board = box(name, (-0.225, -0.25 - front, low - 0.02), (0.225, -0.25, low + 0.168))
    meshes = [body.mesh, board.mesh] if front else [body.mesh]
    return moved(replace(body, surfaces=(Surface(merge_meshes(meshes)),)), translation(np.array([0.0, -opened, 0.0])))


def moved(part: Part, T: np.ndarray) -> Part:
    return replace(part, surfaces=tuple(surface.transformed(T) for surface in part.surfaces))


def opening_of(asset: Asset, name: str = "drawer") -> float:
    """How far open the drawer is found to be drawn, metres."""
    plan = closed_plan(plan_from_annotation(asset), asset, RealizationConfig())
    return next(request.drawn_at for request in plan.joints if request.moving == name)


def furniture(*drawers: Part, more: tuple[Part, ...] = ()) -> Asset:
    return scene(*CASE, *more, *drawers, joints=tuple(sliding(part.id, FORWARD) for part in drawers))


@pytest.mark.parametrize("front", [0.0, 0.018])
@given(opened=st.floats(0.03, 0.3))
def test_an_open_drawer_is_closed_against_its_case_or_level_with_it(front: float, opened: float):
    assert opening_of(furniture(drawer("drawer", 0.03, opened, front))) == pytest.approx(opened, abs=TOLERANCE)


@pytest.mark.parametrize("front", [0.0, 0.018])
@pytest.mark.parametrize("opened", [0.0, 0.004])
def test_a_closed_drawer_stays(front: float, opened: float):
    asset = furniture(drawer("drawer", 0.03, opened, front))
    plan = plan_from_annotation(asset)
    assert closed_plan(plan, asset, RealizationConfig()) is plan


def test_a_drawer_that_could_be_pushed_deeper_than_its_case_is_closed_as_it_is():
    short = box("drawer", (-0.2, -0.25, 0.03), (0.2, 0.0, 0.18))  # a quarter of a metre is free behind it
    assert opening_of(furniture(short)) == 0.0


def test_an_open_drawer_is_closed_level_with_one_of_its_size():
    two = (drawer("drawer", 0.03, 0.0), drawer("drawer_2", 0.22, 0.13))
    bare = scene(*CASE[:2], CASE[-1], *two, joints=tuple(sliding(part.id, FORWARD) for part in two))
    assert opening_of(bare, "drawer_2") == pytest.approx(0.13, abs=TOLERANCE)
    assert opening_of(bare) == 0.0


def test_a_front_in_the_plane_of_closed_fronts_around_it_stays():
    """The case stands back behind all fronts, and what moves beside a drawer is level with it."""
    beside = [
        box(f"door_{k}", (s * 0.33 - 0.12, -0.25, 0.0), (s * 0.33 + 0.12, -0.23, 0.42)) for k, s in ((1, -1), (2, 1))
    ]
    back = tuple(moved(part, translation(np.array([0.0, 0.06, 0.0]))) for part in CASE)
    joints = (
        sliding("drawer", FORWARD),
        *(hinged(part.id, Axis(part.box.low, vec3(0.0, 0.0, -1.0))) for part in beside),
    )
    closed = drawer("drawer", 0.03, 0.0)
    assert opening_of(scene(*back, closed, joints=joints[:1])) == pytest.approx(0.06, abs=TOLERANCE)
    assert opening_of(scene(*back, *beside, closed, joints=joints)) == 0.0


def test_what_lies_in_the_way_leaves_it_open():
    stop = box("stop", (-0.05, 0.05, 0.05), (0.05, 0.24, 0.15))
    assert opening_of(furniture(drawer("drawer", 0.03, 0.2), more=(stop,))) == 0.0


def test_the_runners_that_it_is_drawn_on_are_not_in_its_way():
    runners = tuple(
        box(f"runner_{k}", (s * 0.205 - 0.01, -0.2, 0.09), (s * 0.205 + 0.01, 0.2, 0.11)) for k, s in ((1, -1), (2, 1))
    )
    assert opening_of(furniture(drawer("drawer", 0.03, 0.15), more=runners)) == pytest.approx(0.15, abs=TOLERANCE)


def test_fronts_drawn_alike_before_their_case_are_closed():
    proud = [
        moved(box(name, (-0.2, -0.25, low), (0.2, 0.2, low + 0.15)), translation(np.array([0.0, -0.03, 0.0])))
        for name, low in (("drawer", 0.03), ("drawer_2", 0.23))
    ]
    assert opening_of(furniture(*proud)) == 0.0
    assert opening_of(furniture(proud[0])) == pytest.approx(0.03, abs=TOLERANCE)


@given(turn=st.floats(-0.6, 0.6))
def test_furniture_may_stand_at_any_angle(turn: float):
    T = from_rotation(rotation_matrix(np.array([0.0, 0.0, 1.0]), turn))
    parts = tuple(moved(part, T) for part in (*CASE, drawer("drawer", 0.03, 0.12, 0.018)))
    direction = tuple(float(x) for x in T[:3, :3] @ np.array(FORWARD))
    asset = scene(*parts, joints=(sliding("drawer", direction),))
    assert opening_of(asset) == pytest.approx(0.12, abs=TOLERANCE)


def test_what_a_request_states_stays():
    asset = furniture(drawer("drawer", 0.03, 0.15))
    plan = plan_from_annotation(asset)
    stated = RealizationPlan(tuple(replace(r, drawn_at=0.05) for r in plan.joints))
    assert closed_plan(stated, asset, RealizationConfig()) is stated


def test_the_opening_counts_from_closed_unless_it_was_chosen():
    asset = furniture(drawer("drawer", 0.03, 0.15))
    plan = plan_from_annotation(asset)
    chosen = RealizationPlan(tuple(replace(r, choice=JointChoice(opening=0.2), reference=0.2) for r in plan.joints))
    config = RealizationConfig()
    assert closed_plan(plan, asset, config).joints[0].reference == pytest.approx(0.45, abs=TOLERANCE)
    assert closed_plan(chosen, asset, config).joints[0].reference == 0.2


@pytest.mark.parametrize("source", [MotionSource.RULE, MotionSource.NETWORK, MotionSource.ANNOTATION])
def test_every_source_of_motions_has_it_closed_first(source: MotionSource):
    made = functionalize(furniture(drawer("drawer", 0.03, 0.15, 0.018)), source, builtin_gallery())
    (installed,) = made.report.installed
    (closed,) = (step for step in installed.clearances if step.kind == "closed")
    assert closed.amount == pytest.approx(0.15, abs=TOLERANCE)
    (drawn,) = (visual for visual in made.object.link("drawer").visuals if visual.name == "drawer")
    assert drawn.mesh.box.low[1] == pytest.approx(-0.268, abs=TOLERANCE)
