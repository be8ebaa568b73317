"""A door that slides along its case: its edge in the graph, in files, in pictures and towards the network."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.part import AnnotatedJoint
from grafu.errors import GraphError
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.graph.annotated import joint_edges
from grafu.graph.arrays import KIND_CODES, graph_arrays
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Contact, Rail, Slide
from grafu.graph.edit import mirrored
from grafu.graph.functional_graph import FunctionalGraph, PartNode, paper_edges
from grafu.graph.official_json import functional_to_official
from grafu.graph.serialize import completion_from_json, completion_to_json, graph_from_json, graph_to_json
from grafu.render.graph_picture import draw_graph, motion_words
from grafu.vocabulary import EdgeKind, JointType, PartLabel

CASE = PartNode("case", PartLabel.SIDE_PANEL, Box(vec3(-0.5, -0.2, 0.0), vec3(0.5, 0.2, 1.0)))
FRONT = PartNode("front", PartLabel.DOOR, Box(vec3(-0.5, -0.22, 0.0), vec3(0.0, -0.2, 1.0)))
SLIDE = Slide("case", "front", 1)
GRAPH = FunctionalGraph("sideboard", (CASE, FRONT), (SLIDE,))


@pytest.mark.parametrize("axis", range(6))
def test_a_round_trip_is_exact_along_every_axis(axis):
    graph = replace(GRAPH, edges=(Slide("case", "front", axis),))
    data = graph_to_json(graph)
    assert (data["edges"][0]["kind"], data["edges"][0]["slide_axis_signed"]) == ("slide", axis)
    assert graph_from_json(data).edges == graph.edges


def test_only_doors_slide_so_and_on_one_way():
    assert (GRAPH.slides, GRAPH.moving) == ((SLIDE,), {"front"})
    with pytest.raises(GraphError, match="a slide what is no drawer"):
        replace(GRAPH, nodes=(CASE, replace(FRONT, label=PartLabel.DRAWER)))
    top = replace(CASE, id="top", label=PartLabel.TOP_PANEL)
    with pytest.raises(GraphError, match="must state one motion"):
        FunctionalGraph("two", (CASE, FRONT, top), (SLIDE, Slide("top", "front", 0)))


def test_a_completed_graph_with_a_sliding_door_leaves_nothing_in_silence():
    completion = GraphCompletion(replace(GRAPH, edges=(Contact("case", "front"),)), GRAPH, "annotation")
    assert completion_from_json(completion_to_json(completion)) == completion


def test_a_joint_that_slides_a_door_gets_the_edge():
    joint = AnnotatedJoint("front", JointType.PRISMATIC, Axis(np.zeros(3), vec3(1.0, 0.0, 0.0)), 0.0, 0.4)
    bare = replace(GRAPH, edges=(Contact("case", "front"),))
    assert joint_edges(joint, bare, [CASE]) == [SLIDE]
    drawer = replace(bare, nodes=(CASE, replace(FRONT, label=PartLabel.DRAWER)))
    assert joint_edges(joint, drawer, [CASE]) == [Rail("case", "front", 1)]


def test_the_paper_s_kinds_and_the_authors_files_state_a_contact():
    assert paper_edges(GRAPH) == (Contact("case", "front"),)
    arrays = graph_arrays(GRAPH, "paper")
    assert (arrays.edges[0, 1], arrays.child.any()) == (KIND_CODES[EdgeKind.CONTACT], False)
    ours = graph_arrays(GRAPH)
    assert (ours.edges[0, 1], ours.child.tolist()) == (KIND_CODES[EdgeKind.SLIDE], [[False, False], [True, False]])
    assert ours.slide.tolist() == [-1, SLIDE.axis]
    assert [edge["kind"] for edge in functional_to_official(GRAPH)["edges"]] == ["contact"]


def test_the_mirror_image_slides_the_other_way():
    assert mirrored(GRAPH, 0).edges == (Slide("case", "front", 0),)
    assert mirrored(GRAPH, 1).edges == (SLIDE,)


def test_the_picture_says_it():
    assert motion_words(GRAPH, SLIDE) == "slides +X"
    assert "slides +X" in [writing.text for writing in draw_graph(GRAPH).writings]
