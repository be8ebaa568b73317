"""Doors right above each other agree on a side, as far as none of them is sure of another."""

import numpy as np
import pytest
from hypothesis import assume, given
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


def test_a_column_that_tells_nothing_hangs_on_the_right():
    assert agreed((door("low", 0.0), 0.53), (door("up", 0.61), 0.52)) == {"low": RIGHT, "up": RIGHT}
    assert agreed((door("low", 0.0), 0.53), (door("up", 0.61), 0.6)) == {"low": LEFT, "up": LEFT}
    assert agreed((door("alone", 0.0), 0.53)) == {"alone": LEFT}


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
    flap = np.array([0.02, 0.015, 0.0, 0.965])
    factors = agreed_borders([door("low", 0.0), door("up", 0.61)], {"low": flap, "up": borders(0.1)}, CONFIG)
    assert factors["low"].tolist() == [0.0, 1.0, 1.0, 1.0]
    assert int(np.argmax(flap * factors["low"])) == 3
    assert "up" not in factors


@given(st.lists(st.floats(0.02, 0.98), min_size=2, max_size=5))
def test_unsure_doors_follow_the_surest_whatever_the_order(alone):
    doors = [door(f"d{k}", 0.61 * k) for k in range(len(alone))]
    seen = {d.id: borders(left) for d, left in zip(doors, alone, strict=True)}
    factors = agreed_borders(doors, seen)
    assert all(np.array_equal(a, factors[k]) for k, a in agreed_borders(doors[::-1], seen).items())
    sureness = [max(left, 1.0 - left) for left in alone]
    assume(sorted(sureness)[-1] > sorted(sureness)[-2])
    assume(abs(max(sureness) - min(1.0 - s for s in sureness) - CONFIG.tied) > 1e-6)
    is_tied = max(sureness) - min(1.0 - s for s in sureness) < CONFIG.tied
    leading = LEFT if alone[int(np.argmax(sureness))] > 0.5 and not is_tied else RIGHT
    for k, left in enumerate(alone):
        follows = sureness[k] < CONFIG.unsure and (is_tied or sureness[k] < max(sureness))
        own = LEFT if left >= 0.5 else RIGHT
        chosen = int(np.argmax(seen[f"d{k}"] * factors.get(f"d{k}", 1.0)))
        assert chosen == (leading if follows else own)


def test_a_config_refuses_what_is_no_ratio():
    with pytest.raises(ValueError, match="unsure"):
        ColumnConfig(unsure=0.0)
