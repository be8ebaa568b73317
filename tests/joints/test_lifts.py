"""What slides up: desks on lifting columns, found by shape or stated, sashes and shutters in tracks."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.part import Asset
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.graph.edges import Contact
from grafu.graph.parse import parse_graph
from grafu.joints.lifts import with_lifts
from grafu.joints.motion_choice import MotionChoice, Moves, Side
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.pipeline.shown_by_shape import shown_by_shape
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType
from judging import hardware, installed, realized, swept_collisions
from small_scenes import box, scene, sliding

WALL = 0.01


def sleeve(name, x, walls=4):
    """The walls of a sleeve of 0.1 x 0.08 m around x, 0.5 m high, on a foot."""
    sides = [
        box(f"{name}_left", (x - 0.05 - WALL, -0.04, 0.04), (x - 0.05, 0.04, 0.5)),
        box(f"{name}_right", (x + 0.05, -0.04, 0.04), (x + 0.05 + WALL, 0.04, 0.5)),
        box(f"{name}_front", (x - 0.06, -0.04 - WALL, 0.04), (x + 0.06, -0.04, 0.5)),
        box(f"{name}_back", (x - 0.06, 0.04, 0.04), (x + 0.06, 0.04 + WALL, 0.5)),
    ]
    return [box(f"{name}_foot", (x - 0.08, -0.35, 0.0), (x + 0.08, 0.35, 0.04)), *sides[:walls]]


def desk(walls=4, low=0.12, joints=()) -> Asset:
    """A desk of 1.4 x 0.7 m on two columns, which stand in sleeves from 0.04 to 0.5 m, with a drawer under its top."""
    columns = [box(f"tube_{k}", (x - 0.048, -0.038, low), (x + 0.048, 0.038, 0.7)) for k, x in enumerate((-0.5, 0.5))]
    top = [
        box("desktop", (-0.7, -0.35, 0.7), (0.7, 0.35, 0.73)),
        box("runner_left", (-0.3, -0.3, 0.6), (-0.28, 0.2, 0.7)),
        box("runner_right", (0.28, -0.3, 0.6), (0.3, 0.2, 0.7)),
    ]
    drawer = box("drawer", (-0.265, -0.34, 0.6), (0.265, 0.15, 0.68))
    sleeves = [*sleeve("sleeve_0", -0.5, walls), *sleeve("sleeve_1", 0.5, walls)]
    return scene(*sleeves, *columns, *top, drawer, joints=joints)


def by_rule(asset, **motions):
    config = PipelineConfig(Settings(motions=motions))
    return functionalize(asset, MotionSource.RULE, builtin_gallery(), config)


def test_a_desk_on_lifting_columns_rises_with_all_that_it_carries():
    made = by_rule(desk())
    joints = made.object.joint_of
    leader, follower, drawer = joints["tube_0"], joints["tube_1"], joints["drawer"]

    assert np.allclose(leader.axis.direction, (0, 0, 1))
    assert follower.coupling is not None
    assert (follower.coupling.leader, follower.coupling.multiplier) == (leader.id, 1.0)
    assert leader.limits.upper == follower.limits.upper > 0.3
    assert drawer.parent == "tube_0"
    carried = {visual.name for visual in made.object.link("tube_0").visuals}
    assert {"tube_0", "desktop", "runner_left", "runner_right"} <= carried
    assert not carried & {part.id for part in made.asset.parts if part.id.startswith("sleeve")}
    assert swept_collisions(made.object, leader, 20) == {}


def test_columns_need_no_handle():
    made = by_rule(desk())
    assert {made.fittings.grasps[name].kind for name in ("tube_0", "tube_1")} == {"driven"}
    assert not [addition for addition in made.additions if addition.part.carried_by in ("tube_0", "tube_1")]


@pytest.mark.parametrize("still", [desk(walls=2), desk(walls=3), desk(low=0.0)])
def test_posts_without_a_sleeve_all_around_or_on_the_floor_stand_still(still):
    assert set(by_rule(still).object.joint_of) <= {"drawer"}


def test_a_post_in_a_sleeve_that_carries_no_top_stands_still():
    lamp = scene(*sleeve("sleeve", 0.0), box("post", (-0.048, -0.038, 0.12), (0.048, 0.038, 0.7)))
    assert not by_rule(lamp).object.joints


def test_a_user_may_fix_what_would_lift():
    made = by_rule(desk(), tube_0=MotionChoice(Moves.FIXED), tube_1=MotionChoice(Moves.FIXED))
    assert {joint.child for joint in made.object.joints} == {"drawer"}
    assert made.object.joint_of["drawer"].parent == made.object.root


def test_the_same_desk_ten_times_as_large_lifts_too():
    asset = desk()
    T = np.diag([10.0, 10.0, 10.0, 1.0])
    parts = tuple(replace(p, surfaces=tuple(s.transformed(T) for s in p.surfaces)) for p in asset.parts)
    plain, large = by_rule(asset), by_rule(replace(asset, parts=parts))
    assert large.object.joint_of.keys() == plain.object.joint_of.keys()


def shutter(joints=()) -> Asset:
    """A case of 0.6 x 0.4 x 1.6 m with a board of 0.7 m before its lower half."""
    shell = [
        box("side_left", (-0.32, -0.2, 0.0), (-0.3, 0.2, 1.6)),
        box("side_right", (0.3, -0.2, 0.0), (0.32, 0.2, 1.6)),
        box("back", (-0.3, 0.19, 0.0), (0.3, 0.2, 1.6)),
    ]
    return scene(*shell, box("door_sash", (-0.297, -0.18, 0.02), (0.297, -0.16, 0.72)), joints=joints)


def test_a_sash_slides_up_in_tracks_on_both_sides():
    result = realized(shutter((sliding("door_sash", (0.0, 0.0, 1.0), 0.6),)))
    made = installed(result)["door_sash"]
    moving, still = hardware(result, "door_sash")

    assert made.opening == pytest.approx(0.525, abs=0.08)
    assert made.count == 2
    assert swept_collisions(result.object, result.object.joint_of["door_sash"], 40) == {}
    assert sorted(np.sign(round(v.mesh.box.center[0], 3)) for v in still) == [-1, 1]
    assert len(moving) == 2


def test_a_user_may_let_a_part_slide_up():
    made = functionalize(
        shutter(),
        MotionSource.RULE,
        builtin_gallery(),
        PipelineConfig(Settings(motions={"door_sash": MotionChoice(Moves.SLIDES, Side.TOP)})),
    )
    joint = made.object.joint_of["door_sash"]
    assert np.allclose(joint.axis.direction, (0, 0, 1))
    assert joint.limits.upper > 0.4


def seat(screw: float = 0.1) -> Asset:
    """A seat of a board on a frame of four, 0.45 m high on legs; screws come up through the frame into the board."""
    corners = [(x, y) for x in ENDS for y in ENDS]
    legs = [box(f"leg_{x}{y}", (x - 0.03, y - 0.03, 0.0), (x + 0.03, y + 0.03, 0.36)) for x, y in corners]
    sides = [(end + out - 0.01, end + out + 0.01) for end in ENDS for out in (-0.02, 0.02)]
    rails = [box(f"rail_{low}", (-0.3, low, 0.36), (0.3, high, 0.42)) for low, high in sides]
    ties = [box(f"tie_{low}", (low, -0.3, 0.36), (high, 0.3, 0.42)) for low, high in sides]
    below = 0.46 - screw
    screws = [box(f"screw_{x}{y}", (x - 0.01, y - 0.01, below), (x + 0.01, y + 0.01, 0.46)) for x, y in corners]
    return scene(*legs, *rails, *ties, *screws, box("board", (-0.32, -0.32, 0.45), (0.32, 0.32, 0.47)))


ENDS = (-0.25, 0.25)


def lifted(asset: Asset) -> set[str]:
    return {request.moving for request in with_lifts(RealizationPlan(), parse_graph(asset)).joints}


def test_screws_in_a_frame_below_a_seat_are_no_columns():
    assert not lifted(seat())


def test_posts_in_the_same_frame_that_are_long_enough_are():
    assert len(lifted(seat(screw=0.15))) == 4


def test_what_was_only_predicted_to_be_missing_is_not_lifted():
    asset = desk()
    graph = parse_graph(asset)
    ghost = replace(graph.node("desktop"), id="top_panel_added_1")
    touching = tuple(Contact(ghost.id, f"tube_{k}") for k in (0, 1))
    completed = replace(graph, nodes=(*graph.nodes, ghost), edges=(*graph.edges, *touching))
    plan, _ = shown_by_shape(RealizationPlan(), asset, completed, PipelineConfig().joints)
    assert {request.moving for request in plan.joints} == {"tube_0", "tube_1"}
    assert {part for request in plan.joints for part in request.attached} <= {part.id for part in asset.parts}


@pytest.mark.parametrize(
    ("mounts", "rides"), [(("runner_left", "sleeve_1_left"), True), (("sleeve_0_right", "sleeve_1_left"), False)]
)
def test_of_the_mounts_of_a_drawer_the_nearest_ones_tell_whether_it_rises(mounts, rides):
    axis = Axis(vec3(0.0, 0.0, 0.64), vec3(0.0, -1.0, 0.0))
    drawer = JointRequest("drawer", JointType.PRISMATIC, axis, "network", mounts=mounts)
    plan = with_lifts(RealizationPlan((drawer,)), parse_graph(desk()))
    (found,) = (request for request in plan.joints if request.moving == "drawer")
    assert found.parent == ("tube_0" if rides else "")
