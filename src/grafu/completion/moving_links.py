"""Links of a robot description that plainly move, though the network sees no door or drawer in them.

A link of its own whose plate has a handle moves, and so does what closes a hollow body from above: a file has no reason
to part these from the body otherwise. It looks at links, labels and shapes, never at joints.
"""

from collections.abc import Sequence
from typing import Final, final

import numpy as np

from grafu.asset.body_link import body_link, parts_of_links
from grafu.asset.grips import face_area
from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.graph.completion import GraphCompletion
from grafu.vocabulary import PartLabel

_UP: Final = 2
_RAYS: Final = 12  # along each side of an outline


@final
@dataclass(frozen=True, slots=True)
class MovingLinkConfig:
    """Which links move by their shape; lengths are metres.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    fitting: float = 0.12
    """Greatest face of what else is on such a link (fraction of that of its main part)."""
    plate: float = 0.35
    """Greatest thickness of a plate with a handle (fraction of its next side)."""
    large: float = 0.15
    """Least larger side of such a plate (fraction of the object's largest side): smaller ones are controls."""
    flat: float = 0.6
    """Greatest height of a lid (fraction of its shorter level side): a hood is higher than a board."""
    plan: float = 0.4
    """Least plan of a lid (fraction of the body's)."""
    overhang: float = 0.035
    """How far a lid stands out of its body at most (metres): the tops of tables stand out farther."""
    hollow: float = 0.06
    """Below a lid it is hollow for this at least (metres) ..."""
    open: float = 0.5
    """... on this much of its plan (fraction) ..."""
    floor: float = 0.6
    """... with a floor below this much of it (fraction) ..."""
    walls: float = 0.75
    """... and closed on this much of each side (fraction): that of a cabinet is closed by doors, of other links."""

    def __post_init__(self) -> None:
        require_positive(self, "overhang", "hollow")
        require_ratios(self, "fitting", "plate", "large", "flat", "plan", "open", "floor", "walls")


def links_that_move(
    completion: GraphCompletion, asset: Asset, config: MovingLinkConfig = MovingLinkConfig()
) -> tuple[str, ...]:
    """Returns the ids of parts that neither are nor were taken for doors or drawers, and plainly move.

    What the input names as anything else does not.
    """
    body, links = body_link(asset), parts_of_links(asset)
    if not body:
        return ()
    graph = completion.completed
    moving = {edge.child for edge in graph.motions}
    handles = {part.id for part in asset.parts if graph.node(part.id).label is PartLabel.HANDLE}
    found = []
    for own in (own for link, own in links.items() if link != body):
        part = max(own, key=lambda p: face_area(p.box))
        is_one = all(p.id in handles or _is_small(p.box, part.box, config) for p in own if p is not part)
        if part.label is not PartLabel.UNKNOWN or not is_one or moving & {p.id for p in own}:
            continue
        has_handle = any(p.id in handles for p in own if p is not part)
        if (has_handle and _is_leaf(part.box, asset, config)) or _is_lid(part.box, links[body], config):
            found.append(part.id)
    return tuple(found)


def _is_small(box: Box, main: Box, config: MovingLinkConfig) -> bool:
    return face_area(box) <= config.fitting * face_area(main)


def _is_leaf(box: Box, asset: Asset, config: MovingLinkConfig) -> bool:
    sides = np.sort(box.size)
    return bool(sides[0] <= config.plate * sides[1] and sides[2] >= config.large * asset.extent)


def _is_lid(lid: Box, body: Sequence[Part], config: MovingLinkConfig) -> bool:
    """Whether a level plate or hood lies on a body, and closes a hollow in it that has a floor and four walls."""
    mesh = merge_meshes([part.mesh for part in body])
    around = mesh.box
    if lid.size[_UP] > config.flat * lid.size[:_UP].min() or lid.low[_UP] < around.center[_UP]:
        return False
    below = Box.enclosing(p.box for p in body if p.box.low[_UP] < lid.low[_UP])
    beyond = np.maximum(below.low - lid.low, lid.high - below.high)[:_UP]
    is_small = float(np.prod(lid.size[:_UP])) < config.plan * float(np.prod(below.size[:_UP]))
    if is_small or beyond.max() > config.overhang:
        return False
    rays = RayCaster(mesh)
    origins = _spots(lid)
    depths = rays.along(origins, np.array([0.0, 0.0, -1.0]))
    is_hollow = np.isfinite(depths) & (depths >= config.hollow)
    if is_hollow.mean() < config.open or np.isfinite(depths).mean() < config.floor:
        return False
    return _is_walled(rays, origins[is_hollow], float(np.median(depths[is_hollow])), lid, config)


def _spots(lid: Box) -> np.ndarray:
    """Returns points right below a lid, all over its plan but at its borders."""
    steps = (np.arange(_RAYS) + 0.5) / _RAYS
    places = lid.low[:_UP] + np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2) * lid.size[:_UP]
    return np.column_stack([places, np.full(len(places), float(lid.low[_UP]) - 1e-4)])


def _is_walled(rays: RayCaster, spots: np.ndarray, depth: float, lid: Box, config: MovingLinkConfig) -> bool:
    """Whether rays from the middle of a hollow end within the outline of its lid, to each of the four sides."""
    starts = spots - np.array([0.0, 0.0, depth / 2])
    for axis in range(_UP):
        for sign in (-1.0, 1.0):
            met = rays.along(starts, sign * np.eye(3)[axis])
            border = lid.high[axis] - starts[:, axis] if sign > 0 else starts[:, axis] - lid.low[axis]
            if float((met <= border + config.overhang).mean()) < config.walls:
                return False
    return True
