"""Loose pieces of doors and drawers become one part each, by where they lie. It reads no names but to tell pieces.

A drawer's sides, back, bottom and box belong to the `front` whose outline, seen from where it faces, covers them, or to
the plate that is called the drawer; so do the box's own front behind it, and what is called a drawer but hangs on it. A
door's pane or panel belongs to the larger door piece around it. Pieces that no front covers stay parts of their own; a
drawer's side, back or bottom among them is no drawer where the input names fronts. A handle rides on the door or drawer
that it touches, where the input does not say.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.behind_fronts import behind_fronts
from grafu.asset.grips import face_area, facing_axis, is_plate, pieces_before
from grafu.asset.inner_pieces import with_sitting_pieces
from grafu.asset.labels import is_piece
from grafu.asset.names import spoken
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import distinct
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh, triangle_bounds
from grafu.geometry.sampling import point_triangle_distances
from grafu.geometry.shells import shell_numbers
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True, slots=True)
class PieceConfig:
    """Which pieces belong to one door or drawer, and which part a handle rides on.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    stand_out: float = 0.01
    """How far a piece may stand out of the outline of its front (fraction of the object's diagonal) ..."""
    touch: float = 0.004
    """... and lie from it (fraction of the object's diagonal)."""
    leaf: float = 0.2
    """Smallest face of a door's frame (fraction of its pane's)."""
    plate: float = 0.25
    """Largest thickness of what is called a whole door or drawer and is only a front (fraction of its next side)."""
    small: float = 0.12
    """Largest face of what sits on a front (fraction of the front's)."""
    reach: float = 0.01
    """How far a handle may stand off what carries it: modelling gaps, not real ones (metres)."""
    alike: float = 0.1
    """Gaps that differ by less are one: a door wins over a frame that the handle touches as closely (fraction of
    `reach`)."""
    stray: float = 0.05
    """Shells smaller than this are slivers of a piece, or pieces of a runner (fraction of its area) ..."""
    strays: float = 0.2
    """... if all of them together are no more than this."""
    points: int = 300
    """Points of a handle that are measured, about ..."""
    faces: int = 3000
    """... from as many faces of what may carry it."""

    def __post_init__(self) -> None:
        require_positive(self, "reach", "points", "faces")
        require_ratios(self, "stand_out", "touch", "leaf", "plate", "small", "alike", "stray", "strays")


_DEFAULT = PieceConfig()
_BOARDS = frozenset({"side", "back", "bottom"})


@final
@dataclass(frozen=True)
class _Host:
    """A piece that may hold others, and the axis that it faces along."""

    part: Part
    axis: int

    def gap(self, piece: Part) -> float:
        """How far a piece lies before or behind it."""
        return max(float(self.part.box.axis_gaps(piece.box)[self.axis]), 0.0)

    def misses(self, piece: Part) -> float:
        """How far a piece stands out of its outline, 0 where that covers it."""
        beyond = np.maximum(self.part.box.low - piece.box.low, piece.box.high - self.part.box.high)
        return float(max(np.delete(beyond, self.axis).max(), 0.0))


def with_joined_pieces(
    parts: tuple[Part, ...], whole: Box, config: PieceConfig = _DEFAULT
) -> tuple[tuple[Part, ...], list[str]]:
    """Returns the parts of an unannotated input with the pieces of one door or drawer joined, and notes on that.

    Args:
        parts: labelled parts in any one frame.
        whole: the box around them, for tolerances.
        config: the tolerances.
    """
    hosts: dict[str, list[Part]] = {}
    for label in (PartLabel.DRAWER, PartLabel.DOOR):
        named = [p for p in parts if p.label is label]
        pieces = [p for p in named if is_piece(p.source.name)]
        if label is PartLabel.DRAWER:
            faces = [(p, facing_axis(p.mesh, config.plate)) for p in pieces if _is_front(p)]
            others, size = [p for p in named if p not in pieces], whole.diagonal
            pieces += behind_fronts(faces, others, config.touch * size, config.stand_out * size)
        plates = [p for p in named if p not in pieces and is_plate(p.box, config.plate)] if pieces else []
        for piece, host in _pairs(pieces, plates, label, whole.diagonal, config):
            hosts.setdefault(host.id, []).append(piece)
    taken = {piece.id for members in hosts.values() for piece in members}
    for piece, host in _inside_doors([p for p in parts if p.id not in taken], whole.diagonal, config):
        hosts.setdefault(host.id, []).append(piece)
    joined = {piece.id: host for host, members in hosts.items() for piece in members}
    kept = tuple(with_pieces(p, hosts.get(p.id, []), joined) for p in parts if p.id not in joined)
    kept = with_sitting_pieces(kept, _held(kept, whole.diagonal, config), whole)
    notes = [f"{in_words(members)} joined to {host}" for host, members in hosts.items()]
    left = _left_over(kept, hosts)
    if left:
        notes.append(f"{in_words(left)}: taken for no drawer, as no front covers it")
    return tuple(replace(p, label=PartLabel.MISC) if p in left else p for p in kept), notes


def _inside_doors(parts: Sequence[Part], size: float, config: PieceConfig) -> list[tuple[Part, Part]]:
    """Returns what is called a door and lies within another one, with that: a pane in its frame.

    Pieces of one object by their names, `lid` and `lid_1` of two materials, may stand out farther: bands around it.
    """
    doors = sorted((p for p in parts if p.label is PartLabel.DOOR), key=lambda p: -face_area(p.box))

    def is_inside(inner: Part, outer: Part) -> bool:
        numbered = re.fullmatch(rf"{re.escape(outer.source.name)}[_.]\d+", inner.source.name)
        spare = (config.stand_out if numbered else config.touch) * size
        return bool(outer.box.grown(spare).contains(inner.box.corners()).all())

    inner = ((k, i) for k, door in enumerate(doors) for i in range(k) if is_inside(door, doors[i]))
    return _followed([(doors[k], doors[i]) for k, i in dict(reversed(list(inner))).items()])


def _left_over(parts: tuple[Part, ...], hosts: Mapping[str, Sequence[Part]]) -> list[Part]:
    """Returns the sides, backs and bottoms of drawers that joined nothing, where other parts are called fronts."""
    drawers = [p for p in parts if p.label is PartLabel.DRAWER]
    held = {p.carried_by for p in parts} | set(hosts)
    if not any(_is_front(p) for p in drawers):
        return []
    return [p for p in drawers if not _is_front(p) and p.id not in held and _BOARDS & set(spoken(p.source.name))]


def _pairs(
    pieces: list[Part], plates: list[Part], label: PartLabel, size: float, config: PieceConfig
) -> list[tuple[Part, Part]]:
    """Returns each piece that belongs to a front, with it: to a piece that is one, or to a plate named as a whole."""
    own = [p for p in pieces if label is PartLabel.DOOR or _is_front(p)]
    fronts = {p.id: _Host(p, facing_axis(p.mesh, config.plate)) for p in (*own, *plates)}
    ranked = sorted(fronts.values(), key=lambda f: -face_area(f.part.box))
    pairs: list[tuple[Part, Part]] = []
    taken: set[str] = set()
    for piece in sorted(pieces, key=lambda p: face_area(p.box)):
        others = [f for f in ranked if f.part.id not in taken and f.part is not piece]
        touching = piece.id in fronts
        host = _host(piece, others, size, config, touching) or (
            _host(_without_strays(piece, config), others, size, config, touching) if others else None
        )
        if host is not None:
            pairs.append((piece, host))
            taken.add(piece.id)
    return _followed(pairs)


def _held(parts: tuple[Part, ...], size: float, config: PieceConfig) -> dict[str, str]:
    """Returns, for each small part that is called a door or drawer but sits on one, the front that it sits on.

    The bar and the posts of a handle are often called as what they belong to. They touch the front or each other, lie
    within its outline, and not in its plane.
    """
    moving = [p for p in parts if p.label.is_movable]
    found: dict[str, str] = {}
    for front in sorted((p for p in moving if is_plate(p.box, config.plate)), key=lambda p: -face_area(p.box)):
        left = [p for p in moving if p.id not in found]
        sitting = pieces_before(front.box, [p.box for p in left], config.small, config.touch * size)
        found |= dict.fromkeys((left[k].id for k in sitting), front.id)
    return found


def _followed(pairs: list[tuple[Part, Part]]) -> list[tuple[Part, Part]]:
    """Returns the pairs with each host replaced by the piece that the host itself was joined to, if any."""
    host_of = {piece.id: host for piece, host in pairs}

    def last(host: Part) -> Part:
        return last(host_of[host.id]) if host.id in host_of else host

    return [(piece, last(host)) for piece, host in pairs]


def _is_front(part: Part) -> bool:
    return bool({"front", "face"} & set(spoken(part.source.name)))


def _without_strays(piece: Part, config: PieceConfig) -> Part:
    """Returns a piece without the slivers, shells of their own, that stretch its box; itself where there are none."""
    mesh = piece.mesh
    number = shell_numbers(mesh)
    areas = np.bincount(number, mesh.face_areas)
    stray = areas < config.stray * areas.sum()
    if not stray.any() or areas[stray].sum() > config.strays * areas.sum():
        return piece
    return replace(piece, surfaces=(Surface(mesh.with_faces(~stray[number])),))


def _host(piece: Part, fronts: list[_Host], size: float, config: PieceConfig, touching: bool) -> Part | None:
    """Returns the front that covers the piece, the nearest of several, or None; it may have to touch the piece."""
    covering = [f for f in fronts if f.misses(piece) <= config.stand_out * size and _may_hold(f, piece, config)]
    best = min(covering, key=lambda f: f.gap(piece) + f.misses(piece), default=None)
    return None if best is None or (touching and best.gap(piece) > config.touch * size) else best.part


def _may_hold(front: _Host, piece: Part, config: PieceConfig) -> bool:
    """Whether a front may have such a piece: a door has none that is far larger, and no plate that stands across it."""
    box, is_door = piece.box, front.part.label is PartLabel.DOOR
    across = is_plate(box, config.plate) and box.size[front.axis] > config.plate * box.size.max()
    return not is_door or bool(not across and face_area(front.part.box) >= config.leaf * face_area(box))


def with_pieces(part: Part, members: Sequence[Part], joined: Mapping[str, str]) -> Part:
    """Returns a part with its pieces; `joined` names for each piece of any part the part that it belongs to now."""
    surfaces = part.surfaces + tuple(s for m in members for s in m.surfaces)
    return replace(part, surfaces=surfaces, carried_by=joined.get(part.carried_by or "", part.carried_by))


def in_words(members: Sequence[Part]) -> str:
    """Returns the names of parts, the first four of more."""
    names = ", ".join(m.source.name for m in members[:4])
    return names if len(members) <= 4 else f"{names} and {len(members) - 4} more"


def with_attached(parts: tuple[Part, ...], config: PieceConfig = _DEFAULT) -> tuple[Part, ...]:
    """Returns the parts, each handle that rides on nothing yet set to ride on the nearest door or drawer in reach.

    A handle that lies nearer to a static part than to any door or drawer rides on nothing.

    Args:
        parts: labelled parts in the object frame.
        config: the largest gap that counts as contact.
    """
    loose = [p for p in parts if p.label is PartLabel.HANDLE and p.carried_by is None]
    others = [p for p in parts if p.label is not PartLabel.HANDLE]
    if not loose or not any(p.label.is_movable for p in others):
        return parts
    carriers = {p.id: _carrier(p, others, config) for p in loose}
    return tuple(replace(p, carried_by=carriers[p.id]) if p.id in carriers else p for p in parts)


def _carrier(handle: Part, others: list[Part], config: PieceConfig) -> str | None:
    reach = config.reach
    near = [p for p in others if handle.box.overlaps(p.box, reach)]
    movable = [p for p in near if p.label.is_movable]
    if len(near) <= 1 or not movable:
        return movable[0].id if movable else None
    points = _points(handle.mesh, config.points)
    region = handle.box.grown(reach)
    gaps = {p.id: surface_gap(points, p.mesh, region, config.faces) for p in near}
    # Rounding decides nothing: a door wins over a frame that touches the handle as closely.
    best = min(movable, key=lambda p: gaps[p.id])
    return best.id if gaps[best.id] <= min(reach, min(gaps.values()) + config.alike * reach) else None


def _points(mesh: TriangleMesh, most: int) -> np.ndarray:
    points = np.vstack([mesh.vertices[distinct(mesh.faces)], mesh.triangles.mean(axis=1)])
    return points[:: max(1, len(points) // most)]


def surface_gap(points: np.ndarray, mesh: TriangleMesh, region: Box, most: int = _DEFAULT.faces) -> float:
    """Returns the least distance of the points from those faces of the mesh whose boxes reach into `region`.

    Of many faces about `most` are measured.
    """
    low, high = triangle_bounds(mesh.triangles)
    faces = mesh.triangles[np.all((low <= region.high) & (high >= region.low), axis=1)]
    faces = faces[:: max(1, len(faces) // most)]
    if not len(faces):
        return float("inf")
    least = np.inf
    for chunk in np.array_split(points, max(1, len(points) * len(faces) // 200_000)):
        least = min(least, float(point_triangle_distances(chunk, faces).min()))
    return least
