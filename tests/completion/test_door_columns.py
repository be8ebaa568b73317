"""Doors right above each other agree on a side, as far as none of them is sure of another."""

from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.completion.columns import agreed_borders
from grafu.completion.decode_config import ColumnConfig
from grafu.geometry.box import Box
from grafu.graph.functional_graph import PartNode
from grafu.vocabulary import PartLabel

CONFIG = ColumnConfig()
LEFT, RIGHT = 0, 1  # borders of a door before -Y: the low and the high end of X


def door(name: str, z: float, x: float = 0.0, width: float = 0.5, height: float = 0.6, y: float = 0.0) -> PartNode:
    return PartNode(name, PartLabel.DOOR, Box(np.array([x, y, z]), np.array([x + width, y + 0.02, z + height])))


def borders(left: float) -> np.ndarray:
    return np.array([left, 1.0 - left, 0.0, 0.0])


def agreed(*doors: tuple[PartNode, float], config: ColumnConfig = CONFIG) -> dict[str, int]:
    """Returns the likelier side of each door; each number is how likely it alone is hinged on the left."""
    seen = {node.id: borders(left) for node, left in doors}
    factors = agreed_borders([node for node, _ in doors], seen, config)
    return {name: int(np.argmax(alone * factors.get(name, 1.0))) for name, alone in seen.items()}


def test_a_door_that_tells_nothing_follows_the_one_above_it():
    assert agreed((door("low", 0.0), 0.49), (door("up", 0.61), 0.8)) == {"low": LEFT, "up": LEFT}
    assert agreed((door("low", 0.0), 0.2), (door("up", 0.61), 0.51)) == {"low": RIGHT, "up": RIGHT}


def test_doors_that_are_sure_keep_their_sides():
    assert agreed((door("low", 0.0), 0.97), (door("up", 0.61), 0.03)) == {"low": LEFT, "up": RIGHT}


@pytest.mark.parametrize(
    "other",
    [door("up", 0.61, x=0.51), door("up", 0.61, width=0.7), door("up", 0.9), door("up", 0.61, y=0.3)],
    ids=["beside it", "wider", "far above", "in another plane"],
)
def test_only_doors_of_one_column_agree(other):
    assert agreed((door("low", 0.0), 0.49), (other, 0.99)) == {"low": RIGHT, "up": LEFT}


def test_what_turns_about_a_level_line_is_left_as_it_is():
    flap = np.array([0.02, 0.01, 0.0, 0.97])
    factors = agreed_borders([door("low", 0.0), door("up", 0.61)], {"low": flap, "up": borders(0.4)}, CONFIG)
    assert int(np.argmax(flap * factors["low"])) == 3
    np.testing.assert_array_equal(factors["low"][2:], 1.0)


@given(st.lists(st.floats(0.02, 0.98), min_size=2, max_size=5), st.floats(1.0, 30.0))
def test_a_column_is_judged_as_all_its_combinations_are(alone, same_side):
    """The probabilities are those of the sum over all combinations of sides, whatever the order of the doors."""
    doors = [door(f"d{k}", 0.61 * k) for k in range(len(alone))]
    weights = {}
    for sides in product((LEFT, RIGHT), repeat=len(alone)):
        each = [left if side == LEFT else 1.0 - left for side, left in zip(sides, alone, strict=True)]
        alike = sum(a == b for a, b in pairwise(sides))
        weights[sides] = np.prod(each) * same_side**alike
    total = sum(weights.values())
    factors = agreed_borders(
        doors[::-1], {d.id: borders(p) for d, p in zip(doors, alone, strict=True)}, ColumnConfig(same_side)
    )
    for k, left in enumerate(alone):
        expected = sum(w for sides, w in weights.items() if sides[k] == LEFT) / total
        assert left * factors[f"d{k}"][LEFT] == pytest.approx(expected, rel=1e-9)


def test_a_config_refuses_what_is_no_ratio():
    with pytest.raises(ValueError, match="same_side"):
        ColumnConfig(same_side=0.0)
