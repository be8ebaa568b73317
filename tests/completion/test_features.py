"""What the network sees of a graph: its frame, its codes, its grouped points, and the mirror image."""

import numpy as np
import pytest

from grafu.completion.features import (
    FeatureConfig,
    GraphFeatures,
    box_points,
    farthest_points,
    graph_features,
    group_points,
    mirrored,
    resampled,
)
from grafu.geometry.box import Box
from grafu.graph.arrays import ATTACHED, CONTACT, HINGE, LABELS, NULL, RAIL
from grafu.graph.edit import mirrored as mirrored_graph
from grafu.graph.edit import scaled, without_nodes
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.vocabulary import PartLabel
from small_graphs import cabinet

SMALL = FeatureConfig(points=40, anchors=6, neighbours=5)


def place(graph: FunctionalGraph, name: str) -> int:
    return [node.id for node in graph.nodes].index(name)


def test_unknown_is_the_last_label() -> None:
    assert len(LABELS) == 14
    assert LABELS[-1] is PartLabel.UNKNOWN


def test_the_object_stands_on_the_ground_and_fills_a_unit() -> None:
    features = graph_features(cabinet(50), SMALL)
    low, high = features.boxes[:, :3] - features.boxes[:, 3:], features.boxes[:, :3] + features.boxes[:, 3:]

    assert np.isclose(low[:, 2].min(), 0.0)
    assert np.allclose(low[:, :2].min(axis=0), -high[:, :2].max(axis=0), atol=1e-6)
    assert np.isclose((high.max(axis=0) - low.min(axis=0)).max(), 1.0)


def test_origin_and_scale_lead_back() -> None:
    graph = cabinet(50)
    features = graph_features(graph, SMALL)

    centres = features.boxes[:, :3] * features.scale + features.origin
    assert np.allclose(centres, [node.box.center for node in graph.nodes], atol=1e-6)


def test_edges_are_codes_both_ways() -> None:
    graph = cabinet()
    edges = graph_features(graph, SMALL).edges
    left, door, drawer, knob = (place(graph, name) for name in ("left", "door_1", "drawer_1", "knob_1"))

    assert (edges == edges.T).all()
    assert (edges.diagonal() == NULL).all()
    assert (edges[left, door], edges[left, drawer], edges[door, knob]) == (HINGE, RAIL, ATTACHED)
    assert edges[left, place(graph, "back")] == CONTACT
    assert edges[left, knob] == NULL


def test_groups_are_points_of_the_part() -> None:
    graph = cabinet(40)
    features = graph_features(graph, SMALL)
    points = (graph.nodes[3].points.points - features.origin) / features.scale
    seen = (features.anchors[3][:, None] + features.groups[3]).reshape(-1, 3)

    assert np.abs(seen[:, None] - points[None]).max(axis=2).min(axis=1).max() < 1e-6


def test_a_part_is_seen_alike_alone_and_among_others() -> None:
    graph = cabinet(40)
    features = graph_features(graph, SMALL)
    order = np.arange(len(graph.nodes))[::-1]
    turned = graph_features(FunctionalGraph("turned", graph.nodes[::-1], graph.edges), SMALL)

    assert np.array_equal(turned.anchors, features.anchors[order])
    assert np.array_equal(turned.groups, features.groups[order])
    assert np.array_equal(turned.edges, features.edges[np.ix_(order, order)])


def test_size_and_place_change_nothing() -> None:
    graph = cabinet(40)
    here, there = graph_features(graph, SMALL), graph_features(scaled(graph, 4.0), SMALL)

    assert there.scale == pytest.approx(4 * here.scale)
    assert np.allclose(there.boxes, here.boxes, atol=1e-6)
    assert np.allclose(there.anchors, here.anchors, atol=1e-6)


def test_the_same_graph_gives_the_same_features() -> None:
    assert graph_features(cabinet(40), SMALL) == graph_features(cabinet(40), SMALL)


@pytest.mark.parametrize("across", [0, 1])
def test_the_mirror_image_is_the_image_of_the_features(across: int) -> None:
    graph = cabinet(40)
    expected, found = (
        graph_features(mirrored_graph(graph, across), SMALL),
        mirrored(graph_features(graph, SMALL), across),
    )

    assert np.allclose(found.boxes, expected.boxes, atol=1e-6)
    assert np.allclose(found.anchors, expected.anchors, atol=1e-6)
    assert np.allclose(np.sort(found.groups, axis=2), np.sort(expected.groups, axis=2), atol=1e-6)
    assert mirrored(found, across) == graph_features(graph, SMALL)


def test_gravity_is_not_mirrored() -> None:
    with pytest.raises(ValueError, match=r"`across` must be 0 \(X\) or 1 \(Y\): got 2"):
        mirrored(graph_features(cabinet(), SMALL), 2)


def test_a_graph_without_nodes_has_features() -> None:
    features = graph_features(FunctionalGraph("empty", ()), SMALL)

    assert (features.labels.shape, features.groups.shape, features.edges.shape) == ((0,), (0, 6, 5, 3), (0, 0))


def test_a_part_without_any_extent_has_features() -> None:
    point = Box(np.ones(3), np.ones(3))
    features = graph_features(FunctionalGraph("dot", (PartNode("dot", PartLabel.MISC, point),)), SMALL)

    assert isinstance(features, GraphFeatures)
    assert (features.scale, float(np.abs(features.boxes).max()), float(np.abs(features.anchors).max())) == (1.0, 0, 0)


def test_points_of_a_box_lie_on_all_its_faces_by_area() -> None:
    low, high = np.zeros((1, 3)), np.array([[1.0, 2.0, 4.0]])
    points = box_points(low, high, 2800)[0]
    on_face = [(points[:, axis] == end[0, axis]).sum() for axis in range(3) for end in (low, high)]

    assert sum(on_face) == 2800
    assert np.allclose(on_face, [800, 800, 400, 400, 200, 200], atol=40)


def test_a_flat_box_is_covered_on_both_sides() -> None:
    points = box_points(np.zeros((1, 3)), np.array([[1.0, 0.0, 1.0]]), 64)[0]

    assert (points[:, 1] == 0).all()
    assert np.ptp(points[:, [0, 2]], axis=0).min() > 0.8


def test_anchors_are_spread_farthest_apart() -> None:
    line = np.zeros((1, 101, 3), dtype=np.float32)
    line[0, :, 0] = np.linspace(0, 1, 101) ** 2  # its mean is nearer to 0, so that 1 comes first

    assert line[0, farthest_points(line, 3)[0], 0].tolist() == pytest.approx([1.0, 0.0, 0.5], abs=0.02)


def test_groups_hold_the_nearest() -> None:
    rng = np.random.default_rng(0)
    clouds = rng.random((2, 60, 3)).astype(np.float32)
    anchors, groups = group_points(clouds, 4, 7)
    away = np.sort(np.linalg.norm(clouds[1][None] - anchors[1][:, None], axis=2), axis=1)[:, :7]

    assert np.allclose(np.sort(np.linalg.norm(groups[1], axis=2), axis=1), away, atol=1e-6)


def test_few_points_are_repeated_and_many_picked() -> None:
    points = np.arange(30.0).reshape(10, 3)

    assert resampled(points, 25).shape == (25, 3)
    assert resampled(points, 5)[:, 0].tolist() == [0.0, 6.0, 12.0, 18.0, 24.0]
    assert resampled(points, 10) is points


def test_more_anchors_than_points_are_refused() -> None:
    with pytest.raises(ValueError, match="must be 1 to `points`"):
        FeatureConfig(points=8, anchors=16, neighbours=4)


def test_what_is_seen_of_the_rest_stays_when_a_part_within_goes() -> None:
    graph = cabinet(40)
    features, fewer = graph_features(graph, SMALL), graph_features(without_nodes(graph, ["back"]), SMALL)

    assert np.array_equal(np.delete(features.anchors, place(graph, "back"), axis=0), fewer.anchors)
