"""Equal boards beside one another get one label; what differs, stands apart or is labelled keeps its own."""

import numpy as np
import pytest

from grafu.completion.alike import AlikeConfig, with_alike
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.graph.arrays import LABELS
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.vocabulary import PartLabel

BAR, DRAWER = LABELS.index(PartLabel.BAR), LABELS.index(PartLabel.DRAWER)
DRAWERS = (0.5, 0.2, 0.95, 0.99)


def weighed(drawers=DRAWERS, sizes=(0.15,) * 4, pitch=0.16, step=(0, 0, 1), first=PartLabel.UNKNOWN, deep=0.02):
    """The drawers' weights of boards in a row, before and after; the rest of the weight is the bars'."""
    nodes = []
    for k, size in enumerate(sizes):
        at = k * pitch * np.array(step, float)
        box = Box(at, at + vec3(0.5, deep, size) if step[2] else at + vec3(size, deep, 0.5))
        nodes.append(PartNode(f"p{k}", first if k == 0 else PartLabel.UNKNOWN, box))
    weights = np.zeros((len(nodes), len(LABELS)))
    weights[:, DRAWER], weights[:, BAR] = drawers, 1.0 - np.array(drawers)
    return with_alike(weights, FunctionalGraph("row", tuple(nodes)))[:, DRAWER]


@pytest.mark.parametrize("step", [(0, 0, 1), (1, 0, 0)], ids=["column", "row"])
@pytest.mark.parametrize("pitch", [0.15, 0.16])
def test_equal_boards_beside_one_another_have_the_mean(step, pitch):
    np.testing.assert_allclose(weighed(step=step, pitch=pitch), np.mean(DRAWERS))


@pytest.mark.parametrize(
    ("how", "expected"),
    [
        ({"pitch": 0.2}, DRAWERS),
        ({"drawers": DRAWERS[:2], "sizes": (0.15,) * 2}, DRAWERS[:2]),
        ({"sizes": (0.15, 0.13, 0.15, 0.13), "pitch": 0.15}, DRAWERS),
        ({"step": (0, 1, 0), "pitch": 0.02}, DRAWERS),
        ({"deep": 0.14}, DRAWERS),
        ({"first": PartLabel.BAR}, (0.5, *[np.mean(DRAWERS[1:])] * 3)),
    ],
    ids=["apart", "only two", "of two sizes", "one behind the other", "no boards", "a label that is given"],
)
def test_others_keep_theirs(how, expected):
    np.testing.assert_allclose(weighed(**how), expected)


def test_fractions_are_checked():
    with pytest.raises(ValueError, match="same"):
        AlikeConfig(same=1.5)
    with pytest.raises(ValueError, match="least"):
        AlikeConfig(least=0)
