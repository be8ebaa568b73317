"""Round doors of washing machines and dryers: a disc before the front panel is the door, and the panel stays."""

from collections.abc import Collection, Iterator
from dataclasses import replace
from typing import final

import numpy as np
import shapely

from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.swept_body import SweptBody
from grafu.joints.framed_leaves import relabelled
from grafu.vocabulary import PartLabel

_DEPTH = 1
_ACROSS = [0, 2]


@final
@dataclass(frozen=True)
class PortholeConfig:
    """What counts as a round door in a front panel.

    Raises:
        ValueError: if a number is not between 0 and 1.
    """

    slender: float = 0.5
    """Least width of the object (fraction of its height), and least depth (fraction of its width): others are closets,
    clocks and mirrors."""
    wide: float = 0.4
    """Least diameter of the disc (fraction of the object's width)."""
    round: float = 0.88
    """Least area of its outline (fraction of the circle around it)."""
    deep: float = 0.4
    """Greatest depth of the disc (fraction of its diameter)."""
    middle: float = 0.15
    """How far the disc's middle may be from the object's at most (fraction of the object's width)."""
    near: float = 0.1
    """How far behind the foremost point of the object the disc begins at most (fraction of the object's depth)."""
    flat: float = 0.15
    """Greatest thickness of the panel behind it (fraction of the object's depth)."""
    on_panel: float = 0.02
    """How far the disc may stand out of the panel's outline (fraction of the object's width)."""
    controls: float = 0.5
    """Least width of the control panel above the disc (fraction of the object's): a drawer for powder is narrower."""
    sunk: float = 5e-4
    """A disc that cuts deeper into what is none is fixed in it (fraction of the object's largest side)."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def with_porthole_labels(asset: Asset, config: PortholeConfig = PortholeConfig()) -> Asset:
    """Returns the asset in which the round door of a washing machine is a door, and the panel behind it is none.

    All discs of its size lie on one another, and nothing else is called a door or a drawer. Parts with names keep
    their labels.
    """
    discs = [part for part in asset.parts if _is_disc(part, asset.box, config)]
    width, depth, height = asset.box.size.tolist()
    if not discs or width < config.slender * height or depth < config.slender * width:
        return asset
    door = max(discs, key=lambda part: float(part.box.size[0]))
    others = [part for part in asset.parts if part.label.is_movable and part is not door]
    if others or any(not _lies_on(part.box, door.box, asset.box, config) for part in discs):
        return asset
    panels = {part.id: PartLabel.FACE_FRAME for part in _panels(door.box, asset, config)}
    loose = (part for part in discs if part is not door and part.label is PartLabel.UNKNOWN)
    riding = {part.id for part in loose if not _is_sunk(part, asset, [disc.id for disc in discs], config)}
    found = relabelled(asset, {door.id: PartLabel.DOOR, **panels, **dict.fromkeys(riding, PartLabel.MISC)})
    parts = tuple(replace(p, carried_by=door.id) if p.id in riding else p for p in found.parts)
    return replace(found, parts=parts)


def _is_sunk(disc: Part, asset: Asset, discs: Collection[str], config: PortholeConfig) -> bool:
    """Whether a disc cuts into what is no disc: the ring of an opening, which stays."""
    body = SweptBody(disc.mesh, config.sunk * float(asset.box.size.max()))
    body.place(np.eye(4))
    near = (p for p in asset.parts if p.id not in discs and p.carried_by not in discs and p.box.overlaps(disc.box))
    return any(body.penetrates(MeshCollider(part.mesh)) for part in near)


def _is_disc(part: Part, whole: Box, config: PortholeConfig) -> bool:
    box = part.box
    if part.label not in (PartLabel.UNKNOWN, PartLabel.DOOR) or part.carried_by is not None:
        return False
    width = float(box.size[0])
    is_large = width >= config.wide * whole.size[0] and box.size[_DEPTH] <= config.deep * width
    is_before = box.low[_DEPTH] - whole.low[_DEPTH] <= config.near * whole.size[_DEPTH]
    is_amid = abs(box.center[0] - whole.center[0]) <= config.middle * whole.size[0]
    return bool(is_large and is_before and is_amid) and _is_round(part, config)


def _is_round(part: Part, config: PortholeConfig) -> bool:
    """Whether the outline of a part, seen from the front, is a circle."""
    outline = np.vstack([surface.mesh.vertices for surface in part.surfaces])[:, _ACROSS]
    radius = float(np.linalg.norm(outline - part.box.center[_ACROSS], axis=1).max())
    area = float(shapely.convex_hull(shapely.multipoints(outline)).area)
    return area >= config.round * np.pi * radius**2


def _panels(door: Box, asset: Asset, config: PortholeConfig) -> Iterator[Part]:
    """Yields the nameless flat parts of the front in whose outline the door lies, and the control panel above it."""
    spare = config.on_panel * float(asset.box.size[0])
    for part in asset.parts:
        box = part.box
        is_flat = (
            box.size[_DEPTH] <= config.flat * asset.box.size[_DEPTH] and box.low[_DEPTH] < asset.box.center[_DEPTH]
        )
        is_above = box.low[2] >= door.high[2] - spare and box.size[0] >= config.controls * asset.box.size[0]
        is_open = part.label is PartLabel.UNKNOWN and part.carried_by is None and box is not door
        if is_open and is_flat and (is_above or _lies_on(door, box, asset.box, config)):
            yield part


def _lies_on(inner: Box, outer: Box, whole: Box, config: PortholeConfig) -> bool:
    """Whether a box lies in the outline of another, seen from the front."""
    spare = config.on_panel * float(whole.size[0])
    within = np.minimum(inner.low - outer.low, outer.high - inner.high)[_ACROSS]
    return bool((within >= -spare).all())
