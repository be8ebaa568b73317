"""The input's own joints as a completed graph."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.part import AnnotatedJoint, Asset
from grafu.geometry.axis import Axis
from grafu.graph.edges import Slide
from grafu.graph.motion import code_to_direction, hinge_to_axis, rail_to_axis
from grafu.graph.parse import parse_graph
from grafu.pipeline.complete import complete_by_annotation
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door, Drawer, Pair, Stack
from grafu.vocabulary import JointType, PartLabel


@pytest.fixture(scope="module")
def cabinet() -> Asset:
    return make_cabinet(Cabinet("made", Case(0.8, 1.0), Stack((Drawer(), Pair()), (1.0, 3.0))))


def test_every_joint_becomes_an_edge_that_says_the_same(cabinet: Asset) -> None:
    completed = complete_by_annotation(cabinet, parse_graph(cabinet)).completed
    hinges = {hinge.child: hinge for hinge in completed.hinges}
    rails = {rail.child: rail for rail in completed.rails}

    for joint in cabinet.joints:
        box = cabinet.part(joint.part).box
        if joint.type is JointType.REVOLUTE:
            hinge = hinges[joint.part]
            found = hinge_to_axis(box, hinge.border, hinge.sign)
        else:
            found = rail_to_axis(box, rails[joint.part].axis)
        assert found.direction @ joint.axis.direction > 0.99


def test_a_door_hangs_on_the_side_of_its_pin_and_a_drawer_on_both(cabinet: Asset) -> None:
    completed = complete_by_annotation(cabinet, parse_graph(cabinet)).completed

    for hinge in completed.hinges:
        mount, door = cabinet.part(hinge.parent).box, cabinet.part(hinge.child).box
        assert np.sign(mount.center[0]) == np.sign(door.center[0])
    [drawer] = {rail.child for rail in completed.rails}
    sides = [np.sign(cabinet.part(rail.parent).box.center[0]) for rail in completed.rails if rail.child == drawer]
    assert sorted(sides) == [-1, 1]


def test_handles_are_attached_to_what_they_ride_on(cabinet: Asset) -> None:
    completed = complete_by_annotation(cabinet, parse_graph(cabinet)).completed

    riding = {(part.carried_by, part.id) for part in cabinet.parts if part.label is PartLabel.HANDLE}
    assert {(edge.parent, edge.child) for edge in completed.attachments} == riding


def test_a_part_without_a_joint_is_refused(cabinet: Asset) -> None:
    completion = complete_by_annotation(replace(cabinet, joints=()), parse_graph(cabinet))

    assert {r.part for r in completion.refused} == {p.id for p in cabinet.parts if p.label.is_movable}
    assert "no joint" in completion.refused[0].why


def test_a_sliding_door_slides_along_the_axis_that_is_stated(cabinet: Asset) -> None:
    door = next(part.id for part in cabinet.parts if part.label is PartLabel.DOOR)
    slide = AnnotatedJoint(door, JointType.PRISMATIC, Axis(np.zeros(3), np.array([1.0, 0, 0])), 0.0, 0.3)

    completion = complete_by_annotation(replace(cabinet, joints=(slide,)), parse_graph(cabinet))

    assert door not in {r.part for r in completion.refused}
    [edge] = [edge for edge in completion.completed.edges if isinstance(edge, Slide)]
    assert edge.child == door
    np.testing.assert_array_equal(code_to_direction(edge.axis), [1.0, 0.0, 0.0])


def test_doors_without_labels_never_hang_on_one_another() -> None:
    made = make_cabinet(Cabinet("doors", Case(0.8, 1.0), Stack((Door(), Door()))))
    masked = made.with_labels({part.id: PartLabel.UNKNOWN for part in made.parts})

    completed = complete_by_annotation(masked, parse_graph(masked)).completed

    moving = {joint.part for joint in masked.joints}
    assert {hinge.child for hinge in completed.hinges} == moving
    assert not moving & {hinge.parent for hinge in completed.hinges}
