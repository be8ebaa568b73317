"""Whether shelves and dividers that were added stand and leave all motions free, and which rooms could hold some.

They are measured on a finished piece and share nothing with what makes panels and finds compartments. trimesh's
collision manager looks for panels that float (an end does not rest on anything that is static), pierce (cut into
anything at rest) or block (are in the path of what moves).

Empty rooms are found by rays: points in a grid look along the axes at what is at rest. A room has walls on both sides,
a floor, a ceiling and a back that are static; in front of it is nothing, or a door. Its middle, a cube, must be empty,
and half of all faces but the front be covered. What a drawer takes of a room, with all that lies behind it, is no room.
"""

from collections.abc import Collection, Mapping, Sequence
from itertools import product
from typing import Any, Literal, final

import numpy as np
import trimesh

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Points, vec3
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh, heading_of, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.geometry.transform import from_rotation, rotation_matrix
from grafu.judging.outlined import PrismPanel, is_plain
from grafu.judging.piece import JudgedBody, JudgedPart, JudgedPiece
from grafu.vocabulary import PartLabel

_MANAGER: Any = trimesh.collision.CollisionManager  # untyped


@final
@dataclass(frozen=True, slots=True)
class RoomSearchConfig:
    """What counts as an empty room.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    steps: int = 30
    """Points along the object's longest side."""
    least: float = 0.25
    """Smaller rooms, along any axis, are pigeonholes (metres) ..."""
    least_ratio: float = 0.2
    """... and no room needs to be larger than this in a model of another scale (fraction of the largest side)."""
    tried: int = 40
    """Candidates that are looked at one by one."""
    middle: float = 0.45
    """Half the side of the cube in a room's middle that must be empty (fraction of the least room)."""
    across: int = 7
    """Rays along each side of a face ..."""
    span: float = 0.8
    """... over this much of it (fraction) ..."""
    beyond: float = 1.1
    """... that meet a wall where it stands at most this far from the middle (ratio to where the face lies)."""
    covered: float = 0.5
    """Fraction of the rays that must do so."""
    leaf: float = 0.15
    """What slides and is thinner than this is a door (fraction of its next larger side)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "least_ratio", "middle", "span", "covered", "leaf")


def empty_rooms(piece: JudgedPiece, config: RoomSearchConfig = RoomSearchConfig()) -> list[Box]:
    """Returns rooms that nothing furnishes, as boxes in metres (object frame), the largest first; none overlap."""
    extent, still = piece.largest_side, piece.still_mesh
    moving = [body.mesh for body in piece.bodies]
    if extent <= 0 or not len(still.faces):
        return []
    least = min(config.least, config.least_ratio * extent)
    whole = merge_meshes([still, *moving])
    points = _points(whole.box, extent / config.steps)
    points = points[~_taken(points, piece, config.leaf)]
    rooms = _seen_from(points, RayCaster(still), RayCaster(merge_meshes(moving)), whole.box, least)
    manager, everything = _MANAGER(), RayCaster(whole)
    manager.add_object("", whole.to_trimesh())
    found: list[Box] = []
    for room in sorted(rooms, key=lambda box: -float(box.size.prod()))[: config.tried]:
        if any(room.overlaps(other) for other in found) or _taken(room.center[None], piece, config.leaf).any():
            continue
        half = np.full(3, config.middle * least)
        cube = TriangleMesh.box_mesh(Box.from_center(room.center, half)).to_trimesh()
        if not manager.in_collision_single(cube) and _is_enclosed(room, everything, config):
            found.append(room)
    return found


def _is_enclosed(room: Box, everything: RayCaster, config: RoomSearchConfig) -> bool:
    """Whether surfaces cover at least half of five faces of a room: posts and rails are no walls."""
    steps = np.linspace(-config.span, config.span, config.across)
    covered = []
    for axis in range(3):
        ratios = np.stack(np.meshgrid(steps, steps, indexing="ij"), axis=-1).reshape(-1, 2)
        origins = np.tile(room.center, (len(ratios), 1))
        origins[:, [k for k in range(3) if k != axis]] += ratios * np.delete(room.half, axis)
        for sign in (-1.0, 1.0):
            found = everything.along(origins, sign * np.eye(3)[axis])
            covered.append(float((found <= config.beyond * room.half[axis]).mean()))
    return sum(ratio >= config.covered for ratio in covered) >= len(covered) - 1


def _points(box: Box, step: float) -> Points:
    axes = [np.arange(box.low[k] + step / 2, box.high[k], step) for k in range(3)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def _taken(points: Points, piece: JudgedPiece, leaf: float) -> np.ndarray:
    zones = [_taken_by(points, body, leaf) for body in piece.bodies]
    return np.any(zones, axis=0) if zones else np.zeros(len(points), dtype=bool)


def _taken_by(points: Points, body: JudgedBody, leaf: float) -> np.ndarray:
    """Returns which points lie in a drawer or anywhere before or behind it; none for doors, sliding ones too."""
    mesh = body.mesh
    if body.motion is None or body.motion.turns or not len(mesh.faces):
        return np.zeros(len(points), dtype=bool)
    axis = int(np.abs(body.motion.axis.direction).argmax())
    size = mesh.box.size
    across = [k for k in range(3) if k != axis]
    is_leaf = min(size[across]) < leaf * np.sort(size)[1] and int(np.argmin(size)) in across
    if is_leaf:
        return np.zeros(len(points), dtype=bool)
    inside = (points[:, across] >= mesh.box.low[across]) & (points[:, across] <= mesh.box.high[across])
    return np.asarray(inside.all(axis=1))


def _seen_from(points: Points, still: RayCaster, moving: RayCaster, box: Box, least: float) -> list[Box]:
    """Returns the boxes that points see around them, those that are rooms."""
    directions = [sign * np.eye(3)[axis] for axis in range(3) for sign in (-1.0, 1.0)]
    at_still = np.stack([still.along(points, d) for d in directions], axis=1)
    at_moving = np.stack([moving.along(points, d) for d in directions], axis=1)
    nearest = np.minimum(at_still, at_moving)
    walled = np.isfinite(at_still) & (at_still <= at_moving)
    doored = np.isfinite(at_moving) & (at_moving < at_still)
    fronted = ~walled
    level = walled[:, 4] & walled[:, 5]
    opens = [
        walled[:, 0] & walled[:, 1] & level & ((walled[:, 3] & fronted[:, 2]) | (walled[:, 2] & fronted[:, 3])),
        walled[:, 2] & walled[:, 3] & level & ((walled[:, 1] & doored[:, 0]) | (walled[:, 0] & doored[:, 1])),
    ]
    kept = opens[0] | opens[1]
    ends = np.stack([points - box.low, box.high - points], axis=2).reshape(len(points), 6)
    reach = np.minimum(nearest, ends)[kept]
    low, high = points[kept] - reach[:, 0::2], points[kept] + reach[:, 1::2]
    large = (high - low >= least).all(axis=1)
    unique = np.unique(np.round(np.hstack([low[large], high[large]]) / least, 2) * least, axis=0)
    return [Box(row[:3], row[3:]) for row in unique]


PanelFault = tuple[str, Literal["floats", "pierces", "blocks"], str]
POSES = 60  # of each joint, from closed to wide open


def panel_faults(piece: JudgedPiece, panels: Collection[str], skin: float) -> list[PanelFault]:
    """Returns (panel, fault, the end or the other part) for all that is wrong with static panels, by their names.

    A cut of less than `skin` metres is a touch, a gap of twice as much none. Ends and halves are those along the
    panels' own level axes.
    """
    angle = heading_of(part.mesh for part in piece.still if part.name in panels)
    if angle:
        piece = piece.seen_after(from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), -angle)))
    root = [part for part in piece.still if len(part.mesh.faces)]
    standing = {part.name: part.mesh for part in root}
    moving = {body.id: body.mesh for body in piece.bodies}
    found: list[PanelFault] = []
    for panel in (part for part in root if part.name in panels):
        others = {name: mesh for name, mesh in standing.items() if name != panel.name}
        found += [(panel.name, "floats", end) for end in _loose_ends(panel, others, 2 * skin)]
        found += [(panel.name, "pierces", other) for other in _pierced(panel.mesh, {**others, **moving}, skin)]
        found += [(panel.name, "blocks", body.id) for body in piece.moving if _is_blocked(panel.mesh, body, skin)]
    return found


def _loose_ends(panel: JudgedPart, others: Mapping[str, TriangleMesh], reach: float) -> Sequence[str]:
    """A panel rests with the front and the back half of both its ends: of one pair of opposite sides at least.

    One of another outline rests with enough of its edge.
    """
    mesh = panel.mesh
    if not is_plain(mesh):
        reached = _manager(others, mesh, reach)
        return [] if PrismPanel(mesh).is_carried(reached, reach) else ["edge"]
    thin = 2 if panel.label is PartLabel.SHELF else int(np.argmin(mesh.box.size))
    manager = _manager(others, mesh, reach)
    loose: dict[int, list[str]] = {}
    for axis in (k for k in range(3) if k != thin):
        other = 3 - thin - axis
        loose[axis] = [
            f"{'xyz'[axis]}{'-+'[side]} {('front', 'back')[half]}"
            for side in (0, 1)
            for half in (0, 1)
            if manager.min_distance_single(_cap(mesh, axis, side, other, half)) > reach
        ]
    return min(loose.values(), key=len)


def _cap(mesh: TriangleMesh, axis: int, side: int, other: int, half: int) -> trimesh.Trimesh:
    """Returns the outer hundredth of a half of one end of a prism with eight corners, in the prism's own shape."""
    corner = {tuple(key): v for key, v in zip(mesh.vertices > mesh.box.center, mesh.vertices, strict=True)}

    def at(u: float, v: float, top: bool) -> Points:
        """Returns the point at fractions along the end's axis and along the other one."""
        point = np.zeros(3)
        for far, farther in product((False, True), repeat=2):
            key = [top] * 3
            key[axis], key[other] = far, farther
            point += (u if far else 1 - u) * (v if farther else 1 - v) * corner[tuple(key)]
        return point[None]

    us, vs = ((0.0, 0.01) if side == 0 else (0.99, 1.0)), ((0.0, 0.5) if half == 0 else (0.5, 1.0))
    corners = np.concatenate([at(u, v, top) for u in us for v in vs for top in (False, True)])
    return trimesh.convex.convex_hull(corners)


def _pierced(panel: TriangleMesh, others: Mapping[str, TriangleMesh], skin: float) -> list[str]:
    hit, names = _manager(others, panel, 0.0).in_collision_single(_shrunk(panel, skin), return_names=True)
    return sorted(names) if hit else []


def _is_blocked(panel: TriangleMesh, body: JudgedBody, skin: float) -> bool:
    if not len(body.mesh.faces) or body.motion is None:
        return False
    shrunk = _shrunk(panel, skin)
    manager = _MANAGER()
    manager.add_object("moving body", body.mesh.to_trimesh())
    for value in np.linspace(body.motion.lower, body.motion.upper, POSES):
        manager.set_transform("moving body", body.motion.at(float(value)))
        if manager.in_collision_single(shrunk):
            return True
    return False


def _manager(others: Mapping[str, TriangleMesh], near: TriangleMesh, reach: float) -> Any:
    manager = _MANAGER()
    for name, mesh in others.items():
        if len(mesh.faces) and mesh.box.overlaps(near.box, reach + 0.01 * float(near.box.size.max())):
            manager.add_object(name, mesh.to_trimesh())
    return manager


def _shrunk(mesh: TriangleMesh, skin: float) -> trimesh.Trimesh:
    if not is_plain(mesh):
        return PrismPanel(mesh).shrunk(skin)
    size = mesh.box.size
    factor = np.maximum(size - 2 * skin, 0.1 * size) / size
    return trimesh.Trimesh(mesh.box.center + (mesh.vertices - mesh.box.center) * factor, mesh.faces, process=False)
