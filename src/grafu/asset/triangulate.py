"""Polygons to triangles: fans for convex ones, ear clipping for the others. It knows no files."""

import numpy as np


def triangulate(positions: np.ndarray, vertex: np.ndarray, starts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns triangles as positions in the corner list (m, 3), and the polygon that each comes from (m,).

    Args:
        positions: vertices, (n, 3).
        vertex: for each corner its vertex, polygons one after another.
        starts: where each polygon starts in `vertex`, and the end.
    """
    counts = np.diff(starts)
    triangles, owners = [], []
    for n in np.unique(counts):
        polygons = np.flatnonzero(counts == n)
        if n < 3:
            continue
        corners = starts[polygons][:, None] + np.arange(n)
        made = corners.reshape(-1, 1, 3) if n == 3 else _fans(positions, vertex, corners)
        triangles.append(made.reshape(-1, 3))
        owners.append(np.repeat(polygons, n - 2))
    if not triangles:
        return np.zeros((0, 3), np.int64), np.zeros(0, np.int64)
    owner = np.concatenate(owners)
    order = np.argsort(owner, kind="stable")
    return np.concatenate(triangles)[order], owner[order]


def _fans(positions: np.ndarray, vertex: np.ndarray, corners: np.ndarray) -> np.ndarray:
    n = corners.shape[1]
    fan = np.array([[0, k, k + 1] for k in range(1, n - 1)])
    made = corners[:, fan]
    points = positions[vertex[corners]]
    after, before = np.roll(points, -1, axis=1) - points, points - np.roll(points, 1, axis=1)
    turns = np.cross(before, after)
    normal = np.cross(points, np.roll(points, -1, axis=1)).sum(axis=1)
    size = np.linalg.norm(normal, axis=1)
    concave = ((turns * normal[:, None]).sum(axis=2) < -1e-6 * size[:, None] ** 2).any(axis=1)
    for row in np.flatnonzero(concave):
        ears = _ears(points[row], normal[row])
        if ears is not None:
            made[row] = corners[row][ears]
    return made


def _ears(points: np.ndarray, normal: np.ndarray) -> np.ndarray | None:
    """Returns ear-clipped triangles with the polygon's winding, or None where the polygon cannot be clipped."""
    import mapbox_earcut  # local: only concave polygons need it

    drop = int(np.argmax(np.abs(normal)))
    flat = np.delete(points, drop, axis=1)
    ears = mapbox_earcut.triangulate_float64(flat, np.array([len(flat)], np.uint32)).reshape(-1, 3).astype(np.int64)
    if len(ears) != len(points) - 2:
        return None
    made = np.cross(points[ears[:, 1]] - points[ears[:, 0]], points[ears[:, 2]] - points[ears[:, 0]]).sum(axis=0)
    return ears if made @ normal > 0 else ears[:, ::-1]
