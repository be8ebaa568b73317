"""A watertight slab over a plane outline, its upper edge sharp, rounded or chamfered. It knows no furniture."""

import manifold3d
import numpy as np
from jaxtyping import Float
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry
from shapely.geometry.polygon import orient

from grafu.geometry.mesh import TriangleMesh
from grafu.realization.top.config import TopShape
from grafu.realization.top.section import offset, polygons_in

Ring = Float[np.ndarray, "n 2"]

_ARRIS = 0.35  # of the thickness: how far the upper edge is broken
_FINE = 1e-5  # of a slab's length: edges shorter than that are no edges
_STEPS = 4  # of a quarter round
_CORNER = 0.02  # metres: how far the corners are broken, seen from above


def with_corners(outline: BaseGeometry, shape: TopShape, metre: float) -> BaseGeometry:
    """Returns an outline with its outer corners as the shape wants them."""
    if shape == "rectangle":
        return outline
    least = min((min(p.minimum_rotated_rectangle.exterior.length / 8, 1e9) for p in polygons_in(outline)), default=0.0)
    radius = min(_CORNER * metre, 0.2 * least)
    inner = offset(outline, -radius)
    if shape == "rounded":
        return inner.buffer(radius, join_style="round", quad_segs=_STEPS)
    return inner.buffer(radius, join_style="bevel")


def slab_mesh(outline: Polygon, low: float, high: float, shape: TopShape) -> TriangleMesh:
    """Returns the closed mesh of a slab from `low` to `high`; where its edge leaves no room to break it stays sharp.

    Raises:
        ValueError: if the outline has no area or the heights are no height apart.
    """
    if not (high > low and outline.is_valid and outline.area > 0):
        found = f"{outline.area} m2, {low}..{high}"
        raise ValueError(f"a slab needs an outline with an area and heights apart: got {found}")
    plan = orient(outline)
    rings = [np.asarray(ring.coords)[:-1, :2] for ring in (plan.exterior, *plan.interiors)]
    for profile in (_profile(shape, high - low), _profile("rectangle", high - low)):
        layers = [[_inset(ring, depth) for ring in rings] for depth, _ in profile]
        if all(_is_sound(layer, outline.area) for layer in layers):
            break
    return _stacked(layers, [low + rise for _, rise in profile])


def without_block(mesh: TriangleMesh, region: BaseGeometry, low: float, high: float) -> TriangleMesh:
    """Returns a closed mesh less what stands over a region from `low` to `high`; as it was where that is nothing."""
    body = _manifold(mesh)
    for polygon in polygons_in(region):
        body = body - _manifold(slab_mesh(polygon, low, high, "rectangle"))
    cut = body.simplify(_FINE * float(mesh.box.size.max())).to_mesh()
    found = TriangleMesh(np.asarray(cut.vert_properties, np.float64)[:, :3], np.asarray(cut.tri_verts, np.int64))
    return found if len(found.faces) else mesh


def _manifold(mesh: TriangleMesh) -> manifold3d.Manifold:
    return manifold3d.Manifold(manifold3d.Mesh(mesh.vertices.astype(np.float32), mesh.faces.astype(np.uint32)))


def _profile(shape: TopShape, thickness: float) -> list[tuple[float, float]]:
    """Returns how far the edge lies inwards at heights over the underside, from below."""
    arris = _ARRIS * thickness
    if shape == "chamfered":
        return [(0.0, 0.0), (0.0, thickness - arris), (arris, thickness)]
    if shape == "rounded":
        turns = np.linspace(0.0, np.pi / 2, _STEPS + 1)
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
    return ring + depth * (left + before) / np.maximum(spread, 0.2)[:, None]


def _is_sound(layer: list[Ring], area: float) -> bool:
    plan = Polygon(layer[0], layer[1:])
    return bool(plan.is_valid and 0 < plan.area <= area * (1 + 1e-9))


def _stacked(layers: list[list[Ring]], heights: list[float]) -> TriangleMesh:
    """Returns the closed mesh through rings of equal numbers of corners at rising heights."""
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
