"""A door of a building that is drawn without a frame gets one, and turns in it; nothing else does."""

from dataclasses import replace

import numpy as np
import pytest

import grafu
from grafu.additions.door_frame.complete import add_door_frame
from grafu.additions.door_frame.config import DoorFrameConfig
from grafu.additions.step import DeficiencyKind, StepRequest
from grafu.asset.part import Asset
from grafu.joints.building_doors import with_building_doors
from grafu.joints.lone_leaves import lone_leaves_of, with_lone_labels, with_lone_leaf
from grafu.joints.plan import RealizationPlan
from grafu.pipeline.additions import planned_scene
from grafu.pipeline.shown_by_shape import with_labels_by_shape
from grafu.synth.openings.door import drawn_door, make_building_door
from grafu.vocabulary import PartLabel
from judging import swept_collisions
from small_scenes import box, cylinder, scene

LEAF = box("door", (-0.45, -0.02, 0.0), (0.45, 0.02, 2.0))
PANE = replace(box("glass", (-0.3, -0.005, 1.2), (0.3, 0.005, 1.8)), label=PartLabel.MISC)


def knob(side: float):
    return cylinder("handle", ((side * 0.38, -0.08, 1.0), (side * 0.38, -0.02, 1.0)), 0.02)


def alone(*more, leaf=LEAF) -> Asset:
    return scene(leaf, *more)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_leaf_that_is_drawn_alone_turns_in_a_frame_about_the_side_away_from_its_handle(side):
    result = grafu.functionalize(alone(knob(side), PANE))
    (joint,) = result.object.joints
    assert joint.child == "door"
    assert np.sign(joint.axis.point[0]) == -side
    assert joint.limits.upper > 1.2
    assert swept_collisions(result.object, joint, 25) == {}
    riding = {visual.name for visual in result.object.link("door").visuals}
    assert {"door", "handle", "glass"} <= riding
    (frame,) = [v for v in result.object.link(result.object.root).visuals if v.name == "door_frame"]
    assert frame.mesh.box.low[0] < LEAF.box.low[0]
    assert frame.mesh.box.high[2] > LEAF.box.high[2]
    assert result.report.verdict.colour == "green"
    assert "door frame" in [one.style for one in result.report.added]


def test_without_it_the_lack_is_stated_and_the_leaf_stays():
    result = grafu.functionalize(alone(knob(1.0)), door_frame=False)
    assert result.object.joints == ()
    assert "door frame" in {one.kind for one in result.report.deficiencies}
    assert result.report.verdict.colour == "red"


OTHERS = {
    "a low board": alone(knob(1.0), leaf=box("door", (-0.3, -0.02, 0.0), (0.3, 0.02, 1.2))),
    "a post beside it": alone(knob(1.0), box("post", (0.5, -0.05, 0.0), (0.6, 0.05, 2.0))),
    "a leaf that lies": alone(leaf=box("door", (-0.45, -1.0, 0.0), (0.45, 1.0, 0.04))),
    "no door": alone(leaf=replace(LEAF, label=PartLabel.MISC)),
    "a door in its frame": make_building_door(drawn_door(np.random.default_rng(1), "door")).without_annotation(),
}


@pytest.mark.parametrize("what", OTHERS)
def test_nothing_else_gets_one(what):
    asset = OTHERS[what]
    assert lone_leaves_of(asset.parts) == ()
    plan = with_lone_leaf(RealizationPlan(), asset)
    assert plan == RealizationPlan()
    made = add_door_frame(planned_scene(asset, plan), StepRequest(plan), DoorFrameConfig())
    assert (made.additions, made.deficiencies) == ((), ())


def test_the_frame_leaves_room_for_what_stands_out_at_a_side():
    lock = replace(box("lock", (0.44, -0.03, 0.95), (0.47, 0.03, 1.05)), label=PartLabel.MISC)
    asset = alone(knob(1.0), lock)
    plan = with_lone_leaf(RealizationPlan(), asset)
    made = add_door_frame(planned_scene(asset, plan), StepRequest(plan), DoorFrameConfig())
    (added,) = made.additions
    triangles = added.part.mesh.triangles.reshape(-1, 3)
    inner = triangles[(triangles[:, 0] > 0) & (triangles[:, 2] < 1.9)][:, 0].min()
    assert inner == pytest.approx(0.473)
    assert {d.kind for d in made.deficiencies} == {DeficiencyKind.DOOR_FRAME}
    assert added.part.mesh.box.size[1] == pytest.approx(0.1)


def test_a_leaf_in_a_slim_frame_keeps_its_joint():
    """The frame ends 3 cm beside the leaf, as near as a lock: it is not on the leaf."""
    jambs = [box(f"jamb_{k}", (x, -0.05, 0.0), (x + 0.03, 0.05, 2.05)) for k, x in enumerate((-0.48, 0.45))]
    head = box("head", (-0.48, -0.05, 2.0), (0.48, 0.05, 2.05))
    frame = replace(head, id="frame", surfaces=tuple(s for part in (*jambs, head) for s in part.surfaces))
    leaf = replace(LEAF, id="board", label=PartLabel.UNKNOWN)
    asset = with_labels_by_shape(scene(frame, leaf, cylinder("grip", ((0.38, -0.08, 1.0), (0.38, -0.02, 1.0)), 0.02)))
    assert (asset.part("board").label, asset.part("board").labelled_by) == (PartLabel.DOOR, "shape")
    plan = with_building_doors(RealizationPlan(), asset)
    assert [request.moving for request in plan.joints] == ["board"]
    assert "frame" not in plan.joints[0].attached
    assert with_lone_leaf(plan, asset) is plan


def nameless(*parts) -> Asset:
    return scene(*(replace(part, label=PartLabel.UNKNOWN, labelled_by="none") for part in parts))


def pair(gap: float = 0.004, wide: float = 0.9, narrow: float = 0.4, name: str = "board"):
    """Two leaves side by side, the left one wider."""
    return (
        box(f"{name}_0", (-wide, -0.02, 0.0), (0.0, 0.02, 2.0)),
        box(f"{name}_1", (gap, -0.02, 0.0), (gap + narrow, 0.02, 2.0)),
    )


LEVER = cylinder("a", ((-0.06, -0.07, 1.0), (-0.06, -0.02, 1.0)), 0.02)
OTHER_LEVER = cylinder("b", ((-0.06, 0.02, 1.0), (-0.06, 0.07, 1.0)), 0.02)
SHIELD = box("c", (-0.09, -0.025, 0.9), (-0.03, -0.02, 1.15))


@pytest.mark.parametrize(
    "asset",
    [
        pytest.param(nameless(*pair(), LEVER, OTHER_LEVER, SHIELD), id="nameless"),
        pytest.param(scene(*pair(name="door"), LEVER, OTHER_LEVER, SHIELD), id="named"),
    ],
)
def test_a_pair_of_leaves_turns_about_its_outer_edges_in_one_frame(asset):
    result = grafu.functionalize(asset)
    joints = {joint.child[-1]: joint for joint in result.object.joints}
    assert set(joints) == {"0", "1"}
    assert joints["0"].axis.point[0] < -0.8
    assert joints["1"].axis.point[0] > 0.3
    assert all(joint.limits.upper > 1.2 for joint in joints.values())
    assert {"a", "b", "c"} <= {visual.name for visual in result.object.link(joints["0"].child).visuals}
    (frame,) = [v for v in result.object.link(result.object.root).visuals if v.name == "door_frame"]
    assert frame.mesh.box.low[0] < -0.9
    assert frame.mesh.box.high[0] > 0.404


def test_a_nameless_leaf_is_grasped_from_both_sides():
    leaf = pair()[0]
    (found,) = lone_leaves_of(with_lone_labels(nameless(leaf, LEVER, OTHER_LEVER)).parts)
    assert (found.id, found.labelled_by) == ("board_0", "shape")


NO_LEAVES = {
    "a mirror with a hook": nameless(pair()[0], LEVER),
    "a screen of two": nameless(*pair()),
    "a board with a lamp on it": nameless(*pair(), cylinder("a", ((-0.06, -0.07, 1.7), (-0.06, -0.02, 1.7)), 0.02)),
    "two boards apart": nameless(*pair(gap=0.1), LEVER, OTHER_LEVER),
    "two low boards": nameless(*(box(p.id, p.box.low, (*p.box.high[:2], 1.2)) for p in pair()), LEVER, OTHER_LEVER),
    "doors of a cabinet": nameless(*pair(), LEVER, box("case", (-0.9, 0.02, 0.0), (0.404, 0.6, 2.0))),
    "a board that has another name": scene(*(replace(p, label=PartLabel.SIDE_PANEL) for p in pair()), LEVER),
}


@pytest.mark.parametrize("what", NO_LEAVES)
def test_no_other_boards_are_taken_for_leaves(what):
    asset = NO_LEAVES[what]
    assert with_lone_labels(asset) is asset
