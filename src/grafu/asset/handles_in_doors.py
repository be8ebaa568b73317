"""Handles that are drawn in the mesh of their door, as shells of their own, become parts: they tell how it opens.

Inputs whose makers divided them by what moves are not cut (`cutting`); this is done to them. A door that has its handle
as a part, and one that more stands out of than a door has handles, stay as they are.
"""

from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import Final, final

import numpy as np

from grafu.asset.loose import faces_of_part
from grafu.asset.lying_handles import LyingHandleConfig, lies_as_handle
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat4, Vec3
from grafu.geometry.box import Box
from grafu.geometry.components import linked
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh, triangle_bounds
from grafu.geometry.raycast import RayCaster
from grafu.geometry.shells import shell_numbers
from grafu.shapes import Int
from grafu.vocabulary import PartLabel

_Numbers = Int[np.ndarray, "_"]
_DOORS: Final = (PartLabel.DOOR, PartLabel.UNKNOWN)


@final
@dataclass(frozen=True, slots=True)
class HandlesInDoorsConfig:
    """What of a door is its handle, beside what `LyingHandleConfig` states of one.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    plate: float = 0.35
    """How thick a door is at most, with its handle (fraction of its shorter side): drawers are thicker."""
    front: float = 0.1
    """The plane of a door is where this of the area that faces outwards lies at it or before it (fraction of area):
    panels lie behind their frames, and handles are smaller."""
    out: float = 0.02
    """A handle reaches so far before that plane at least (fraction of the door's shorter side): a flat knob on a
    wide door ends there ..."""
    deep: float = 0.014
    """... or so far (fraction of the largest side of the piece), as `StandingHandleConfig.deep`, if that is less."""
    touch: float = 0.003
    """Shells this near are pieces of one handle (fraction of the largest side of the piece): a bar and its posts."""
    long: float = 0.8
    """How long a handle is at most (fraction of the door's side along it): longer ones are mouldings or battens."""
    most: int = 2
    """A door has as many handles at most: more are decoration."""

    def __post_init__(self) -> None:
        require_positive(self, "most")
        require_ratios(self, "plate", "front", "out", "deep", "touch", "long")


def with_handles_of_doors(
    parts: Sequence[Part],
    T: Mat4,
    labelled: bool,
    config: HandlesInDoorsConfig = HandlesInDoorsConfig(),
    lying: LyingHandleConfig = LyingHandleConfig(),
) -> tuple[Part, ...]:
    """Returns the parts with the handles of doors as parts of their own, which their doors carry.

    Args:
        parts: the parts, in the input's coordinates.
        T: turns the input upright: Z up, front -Y. Its unit does not matter.
        labelled: whether labels count: what is called otherwise than a door is then none. Else any upright plate is.
        config: what is a handle in a door.
        lying: what is a handle on a front.
    """
    boxes = [part.mesh.box for part in parts]
    whole = Box.enclosing(boxes)
    touch = config.touch * float(whole.size.max())
    taken = {part.id for part in parts}
    held = {part.carried_by for part in parts}
    found: list[Part] = []
    for k, part in enumerate(parts):
        pieces = [part]
        if part.id not in held and (not labelled or part.label in _DOORS):
            others = [box for n, box in enumerate(boxes) if n != k and box.overlaps(boxes[k], touch)]
            pieces = _parted(part, others, whole, T, taken, config, lying)
            taken |= {piece.id for piece in pieces}
        found += pieces
    return tuple(found)


def _parted(
    door: Part,
    others: Sequence[Box],
    whole: Box,
    T: Mat4,
    taken: Collection[str],
    config: HandlesInDoorsConfig,
    lying: LyingHandleConfig,
) -> list[Part]:
    """Returns a door without its handles, and these; the door alone where none is in it."""
    axis = door.box.thin_axis
    sides = np.delete(door.box.size, axis)
    up = int(np.argmax(np.abs(T[2, :3])))
    if axis == up or door.box.size[axis] > config.plate * sides.min():
        return [door]
    towards = np.eye(3)[axis] * np.sign(door.box.center[axis] - whole.center[axis] or 1.0)
    board = _board(door.mesh, towards, config)
    if any(lies_as_handle(board, axis, box, lying) for box in others):
        return [door]
    groups = _groups_before(door.mesh, board, towards, float(whole.size.max()), config)
    handles = [faces for faces in groups if _is_handle(door.mesh, faces, board, towards, whole, config, lying)]
    if not 0 < len(handles) <= config.most:
        return [door]
    kept = np.ones(len(door.mesh.faces), dtype=bool)
    kept[np.concatenate(handles)] = False
    names = (name for k in range(1, 10_000) if (name := f"{door.id}_handle" + (f"_{k}" if k > 1 else "")) not in taken)
    handle = replace(door, label=PartLabel.HANDLE, labelled_by="shape", carried_by=door.id)
    return [
        replace(door, surfaces=faces_of_part(door, np.flatnonzero(kept))),
        *(
            replace(handle, id=name, surfaces=faces_of_part(door, faces))
            for name, faces in zip(names, handles, strict=False)
        ),
    ]


def _board(mesh: TriangleMesh, towards: Vec3, config: HandlesInDoorsConfig) -> Box:
    """Returns the box of a door that ends at its front plane."""
    facing = np.abs(mesh.face_normals @ towards) * mesh.face_areas
    depth = mesh.triangles.mean(axis=1) @ towards
    order = np.argsort(-depth, kind="stable")
    area = np.cumsum(facing[order])
    plane = float(depth[order[min(int(np.searchsorted(area, config.front * area[-1])), len(order) - 1)]])
    axis = int(np.argmax(np.abs(towards)))
    low, high = mesh.box.low.copy(), mesh.box.high.copy()
    at = float(np.clip(plane * towards[axis], low[axis], high[axis]))
    (high if towards[axis] > 0 else low)[axis] = at
    return Box(low, high)


def _groups_before(
    mesh: TriangleMesh, board: Box, towards: Vec3, extent: float, config: HandlesInDoorsConfig
) -> list[_Numbers]:
    """Returns the faces of each group of shells that touch one another and have their middles before a board."""
    number = shell_numbers(mesh)
    count = int(number.max()) + 1
    low, high = triangle_bounds(mesh.triangles)
    ends = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    np.minimum.at(ends[0], number, low)
    np.maximum.at(ends[1], number, high)
    plane = _end(board, towards)
    axis = int(np.argmax(np.abs(towards)))
    across = np.delete(np.arange(3), axis)
    middle = (ends[0] + ends[1]) @ towards / 2
    inside = ((ends[0] > board.low) & (ends[1] < board.high))[:, across].all(axis=1)
    before = np.flatnonzero((middle > plane) & inside)
    if count == 1 or not len(before):
        return []
    boxes = [Box(ends[0][k], ends[1][k]) for k in before]
    pairs = [
        (a, b)
        for a in range(len(boxes))
        for b in range(a + 1, len(boxes))
        if boxes[a].overlaps(boxes[b], config.touch * extent)
    ]
    first, second = np.array(pairs, dtype=np.int64).reshape(-1, 2).T
    group = linked(len(boxes), first, second)
    return [np.flatnonzero(np.isin(number, before[group == g])) for g in range(int(group.max()) + 1)]


def _is_handle(
    mesh: TriangleMesh,
    faces: _Numbers,
    board: Box,
    towards: Vec3,
    whole: Box,
    config: HandlesInDoorsConfig,
    lying: LyingHandleConfig,
) -> bool:
    corners = mesh.triangles[faces].reshape(-1, 3)
    box = Box(corners.min(axis=0), corners.max(axis=0))
    axis = int(np.argmax(np.abs(towards)))
    across = np.delete(np.arange(3), axis)
    least = min(config.out * float(board.size[across].min()), config.deep * float(whole.size.max()))
    level = max(_end(board, towards), _level_behind(mesh, faces, box, towards))
    reaches = _end(box, towards) - level >= least
    is_short = bool((box.size <= config.long * board.size)[across].all())
    return reaches and is_short and lies_as_handle(board, axis, box, lying)


def _level_behind(mesh: TriangleMesh, faces: _Numbers, box: Box, towards: Vec3) -> float:
    """Returns how far out the rest of a door lies behind the middle of some of its faces: a bent door is not flat."""
    rest = np.ones(len(mesh.faces), dtype=bool)
    rest[faces] = False
    start = _end(box, towards)
    middle = box.center + (start - float(box.center @ towards)) * towards
    return start - float(RayCaster(mesh.with_faces(rest)).along(middle[None], -towards)[0])


def _end(box: Box, towards: Vec3) -> float:
    return float(max(box.low @ towards, box.high @ towards))
