"""Two leaves above each other that fold up: the upper one on the case, the lower one on it, coupled."""

from dataclasses import replace
from math import degrees, radians

import numpy as np
import pytest

import grafu
from fold_judge import cuts, cutting_over_sweep, loose, opened, pairs_of
from grafu.articulation.articulated_object import Coupling
from grafu.articulation.kinematics import link_poses
from grafu.articulation.physics import physics_of
from grafu.asset.part import AnnotatedJoint, Asset, PartSource
from grafu.errors import OptionError
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.motion_choice import MotionChoice, Moves, Side
from grafu.pipeline.motion_choices import motions_of
from grafu.pipeline.move_options import move_options
from grafu.synth.cabinets.wall_units import WallUnit, make_wall_unit
from grafu.vocabulary import JointType

UNIT = WallUnit(leaves=2)


def folded(asset: Asset, motions: dict[str, str] | None = None) -> grafu.Result:
    return grafu.functionalize(asset, motion="rule", motions=motions)


@pytest.fixture(scope="module")
def result() -> grafu.Result:
    return folded(make_wall_unit(UNIT), {"door_2": "fold-up"})


def require_folded(result: grafu.Result) -> None:
    """Raises AssertionError unless the lower leaf follows the upper one up, and nothing collides or is loose."""
    made = result.object
    ((upper, lower),) = pairs_of(made)

    assert (upper.child, lower.child, lower.parent) == ("door_1", "door_2", "door_1")
    assert lower.coupling.multiplier == 2.0
    assert 80 < degrees(upper.limits.upper) < 90
    top, bottom = (np.append(result.asset.part(name).box.center, 1.0) for name in ("door_1", "door_2"))
    poses = link_poses(made, opened(made, 1.0))
    assert (poses["door_2"] @ bottom)[2] > (poses["door_1"] @ top)[2] - 0.1
    assert cutting_over_sweep(made) | cuts(made, opened(made, 0.0)) == set()
    assert loose(result) == set()
    assert not any("track" in v.name for link in made.links for v in link.visuals)


def test_the_lower_leaf_folds_up_below_the_upper_one(result):
    require_folded(result)


def test_inset_leaves_fold_up_as_well():
    require_folded(folded(make_wall_unit(replace(UNIT, mount="inset", gap=0.002)), {"door_1": "fold-up"}))


def test_leaves_above_each_other_that_are_called_folding_fold_up():
    asset = make_wall_unit(UNIT)
    named = (replace(p, source=PartSource(f"bifold_{p.id}")) if p.id.startswith("door") else p for p in asset.parts)

    require_folded(folded(replace(asset, parts=tuple(named))))


def test_others_above_each_other_turn_by_themselves():
    assert pairs_of(folded(make_wall_unit(UNIT)).object) == []


def test_the_weight_of_both_leaves_is_held(result):
    made, physics = result.object, physics_of(result.object)
    upper = next(joint for joint in made.joints if joint.child == "door_1")
    dynamics = physics.dynamics[upper.id]

    assert dynamics.counterbalance is not None
    center = dynamics.counterbalance.center
    height = float(result.asset.part("door_1").box.size[2])
    assert 0.8 * height < upper.axis.distance_to(center) < 1.2 * height  # of two like leaves the seam's height


def test_it_is_read_back_as_what_was_stated(result):
    fold = MotionChoice(Moves.FOLDS, Side.TOP)

    assert motions_of(result.object) == {"door_1": fold, "door_2": fold}
    assert move_options(result.made)["door_1"] == ("--move door_1=lift", "--move door_1=fixed")


def test_a_flap_alone_cannot_fold_up():
    with pytest.raises(OptionError, match="none stands above or below it"):
        folded(make_wall_unit(WallUnit()), {"door": "fold-up"})


def test_stated_leaves_whose_lower_one_ends_at_the_floor_fold_up_as_far_as_is_stated():
    """The stated axis lies on the backs of the leaves; a front corner sinks a little as the lower one turns alone."""
    asset = make_wall_unit(UNIT)
    upper, lower = asset.part("door_1"), asset.part("door_2")
    down = lower.mesh.vertices[:, 2:] < lower.box.center[2]
    sunk = TriangleMesh(np.where(down, lower.mesh.vertices * (1.0, 1.0, 0.0), lower.mesh.vertices), lower.mesh.faces)
    leaf = replace(lower, surfaces=(replace(lower.surfaces[0], mesh=sunk),), carried_by="door_1")
    top = vec3(0.0, float(upper.box.low[1]), float(upper.box.high[2]))
    seam = vec3(0.0, float(lower.box.high[1]), float(lower.box.high[2]))
    joints = (
        AnnotatedJoint("door_1", JointType.REVOLUTE, Axis(top, vec3(-1.0, 0.0, 0.0)), 0.0, radians(85)),
        AnnotatedJoint(
            "door_2",
            JointType.REVOLUTE,
            Axis(seam, vec3(1.0, 0.0, 0.0)),
            0.0,
            radians(170),
            coupling=Coupling("door_1", 2.0, 0.0),
        ),
    )
    parts = tuple(leaf if part.id == "door_2" else part for part in asset.parts)

    made = grafu.functionalize(replace(asset, parts=parts, joints=joints), motion="annotation").object

    joint_of = made.joint_of
    assert degrees(joint_of["door_1"].limits.upper) == pytest.approx(85, abs=0.5)
    assert joint_of["door_2"].coupling.multiplier == 2.0
    assert cutting_over_sweep(made) | cuts(made, opened(made, 0.0)) == set()
