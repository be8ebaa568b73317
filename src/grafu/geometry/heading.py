"""How furniture stands turned about Z: the angle that most of its upright faces follow."""

from collections.abc import Iterable

import numpy as np

from grafu.geometry.mesh import TriangleMesh

_UPRIGHT = 0.1  # most of a unit normal that may point up or down in an upright face
_BINS = 90  # of one degree each
_AS_WELL = 0.6  # of the largest area must lie along the axes for those to serve: a room's corner has two such pairs


def heading_of(meshes: Iterable[TriangleMesh]) -> float:
    """Returns the rotation about Z, radians in (-pi/4, pi/4], that lays an axis along most of the upright area.

    It is 0 where the axes serve nearly as well, and for angles below one degree: walls that are a little askew.
    """
    crosses = [_crosses(mesh) for mesh in meshes if len(mesh.faces)]
    cross = np.concatenate(crosses) if crosses else np.zeros((0, 3))
    area = np.linalg.norm(cross, axis=1)
    upright = (area > 0) & (np.abs(cross[:, 2]) <= _UPRIGHT * area)
    if not upright.any():
        return 0.0
    cross, area = cross[upright], area[upright]
    angles = np.mod(np.arctan2(cross[:, 1], cross[:, 0]), np.pi / 2)
    bins = np.bincount((angles / (np.pi / 2) * _BINS).round().astype(int) % _BINS, area, _BINS)
    near = bins + np.roll(bins, 1) + np.roll(bins, -1)
    best = int(np.argmax(near))
    if near[0] >= _AS_WELL * near[best]:
        return 0.0
    apart = np.mod(angles - best * np.pi / 2 / _BINS + np.pi / 4, np.pi / 2) - np.pi / 4
    close = np.abs(apart) <= 1.5 * np.pi / 2 / _BINS
    angle = best * np.pi / 2 / _BINS + float(np.average(apart[close], weights=area[close]))
    return angle if angle <= np.pi / 4 else angle - np.pi / 2


def _crosses(mesh: TriangleMesh) -> np.ndarray:
    a, b, c = np.moveaxis(mesh.triangles, 1, 0)
    return np.asarray(np.cross(b - a, c - a))
