"""Arms and stays that the input draws: they carry a flap, are replaced, stay in place, or are left out."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest

import grafu
from fold_judge import cuts, opened
from grafu.articulation.kinematics import link_poses
from grafu.asset.part import Asset, PartSource
from grafu.geometry.axis import Axis
from grafu.joints.bars import bars_of
from grafu.joints.drawn_arm_config import DrawnArmConfig
from grafu.joints.drawn_arms import with_drawn_arms
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.plan import MotionRole
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.case.construction import Base
from grafu.synth.fronts.gliding import Lift
from grafu.synth.fronts.layout import Door
from grafu.synth.pieces.shapes import rod
from small_scenes import cylinder

CASE = Case(0.9, 0.4, 0.35, base=Base("none"))
LIFT = make_cabinet(Cabinet(case=CASE, layout=Lift(handle="none")))
FLAP = make_cabinet(Cabinet(case=CASE, layout=Door("top", handle="none")))


def with_rods(asset: Asset, *names: str, start: tuple[float, float], end: tuple[float, float]) -> Asset:
    """Returns the asset with a rod beside either wall, between two places (y, z)."""
    rods = [cylinder(name, ((x, *start), (x, *end)), 0.005) for name, x in zip(names, (-0.41, 0.41), strict=True)]
    return replace(asset, parts=(*asset.parts, *rods))


def renamed(asset: Asset, **names: str) -> Asset:
    parts = (replace(p, source=PartSource(names[p.id])) if p.id in names else p for p in asset.parts)
    return replace(asset, parts=tuple(parts))


def require_lifted(result: grafu.Result) -> None:
    """Raises AssertionError unless the flap rises upright on the drawn arms, and nothing collides."""
    made = result.object
    lead, follow = made.joint_of["lift_arms"], made.joint_of["door"]
    assert (lead.parent, follow.parent) == (made.root, "lift_arms")
    assert (follow.coupling.leader, follow.coupling.multiplier) == (lead.id, 1.0)
    assert not any(v.name.startswith(("hinge_", "support_")) for link in made.links for v in link.visuals)
    for ratio in (0.0, 0.3, 0.7, 1.0):
        T = link_poses(made, opened(made, ratio))["door"]
        np.testing.assert_allclose(T[:3, :3], np.eye(3), atol=1e-9)
        assert cuts(made, opened(made, ratio), frozenset()) == set()
    assert T[2, 3] > 0.4 * result.asset.part("door").box.size[2]
    assert {result.joint(part).template for part in ("lift_arms", "door")} == {"drawn"}


def test_stated_arms_carry_the_flap():
    require_lifted(grafu.functionalize(LIFT, motion="annotation"))


def test_arms_carry_a_flap_that_is_to_rise_upright_though_no_joint_is_stated():
    require_lifted(grafu.functionalize(LIFT, motion="rule", motions={"door": "lift-parallel"}))


def test_arms_that_are_not_called_so_are_found_by_shape():
    plain = renamed(LIFT, lift_arms="Cube.001")
    result = grafu.functionalize(plain, motion="rule", motions={"door": "lift-parallel"})
    assert result.object.joint_of["door"].parent == "lift_arms"


def test_without_a_coupling_arms_are_those_that_are_shown():
    free = replace(LIFT, joints=tuple(replace(joint, coupling=None) for joint in LIFT.joints))
    plan = with_drawn_arms(plan_from_annotation(free), free)
    (arms,) = plan.arms
    (request,) = plan.joints
    stated = {joint.part: joint.axis for joint in LIFT.joints}

    assert (request.moving, request.role, request.parent) == ("door", MotionRole.LIFTED, "")
    for found, true in ((arms.on_case, stated["lift_arms"]), (arms.on_flap, stated["door"])):
        assert abs(float(found.direction @ true.direction)) == pytest.approx(1.0)
        assert found.distance_to(true.point) < 0.002


def test_arms_that_are_stated_to_turn_where_they_cannot_are_replaced():
    deep = Axis(np.array([0.0, 0.1, 0.3]), np.array([-1.0, 0.0, 0.0]))
    joints = tuple(replace(joint, axis=deep) if joint.part == "lift_arms" else joint for joint in LIFT.joints)
    result = grafu.functionalize(replace(LIFT, joints=joints), motion="annotation")

    assert "lift_arms" not in result.object.joint_of
    assert result.object.joint_of["door"].parent == "door_arms"
    assert [part.link for part in result.report.parts if part.id == "lift_arms"] == [""]
    assert "the drawn lift_arms are replaced" in result.joint("door").notes


@pytest.mark.parametrize("names", [("gas_strut_left", "gas_strut_right"), ("Cylinder", "Cylinder_1")])
def test_drawn_stays_of_a_flap_are_replaced_by_stays_that_move(names):
    asset = with_rods(FLAP, *names, start=(-0.1, 0.33), end=(-0.155, 0.2))
    result = grafu.functionalize(asset, motion="annotation")
    shown = {v.name for link in result.object.links for v in link.visuals}

    assert result.joint("door").collision_share == 0.0
    assert result.joint("door").stays == 2
    assert shown.isdisjoint(names)
    assert any("are replaced" in note for note in result.joint("door").notes)


def test_drawn_stays_that_the_flap_clears_stay_where_none_are_built():
    names = ("gas_strut_left", "gas_strut_right")
    asset = with_rods(FLAP, *names, start=(-0.1, 0.33), end=(-0.155, 0.2))
    result = grafu.functionalize(asset, motion="annotation", stays=False)
    assert {v.name for v in result.object.link("body").visuals} >= {*names}


def test_posts_rails_and_rods_are_no_arms():
    level = with_rods(FLAP, "a", "b", start=(-0.155, 0.2), end=(0.1, 0.2))
    far = with_rods(FLAP, "a", "b", start=(0.15, 0.1), end=(0.1, 0.3))
    for asset in (level, far, FLAP):
        assert with_drawn_arms(plan_from_annotation(asset), asset).arms == ()


def test_bars_have_their_ends_and_widths():
    (bar,) = bars_of(rod(np.array([0.0, 0.1, 0.5]), np.array([0.0, 0.0, 0.1]), 0.01, 12), 5.0)
    np.testing.assert_allclose(bar.start, [0.0, 0.0, 0.1], atol=2e-3)
    np.testing.assert_allclose(bar.end, [0.0, 0.1, 0.5], atol=2e-3)
    assert bar.width == pytest.approx(0.02, abs=2e-3)
    assert not list(bars_of(rod(np.zeros(3), np.array([0.0, 0.0, 0.03]), 0.01), 5.0))


def test_what_makes_no_sense_is_refused():
    with pytest.raises(ValueError, match="above 0"):
        DrawnArmConfig(slim=0.0)
    with pytest.raises(ValueError, match="within its opening"):
        Lift(rise=1.5, start=0.3)
    assert Lift().angle < radians(90)
