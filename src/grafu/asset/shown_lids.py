"""The lid of a box that no name tells: one broad plate that alone closes a hollow body, on top of all.

Chests, ottomans and bins have such lids. The tops of tables lie on legs, on solid bodies, or stand out all round; those
of cabinets close a body that fronts close, too; a cushion in an armchair lies below its back. No name is asked but what
tells that a part is something else.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final, final

import numpy as np

from grafu.asset.cutting import is_divided, turn_of
from grafu.asset.names import spoken
from grafu.asset.part import Frame, Part
from grafu.asset.pieces import in_words, with_pieces
from grafu.asset.reading import Reading
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.leaning import laid_level, leans
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster, depths_below
from grafu.vocabulary import PartLabel

_UP: Final = 2
_RAYS: Final = 24  # along each side of an outline
_TABLES: Final = frozenset({"table", "desk"})


@final
@dataclass(frozen=True, slots=True)
class ShownLidConfig:
    """What is a lid by its shape; lengths are metres.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    plan: float = 0.85
    """Least plan of a lid (fraction of the area of the box around all)."""
    thick: float = 0.45
    """Greatest thickness of a lid, with what lies on it (fraction of the height of all)."""
    high: float = 0.9
    """Greatest height of such a piece (metres): a lid is lifted from above ..."""
    bin: float = 1.3
    """... or of a bin (metres): one part closes it all round, ..."""
    slender: float = 1.5
    """... and it is so many times as high as it is wide ..."""
    wide: float = 1.7
    """... and its greatest side (metres): a bed is longer."""
    overhang: float = 0.035
    """How far a lid stands out of its body at most (metres)."""
    near: float = 0.01
    """How far a lid lies above its body at most (metres) ..."""
    lip: float = 0.06
    """... and how far it reaches below the rim of that, as a plug into it or as a cap around it (metres)."""
    hollow: float = 0.5
    """What of its plan is open from above down to its lower half at least (fraction) ..."""
    floor: float = 0.6
    """... what of it has a floor (fraction) ..."""
    walls: float = 0.75
    """... and what of each of its four sides is closed (fraction): feet may be below."""
    wall: float = 0.25
    """How far inside its side such a wall stands at most (fraction of the side across)."""
    alike: float = 0.25
    """How much a wall in front may differ in thickness from that of the back: a door is another board (fraction)."""
    small: float = 0.05
    """What is smaller, seen from each side, is a fitting: no wall, and no back of a seat (fraction of that side)."""

    def __post_init__(self) -> None:
        require_positive(self, "high", "bin", "slender", "wide", "overhang", "near", "lip")
        require_ratios(self, "plan", "thick", "hollow", "floor", "walls", "wall", "alike", "small")


def with_shown_lid(
    reading: Reading, frame: Frame, name: str = "", config: ShownLidConfig = ShownLidConfig()
) -> Reading:
    """Returns the reading in which the plate that alone closes a hollow body from above is a lid, and a note on that.

    The walls of that body, also where a name tells of the lid, are no doors, unless a handle sits on one.

    Args:
        reading: what was read.
        frame: how it stands, and its scale.
        name: that of the model: what is called a table has a top.
        config: what is a lid.
    """
    parts = reading.parts
    movable = [part for part in parts if part.label.is_movable]
    is_told = is_divided(reading) and any(part.labelled_by not in ("hidden", "none") for part in parts)
    is_open = parts and not is_told and [part.label for part in movable] in ([], [PartLabel.DOOR])
    if not is_open or _TABLES & set(spoken(name)):
        return reading
    T = turn_of(frame) * np.array([[frame.scale]] * 3 + [[1.0]])
    meshes = {part.id: _closed(part.mesh.transformed(T)) for part in parts}
    lids, walls = _lids(parts, meshes, config)
    if not lids or any(part is not lids[0] for part in movable):
        return reading
    parts = tuple(replace(p, label=PartLabel.SIDE_PANEL, labelled_by="shape") if p.id in walls else p for p in parts)
    plate, *others = lids
    if movable:
        return replace(reading, parts=parts)
    joined = {part.id: plate.id for part in others}
    lid = replace(with_pieces(plate, others, joined), label=PartLabel.DOOR, labelled_by="shape")
    made = (lid if part is plate else with_pieces(part, (), joined) for part in parts if part.id not in joined)
    note = f"{in_words(lids)} taken for a lid: nothing else closes a hollow body from above"
    return replace(reading, parts=tuple(made), notes=(*reading.notes, note))


def _closed(mesh: TriangleMesh) -> TriangleMesh:
    """Returns a mesh as it is where it closes a body from above: a lid that leans is drawn open."""
    return laid_level(mesh) if leans(mesh) else mesh


def _lids(
    parts: Sequence[Part], meshes: dict[str, TriangleMesh], config: ShownLidConfig
) -> tuple[list[Part], set[str]]:
    """Returns the plate that is a lid with what lies on it, and the walls below; empty where there is none.

    Meshes are in metres, Z up.
    """
    whole = Box.enclosing(mesh.box for mesh in meshes.values())
    fitting = {p.id for p in parts if p.label is PartLabel.HANDLE or _is_small(meshes[p.id].box, whole, config)}
    is_slim = bool(whole.size[_UP] >= config.slender * whole.size[:_UP].max())
    if whole.size[_UP] > (config.bin if is_slim else config.high) or whole.size[:_UP].max() > config.wide:
        return [], set()
    plates = [p for p in parts if p.id not in fitting and _is_plate(p, meshes[p.id].box, whole, config)]
    if not plates:
        return [], set()
    plate = min(plates, key=lambda p: float(meshes[p.id].box.low[_UP]))
    level = float(meshes[plate.id].box.low[_UP]) - config.near
    on = [p for p in parts if meshes[p.id].box.low[_UP] >= level and p is not plate and p.id not in fitting]
    body = [p for p in parts if p not in on and p is not plate and p.id not in fitting]
    top = Box.enclosing(meshes[p.id].box for p in (plate, *on))
    is_thin = top.size[_UP] <= config.thick * whole.size[_UP]
    is_free = all(part.label in (PartLabel.UNKNOWN, PartLabel.MISC) for part in on)
    if not (body and is_thin and is_free and _is_box(body, meshes, top, plate, config)):
        return [], set()
    around = Box.enclosing(meshes[p.id].box for p in body)
    walls = (p for p in body if _is_bare_wall(p, parts, meshes, config) or _is_tub(p, meshes[p.id].box, around, config))
    return [plate, *on], {part.id for part in walls}


def _is_tub(part: Part, box: Box, body: Box, config: ShownLidConfig) -> bool:
    """Whether a part without a label is the body itself, or what is left of it: it takes most of each of its sides."""
    return part.label is PartLabel.UNKNOWN and bool(np.all(box.size >= config.plan * body.size))


def _is_bare_wall(part: Part, parts: Sequence[Part], meshes: dict[str, TriangleMesh], config: ShownLidConfig) -> bool:
    """Whether a part without a label is an upright board that no handle sits on: one above it is on the lid."""
    box = meshes[part.id].box
    handles = [meshes[p.id].box for p in parts if p.label is PartLabel.HANDLE]
    is_held = any(box.overlaps(handle, config.near) and handle.center[_UP] <= box.high[_UP] for handle in handles)
    return part.label is PartLabel.UNKNOWN and box.thin_axis != _UP and not is_held


def _is_small(box: Box, whole: Box, config: ShownLidConfig) -> bool:
    """Whether a part is a fitting: it covers little of each side of the whole."""
    ratio = box.size / np.maximum(whole.size, 1e-9)
    return bool(all(ratio[a] * ratio[b] <= config.small for a, b in ((0, 1), (0, 2), (1, 2))))


def _is_plate(part: Part, box: Box, whole: Box, config: ShownLidConfig) -> bool:
    plan = float(box.size[:_UP].prod()) >= config.plan * float(whole.size[:_UP].prod())
    is_above = box.low[_UP] > whole.center[_UP]
    return part.label in (PartLabel.UNKNOWN, PartLabel.DOOR) and bool(plan and is_above)


def _is_box(
    body: Sequence[Part], meshes: dict[str, TriangleMesh], lid: Box, plate: Part, config: ShownLidConfig
) -> bool:
    """Whether a body is hollow, closed all round but from above, and nothing of it stands beside or above its lid.

    Where a name tells of the lid, a wall that was cut from its object counts with it.
    """
    mesh = merge_meshes([meshes[part.id] for part in body])
    box, rays = mesh.box, RayCaster(mesh)
    beyond = np.maximum(box.low - lid.low, lid.high - box.high)[:_UP]
    is_under = -config.lip <= float(lid.low[_UP] - box.high[_UP]) <= config.near < float(lid.high[_UP] - box.high[_UP])
    if not is_under or beyond.max() > config.overhang or not (box.size > 0).all():
        return False
    above = float(box.size.max())
    depths = depths_below(rays, box, _UP, _RAYS, above)
    is_deep = np.isfinite(depths) & (depths >= float(box.size[_UP]) / 2)
    if float(is_deep.mean()) < config.hollow or float(np.isfinite(depths).mean()) < config.floor:
        return False
    if not _is_walled(mesh, box, config):
        return False
    of_object: dict[object, list[TriangleMesh]] = {}
    for part in body:
        key = part.source if plate.label is PartLabel.DOOR else part.id
        of_object.setdefault(key, []).append(meshes[part.id])
    alone = any(_is_walled(merge_meshes(of_one), box, config) for of_one in of_object.values())
    if float(lid.high[_UP] - box.low[_UP]) > config.high:
        return alone
    return alone or _is_walled_alike([meshes[part.id].box for part in body], box, config)


def _is_walled(mesh: TriangleMesh, box: Box, config: ShownLidConfig) -> bool:
    """Whether a mesh closes the four sides of a body in this box."""
    for axis in (0, 1):
        for one in (mesh, _mirrored(mesh, box, axis)):
            wall = depths_below(RayCaster(one), box, axis, _RAYS, float(box.size.max()))
            if float((wall <= config.wall * float(box.size[axis])).mean()) < config.walls:
                return False
    return True


def _mirrored(mesh: TriangleMesh, box: Box, axis: int) -> TriangleMesh:
    """Returns a mesh with its two ends along an axis exchanged, in a box."""
    vertices = mesh.vertices.copy()
    vertices[:, axis] = box.low[axis] + box.high[axis] - vertices[:, axis]
    return TriangleMesh(vertices, mesh.faces[:, ::-1])


def _is_walled_alike(boxes: Sequence[Box], whole: Box, config: ShownLidConfig) -> bool:
    """Whether one board each closes front and back, as thick as the other; where one part closes all, none does."""
    walls = [box for box in boxes if box.thin_axis == 1 and _covers(box, whole, config)]
    around = [box for box in boxes if box.size[1] >= (1 - config.wall) * whole.size[1] and _covers(box, whole, config)]
    front = [box for box in walls if box.center[1] < whole.center[1]]
    back = [box for box in walls if box.center[1] >= whole.center[1]]
    if not walls:
        return len(around) == 1
    if len(front) != 1 or len(back) != 1:
        return False
    first, second = float(front[0].size[1]), float(back[0].size[1])
    return abs(first - second) <= config.alike * max(first, second)


def _covers(box: Box, whole: Box, config: ShownLidConfig) -> bool:
    return bool(box.size[0] * box.size[_UP] >= config.walls * whole.size[0] * whole.size[_UP])
