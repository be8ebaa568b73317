"""Motions on moving parts, motions that follow others, and parts that turn about no border of their box."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.articulation.articulated_object import Coupling
from grafu.asset.part import AnnotatedJoint, Asset, Part, PartSource
from grafu.errors import GraphError
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.graph.annotated import joint_edges
from grafu.graph.arrays import HINGE, NONE, NULL, graph_arrays
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Contact, Hinge, Rail, Slide, Turn
from grafu.graph.edit import mirrored, relabelled, scaled, without_edges, without_nodes
from grafu.graph.functional_graph import FunctionalGraph, PartNode, paper_edges
from grafu.graph.official_json import functional_to_official, graph_from_official
from grafu.graph.serialize import dump_json, graph_from_json, graph_to_json, load_json
from grafu.joints.make_plan import plan_from_completion
from grafu.render.graph_picture import draw_graph, motion_words
from grafu.vocabulary import JointType, PartLabel

CASE = PartNode("case", PartLabel.SIDE_PANEL, Box(vec3(-0.5, -0.2, 0.0), vec3(0.5, 0.2, 1.0)))
LEAF_1 = PartNode("leaf_1", PartLabel.DOOR, Box(vec3(-0.5, -0.22, 0.0), vec3(0.0, -0.2, 1.0)))
LEAF_2 = PartNode("leaf_2", PartLabel.DOOR, Box(vec3(0.0, -0.22, 0.0), vec3(0.5, -0.2, 1.0)))
TRAY = PartNode("tray", PartLabel.DRAWER, Box(vec3(0.1, -0.2, 0.4), vec3(0.4, -0.1, 0.5)))
KNOB = PartNode("knob", PartLabel.HANDLE, Box(vec3(-0.1, -0.24, 0.5), vec3(-0.04, -0.22, 0.56)))
FOLDS = Coupling("leaf_1", 2.0, 0.25)
FIRST, SECOND = Hinge("case", "leaf_1", 0, 0), Hinge("leaf_1", "leaf_2", 0, 1, FOLDS)
RUNS = Rail("leaf_2", "tray", 2, Coupling("leaf_1", 0.1))
TURNS = Turn("leaf_1", "knob", 3)
GRAPH = FunctionalGraph("folding", (CASE, LEAF_1, LEAF_2, TRAY, KNOB), (FIRST, SECOND, RUNS, TURNS))


def test_a_round_trip_keeps_parents_couplings_and_turns() -> None:
    data = load_json(dump_json(graph_to_json(GRAPH)))
    assert graph_from_json(data).edges == GRAPH.edges
    second, knob = data["edges"][1], data["edges"][3]
    assert (second["src"], second["dst"]) == ("leaf_1", "leaf_2")
    assert second["follows"] == {"leader": "leaf_1", "multiplier": 2.0, "offset": 0.25}
    assert (knob["kind"], knob["turn_axis_signed"]) == ("turn", 3)
    assert "follows" not in data["edges"][0]


@pytest.mark.parametrize(
    "follows", [{"leader": "leaf_1", "multiplier": 0, "offset": 0}, {"multiplier": 1, "offset": 0}, 3, {"leader": "x"}]
)
def test_a_coupling_that_is_none_is_refused(follows: object) -> None:
    data = graph_to_json(GRAPH)
    data["edges"][1]["follows"] = follows
    with pytest.raises(GraphError):
        graph_from_json(data)


def test_what_carries_what_is_known() -> None:
    assert GRAPH.moving == {"leaf_1", "leaf_2", "tray", "knob"}
    assert [GRAPH.carrier_of(part) for part in ("leaf_1", "leaf_2", "tray", "knob")] == [
        "",
        "leaf_1",
        "leaf_2",
        "leaf_1",
    ]
    assert GRAPH.motions_of("leaf_2") == (SECOND,)


@pytest.mark.parametrize(
    ("edges", "why"),
    [
        ((SECOND,), "to a support or to what moves"),  # leaf 1 does not move
        ((FIRST, replace(SECOND, coupling=Coupling("no_one"))), "must follow another part"),
        ((FIRST, replace(SECOND, coupling=Coupling("leaf_2"))), "must follow another part"),
        ((Hinge("leaf_2", "leaf_1", 0, 0), Rail("leaf_1", "tray", 2), Hinge("tray", "leaf_2", 0, 0)), "in a circle"),
        ((FIRST, SECOND, Hinge("case", "leaf_2", 0, 1)), "must state one motion"),  # one edge follows, the other not
        ((FIRST, Slide("leaf_1", "tray", 0)), "a slide what is no drawer"),
    ],
)
def test_what_cannot_be_is_refused(edges: tuple, why: str) -> None:
    with pytest.raises(GraphError, match=why):
        replace(GRAPH, edges=edges)


def test_without_its_motion_a_part_carries_nothing_that_moves() -> None:
    contacts = (Contact("leaf_1", "leaf_2"), Contact("leaf_2", "tray"), Contact("leaf_1", "knob"))
    assert without_edges(GRAPH, [FIRST]).edges == contacts
    assert without_nodes(GRAPH, ["case"]).edges == contacts
    panel = relabelled(GRAPH, {"leaf_1": PartLabel.SIDE_PANEL})
    assert panel.edges == (Contact("case", "leaf_1"), SECOND, RUNS, TURNS)  # a panel carries what moves


def test_what_followed_a_part_that_is_gone_follows_nothing() -> None:
    apart = replace(GRAPH, edges=(FIRST, Hinge("case", "leaf_2", 2, 0, Coupling("leaf_1"))))
    assert without_nodes(apart, ["leaf_1"]).edges == (Hinge("case", "leaf_2", 2, 0),)


def test_couplings_scale_where_they_count_metres() -> None:
    second, rail = scaled(GRAPH, 10.0).edges[1:3]
    assert second == SECOND  # radians for radians
    assert rail.coupling == Coupling("leaf_1", 1.0)  # metres for radians


def test_a_mirror_image_turns_the_other_way() -> None:
    assert mirrored(GRAPH, 0).edges[3] == Turn("leaf_1", "knob", 2)
    assert mirrored(GRAPH, 1).edges[3] == TURNS  # about the axis across the mirror
    assert mirrored(mirrored(GRAPH, 0), 0).edges == GRAPH.edges
    assert mirrored(GRAPH, 0).edges[1].coupling == FOLDS


def test_the_paper_s_kinds_and_the_authors_files_state_contacts() -> None:
    touching = {Contact("leaf_1", "leaf_2"), Contact("leaf_2", "tray"), Contact("leaf_1", "knob")}
    assert set(paper_edges(GRAPH)) == {FIRST, *touching}
    arrays = graph_arrays(GRAPH, "paper")
    assert arrays.edges[0, 1] == HINGE
    assert arrays.border[2] == arrays.slide[3] == NONE
    assert (arrays.edges != NULL).sum() == 8
    ours = graph_arrays(GRAPH)
    place = {node.id: k for k, node in enumerate(GRAPH.nodes)}
    assert all(ours.child[place[edge.child], place[edge.parent]] for edge in GRAPH.motions)
    assert ours.slide[place["knob"]] == TURNS.axis
    assert graph_from_official(functional_to_official(GRAPH)).graph.edges == paper_edges(GRAPH)


def test_the_paper_knows_no_couplings() -> None:
    beside = replace(GRAPH, edges=(FIRST, Hinge("case", "leaf_2", 2, 0, Coupling("leaf_1"))))
    assert paper_edges(beside) == (FIRST, Hinge("case", "leaf_2", 2, 0))


@pytest.mark.parametrize(
    ("part", "kind", "direction", "edge"),
    [
        (KNOB, JointType.REVOLUTE, (0.0, 1.0, 0.0), Turn("case", "knob", 3)),
        (LEAF_1, JointType.REVOLUTE, (0.0, 1.0, 0.0), Turn("case", "leaf_1", 3)),  # across its plane
        (LEAF_1, JointType.REVOLUTE, (0.0, 0.0, -1.0), Hinge("case", "leaf_1", 0, 0)),
        (TRAY, JointType.REVOLUTE, (0.0, 0.0, 1.0), Turn("case", "tray", 5)),
        (KNOB, JointType.PRISMATIC, (0.0, 1.0, 0.0), Slide("case", "knob", 3)),  # a button
    ],
)
def test_every_joint_has_an_edge(part: PartNode, kind: JointType, direction: tuple, edge: object) -> None:
    joint = AnnotatedJoint(part.id, kind, Axis(part.box.low, vec3(*direction)), 0.0, 0.1)
    assert joint_edges(joint, replace(GRAPH, edges=()), [CASE]) == [edge]


def test_a_plan_has_the_parents_and_couplings_of_the_graph() -> None:
    parts = (Part(n.id, n.label, (Surface(TriangleMesh.box_mesh(n.box)),), PartSource(n.id)) for n in GRAPH.nodes)
    asset = Asset("folding", "", "mesh folder", tuple(parts))
    plan = plan_from_completion(GraphCompletion(replace(GRAPH, edges=()), GRAPH, "test"), asset)
    requests = {request.moving: request for request in plan.joints}
    assert {part: request.parent for part, request in requests.items()} == {
        "leaf_1": "", "leaf_2": "leaf_1", "tray": "leaf_2", "knob": "leaf_1"
    }  # fmt: skip
    assert requests["leaf_2"].coupling == FOLDS
    assert set(requests["leaf_1"].attached) == {"leaf_2", "tray", "knob"}
    assert requests["leaf_2"].mounts == ()
    np.testing.assert_array_equal(requests["knob"].axis.direction, (0.0, 1.0, 0.0))


def test_the_picture_says_it() -> None:
    assert motion_words(GRAPH, TURNS) == "turns about +Y"
    assert "turns about +Y" in [writing.text for writing in draw_graph(GRAPH).writings]
