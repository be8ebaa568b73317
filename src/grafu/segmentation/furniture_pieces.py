"""Which parts of a scene are one piece of furniture, and which are its floor, walls and props that lie alone.

It asks geometry alone, in metres, Z up. Shells that touch are one piece. Pieces that stand side by side and touch are
two where each has two sides of its own and the plane between them cuts no object.
"""

from collections.abc import Sequence
from functools import cached_property
from typing import Final, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Indices, Mask, distinct
from grafu.geometry.box import Box
from grafu.geometry.components import linked
from grafu.geometry.config_checks import require_positive
from grafu.geometry.mesh import TriangleMesh, triangle_bounds
from grafu.geometry.shells import shell_numbers
from grafu.geometry.touching import near_ends, near_pairs, touching_pairs

FLOOR_OR_WALL: Final = -1
ALONE: Final = -2

Groups = list[np.ndarray]


@final
@dataclass(frozen=True, slots=True)
class FurnitureConfig:
    """What is one piece of furniture in a scene, and what is a floor, a wall or a prop.

    Raises:
        ValueError: if a number is not above 0.
    """

    touch: float = 0.005
    """As near as this, two shells touch (metres)."""
    floor_side: float = 1.5
    """A floor or a carpet is at least as long and as wide as this (metres)."""
    wall_height: float = 1.8
    """Least height of a wall, which is as wide as a floor (metres)."""
    thickness: float = 0.3
    """Largest thickness of a floor or a wall (metres) ..."""
    plate: float = 0.15
    """... and as a fraction of its shorter side."""
    low: float = 0.1
    """How far from the end of the scene a floor or a wall lies (fraction of the scene's extent)."""
    spans: float = 0.9
    """What a wall spans (fraction of the scene's extent)."""
    filled: float = 0.7
    """What one piece covers of a plate that is a panel of that piece (fraction of the plate)."""
    side: float = 0.15
    """The shortest side of a piece of furniture (metres) ..."""
    length: float = 0.25
    """... and its longest (metres)."""
    within: float = 0.9
    """How much of the content of a piece lies in its box (fraction of the content's extent along each axis)."""
    near: float = 0.1
    """As near as this, a front or a prop belongs to a piece (metres)."""
    crossed: float = 0.002
    """By how much an object may cross the plane between two pieces (metres)."""
    reach: float = 0.05
    """How far from that plane a side stands (metres)."""
    beside: float = 0.4
    """What lies so near to the plane shows how high and how deep a side must be (metres)."""
    closed: float = 0.5
    """What a side covers (fraction of that outline)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, eq=False)
class SceneShells:
    """The shells of the objects of a scene: their meshes, the object that holds each, and its faces there."""

    meshes: tuple[TriangleMesh, ...]
    owner: Indices
    faces: tuple[np.ndarray, ...]

    @classmethod
    def of(cls, objects: Sequence[TriangleMesh]) -> "SceneShells":
        """Returns the shells of some objects, in order."""
        meshes, owner, faces = [], [], []
        for k, mesh in enumerate(objects):
            numbers = shell_numbers(mesh)
            order = np.argsort(numbers, kind="stable")
            found = np.split(order, np.cumsum(np.bincount(numbers))[:-1]) if len(numbers) else []
            faces += found
            meshes += [mesh] if len(found) == 1 else [mesh.with_faces(chosen) for chosen in found]
            owner += [k] * len(found)
        return cls(tuple(meshes), np.array(owner, dtype=np.int64), tuple(faces))

    @cached_property
    def low(self) -> np.ndarray:
        """The low corner of each shell's box."""
        return np.array([mesh.box.low for mesh in self.meshes]).reshape(-1, 3)

    @cached_property
    def high(self) -> np.ndarray:
        """The high corner of each shell's box."""
        return np.array([mesh.box.high for mesh in self.meshes]).reshape(-1, 3)

    def box(self, group: Indices) -> Box:
        """Returns the box around some shells, at least one."""
        return Box(self.low[group].min(axis=0), self.high[group].max(axis=0))


def furniture_pieces(shells: SceneShells, config: FurnitureConfig = FurnitureConfig()) -> Indices:
    """Returns for each shell the number of its piece of furniture; `FLOOR_OR_WALL` or `ALONE` where it is of none.

    Pieces are numbered from 0, from left to right as they are seen from -Y, those behind and above later.
    """
    number = np.full(len(shells.meshes), FLOOR_OR_WALL, dtype=np.int64)
    groups = without_room(shells, config)
    if not groups:
        return number
    bodies, alone = with_what_belongs(shells, groups, config)
    number[np.concatenate([np.zeros(0, np.int64), *alone])] = ALONE
    pieces = [piece for body in bodies for piece in side_by_side(shells, body, config)]
    for k, piece in enumerate(sorted(pieces, key=lambda piece: _place(shells.box(piece)))):
        number[piece] = k
    return number


def _place(box: Box) -> tuple[float, ...]:
    return tuple(np.round([box.center[0], box.low[1], box.low[2]], 3).tolist())


def without_room(shells: SceneShells, config: FurnitureConfig, by_boxes: bool = False) -> Groups:
    """Returns the shells that touch, in groups, floors and walls left out; `by_boxes`: those whose boxes do."""
    if by_boxes:
        touching = np.stack(near_ends(shells.low, shells.high, config.touch), axis=1)
    else:
        pairs = near_pairs([mesh.box for mesh in shells.meshes], config.touch)
        touching = np.array(touching_pairs(shells.meshes, pairs, config.touch), dtype=np.int64).reshape(-1, 2)
    room = _plates_of_room(shells, config)
    while True:
        groups = _groups(touching, ~room)
        boxes = [shells.box(group) for group in groups]
        panels = [
            k for k in np.flatnonzero(room) if any(_fills(box, shells.meshes[k].box, config.filled) for box in boxes)
        ]
        if not panels:
            return groups
        room[panels] = False


def _groups(touching: np.ndarray, among: Mask) -> Groups:
    kept = touching[among[touching].all(axis=1)]
    label = linked(len(among), kept[:, 0], kept[:, 1])
    return [np.flatnonzero(among & (label == k)) for k in distinct(label[among])]


def _plates_of_room(shells: SceneShells, config: FurnitureConfig) -> Mask:
    """Returns which shells may be floors, carpets or walls by their size and place."""
    low, high = shells.low.min(axis=0), shells.high.max(axis=0)
    size, whole = shells.high - shells.low, high - low
    sides = np.sort(size, axis=1)
    thin = np.argmin(size, axis=1)
    is_plate = (sides[:, 0] <= config.thickness) & (sides[:, 0] <= config.plate * sides[:, 1])
    middle = (shells.low + shells.high)[np.arange(len(thin)), thin] / 2
    below = middle - low[thin] <= config.low * whole[thin]
    above = high[thin] - middle <= config.low * whole[thin]
    is_floor = (thin == 2) & below & (sides[:, 1] >= config.floor_side)
    spans = size >= config.spans * whole
    spans[np.arange(len(thin)), thin] = True
    is_tall = (size[:, 2] >= config.wall_height) & (np.maximum(size[:, 0], size[:, 1]) >= config.floor_side)
    return is_plate & (is_floor | ((thin != 2) & (below | above) & spans.all(axis=1) & is_tall))


def _fills(box: Box, plate: Box, filled: float) -> bool:
    """Whether a piece covers the fraction `filled` of a plate, seen along its thin side: it is a panel of the piece."""
    along = np.delete(np.arange(3), plate.thin_axis)
    shared = np.minimum(box.high, plate.high)[along] - np.maximum(box.low, plate.low)[along]
    return float(np.prod(np.maximum(shared, 0.0))) >= filled * float(np.prod(plate.size[along]))


def with_what_belongs(shells: SceneShells, groups: Groups, config: FurnitureConfig) -> tuple[Groups, Groups]:
    """Returns the groups that are furniture, with contents, fronts and props of each; and those that lie alone.

    Where no group is large enough to be furniture, all are one piece.
    """
    boxes = [shells.box(group) for group in groups]
    order = sorted(range(len(groups)), key=lambda k: -boxes[k].diagonal)
    bodies: list[int] = []
    held: dict[int, list[np.ndarray]] = {}
    for k in order:
        host = min(bodies, key=lambda b: (boxes[b].gap(boxes[k]), boxes[b].volume), default=None)
        within = next((b for b in bodies if _lies_in(boxes[k], boxes[b], config.within)), None)
        if within is None and is_furniture(boxes[k], config):
            bodies.append(k)
        elif within is not None or (host is not None and boxes[host].gap(boxes[k]) <= config.near):
            held.setdefault(host if within is None else within, []).append(groups[k])  # type: ignore[arg-type]
    if not bodies:
        return [np.sort(np.concatenate(groups))], []
    kept = [np.sort(np.concatenate([groups[b], *held.get(b, [])])) for b in bodies]
    taken = np.concatenate(kept)
    return kept, [group for group in groups if not np.isin(group, taken).any()]


def is_furniture(box: Box, config: FurnitureConfig) -> bool:
    """Whether a box is as large as a piece of furniture."""
    return float(box.size.min()) >= config.side and float(box.size.max()) >= config.length


def _lies_in(inner: Box, outer: Box, within: float) -> bool:
    shared = np.minimum(inner.high, outer.high) - np.maximum(inner.low, outer.low)
    return bool(np.all(shared >= within * inner.size))


def side_by_side(shells: SceneShells, group: Indices, config: FurnitureConfig) -> Groups:
    """Returns the pieces that stand side by side in a group of shells, along X and then along Y."""
    return [last for first in _parted(shells, group, 0, config) for last in _parted(shells, first, 1, config)]


def _parted(shells: SceneShells, group: Indices, axis: int, config: FurnitureConfig) -> Groups:
    """Returns a group cut at the planes across an axis that part two pieces, each with sides at both its ends."""
    rows = _slabs(shells, group, axis, config.crossed)
    pieces = [rows[0]]
    for k, row in enumerate(rows[1:], 1):
        before, after = pieces[-1], np.concatenate(rows[k:])
        at = float(shells.low[after, axis].min() + shells.high[before, axis].max()) / 2
        is_one = is_furniture(shells.box(before), config) and _has_side(shells, before, axis, at, -1, config)
        if is_one and _has_side(shells, after, axis, at, 1, config):
            pieces.append(row)
        else:
            pieces[-1] = np.sort(np.concatenate([before, row]))
    return pieces if len(pieces) == 1 else _with_outer_sides(shells, pieces, axis, config)


def _slabs(shells: SceneShells, group: Indices, axis: int, crossed: float) -> Groups:
    """Returns a group cut at every plane across an axis that cuts no object, in order along it."""
    objects, of = np.unique(shells.owner[group], return_inverse=True)
    low, high = np.full(len(objects), np.inf), np.full(len(objects), -np.inf)
    np.minimum.at(low, of, shells.low[group, axis])
    np.maximum.at(high, of, shells.high[group, axis])
    order = np.argsort(low, kind="stable")
    reached = np.maximum.accumulate(high[order])
    slab = np.concatenate([[0], np.cumsum(low[order][1:] >= reached[:-1] - crossed)])
    number = np.empty(len(objects), np.int64)
    number[order] = slab
    return [group[number[of] == k] for k in range(int(slab[-1]) + 1)]


def _with_outer_sides(shells: SceneShells, pieces: Groups, axis: int, config: FurnitureConfig) -> Groups:
    """Returns the pieces of a row, those at its ends that have no outer side, or are a panel, joined to the next."""
    first, last = shells.box(pieces[0]), shells.box(pieces[-1])
    if not _has_side(shells, pieces[0], axis, float(first.low[axis]), 1, config):
        pieces = [np.sort(np.concatenate(pieces[:2])), *pieces[2:]]
    is_one = is_furniture(last, config) and _has_side(shells, pieces[-1], axis, float(last.high[axis]), -1, config)
    if len(pieces) > 1 and not is_one:
        pieces = [*pieces[:-2], np.sort(np.concatenate(pieces[-2:]))]
    return pieces


def _has_side(shells: SceneShells, group: Indices, axis: int, at: float, sense: int, config: FurnitureConfig) -> bool:
    """Whether shells that lie on one side of a plane across an axis have a closed side near it."""
    ends = (at - config.crossed, at + config.beside) if sense > 0 else (at - config.beside, at + config.crossed)
    near = group[(shells.high[group, axis] >= ends[0]) & (shells.low[group, axis] <= ends[1])]
    if not len(near):
        return False
    across = np.delete(np.arange(3), axis)
    outline = float(np.prod(shells.box(near).size[across]))
    covered = np.zeros(2)
    reach = (at - config.crossed, at + config.reach) if sense > 0 else (at - config.reach, at + config.crossed)
    reaching = near[(shells.high[near, axis] >= reach[0]) & (shells.low[near, axis] <= reach[1])]
    for k in reaching.tolist():
        mesh = shells.meshes[k]
        low, high = triangle_bounds(mesh.triangles)
        faced = mesh.face_normals[:, axis]
        lies = (low[:, axis] >= reach[0]) & (high[:, axis] <= reach[1]) & (np.abs(faced) > 1 - config.crossed)
        areas = mesh.face_areas
        covered += [areas[lies & (faced < 0)].sum(), areas[lies & (faced > 0)].sum()]
    return outline > 0 and float(covered.max()) >= config.closed * outline
