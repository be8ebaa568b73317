import numpy as np
import pytest

from grafu.asset.edit import mirrored, yawed
from grafu.asset.part import Asset
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.joints.sliding_doors import with_sliding_doors
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType
from judging import hardware, installed, realized, swept_collisions
from small_scenes import box, scene, sliding


def two_sliding_doors(gap: float, stated: bool = True, lap: float = 0.02, behind_by: float = 0.022) -> Asset:
    """A case of 1.2 x 0.5 x 0.8 m with two doors that slide past one another between its top and bottom.

    They reach `lap` beyond the middle; the second stands `behind_by` behind the first.
    """
    shell = [
        box("side_left", (-0.6, -0.25, 0.0), (-0.58, 0.25, 0.8)),
        box("side_right", (0.58, -0.25, 0.0), (0.6, 0.25, 0.8)),
        box("bottom", (-0.58, -0.25, 0.0), (0.58, 0.25, 0.02)),
        box("top", (-0.58, -0.25, 0.78), (0.58, 0.25, 0.8)),
        box("back", (-0.58, 0.24, 0.02), (0.58, 0.25, 0.78)),
    ]
    front = box("door_front", (-0.58 + gap, -0.25, 0.02 + gap), (lap, -0.232, 0.78 - gap))
    y = -0.25 + behind_by
    behind = box("door_behind", (-lap, y, 0.02 + gap), (0.58 - gap, y + 0.018, 0.78 - gap))
    joints = (sliding("door_front", (1.0, 0.0, 0.0), 0.5), sliding("door_behind", (-1.0, 0.0, 0.0), 0.5))
    return scene(*shell, front, behind, joints=joints if stated else ())


def by_rule(asset: Asset):
    return functionalize(asset, MotionSource.RULE, builtin_gallery()).object.joint_of


@pytest.mark.parametrize("gap", [0.001, 0.003, 0.01])
def test_sliding_doors_run_on_tracks_above_and_below(gap):
    result = realized(two_sliding_doors(gap))
    made = installed(result)

    assert set(made) == {"door_front", "door_behind"}
    for name, outcome in made.items():
        joint = result.object.joint_of[name]
        moving, still = hardware(result, name)
        assert outcome.opening >= 0.7 * 0.5
        assert abs(joint.axis.direction[0]) == pytest.approx(1.0)
        assert swept_collisions(result.object, joint, 50) == {}
        assert min(v.mesh.box.low[2] for v in still) < 0.03
        assert max(v.mesh.box.high[2] for v in still) > 0.77
        assert len(moving) == 2


@pytest.mark.parametrize("turn", [lambda a: yawed(a, np.pi / 2), lambda a: mirrored(a, "x")])
def test_tracks_turn_with_the_case(turn):
    plain = installed(realized(two_sliding_doors(0.003)))
    turned = installed(realized(turn(two_sliding_doors(0.003))))
    assert {k: round(v.opening, 3) for k, v in turned.items()} == {k: round(v.opening, 3) for k, v in plain.items()}


@pytest.mark.parametrize("turn", [lambda a: a, lambda a: mirrored(a, "x"), lambda a: yawed(a, np.pi / 2)])
def test_two_leaves_that_overlap_in_two_planes_slide_over_one_another_without_annotation(turn):
    asset = turn(two_sliding_doors(0.003, stated=False))
    joints = by_rule(asset)
    for name, other in (("door_front", "door_behind"), ("door_behind", "door_front")):
        joint, to_other = joints[name], asset.part(other).box.center - asset.part(name).box.center
        assert joint.type is JointType.PRISMATIC
        assert joint.axis.direction @ to_other > 0.5
        assert 0.4 < joint.limits.upper <= 0.56


def test_leaves_that_meet_in_one_plane_turn():
    joints = by_rule(two_sliding_doors(0.003, stated=False, lap=-0.002, behind_by=0.0))
    assert {joint.type for joint in joints.values()} == {JointType.REVOLUTE}


@pytest.mark.parametrize("end", [-0.002, -0.1])
def test_a_door_that_is_called_sliding_turns_where_another_stands_in_its_way(end):
    *shell, front, behind = two_sliding_doors(0.003, stated=False, lap=-0.002, behind_by=0.0).parts
    leaves = [box("sliding_door", tuple(front.box.low), (end, *front.box.high[1:])), behind]
    joints = by_rule(scene(*shell, *leaves))
    assert joints["sliding_door"].type is JointType.REVOLUTE


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("sliding_door", JointType.PRISMATIC),
        ("slidedoor", JointType.PRISMATIC),
        ("door_slidelink", JointType.PRISMATIC),
        ("door", JointType.REVOLUTE),
    ],
)
def test_a_single_door_that_is_called_sliding_slides_to_where_there_is_room(name, kind):
    *shell, front, _ = two_sliding_doors(0.003, stated=False).parts
    leaf = box(name, tuple(front.box.low), tuple(front.box.high))
    joint = by_rule(scene(*shell, leaf))[name]
    assert joint.type is kind
    if kind is JointType.PRISMATIC:
        assert joint.axis.direction[0] == pytest.approx(1.0)


def test_a_leaf_that_passes_through_its_frame_slides_without_tracks():
    frame = [
        box("left", (-0.5, -0.08, 0.0), (-0.45, -0.02, 2.1)),
        box("left_behind", (-0.5, 0.02, 0.0), (-0.45, 0.08, 2.1)),
        box("right", (0.45, -0.08, 0.0), (0.5, 0.08, 2.1)),
        box("lintel", (-0.5, -0.08, 2.1), (0.5, 0.08, 2.15)),
    ]
    leaf = box("door", (-0.45, -0.018, 0.0), (0.44, 0.018, 2.098))
    result = realized(scene(*frame, leaf, joints=(sliding("door", (-1.0, 0.0, 0.0), 0.8),)))
    joint = installed(result)["door"]
    assert joint.type is JointType.PRISMATIC
    assert joint.collision_share == 0
    assert joint.opening >= 0.6


def test_supports_of_a_track_end_where_the_next_leaf_begins():
    shell = [
        box(p.id, (p.box.low[0], -0.2, p.box.low[2]), tuple(p.box.high)) for p in two_sliding_doors(0.003).parts[:5]
    ]
    front = box("door_front", (-0.6, -0.24, 0.003), (0.02, -0.225, 0.797))
    behind = box("door_behind", (-0.02, -0.22, 0.003), (0.6, -0.205, 0.797))
    joints = (sliding("door_front", (1.0, 0.0, 0.0), 0.58), sliding("door_behind", (-1.0, 0.0, 0.0), 0.58))
    result = realized(scene(*shell, front, behind, joints=joints))
    for leaf in (front, behind):
        assert installed(result)[leaf.id].opening > 0.5
        _, still = hardware(result, leaf.id)
        supports = [visual.mesh.box for visual in still if visual.name.startswith("support_")]
        assert supports or leaf is behind
        assert all(
            leaf.box.grown(0.001).low[0] <= b.low[0] <= b.high[0] <= leaf.box.grown(0.001).high[0] for b in supports
        )


def test_a_door_that_slides_beside_nothing_that_stays_is_skipped():
    doors = [part for part in two_sliding_doors(0.003).parts if part.id.startswith("door")]
    joints = (sliding("door_front", (1.0, 0.0, 0.0)), sliding("door_behind", (-1.0, 0.0, 0.0)))
    result = realized(scene(*doors, joints=joints))
    assert {refusal.part for refusal in result.report.skipped} == {"door_front", "door_behind"}


@pytest.mark.parametrize(("name", "kind"), [("barn_door", JointType.PRISMATIC), ("barnwood_door", JointType.REVOLUTE)])
def test_doors_of_barns_slide(name, kind):
    *shell, front, _ = two_sliding_doors(0.003, stated=False).parts
    asset = scene(*shell, box(name, tuple(front.box.low), (-0.05, *front.box.high[1:])))
    assert by_rule(asset)[name].type is kind


@pytest.mark.parametrize("side", [-1, 1])
def test_a_pocket_door_goes_into_its_pocket_and_not_into_the_wall(side):
    def wall(name, low, high, y):
        left, right = sorted((side * low, side * high))
        return box(name, (left, y[0], 0.0), (right, y[1], 2.3))

    pocket = [wall(f"wall_{k}", -1.2, -0.45, y) for k, y in enumerate(((-0.05, -0.03), (0.03, 0.05)))]
    leaf = box("pocket_door", (-0.46, -0.02, 0.01), (0.445, 0.02, 2.0))
    header = box("header", (-0.45, -0.05, 2.05), (0.45, 0.05, 2.3))
    asset = scene(*pocket, wall("wall_2", 0.45, 1.6, (-0.05, 0.05)), header, leaf)
    hinge = JointRequest("pocket_door", JointType.REVOLUTE, Axis(leaf.box.center, vec3(0.0, 0.0, 1.0)), "network")
    (request,) = with_sliding_doors(RealizationPlan((hinge,)), asset).joints
    assert request.type is JointType.PRISMATIC
    assert request.axis.direction[0] == pytest.approx(-side)
