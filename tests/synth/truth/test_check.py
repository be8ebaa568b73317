"""The checker finds what is planted, passes what is sound, and agrees with a judge that is written apart from it."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from hypothesis import given, settings

from grafu.asset.part import Asset
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.transform import from_rotation
from grafu.graph.annotated import annotated_edges
from grafu.graph.edges import Contact, Hinge, Rail, ends_of
from grafu.graph.edit import with_edges
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.parse import parse_graph
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.fronts.layout import Door, Drawer, OpenCell, Pair, Stack
from grafu.synth.generate import make_specimen
from grafu.synth.noise import edits
from grafu.synth.samples import TIDY
from grafu.synth.specimen import Defect, Specimen
from grafu.synth.truth.check import Fault, faults_in, faults_of
from grafu.synth.truth.clashes import articulated_of, clashes_of
from grafu.vocabulary import PartLabel
from strategies import furniture_specs, made
from sweeping import collisions

MIXED = make_cabinet(Cabinet(layout=Stack((Pair(), Drawer()), (3.0, 1.0))))


def truth_of(asset: Asset) -> FunctionalGraph:
    graph = parse_graph(asset)
    return with_edges(graph, annotated_edges(asset, graph).edges)


def with_joint(asset: Asset, part: str, **changes) -> Asset:
    return replace(asset, joints=tuple(replace(j, **changes) if j.part == part else j for j in asset.joints))


def relabelled(asset: Asset, part: str, label: PartLabel) -> Asset:
    return asset.with_labels({part: label})


def kinds(faults: tuple[Fault, ...]) -> set[tuple[str, str]]:
    return {(fault.kind, fault.parts[0]) for fault in faults}


@pytest.mark.parametrize("name", TIDY)
def test_a_tidy_kind_has_no_fault(name):
    asset = TIDY[name]()
    assert [f for f in faults_of(asset, None, truth_of(asset)) if f.kind != "loose"] == []


@settings(max_examples=30)
@given(furniture_specs)
def test_it_agrees_with_a_plain_judge(spec):
    asset = made(spec)
    for joint in asset.joints:
        steps = np.linspace(0.05, 1.0, 5) * joint.upper
        assert (clashes_of(asset).hits(joint.part) == frozenset()) is (collisions(asset, joint.part, steps) == {})


def test_a_door_that_turns_about_the_wrong_side_hits_the_case():
    asset = make_cabinet(Cabinet(layout=Door(), mount="inset"))
    joint = asset.joints[0]
    inwards = with_joint(asset, "door", axis=joint.axis.reversed())
    faults = faults_of(inwards)
    assert kinds(faults) == {("collision", "door")}
    assert "side_panel_left" in faults[0].parts


def test_a_drawer_that_slides_sideways_hits_the_walls():
    joint = next(j for j in MIXED.joints if j.part == "drawer")
    asset = with_joint(MIXED, "drawer", axis=Axis(joint.axis.point, vec3(1.0, 0.0, 0.0)))
    assert ("collision", "drawer") in kinds(faults_of(asset))


def test_a_drawer_that_slides_in_hits_the_back():
    joint = next(j for j in MIXED.joints if j.part == "drawer")
    faults = faults_of(with_joint(MIXED, "drawer", axis=joint.axis.reversed()))
    assert kinds(faults) == {("collision", "drawer")}
    assert "back_panel" in faults[0].parts


def test_a_drawer_that_does_not_come_out_is_found():
    asset = make_cabinet(Cabinet(layout=OpenCell()))
    joint = next(j for j in MIXED.joints if j.part == "drawer")
    board = replace(asset.part("back_panel"), id="drawer", label=PartLabel.DRAWER)
    within = replace(asset, parts=(*asset.parts, board), joints=(replace(joint, upper=0.5),))
    within = edits.with_swollen(within, "drawer", vec3(-0.01, 0.0, -0.01))
    assert ("limit", "drawer") in kinds(faults_of(within))


@pytest.mark.parametrize(
    ("part", "label"),
    [
        ("door_1", PartLabel.DRAWER),
        ("drawer", PartLabel.DOOR),
        ("door_1", PartLabel.UNKNOWN),
        ("back_panel", PartLabel.DOOR),
    ],
)
def test_a_swapped_label_is_found(part, label):
    assert kinds(faults_of(relabelled(MIXED, part, label))) == {("label", part)}


def test_a_handle_on_nothing_is_found():
    parts = tuple(replace(p, carried_by=None) if p.id == "handle_1" else p for p in MIXED.parts)
    assert kinds(faults_of(replace(MIXED, parts=parts))) == {("attached part", "handle_1")}


def test_a_handle_in_the_air_is_found():
    assert kinds(faults_of(edits.with_shifted(MIXED, "handle_1", vec3(0.0, -0.1, 0.0)))) == {
        ("attached part", "handle_1")
    }


def test_a_handle_on_still_furniture_is_found():
    parts = tuple(replace(p, carried_by="back_panel") if p.id == "handle_1" else p for p in MIXED.parts)
    assert kinds(faults_of(replace(MIXED, parts=parts))) == {("attached part", "handle_1")}


@pytest.mark.parametrize(("part", "upper"), [("door_1", 0.1), ("door_1", 1.5 * pi), ("drawer", 0.01), ("drawer", 3.0)])
def test_an_opening_that_no_furniture_has_is_found(part, upper):
    assert ("limit", part) in kinds(faults_of(with_joint(MIXED, part, upper=upper)))


def test_a_joint_that_does_not_start_at_0_is_found():
    assert kinds(faults_of(with_joint(MIXED, "door_1", lower=0.1))) == {("limit", "door_1")}


@pytest.mark.parametrize(("part", "factors"), [("door_1", (0.1, 1.0, 1.0)), ("drawer", (1.0, 1.0, 0.1))])
def test_a_front_too_small_to_be_one_is_found(part, factors):
    bare = edits.without_parts(MIXED, ("handle",))
    box = bare.part(part).box
    T = from_rotation(np.diag(factors), box.center * (1.0 - np.array(factors)))
    surfaces = (Surface(bare.part(part).mesh.transformed(T)),)
    parts = tuple(replace(p, surfaces=surfaces) if p.id == part else p for p in bare.parts)
    assert ("size", part) in kinds(faults_of(replace(bare, parts=parts)))


def test_two_parts_in_one_place_are_found():
    twin = replace(MIXED.part("back_panel"), id="twin")
    assert kinds(faults_of(replace(MIXED, parts=(*MIXED.parts, twin)))) == {("double", "twin")}


def test_a_sunk_door_is_found():
    asset = edits.with_shifted(MIXED, "door_1", vec3(0.0, 0.003, 0.0))
    assert kinds(faults_of(asset)) == {("collision", "door_1")}


def edges_without(graph: FunctionalGraph, child: str) -> FunctionalGraph:
    kept = [e for e in graph.edges if not isinstance(e, Hinge | Rail) or e.child != child]
    return replace(graph, edges=tuple(kept))


def test_a_graph_without_a_mount_is_found():
    truth = truth_of(MIXED)
    assert ("mount", "door_1") in kinds(faults_of(MIXED, None, edges_without(truth, "door_1")))
    assert ("mount", "drawer") in kinds(faults_of(MIXED, None, edges_without(truth, "drawer")))


def test_a_graph_with_another_motion_is_found():
    truth = truth_of(MIXED)
    flipped = tuple(replace(e, sign=1 - e.sign) if isinstance(e, Hinge) else e for e in truth.edges)
    assert kinds(faults_of(MIXED, None, replace(truth, edges=flipped))) == {("motion", "door_1"), ("motion", "door_2")}


def test_a_graph_of_other_parts_or_in_pieces_is_found():
    truth = truth_of(MIXED)
    assert {k for k, _ in kinds(faults_of(MIXED, None, replace(truth, nodes=truth.nodes[::-1])))} == {"parts"}
    alone = tuple(e for e in truth.edges if not isinstance(e, Contact) or "back_panel" not in ends_of(e))
    assert kinds(faults_of(MIXED, None, replace(truth, edges=alone))) == {("loose", "back_panel")}


def test_an_articulated_object_that_forgets_the_doors_collides():
    asset = make_cabinet(Cabinet(layout=Pair(behind=Drawer())))
    made_ = articulated_of(asset)
    forgetful = replace(made_, joints=tuple(replace(j, after=()) for j in made_.joints))
    assert faults_of(asset, made_) == ()
    assert kinds(faults_of(asset, forgetful)) == {("collision", "drawer")}


def test_drawn_specimens_have_no_fault_beyond_their_defects():
    """A few; `scripts/survey.py` makes and judges thousands."""
    assert [faults_in(make_specimen(2, index, points=8)) for index in range(12)] == [()] * 12


def specimen(whole: Asset, *defects: Defect, asset: Asset | None = None) -> Specimen:
    given_ = (asset or whole).without_annotation()
    return Specimen("made", "cabinet", given_, whole, truth_of(whole), frozenset({"handle_1"}), defects)


def test_what_a_defect_declares_is_no_fault_of_a_specimen():
    sunk = edits.with_shifted(MIXED, "door_1", vec3(0.0, 0.003, 0.0))
    assert faults_in(specimen(sunk, Defect("interpenetrating", ("door_1",)))) == ()
    assert kinds(faults_in(specimen(sunk, Defect("interpenetrating", ("drawer",))))) == {("collision", "door_1")}
    assert kinds(faults_in(specimen(sunk))) == {("collision", "door_1")}


def test_a_false_label_or_a_missing_part_must_be_declared():
    lied = relabelled(edits.without_parts(MIXED, ("top_panel",)), "back_panel", PartLabel.SIDE_PANEL)
    meant = (Defect("mislabelled", ("back_panel",)), Defect("missing", ("top_panel",)))
    assert faults_in(specimen(MIXED, *meant, asset=lied)) == ()
    assert kinds(faults_in(specimen(MIXED, asset=lied))) == {("label", "back_panel"), ("parts", "top_panel")}


def test_unknown_labels_are_no_fault():
    assert faults_in(specimen(MIXED, asset=edits.with_labels_lost(MIXED))) == ()


def test_what_carries_a_door_must_not_be_removable():
    one = specimen(MIXED)
    mount = one.truth.hinges[0].parent
    assert kinds(faults_in(replace(one, removable=frozenset({mount, "drawer"})))) == {
        ("parts", mount),
        ("parts", "drawer"),
    }
