"""Wide open, a door may stand where a neighbour comes out: it opens no wider than leaves that one free."""

from itertools import combinations
from math import radians

import pytest

from grafu.asset.part import Asset
from grafu.geometry.intersection import MeshCollider
from grafu.joints.joint_choice import with_choices
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.plan import JointChoice
from grafu.joints.realize import Realized, realize
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import CellRow, Door, Drawer, Layout, Stack
from judging import GALLERY, installed, realized

LEFT, RIGHT = Door("left"), Door("right")
BARE_LEFT, BARE_RIGHT = Door("left", handle="none"), Door("right", handle="none")
IN_THE_WAY: dict[str, tuple[Layout, ...]] = {
    "door by drawers": (RIGHT, Stack((Drawer(), Drawer()))),
    "doors back to back": (BARE_RIGHT, BARE_LEFT),
    "door between drawers": (Drawer(), LEFT, Drawer()),
}
OUT_OF_IT: dict[str, tuple[Layout, ...]] = {
    "door away from drawers": (LEFT, Drawer()),
    "doors face to face": (LEFT, RIGHT),
}


def side_by_side(layouts: tuple[Layout, ...], mount: str) -> Asset:
    return make_cabinet(Cabinet(case=Case(0.5 * len(layouts), 0.7), layout=CellRow(layouts), mount=mount))


def meeting(result: Realized) -> list[tuple[str, str]]:
    """Pairs of moving bodies that cut into each other where everything is open."""
    joints = result.object.moving_joints
    open_ = {
        j.child: MeshCollider(result.object.link(j.child).body_mesh.transformed(j.motion(j.limits.upper)))
        for j in joints
    }
    return [(a, b) for a, b in combinations(open_, 2) if open_[a].is_within(0.0, open_[b])]


def openings(result: Realized) -> dict[str, float]:
    return {part: made.opening for part, made in installed(result).items() if part.startswith("door")}


@pytest.mark.parametrize("mount", ["inset", "overlay"])
@pytest.mark.parametrize("name", IN_THE_WAY)
def test_everything_can_stand_open_at_once(name, mount):
    result = realized(side_by_side(IN_THE_WAY[name], mount))
    assert meeting(result) == []
    assert min(openings(result).values()) >= radians(90) - 1e-9
    assert min(openings(result).values()) < radians(109)  # else nothing was in the way, and this shows nothing
    assert not any(made.restricted or made.after for made in installed(result).values())


@pytest.mark.parametrize("mount", ["inset", "overlay"])
@pytest.mark.parametrize("name", OUT_OF_IT)
def test_a_door_in_nobodys_way_opens_as_far_as_it_goes(name, mount):
    result = realized(side_by_side(OUT_OF_IT[name], mount))
    assert all(opening > radians(95) for opening in openings(result).values())


def test_doors_whose_handles_meet_at_a_quarter_turn_open_as_far_as_they_go():
    result = realized(side_by_side((RIGHT, LEFT), "overlay"))
    assert meeting(result) == [("door_1", "door_2")]
    assert min(openings(result).values()) > radians(95)


def test_an_opening_that_was_chosen_is_not_given_up():
    asset = side_by_side(IN_THE_WAY["door by drawers"], "overlay")
    (door,) = (joint.part for joint in asset.joints if joint.part.startswith("door"))
    plan = with_choices(plan_from_annotation(asset), {door: JointChoice(opening=radians(108))}, asset, GALLERY)
    assert openings(realize(plan, asset, GALLERY))[door] == pytest.approx(radians(108))
