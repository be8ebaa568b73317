"""Round doors of washing machines are found without any name; round things on other furniture are none."""

from dataclasses import replace

import numpy as np
import pytest

import grafu
from grafu.asset.part import Asset
from grafu.joints.portholes import with_porthole_labels
from grafu.synth.appliances.washing_machine import drawn_washing_machine, make_washing_machine
from grafu.vocabulary import JointType, PartLabel
from small_scenes import box, cylinder, scene


def machine(seed: int, names: frozenset[str] = frozenset()) -> Asset:
    """Returns a washing machine of which only some parts have names."""
    made = make_washing_machine(drawn_washing_machine(np.random.default_rng(seed), "machine"))
    parts = (
        p if p.id in names else replace(p, label=PartLabel.UNKNOWN, labelled_by="none", carried_by=None)
        for p in made.parts
    )
    return replace(made.without_annotation(), parts=tuple(parts))


def labels(asset: Asset) -> dict[str, PartLabel]:
    return {p.id: p.label for p in with_porthole_labels(asset).parts if p.label is not PartLabel.UNKNOWN}


@pytest.mark.parametrize("seed", range(12))
def test_the_door_of_a_nameless_machine_is_its_disc_and_the_panels_around_it_stay(seed):
    panels = dict.fromkeys(("front_plate", "panel"), PartLabel.FACE_FRAME)
    assert labels(machine(seed)) == {"door": PartLabel.DOOR, **panels}


def test_it_turns_about_a_side_and_the_drawer_for_powder_slides():
    joints = grafu.functionalize(machine(3), small_parts=False).object.joint_of
    assert {name: joint.type for name, joint in joints.items()} == {
        "door": JointType.REVOLUTE,
        "drawer": JointType.PRISMATIC,
    }
    assert abs(joints["door"].axis.direction[2]) == pytest.approx(1.0)


def test_what_has_a_name_keeps_its_label():
    named = machine(0, frozenset({"front_plate"}))
    assert labels(named)["front_plate"] is PartLabel.MISC
    (front, *rest) = sorted(machine(0).parts, key=lambda p: p.id != "front_plate")
    with_drawer = replace(machine(0), parts=(replace(front, label=PartLabel.DRAWER, labelled_by="name"), *rest))
    assert labels(with_drawer) == {"front_plate": PartLabel.DRAWER}  # whose front a round handle may be on


def cabinet(size, disc, radius, depth=0.02):
    """A body, a plate before it, and a disc of this middle (x, z) before the plate; all nameless."""
    width, deep, height = size
    parts = [
        box("body", (0.0, 0.0, 0.0), (width, deep, height)),
        box("plate", (0.0, -0.02, 0.0), (width, 0.0, height)),
        cylinder("disc", ((disc[0], -0.02 - depth, disc[1]), (disc[0], -0.02, disc[1])), radius),
    ]
    return scene(*(replace(part, label=PartLabel.UNKNOWN) for part in parts))


@pytest.mark.parametrize(
    ("asset", "is_door"),
    [
        (cabinet((0.6, 0.6, 0.85), (0.3, 0.4), 0.2), True),
        (cabinet((0.6, 0.6, 0.85), (0.3, 0.4), 0.1), False),
        (cabinet((0.6, 0.6, 0.85), (0.15, 0.4), 0.14), False),
        (cabinet((0.6, 0.6, 0.85), (0.3, 0.4), 0.2, depth=0.3), False),
        (cabinet((0.6, 0.6, 1.9), (0.3, 1.2), 0.2), False),
        (cabinet((0.6, 0.1, 0.7), (0.3, 0.4), 0.2), False),
    ],
    ids=["a washing machine", "a knob", "aside", "a barrel", "a mirror on a closet", "a clock"],
)
def test_a_disc_is_a_door_where_the_piece_is_that_of_a_machine(asset, is_door):
    assert labels(asset) == ({"disc": PartLabel.DOOR, "plate": PartLabel.FACE_FRAME} if is_door else {})


def test_what_lies_on_the_disc_rides_on_it():
    base = cabinet((0.6, 0.6, 0.85), (0.3, 0.4), 0.22)
    pane = replace(cylinder("pane", ((0.3, -0.05, 0.4), (0.3, -0.04, 0.4)), 0.15), label=PartLabel.UNKNOWN)
    found = with_porthole_labels(scene(*base.parts, pane))
    assert (found.part("pane").label, found.part("pane").carried_by) == (PartLabel.MISC, "disc")
    square = replace(
        base,
        parts=tuple(p if p.id != "disc" else box("disc", (0.1, -0.04, 0.2), (0.5, -0.02, 0.6)) for p in base.parts),
    )
    assert found.part("disc").label is PartLabel.DOOR
    assert "disc" not in labels(square)


def test_the_ring_of_the_opening_in_which_the_door_lies_stays():
    base = cabinet((0.6, 0.6, 0.85), (0.3, 0.4), 0.22)
    ring = replace(cylinder("ring", ((0.3, -0.022, 0.4), (0.3, -0.01, 0.4)), 0.2), label=PartLabel.UNKNOWN)
    assert with_porthole_labels(scene(*base.parts, ring)).part("ring").carried_by is None
