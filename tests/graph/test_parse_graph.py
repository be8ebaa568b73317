"""Contacts: boxes choose the pairs, meshes decide, and the paper's box-only rule stays an option."""

import time
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.asset.part import Asset, Part, PartSource
from grafu.completion.features import graph_features
from grafu.errors import GraphError
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.sampling import sample_surface
from grafu.geometry.touching import near_pairs
from grafu.graph.edges import Contact
from grafu.graph.functional_graph import PartNode
from grafu.graph.parse import ParsingConfig, parse_graph
from grafu.vocabulary import PartLabel


def block(low, high) -> TriangleMesh:
    return TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))


def asset(**meshes: TriangleMesh) -> Asset:
    parts = [Part(k, PartLabel.UNKNOWN, (Surface(m),), PartSource(f"the {k}")) for k, m in meshes.items()]
    return Asset("thing", "", "made", tuple(parts))


# An L of two legs, and a block in the empty quarter of its box.
CORNER = merge_meshes([block([0, 0, 0], [1, 1, 0.1]), block([0, 0, 0], [0.1, 1, 1])])
NOOK = block([0.5, 0.2, 0.5], [0.9, 0.8, 0.9])


def test_a_part_in_an_l_shaped_parts_box_does_not_touch_it():
    assert parse_graph(asset(corner=CORNER, nook=NOOK)).edges == ()


def test_the_papers_rule_calls_it_a_contact():
    assert parse_graph(asset(corner=CORNER, nook=NOOK), ParsingConfig("box")).edges == (Contact("corner", "nook"),)


@pytest.mark.parametrize(("gap", "touching"), [(-0.01, True), (0.0, True), (0.009, True), (0.011, False)])
def test_the_tolerance_is_a_fraction_of_the_largest_side(gap, touching):
    graph = parse_graph(asset(a=block([0, 0, 0], [1 - gap, 1, 2]), b=block([1, 0, 0], [2, 1, 2])))
    assert bool(graph.edges) is touching  # 0.005 of 2 m


def test_the_mesh_tolerance_is_a_setting():
    parts = asset(a=block([0, 0, 0], [0.996, 1, 1]), b=block([1, 0, 0], [2, 1, 1]))
    assert parse_graph(parts).edges
    assert not parse_graph(parts, ParsingConfig(mesh_tolerance=0.0005)).edges


def test_nodes_keep_order_names_and_boxes():
    graph = parse_graph(asset(z=NOOK, a=CORNER))
    assert [(n.id, n.source_name) for n in graph.nodes] == [("z", "the z"), ("a", "the a")]
    assert graph.node("z").box == NOOK.box
    assert graph.node("z").points is None


GLASS = Material("glass", (0.8, 0.9, 0.9, 0.3), alpha_mode="BLEND")


def test_nodes_state_how_much_of_their_surface_is_transparent():
    frame, pane = block([0, 0, 0], [1, 1, 1]), block([0, 0, 2], [1, 1, 3])
    surfaces = {
        "board": (Surface(frame),),
        "door": (Surface(frame), Surface(pane, GLASS)),
        "pane": (Surface(pane, GLASS),),
        "leaves": (Surface(pane, replace(GLASS, base_color=(0.1, 0.5, 0.1, 1.0))),),  # cut out by its picture
        "tinted": (Surface(pane, replace(GLASS, alpha_mode="OPAQUE")),),
        "point": (Surface(TriangleMesh(np.zeros((3, 3)), np.array([[0, 1, 2]])), GLASS),),
    }
    parts = tuple(Part(name, PartLabel.UNKNOWN, of, PartSource(name)) for name, of in surfaces.items())
    graph = parse_graph(Asset("thing", "", "made", parts))
    found = {node.id: node.transparent for node in graph.nodes}
    assert found == {"board": 0.0, "door": 0.5, "pane": 1.0, "leaves": 0.0, "tinted": 0.0, "point": 0.0}
    assert graph_features(graph).transparent.tolist() == list(found.values())


@pytest.mark.parametrize("transparent", [-0.1, 1.1, float("nan")])
def test_a_fraction_of_a_surface_is_in_0_to_1(transparent):
    with pytest.raises(GraphError, match=r"the transparent fraction of `a` must be 0\.\.1: got"):
        PartNode("a", PartLabel.DOOR, NOOK.box, transparent=transparent)


def test_points_lie_on_the_part_and_repeat_with_the_seed():
    graph = parse_graph(asset(nook=NOOK), ParsingConfig(points=64, seed=3))
    cloud = graph.nodes[0].points
    assert cloud is not None
    assert cloud.points.shape == (64, 3)
    assert np.allclose(np.abs((cloud.points - NOOK.box.center) / NOOK.box.half).max(axis=1), 1.0)
    assert graph == parse_graph(asset(nook=NOOK), ParsingConfig(points=64, seed=3))
    assert graph != parse_graph(asset(nook=NOOK), ParsingConfig(points=64, seed=4))


def test_points_of_a_mesh_without_area_are_its_vertices():
    flat = TriangleMesh(np.array([[1.0, 2.0, 3.0]]), np.array([[0, 0, 0]]))
    assert np.allclose(sample_surface(flat, 5).points, [1, 2, 3])


def test_parts_without_faces_touch_nothing():
    empty = TriangleMesh(np.full((2, 3), 0.05), np.zeros((0, 3), int))
    assert parse_graph(asset(corner=CORNER, empty=empty)).edges == ()


def test_one_part_has_no_contact():
    assert parse_graph(asset(nook=NOOK)).edges == ()


@pytest.mark.parametrize("settings", [{"box_tolerance": -1.0}, {"mesh_tolerance": -1.0}, {"points": -1}])
def test_settings_must_not_be_negative(settings):
    with pytest.raises(ValueError, match="must not be negative"):
        ParsingConfig(**settings)


@given(st.lists(st.tuples(*[st.integers(0, 6)] * 3), max_size=12), st.sampled_from([0.0, 0.5, 1.0]))
def test_the_sweep_finds_what_every_pair_tried_finds(corners, margin):
    boxes = [Box(np.array(c, float), np.array(c, float) + 1) for c in corners]
    expected = [
        (i, j) for i in range(len(boxes)) for j in range(i + 1, len(boxes)) if boxes[i].overlaps(boxes[j], margin)
    ]
    assert near_pairs(boxes, margin) == expected


def test_two_hundred_parts_take_little_time():
    parts = {f"p{k}": block([k % 20, k // 20, 0], [k % 20 + 1, k // 20 + 1, 1]) for k in range(200)}
    made = asset(**parts)
    parse_graph(made)
    start = time.process_time()
    graph = parse_graph(made)
    assert time.process_time() - start < 1.0  # 0.2 s
    assert len(graph.edges) == 19 * 10 + 20 * 9 + 2 * 19 * 9
