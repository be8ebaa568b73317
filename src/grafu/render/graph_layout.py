"""Where the nodes of a graph stand in its picture: where their parts stand, pushed apart. It draws nothing."""

import numpy as np

from grafu.graph.functional_graph import FunctionalGraph
from grafu.shapes import Bool, Float

Places = Float[np.ndarray, "n 2"]

_OBLIQUE = np.array([0.22, -0.30])  # how far depth shifts a node right and up, so that front and back stay apart
_STEPS = 250
_MOST_PUSHED = 500  # nodes: more find no room beside each other anyway, and all pairs of them would take minutes
_ASIDE = 4  # steps of which each pushes boxes more to the side than the one before
_PULL = 0.04  # fraction of the distance to its place that a node is drawn back in each step


def node_places(graph: FunctionalGraph, size: tuple[int, int], margin: float, apart: float) -> Places:
    """Returns the middle of each node in a picture of `size`, y downwards, in the graph's order.

    Nodes keep `margin` from the picture's border, and `apart` from each other where there is room for that; very many
    stand where they are seen.
    """
    if not graph.nodes:
        return np.zeros((0, 2))
    low, room = np.full(2, margin), np.array(size, dtype=np.float64) - 2 * margin
    home = low + _projected(graph) * room
    if len(home) > _MOST_PUSHED:
        return home
    rng = np.random.default_rng(0)  # parts in one place have no side to go to: the same one every time
    places = home + rng.uniform(-0.5, 0.5, home.shape)
    apart = min(apart, 0.95 * float(np.sqrt(room.prod() / len(home))))
    for _ in range(_STEPS):
        places = _within(places + _PULL * (home - places) + _pushes(places, apart), low, low + room)
    return places


def _projected(graph: FunctionalGraph) -> Places:
    """Returns the box middles seen from the front and a little from above, in 0..1, y downwards."""
    middles = np.array([node.box.center for node in graph.nodes])
    sides = np.maximum(np.ptp(middles, axis=0), 1e-9)
    x, y, z = ((middles - middles.min(axis=0)) / sides).T
    flat = np.stack([x + _OBLIQUE[0] * y, 1.0 - z + _OBLIQUE[1] * y], axis=1)
    return (flat - flat.min(axis=0)) / np.maximum(np.ptp(flat, axis=0), 1e-9)


def _pushes(places: Places, apart: float) -> Places:
    x, y = (column[:, None] - column for column in places.T)
    distance = np.maximum(np.sqrt(x * x + y * y), 1e-6)
    push = 0.4 * np.maximum(apart - distance, 0.0) / distance  # of a place from itself: along no way
    return np.stack([(x * push).sum(axis=1), (y * push).sum(axis=1)], axis=1)


def _within(places: Places, low: np.ndarray, high: np.ndarray) -> Places:
    """Returns the places clipped: `numpy.clip` takes three times as long."""
    return np.minimum(np.maximum(places, low), high)


def with_room(places: Places, halves: Places, size: tuple[int, int]) -> Places:
    """Returns the places moved so that boxes of these half sizes around them meet as little as there is room for.

    All numbers are pixels; the boxes stay in the picture. Very many places stay as they are.
    """
    if not 1 < len(places) <= _MOST_PUSHED:
        return places
    low = np.minimum(halves, np.array(size) / 2)
    high = np.maximum(np.array(size) - halves, np.array(size) / 2)
    found = np.clip(places, low, high)
    for step in range(_STEPS):
        push = _box_pushes(found, halves, aside=1.0 + step % _ASIDE)
        if not push.any():
            break
        found = _within(found + push, low, high)
    return found


def _box_pushes(places: Places, halves: Places, aside: float) -> Places:
    """Returns how each box is pushed away from those that it meets: along the side on which the least is lacking.

    Names are wide, so that this is mostly up or down; by the factor `aside` more may be lacking to the side.
    """
    away = places.T[:, None] - places.T[:, :, None]  # of the second number from the first, x and y apart: quicker
    lacking = halves.T[:, None] + halves.T[:, :, None] - np.abs(away)
    first, second = np.nonzero((lacking > 0).all(axis=0))
    first, second = first[first != second], second[first != second]  # only few boxes meet
    away, lacking = away[:, first, second], lacking[:, first, second]
    side = np.where(away != 0, np.sign(away), np.sign(second - first))  # two in one place part
    along_x = lacking[0] <= aside * lacking[1]
    push = 0.5 * side * lacking * np.stack([along_x, ~along_x])
    count = np.bincount(second, minlength=len(places))
    total = np.stack([np.bincount(second, one, len(places)) for one in push], axis=1)
    return np.asarray(total / np.maximum(count, 1)[:, None])


def in_the_way(places: Places, halves: Places, stays: Bool[np.ndarray, " n"]) -> Bool[np.ndarray, " n"]:
    """Returns which boxes of these half sizes must go so that none meets another, the first kept where two meet.

    What `stays` keeps a part of itself, such as the writing of a motion: no other box may meet it, even where it goes.
    """
    found = np.zeros(len(places), dtype=bool)
    for k in range(len(places)):
        lacking = halves[k] + halves - np.abs(places[k] - places)
        meets = (lacking > 1.0).all(axis=1)  # by less than a pixel is not seen
        meets[k] = False
        found[k] = bool((meets[:k] & ~found[:k]).any() or (meets & stays).any())
    return found
