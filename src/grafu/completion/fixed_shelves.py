"""Shelves that are boards are fixed: of what the network slides, racks, baskets and trays do."""

from dataclasses import replace
from typing import Final, final

import numpy as np

from grafu.asset.names import singular, spoken
from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_ratios
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster, depths_below
from grafu.graph.completion import GraphCompletion
from grafu.graph.edit import without_edges
from grafu.vocabulary import PartLabel

_UP: Final = 2
_RAYS: Final = 24  # along each side of an outline
_SLIDING: Final = frozenset({"sliding", "slide", "slider", "pull", "pullout", "tray", "rack", "basket", "translation"})


@final
@dataclass(frozen=True, slots=True)
class FixedShelfConfig:
    """What shelf is a board.

    Raises:
        ValueError: if a number is not between 0 and 1.
    """

    flat: float = 0.05
    """Its greatest height (fraction of the shorter of its level sides): a tray has a rim."""
    closed: float = 0.9
    """Least fraction of its outline that it covers, seen from above: a rack is a grid."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def with_fixed_shelves(
    completion: GraphCompletion, asset: Asset, config: FixedShelfConfig = FixedShelfConfig()
) -> GraphCompletion:
    """Returns the completion in which no shelf slides that is a board, unless it is named as one that slides."""
    graph, parts = completion.completed, {part.id: part for part in asset.parts}
    shelves = [edge for edge in graph.slides if graph.node(edge.child).label is PartLabel.SHELF and edge.child in parts]
    boards = [edge for edge in shelves if _is_board(parts[edge.child].mesh, config)]
    fixed = [edge for edge in boards if not _slides(graph.node(edge.child).source_name)]
    if not fixed:
        return completion
    still = {edge.child for edge in fixed}
    decisions = tuple(d for d in completion.decisions if d.part not in still or d.question == "label")
    return replace(completion, completed=without_edges(graph, fixed), decisions=decisions)


def _slides(name: str) -> bool:
    return not _SLIDING.isdisjoint(singular(word) for word in spoken(name))


def _is_board(mesh: TriangleMesh, config: FixedShelfConfig) -> bool:
    box = mesh.box
    if not (box.size[:_UP] > 0).all() or box.size[_UP] > config.flat * box.size[:_UP].min():
        return False
    depths = depths_below(RayCaster(mesh), box, _UP, _RAYS, float(box.size.max()))
    return bool(np.isfinite(depths).mean() >= config.closed)
