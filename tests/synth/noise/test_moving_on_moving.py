"""Modelling noise on furniture in which one part hangs on another that moves: joints, carriers and followers agree."""

from math import radians

import numpy as np
import pytest

from grafu.asset.part import Asset
from grafu.graph.motion import axis_to_hinge
from grafu.synth.appliances.appliance import Appliance, make_appliance
from grafu.synth.cabinets.folding import FoldingDoors, make_folding_doors
from grafu.synth.noise.distortion import ajar, stretched
from grafu.synth.noise.edits import with_shifted, without_parts
from grafu.synth.noise.segmentation import with_attached_joined
from grafu.synth.openings.door import DoorSpec, make_building_door
from grafu.synth.pieces.riding import bodies_of, carriers_of, moving_with
from grafu.synth.tables.extending import ExtendingTable, make_extending_table
from grafu.synth.truth.check import faults_of
from grafu.synth.truth.true_graph import true_graph

FOLDING = make_folding_doors(FoldingDoors(side="left"))


def joint(asset: Asset, part: str):
    return next(one for one in asset.joints if one.part == part)


def test_what_rides_on_what_rides_moves_with_it() -> None:
    assert moving_with(FOLDING, "door_1") == {"door_1", "door_2", "handle"}
    assert carriers_of(FOLDING) == {"door_1": "", "door_2": "door_1"}
    assert bodies_of(FOLDING)["handle"] == "door_2"


def test_a_folding_door_left_ajar_has_both_leaves_folded_and_the_rest_to_go() -> None:
    opened = ajar(FOLDING, "door_1", 0.5)
    outer, inner = joint(opened, "door_1"), joint(opened, "door_2")

    assert outer.upper == pytest.approx(0.5 * joint(FOLDING, "door_1").upper)
    assert inner.upper == pytest.approx(2 * outer.upper)
    front = FOLDING.part("door_1").box.low[1]
    assert opened.part("door_2").box.high[1] < front + 0.03  # the leaf's free end stays in the track's plane
    assert opened.part("door_2").box.low[1] < front - 0.2  # the seam is out
    assert inner.axis.point[1] < front - 0.2
    assert not [fault for fault in faults_of(opened) if fault.kind == "collision"]


def test_a_follower_is_not_left_ajar_by_itself() -> None:
    with pytest.raises(ValueError, match="by itself"):
        ajar(FOLDING, "door_2", 0.2)


@pytest.mark.parametrize("factors", [(-1.1, 0.9, 1.2), (1.2, 1.2, 0.8)])
def test_what_is_stretched_or_mirrored_keeps_its_motions(factors) -> None:
    image = stretched(FOLDING, np.array(factors))
    for hinge in true_graph(image, 1).hinges:
        stated = joint(image, hinge.child)
        assert (hinge.border, hinge.sign) == axis_to_hinge(image.part(hinge.child).box, stated.axis)
        assert hinge.coupling == stated.coupling
    assert not faults_of(image)
    table = stretched(make_extending_table(ExtendingTable()), np.array(factors))
    assert [one.coupling.multiplier for one in table.joints if one.coupling] == [1.0]
    assert len({round(one.upper, 9) for one in table.joints}) == 1


def test_small_joints_are_stretched_and_shifted_with_what_they_are_on() -> None:
    oven = make_appliance(Appliance("oven", "oven", knobs=2))
    wide = stretched(oven, np.array([2.0, 1.0, 1.0]))
    for before, after in zip(oven.small_joints, wide.small_joints, strict=True):
        assert after.axis.point[0] == pytest.approx(2 * before.axis.point[0])
    door = make_building_door(DoorSpec(bolt=True))
    shifted = with_shifted(door, "leaf", np.array([0.0, -0.005, 0.0]))
    for before, after in zip(door.small_joints, shifted.small_joints, strict=True):
        assert after.axis.point[1] == pytest.approx(before.axis.point[1] - 0.005)


def test_what_is_left_out_takes_its_joints_along() -> None:
    left = without_parts(FOLDING, ["door_1"])
    assert left.joints == ()
    door = make_building_door(DoorSpec(bolt=True))
    assert [one.part for one in with_attached_joined(door, ["lever"]).small_joints] == ["latch_bolt"]


def test_the_second_leaf_of_a_fold_goes_back_by_twice_as_much() -> None:
    assert joint(FOLDING, "door_2").upper == pytest.approx(radians(170))
