"""The two edges of a plate at any angle about a level line: of flaps, lids and seats, closed, raised or hanging."""

from collections.abc import Iterator
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.box import yaw_of
from grafu.geometry.mesh import TriangleMesh

_UP = 2


@final
@dataclass(frozen=True, slots=True)
class PlateEdge:
    """The middle of an edge of a plate, seen along a level axis, metres.

    `level` is its place along the other level axis, `up` its height, `low` that of its lower face, `across` the width
    of the plate from this edge to the other.
    """

    level: float
    up: float
    low: float
    across: float

    @property
    def high(self) -> float:
        """The height of its upper face."""
        return 2 * self.up - self.low


def edges_of(mesh: TriangleMesh, along: int, thin: float) -> Iterator[PlateEdge]:
    """Yields both edges of a plate that run along a level axis; none where it is no plate, seen along that.

    Args:
        mesh: the plate, Z up.
        along: the level axis, 0 (X) or 1 (Y).
        thin: its greatest thickness (fraction of its width).
    """
    seen = mesh.vertices[:, [1 - along, _UP]]
    turn = yaw_of(np.column_stack([seen, np.zeros(len(seen))]))
    frame = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    local = seen @ frame
    low, high = local.min(axis=0), local.max(axis=0)
    wide = int(np.argmax(high - low))
    width, thickness = float((high - low)[wide]), float((high - low)[1 - wide])
    if thickness > thin * width:
        return
    for end in (low[wide], high[wide]):
        middle = (low + high) / 2
        middle[wide] = end
        level, up = (frame @ middle).tolist()
        yield PlateEdge(level, up, up - thickness * abs(float(frame[_UP - 1, 1 - wide])) / 2, width)
