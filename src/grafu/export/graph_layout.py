"""Where the nodes of a functional graph stand in a picture: as the parts stand seen from the front, pushed apart.

It draws nothing.
"""

import numpy as np
from jaxtyping import Float

from grafu.graph.functional_graph import FunctionalGraph

Places = Float[np.ndarray, "n 2"]

_OBLIQUE = np.array([0.22, -0.30])  # how far depth shifts a node right and up, so that front and back stay apart
_STEPS = 250
_MOST_PUSHED = 500  # nodes: more find no room beside each other anyway, and all pairs of them would take minutes
_PULL = 0.04  # share of the way home that a node is drawn back in each step


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
        places = np.clip(places + _PULL * (home - places) + _pushes(places, apart), low, low + room)
    return places


def _projected(graph: FunctionalGraph) -> Places:
    """Returns the box middles seen from the front and a little from above, in 0..1, y downwards."""
    middles = np.array([node.box.center for node in graph.nodes])
    sides = np.maximum(np.ptp(middles, axis=0), 1e-9)
    x, y, z = ((middles - middles.min(axis=0)) / sides).T
    flat = np.stack([x + _OBLIQUE[0] * y, 1.0 - z + _OBLIQUE[1] * y], axis=1)
    return (flat - flat.min(axis=0)) / np.maximum(np.ptp(flat, axis=0), 1e-9)


def _pushes(places: Places, apart: float) -> Places:
    away = places[:, None] - places[None]
    distance = np.maximum(np.linalg.norm(away, axis=2), 1e-6)
    lacking = np.maximum(apart - distance, 0.0)
    np.fill_diagonal(lacking, 0.0)
    return (away * (0.4 * lacking / distance)[..., None]).sum(axis=1)
