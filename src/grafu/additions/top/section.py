"""Level sections of triangles as plane polygons, and how polygons are closed up.

Real furniture is full of sheets without thickness and boards that are open somewhere, so a section is taken as lines of
a hair's width, not as the inside of loops.

A watertight slab over a plane outline, its upper edge sharp, rounded or chamfered.
"""

from collections.abc import Iterable

import manifold3d
import numpy as np
import shapely
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry
from shapely.geometry.polygon import orient

from grafu.additions.top.config import TopShape
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.unions import united
from grafu.shapes import Float

Segments = Float[np.ndarray, "k 2 2"]
Fewer = Float[np.ndarray, "f 2 2"]

SHORTEST_LINE = 1e-7
"""Length below which a line of a section is a point, metres."""
MOST_LINES = 700
"""Lines of a section: more take longer than a tenth of a second to join."""
MITRE_LIMIT = 2.0
"""How much farther a corner may move than its edges: 60 degrees; a slip of a line's width would grow a spike."""
ROUNDINGS = (1e-5, 1e-4, 5e-4, 1e-3, 2e-3)
"""To which the ends of lines are rounded, in turn, until there are not too many lines, metres."""
SHORTEST_EDGE = 1e-5
"""Fraction of a slab's length: shorter edges that a cut leaves are joined."""
LEAST_SPREAD = 0.2
"""Least divisor of a corner's move: corners that are more pointed move no farther."""
SMALL = 0.1
"""Fraction of the width of what is closed up: pieces up to this size become their convex hulls."""
MOST_CORNER = 0.1
"""Fraction of the mean side of a slab's outline by which its corners are broken at most."""
SIDES = 4
"""Sides of a rectangle."""
ARC_EDGES = 4
"""Straight edges of a quarter round."""
ROUND_EDGES = 16
"""Straight edges of a quarter of an oval top, or of a capsule's end."""
EMPTY = Polygon()


def section_lines(triangles: Float[np.ndarray, "n 3 3"], height: float) -> Segments:
    """Returns where triangles cross the level at `height`; those that only touch it do not."""
    above = triangles[:, :, 2] > height
    crossed = above.any(axis=1) & ~above.all(axis=1)
    corners, above = triangles[crossed], above[crossed]
    lone = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), (~above).argmax(axis=1))
    rows = np.arange(len(corners))
    tip, one, other = corners[rows, lone], corners[rows, (lone + 1) % 3], corners[rows, (lone + 2) % 3]
    found = np.stack([_at_level(tip, one, height), _at_level(tip, other, height)], axis=1)
    return found[np.linalg.norm(found[:, 1] - found[:, 0], axis=1) > SHORTEST_LINE]


def section(triangles: Float[np.ndarray, "n 3 3"], heights: Iterable[float], line: float, metre: float) -> BaseGeometry:
    """Returns what triangles cross at some levels: lines with `line` metres around; `filled` alone fills loops."""
    lines = np.concatenate([section_lines(triangles, z) for z in heights])
    if not len(lines):
        return EMPTY
    return united(shapely.polygons(_widened(_few(lines, metre), line)))


def _widened(lines: Fewer, half: float) -> Float[np.ndarray, "f 4 2"]:
    """Returns the rectangle around each line, `half` wider on all four sides."""
    along = lines[:, 1] - lines[:, 0]
    along = half * along / np.linalg.norm(along, axis=1, keepdims=True)
    left = np.stack([-along[:, 1], along[:, 0]], axis=1)
    a, b = lines[:, 0] - along, lines[:, 1] + along
    return np.stack([a - left, b - left, b + left, a + left], axis=1)


def _few(lines: Segments, metre: float) -> Fewer:
    """Returns distinct lines, their ends as exact as not too many allow: shorter ones vanish in their neighbours."""
    for step in ROUNDINGS:
        ends = np.round(lines / (step * metre)).astype(np.int64)
        swapped = (ends[:, 0, 0] > ends[:, 1, 0]) | ((ends[:, 0, 0] == ends[:, 1, 0]) & (ends[:, 0, 1] > ends[:, 1, 1]))
        ends[swapped] = ends[swapped][:, ::-1]
        rows = np.unique(ends.reshape(-1, 4), axis=0)
        rows = rows[(rows[:, :2] != rows[:, 2:]).any(axis=1)]
        found = rows.reshape(-1, 2, 2) * (step * metre)
        if len(found) <= MOST_LINES:
            break
    return found


def filled(shape: BaseGeometry) -> BaseGeometry:
    """Returns a shape without its holes."""
    return united([Polygon(p.exterior) for p in polygons_in(shape)]) if not shape.is_empty else EMPTY


def closed_up(shape: BaseGeometry, width: float) -> BaseGeometry:
    """Returns a shape without holes, and without bays and gaps up to `width` metres wide; corners stay sharp."""
    plain = united([_plain(p, SMALL * width) for p in polygons_in(shape)])
    closed = offset(filled(offset(plain, 0.5 * width)), -0.5 * width)
    return filled(closed.intersection(shapely.convex_hull(plain)))  # slips of a hair beget spikes beyond it


def offset(shape: BaseGeometry, distance: float) -> BaseGeometry:
    """Returns a shape with its edges moved outwards by a distance, corners of 60 degrees on sharp."""
    with np.errstate(invalid="ignore", divide="ignore"):  # of edges that meet at no angle, which come out right
        moved = shape.buffer(distance, join_style="mitre", mitre_limit=MITRE_LIMIT)
    return moved if moved.is_valid else united(polygons_in(shapely.make_valid(moved)))


def _plain(polygon: Polygon, small: float) -> BaseGeometry:
    """Returns a polygon without holes; a turned leg or another small one as its convex hull."""
    low_x, low_y, high_x, high_y = polygon.bounds
    return polygon.convex_hull if max(high_x - low_x, high_y - low_y) <= small else Polygon(polygon.exterior)


def solid(shape: BaseGeometry, width: float) -> BaseGeometry:
    """Returns a section with what lies between lines up to `width` metres apart filled: boards, not rooms."""
    return offset(offset(shape, 0.5 * width), -0.5 * width)


def without_slivers(shape: BaseGeometry, width: float) -> BaseGeometry:
    """Returns a shape without tongues narrower than `width` metres; corners stay sharp."""
    return offset(offset(shape, -0.5 * width), 0.5 * width).intersection(shape)


def polygons_in(shape: BaseGeometry) -> list[Polygon]:
    """Returns the polygons of a shape that have an area."""
    if isinstance(shape, Polygon):
        return [shape] if shape.area > 0 else []
    return [p for g in getattr(shape, "geoms", ()) for p in polygons_in(g)] if not shape.is_empty else []


def _at_level(a: Float[np.ndarray, "n 3"], b: Float[np.ndarray, "n 3"], height: float) -> Float[np.ndarray, "n 2"]:
    ratio = (height - a[:, 2]) / (b[:, 2] - a[:, 2])
    return a[:, :2] + ratio[:, None] * (b[:, :2] - a[:, :2])


Ring = Float[np.ndarray, "n 2"]


def with_corners(outline: BaseGeometry, shape: TopShape, radius: float) -> BaseGeometry:
    """Returns an outline with its outer corners as the shape wants them, broken by up to `radius` metres.

    An oval and a capsule are those around the smallest rectangle that holds the outline.
    """
    if shape == "rectangle" or outline.is_empty:
        return outline
    if shape in ("oval", "capsule"):
        return _around(outline, shape)
    around = (p.minimum_rotated_rectangle.exterior.length for p in polygons_in(outline))
    radius = min(radius, MOST_CORNER * min(around, default=0.0) / SIDES)
    inner = offset(outline, -radius)
    if shape == "rounded":
        return inner.buffer(radius, join_style="round", quad_segs=ARC_EDGES)
    return inner.buffer(radius, join_style="bevel")


def _around(outline: BaseGeometry, shape: TopShape) -> BaseGeometry:
    """Returns the ellipse through the corners of the outline's smallest rectangle, or that with half circles added."""
    corners = np.asarray(outline.minimum_rotated_rectangle.exterior.coords)[:SIDES, :2]
    center, along, across = corners.mean(axis=0), 0.5 * (corners[1] - corners[0]), 0.5 * (corners[3] - corners[0])
    if np.linalg.norm(across) > np.linalg.norm(along):
        along, across = across, along
    if shape == "capsule":
        middle = shapely.linestrings([center - along, center + along])
        return middle.buffer(float(np.linalg.norm(across)), quad_segs=ROUND_EDGES)
    circle = np.asarray(shapely.Point(0.0, 0.0).buffer(np.sqrt(2.0), quad_segs=ROUND_EDGES).exterior.coords)
    return Polygon(center + circle @ np.stack([along, across]))


def slab_mesh(
    outline: Polygon, low: float, high: float, shape: TopShape = "rectangle", edge: float = 0.0
) -> TriangleMesh:
    """Returns the watertight mesh of a slab from `low` to `high`; an edge without room to break stays sharp.

    `edge` is how far the upper edge is broken, as a fraction of the thickness; a rectangle's never is.

    Raises:
        ValueError: if the outline has no area or the heights are no height apart.
    """
    if not (high > low and outline.is_valid and outline.area > 0):
        found = f"{outline.area} m2, {low}..{high}"
        raise ValueError(f"a slab needs an outline with an area and heights apart: got {found}")
    plan = orient(outline)
    rings = [np.asarray(ring.coords)[:-1, :2] for ring in (plan.exterior, *plan.interiors)]
    for profile in (_profile(shape, high - low, edge), _profile("rectangle", high - low, edge)):
        layers = [[_inset(ring, depth) for ring in rings] for depth, _ in profile]
        if all(_is_sound(layer, outline.area) for layer in layers):
            break
    return _stacked(layers, [low + rise for _, rise in profile])


def without_block(mesh: TriangleMesh, region: BaseGeometry, low: float, high: float) -> TriangleMesh:
    """Returns a watertight mesh less what is over a region from `low` to `high`; unchanged if nothing is there."""
    body = _manifold(mesh)
    for polygon in polygons_in(region):
        body = body - _manifold(slab_mesh(polygon, low, high))
    cut = body.simplify(SHORTEST_EDGE * float(mesh.box.size.max())).to_mesh()
    found = TriangleMesh(np.asarray(cut.vert_properties, np.float64)[:, :3], np.asarray(cut.tri_verts, np.int64))
    return found if len(found.faces) else mesh


def _manifold(mesh: TriangleMesh) -> manifold3d.Manifold:
    return manifold3d.Manifold(manifold3d.Mesh(mesh.vertices.astype(np.float32), mesh.faces.astype(np.uint32)))


def _profile(shape: TopShape, thickness: float, edge: float) -> list[tuple[float, float]]:
    """Returns how far the edge lies inwards at heights over the underside, from below."""
    arris = edge * thickness
    if shape == "chamfered":
        return [(0.0, 0.0), (0.0, thickness - arris), (arris, thickness)]
    if shape == "rounded":
        turns = np.linspace(0.0, np.pi / 2, ARC_EDGES + 1)
        arc = [(float(arris * (1 - np.cos(a))), float(thickness - arris * (1 - np.sin(a)))) for a in turns]
        return [(0.0, 0.0), *arc]
    return [(0.0, 0.0), (0.0, thickness)]


def _inset(ring: Ring, depth: float) -> Ring:
    """Returns a ring moved to its left by `depth`, corner by corner."""
    if depth <= 0:
        return ring
    along = np.roll(ring, -1, axis=0) - ring
    along = along / np.linalg.norm(along, axis=1, keepdims=True)
    left = np.stack([-along[:, 1], along[:, 0]], axis=1)
    before = np.roll(left, 1, axis=0)
    spread = 1.0 + np.einsum("ij,ij->i", left, before)
    return ring + depth * (left + before) / np.maximum(spread, LEAST_SPREAD)[:, None]


def _is_sound(layer: list[Ring], area: float) -> bool:
    plan = Polygon(layer[0], layer[1:])
    return bool(plan.is_valid and 0 < plan.area <= area * (1 + 1e-9))


def _stacked(layers: list[list[Ring]], heights: list[float]) -> TriangleMesh:
    """Returns the watertight mesh through rings of equal numbers of corners at rising heights."""
    sizes = [len(ring) for ring in layers[0]]
    count = sum(sizes)
    points = [
        np.column_stack([np.concatenate(rings), np.full(count, z)]) for rings, z in zip(layers, heights, strict=True)
    ]
    ends = np.cumsum(sizes)
    following = np.concatenate([np.roll(np.arange(end - n, end), -1) for n, end in zip(sizes, ends, strict=True)])
    here = np.arange(count)
    faces = [np.asarray(manifold3d.triangulate(layers[0]), np.int64)[:, ::-1]]
    for k in range(len(layers) - 1):
        a, b = here + k * count, following + k * count
        faces += [np.column_stack([a, b, b + count]), np.column_stack([a, b + count, a + count])]
    faces.append(np.asarray(manifold3d.triangulate(layers[-1]), np.int64) + (len(layers) - 1) * count)
    return TriangleMesh(np.concatenate(points), np.concatenate(faces))
