"""What of each part is visible from each side, and what lies behind it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.completion.features import FeatureConfig, graph_features, mirrored
from grafu.completion.visibility import DIRECTIONS, visibility_of
from grafu.geometry.box import Box
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.vocabulary import PartLabel
from small_graphs import cabinet

LEFT, RIGHT, FRONT, BACK, BELOW, ABOVE = range(DIRECTIONS)


def seen(*boxes: tuple[tuple[float, ...], tuple[float, ...]]) -> np.ndarray:
    """Returns by part the visible fraction, the distance and the depth (of the object's size) for each direction."""
    nodes = tuple(
        PartNode(f"p{k}", PartLabel.UNKNOWN, Box(np.array(low), np.array(high))) for k, (low, high) in enumerate(boxes)
    )
    features = graph_features(FunctionalGraph("m", nodes), FeatureConfig())
    found = features.visibility.reshape(len(nodes), 3, DIRECTIONS).astype(np.float64)
    found[:, 1:] = np.sinh(found[:, 1:] * 5.0) * 0.004
    return found


def test_a_front_hides_the_shelf_behind_it_and_has_a_hollow_behind() -> None:
    front, shelf, back = seen(
        ((-0.5, -0.4, 0.0), (0.5, -0.38, 1.0)),
        ((-0.45, -0.3, 0.45), (0.45, 0.3, 0.48)),
        ((-0.5, 0.38, 0.0), (0.5, 0.4, 1.0)),
    )
    assert front[0, FRONT] == back[0, BACK] == 1.0
    assert shelf[0, FRONT] == shelf[0, BACK] == 0.0
    assert shelf[1:, FRONT].tolist() == [0.0, 0.0]
    assert 0.6 < front[1, FRONT] < 0.77  # 0.78 to the back, 0.1 to the narrow shelf before it
    assert front[2, FRONT] == pytest.approx(0.02, abs=0.01)
    assert shelf[0, ABOVE] == 1.0
    assert shelf[1, ABOVE] == pytest.approx(1.0)  # nothing is below


def test_a_part_alone_is_visible_from_all_sides_with_nothing_behind() -> None:
    (only,) = seen(((0.0, 0.0, 0.0), (1.0, 0.5, 0.25)))
    assert (only[0] == 1.0).all()
    assert np.allclose(only[1], 1.0)
    assert only[2] == pytest.approx([1.0, 1.0, 0.5, 0.5, 0.25, 0.25], rel=0.1)


@pytest.mark.parametrize("across", [0, 1])
def test_a_mirror_image_is_seen_from_the_other_side(across: int) -> None:
    graph = cabinet(512)
    features = graph_features(graph, FeatureConfig())
    swapped = np.arange(DIRECTIONS)
    swapped[2 * across : 2 * across + 2] = swapped[2 * across : 2 * across + 2][::-1]
    count = len(graph.nodes)
    plain = features.visibility.reshape(count, 3, DIRECTIONS)[:, :, swapped]
    image = mirrored(features, across).visibility.reshape(count, 3, DIRECTIONS)
    assert np.abs(plain - image).mean() < 0.05  # a point on the border of two cells falls on the other side of it


@given(st.integers(0, 3))
def test_there_is_a_row_for_each_part(count: int) -> None:
    found = visibility_of(np.zeros((count, 4, 3), np.float32), np.zeros((count, 4, 2, 3), np.float32))
    assert found.shape == (count, 18)
    assert np.isfinite(found).all()
