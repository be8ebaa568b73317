"""Furniture that is made for one way to move: its true joints are free and reach as far as they state."""

import numpy as np
import pytest

from grafu.asset.part import Asset
from grafu.metrics.collision import CollisionConfig, collision_shares
from grafu.synth.appliances.appliance import Appliance, drawn_appliance, make_appliance
from grafu.synth.appliances.washing_machine import WashingMachine, drawn_washing_machine, make_washing_machine
from grafu.synth.cabinets.pull_out import PullOutUnit, drawn_pull_out, make_pull_out
from grafu.synth.cabinets.sliding import SlidingDoors, drawn_sliding_doors, make_sliding_doors
from grafu.synth.tables.drop_leaf import (
    DropLeafTable,
    drawn_drop_leaf_table,
    drawn_supported_table,
    make_drop_leaf_table,
)
from grafu.synth.tables.drop_leaf_supports import LeafSupports
from grafu.synth.truth.clashes import articulated_of
from grafu.vocabulary import JointType, PartLabel
from judging import installed, realized

SEEDS = range(6)
MAKERS = {
    "sliding": lambda rng: make_sliding_doors(drawn_sliding_doors(rng, "x")),
    "drop leaf": lambda rng: make_drop_leaf_table(drawn_drop_leaf_table(rng, "x")),
    "supported leaf": lambda rng: make_drop_leaf_table(drawn_supported_table(rng, "x")),
    "pull-out": lambda rng: make_pull_out(drawn_pull_out(rng, "x")),
    "dishwasher": lambda rng: make_appliance(drawn_appliance(rng, "x", "dishwasher")),
    "oven": lambda rng: make_appliance(drawn_appliance(rng, "x", "oven")),
    "washing machine": lambda rng: make_washing_machine(drawn_washing_machine(rng, "x")),
    "microwave": lambda rng: make_appliance(drawn_appliance(rng, "x", "microwave")),
}
TYPES = {
    "sliding": {JointType.PRISMATIC},
    "drop leaf": {JointType.REVOLUTE},
    "supported leaf": {JointType.REVOLUTE, JointType.PRISMATIC},
    "pull-out": {JointType.PRISMATIC},
    "dishwasher": {JointType.REVOLUTE, JointType.PRISMATIC},
    "oven": {JointType.REVOLUTE, JointType.PRISMATIC, JointType.CONTINUOUS},
    "microwave": {JointType.REVOLUTE, JointType.CONTINUOUS, JointType.PRISMATIC},
    "washing machine": {JointType.REVOLUTE, JointType.CONTINUOUS, JointType.PRISMATIC},
}


def drawn(kind: str, seed: int) -> Asset:
    return MAKERS[kind](np.random.default_rng([3, seed]))


@pytest.mark.parametrize("kind", MAKERS)
def test_true_joints_are_of_their_types_and_collide_with_nothing(kind):
    made = [drawn(kind, seed) for seed in SEEDS]
    assert {joint.type for asset in made for joint in (*asset.joints, *asset.small_joints)} <= TYPES[kind]
    for asset in made:
        truth = articulated_of(asset)
        assert asset.joints
        colliding = collision_shares(truth, CollisionConfig(poses=12, tolerance=0.0005))
        assert set(colliding.values()) == {0.0}, (kind, asset.name)


@pytest.mark.parametrize(
    ("spec", "direction"),
    [
        (Appliance("m", "microwave", 0.5, 0.3, 0.4, 0.02, racks=0, knobs=1, keys=12, edge="left"), (0.0, 0.0, -1.0)),
        (Appliance("m", "microwave", 0.5, 0.3, 0.4, 0.02, racks=0, buttons=1, edge="right", pull="none"), (0, 0, 1.0)),
        (Appliance("m", "microwave", 0.6, 0.4, 0.4, 0.02, racks=0, keys=9, pull="long"), (1.0, 0.0, 0.0)),
        (Appliance("o", "oven", height=0.9, drawer=0.2, burners=4, knobs=4), (1.0, 0.0, 0.0)),
        (Appliance("o", "oven", height=0.6, knobs=2, racks=1, edge="left"), (0.0, 0.0, -1.0)),
    ],
)
def test_doors_of_appliances_turn_about_the_stated_edge_clear_of_the_panel(spec, direction):
    asset = make_appliance(spec)
    joint = next(joint for joint in asset.joints if joint.part == "door")
    assert np.allclose(joint.axis.direction, direction)
    assert [p.label for p in asset.parts].count(PartLabel.HANDLE) == (spec.pull != "none") + (spec.drawer > 0)
    panel, leaf = asset.part("panel").box, asset.part("door").box
    axis = 0 if spec.has_panel_beside else 2
    assert leaf.high[axis] < panel.low[axis] or panel.high[axis] < leaf.low[axis]
    assert set(collision_shares(articulated_of(asset), CollisionConfig(poses=12, tolerance=0.0005)).values()) == {0.0}


@pytest.mark.parametrize("kind", ["sliding", "pull-out", "drop leaf", "supported leaf"])
def test_they_are_realized_as_far_as_they_truly_open(kind):
    asset = drawn(kind, 1)
    made = installed(realized(asset))
    for joint in asset.joints:
        outcome = made[joint.part]
        assert outcome.type is joint.type
        assert outcome.collision_share == 0.0
        assert outcome.opening >= 0.9 * joint.upper


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: SlidingDoors(leaves=1), "must be 2 or 3, of a barn door 1: got 1"),
        (lambda: DropLeafTable(leaves=3), "end above the floor"),
        (lambda: LeafSupports(count=3), "one or two that reach less than a leaf: got 3"),
        (
            lambda: DropLeafTable(supports=LeafSupports(thickness=0.03)),
            "must hold the supports behind a leaf",
        ),
        (lambda: PullOutUnit(trays=0), "must be at least 1: got 0"),
        (lambda: Appliance(knobs=2), "knobs a panel"),
        (lambda: WashingMachine(radius=0.29), "leave 3 cm"),
    ],
)
def test_what_cannot_be_made_is_refused(make, text):
    with pytest.raises(ValueError, match=text):
        make()


def test_tracks_of_sliding_doors_are_as_long_as_the_way():
    asset = make_sliding_doors(SlidingDoors())
    result = realized(asset)
    joint = result.object.joint_of["door_1"]
    track = next(v for v in result.object.link("body").visuals if v.name == "rail_door_1_left_static")
    leaf = asset.part("door_1").box.size[0]
    assert track.mesh.box.size[0] == pytest.approx(0.9 * leaf + joint.limits.upper, abs=1e-3)
