"""What convex solids leave of faces: what one takes is clipped plane by plane, what several take goes at once.

Memory is bounded: faces are worked on in batches, and what is clipped of one stays a convex polygon of few triangles.
Split as loose triangles alone it would not: each plane through a corner leaves a triangle without area, and each plane
that crosses such a one leaves two, so that the many planes of a swept hull made millions of a single face.

One after another, pieces that overlap would shred what is left. Taken away together, in the triangle's plane, they
leave no more triangles than the outline of what is left needs.
"""

from collections import defaultdict
from collections.abc import Iterator, Sequence
from typing import final

import manifold3d
import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Indices, Points, vec3
from grafu.geometry.budget import require_room, require_time
from grafu.shapes import Bool, Float, Int

_ROUNDED = 1e-7  # outlines come with corners rounded to 1e-8: triangles thinner than that may be turned over


def remainder(corners: Float[np.ndarray, "3 3"], pieces: Sequence[np.ndarray]) -> Float[np.ndarray, "m 3 3"]:
    """Returns what is left as triangles turned like the given one: each corner as weights of the three `corners`.

    `pieces` hold the points, (n, 3), around convex pieces that lie in the triangle. Where lines cross is found to 1e-8
    of the triangle's longest side.
    """
    plane = _plane(corners)
    whole = (corners - corners[0]) @ plane
    holes = [manifold3d.CrossSection.hull_points((piece - corners[0]) @ plane) for piece in pieces]
    left = manifold3d.CrossSection.batch_boolean([manifold3d.CrossSection([whole]), *holes], manifold3d.OpType.Subtract)
    outlines = left.to_polygons()
    if not outlines:
        return np.zeros((0, 3, 3))
    second, third = np.linalg.solve(whole[1:].T, np.concatenate(outlines).T)
    weights = np.stack([1.0 - second - third, second, third], axis=1)
    return weights[np.asarray(manifold3d.triangulate(outlines, _ROUNDED), np.int64)]


def _plane(corners: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, "3 2"]:
    """Returns the axes of the triangle's plane as columns, as long as makes its longest side 1."""
    first, second = corners[1] - corners[0], corners[2] - corners[0]
    across = vec3(*_cross(_cross(first.tolist(), second.tolist()), first.tolist()))
    axes = np.stack([first / np.sqrt(first @ first), across / np.sqrt(across @ across)], axis=1)
    sides = corners - corners[[2, 0, 1]]
    return np.asarray(axes / np.sqrt((sides * sides).sum(axis=1).max()))


def _cross(a: Sequence[float], b: Sequence[float]) -> tuple[float, float, float]:
    """Returns the cross product, twenty times as quick as numpy's."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


NOTHING = 1e-7
"""Metres: what is shorter counts as nothing, and a corner nearer to a plane as lying on it."""


def split_by_planes(
    triangles: np.ndarray, owner: np.ndarray, planes: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Splits triangles (rows of corner attributes) by a plane each: inside, its owners, outside, its owners."""
    side = np.einsum("ncd,nd->nc", triangles[:, :, :3], planes[:, :3]) - planes[:, 3:]
    side = np.where(np.abs(side) < NOTHING, 0.0, side)
    all_in, all_out = np.all(side <= 0, axis=1), np.all(side >= 0, axis=1)
    mixed = ~(all_in | all_out)
    # Coplanar triangles count as outside: faces that merely lie on the solid's border stay.
    all_in &= ~all_out
    inside, outside = [triangles[all_in]], [triangles[all_out]]
    in_owner, out_owner = [owner[all_in]], [owner[all_out]]
    for positive in (True, False):
        lone = (side > 0) if positive else (side < 0)
        pick = mixed & (lone.sum(axis=1) == 1)
        if not positive:
            pick &= (side > 0).sum(axis=1) != 1
        single, pair = _cut_corner(triangles[pick], side[pick], lone[pick])
        lone_side, other_side = (outside, inside) if positive else (inside, outside)
        lone_owner, other_owner = (out_owner, in_owner) if positive else (in_owner, out_owner)
        lone_side.append(single)
        lone_owner.append(owner[pick])
        other_side.append(pair)
        other_owner.append(np.concatenate([owner[pick], owner[pick]]))
    return np.concatenate(inside), np.concatenate(in_owner), np.concatenate(outside), np.concatenate(out_owner)


def _cut_corner(triangles: np.ndarray, side: np.ndarray, lone: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Cuts the one corner marked in `lone` off each triangle: the corner piece, and the rest as two triangles."""
    first = np.argmax(lone, axis=1)
    order = (first[:, None] + np.arange(3)) % 3
    t = np.take_along_axis(triangles, order[:, :, None], axis=1)
    s = np.take_along_axis(side, order, axis=1)
    ab = t[:, 0] + (t[:, 1] - t[:, 0]) * (s[:, 0] / (s[:, 0] - s[:, 1]))[:, None]
    ac = t[:, 0] + (t[:, 2] - t[:, 0]) * (s[:, 0] / (s[:, 0] - s[:, 2]))[:, None]
    single = np.stack([t[:, 0], ab, ac], axis=1)
    pair = np.concatenate([np.stack([ab, t[:, 1], t[:, 2]], axis=1), np.stack([ab, t[:, 2], ac], axis=1)])
    return single, pair


_MOST_PAIRS = 5_000  # of a face and a solid at once
_MOST_PIECES = 64  # of what is clipped of one face by one solid, before it is made a polygon again
_PAIR_BYTES = 16


def left_over(
    triangles: Float[np.ndarray, "n 3 k"], near: Sequence[np.ndarray], planes: Sequence[np.ndarray]
) -> tuple[Float[np.ndarray, "m 3 k"], Int[np.ndarray, " m"], Bool[np.ndarray, " n"]]:
    """Returns what is left of the triangles that lose something, each with the number of its own, and which those are.

    Args:
        triangles: rows of corner attributes, of which the first three are the position.
        near: for each solid the numbers of the triangles that it may take something of.
        planes: for each solid its half-spaces `normal . x <= offset` as rows (normal, offset).

    Raises:
        TooComplex: if the budget in force does not hold the work.
    """
    require_room(sum(len(n) for n in near), _PAIR_BYTES, "cutting faces by solids")
    face = np.concatenate(near)
    solid = np.repeat(np.arange(len(near)), [len(n) for n in near])
    padded = _padded(planes)
    by_one, by_several, is_cut = [triangles[:0]], [triangles[:0]], np.zeros(len(triangles), dtype=bool)
    of_one, of_several = [face[:0]], [face[:0]]
    for first, last in _batches(np.bincount(face, minlength=len(triangles))):
        pairs = (face >= first) & (face < last)
        left = _left_of_batch(triangles[first:last], face[pairs] - first, padded, solid[pairs])
        by_one.append(left.by_one)
        of_one.append(first + left.of_one)
        by_several += left.by_several
        of_several += [np.full(len(rest), first + k) for k, rest in zip(left.of_several, left.by_several, strict=True)]
        is_cut[first:last] = left.is_cut
    return np.concatenate([*by_one, *by_several]), np.concatenate([*of_one, *of_several]), is_cut


def _batches(counts: np.ndarray) -> Iterator[tuple[int, int]]:
    """Yields the first face of each batch and the one after its last, so that each has few pairs."""
    ends = np.cumsum(counts)
    first = 0
    while first < len(counts):
        before = int(ends[first - 1]) if first else 0
        last = max(int(np.searchsorted(ends, before + _MOST_PAIRS, side="right")), first + 1)
        yield first, last
        first = last


@final
@dataclass(frozen=True, eq=False, slots=True)
class _Left:
    """What one solid each leaves of triangles, and what several do, with their numbers; which lose something."""

    by_one: Float[np.ndarray, "m 3 k"]
    of_one: Int[np.ndarray, " m"]
    by_several: list[np.ndarray]
    of_several: list[int]
    is_cut: Bool[np.ndarray, " n"]


def _left_of_batch(triangles: np.ndarray, face: np.ndarray, planes: np.ndarray, solid: np.ndarray) -> _Left:
    taken = _taken(triangles[face], planes, solid)
    times = np.bincount(face[taken.hit], minlength=len(triangles))
    gone = np.zeros(len(triangles), dtype=bool)  # of which one solid leaves nothing
    gone[face[taken.hit & taken.is_whole]] = True
    alone = taken.hit & (times[face] == 1)
    by_one, of_one = _outside(triangles[face[alone]], planes, solid[alone])
    holes = _holes(face, taken, times > 1)
    several = np.flatnonzero((times > 1) & ~gone).tolist()
    rests = [remainder(triangles[k, :, :3], holes[k]) @ triangles[k] for k in several]
    return _Left(by_one, face[alone][of_one], rests, several, times > 0)


@final
@dataclass(frozen=True, eq=False, slots=True)
class _Taken:
    """What solids take of faces, by pairs: triangles with the number of their pair, and which pairs take anything.

    `is_whole` states that the solid takes all of the face.
    """

    inside: Float[np.ndarray, "m 3 k"]
    owner: Int[np.ndarray, " m"]
    hit: Bool[np.ndarray, " pairs"]
    is_whole: Bool[np.ndarray, " pairs"]


def _taken(inside: np.ndarray, planes: np.ndarray, solid: np.ndarray) -> _Taken:
    count = len(inside)
    owner, is_whole = np.arange(count), np.ones(count, dtype=bool)
    for k in range(planes.shape[1]):
        require_time()
        inside, owner, _, outside_owner = split_by_planes(inside, owner, planes[solid[owner], k])
        is_whole[outside_owner] = False
        inside, owner = _merged(inside, owner, count)
    hit = np.zeros(count, dtype=bool)
    hit[owner[_areas(inside) > NOTHING**2]] = True
    return _Taken(inside, owner, hit, is_whole)


def _outside(inside: np.ndarray, planes: np.ndarray, solid: np.ndarray) -> tuple[np.ndarray, Indices]:
    """Returns what is left of triangles when each is cut by one solid, and the number of each one's triangle."""
    count, owner = len(inside), np.arange(len(inside))
    kept, whose = [inside[:0]], [owner[:0]]
    for k in range(planes.shape[1]):
        require_time()
        inside, owner, outside, outside_owner = split_by_planes(inside, owner, planes[solid[owner], k])
        kept.append(outside)
        whose.append(outside_owner)
        inside, owner = _merged(inside, owner, count)
    return np.concatenate(kept), np.concatenate(whose)


def _merged(inside: np.ndarray, owner: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns the pieces, those of pairs that have many made as few as their outline needs."""
    many = np.bincount(owner, minlength=count) > _MOST_PIECES
    if not many.any():
        return inside, owner
    rest = ~many[owner]
    fans = [(pair, _fan(inside[owner == pair])) for pair in np.flatnonzero(many).tolist()]
    owners = [np.full(len(fan), pair) for pair, fan in fans]
    return np.concatenate([inside[rest], *(f for _, f in fans)]), np.concatenate([owner[rest], *owners])


def _fan(pieces: np.ndarray) -> np.ndarray:
    """Returns the triangles of the convex polygon that pieces make up, turned like them."""
    from scipy.spatial import ConvexHull, QhullError  # local: it takes 0.3 s to import, and not all need a hull

    corners = pieces.reshape(-1, pieces.shape[2])
    normal = np.cross(pieces[:, 1, :3] - pieces[:, 0, :3], pieces[:, 2, :3] - pieces[:, 0, :3]).sum(axis=0)
    axis = int(np.argmax(np.abs(normal)))
    flat = corners[:, [(axis + 1) % 3, (axis + 2) % 3]]
    try:
        outline = ConvexHull(flat).vertices  # counter-clockwise
    except (QhullError, ValueError):
        return pieces[:1]  # a line: it is less than nothing, but still there
    ring = outline if normal[axis] > 0 else outline[::-1]
    hub = np.full(len(ring) - 2, ring[0])
    return corners[np.stack([hub, ring[1:-1], ring[2:]], axis=1)]


def _holes(face: np.ndarray, taken: _Taken, wanted: np.ndarray) -> dict[int, list[Points]]:
    """Returns for each wanted face the corners of what each solid takes of it."""
    used = (taken.hit & wanted[face])[taken.owner]
    owner, inside = taken.owner[used], taken.inside[used, :, :3]
    order = np.argsort(owner, kind="stable")
    pairs, start = np.unique(owner[order], return_index=True)
    found: dict[int, list[Points]] = defaultdict(list)
    for k, points in zip(face[pairs].tolist(), np.split(inside[order], start)[1:], strict=True):
        found[k].append(points.reshape(-1, 3))
    return found


def _padded(planes: Sequence[np.ndarray]) -> Float[np.ndarray, "s k 4"]:
    """Returns the solids' planes, as many of each: what some lack are planes that everything lies within."""
    padded = np.zeros((len(planes), max(len(rows) for rows in planes), 4))
    padded[:, :, 3] = np.inf
    for own, rows in zip(padded, planes, strict=True):
        own[: len(rows)] = rows
    return padded


def _areas(triangles: np.ndarray) -> np.ndarray:
    first, second = triangles[:, 1, :3] - triangles[:, 0, :3], triangles[:, 2, :3] - triangles[:, 0, :3]
    return np.linalg.norm(np.cross(first, second), axis=1) / 2
