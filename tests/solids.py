"""Closed surfaces made of boxes that are joined and cut, for tests of what is drawn on one surface."""

import manifold3d
import numpy as np

from grafu.geometry.mesh import TriangleMesh


def solid(low, high):
    """A box."""
    cube = manifold3d.Manifold.cube([h - lo for lo, h in zip(low, high, strict=True)])
    return cube.translate([float(v) for v in low])


def as_mesh(body) -> TriangleMesh:
    """The surface of what was made of boxes."""
    found = body.to_mesh()
    return TriangleMesh(np.asarray(found.vert_properties)[:, :3].astype(float), np.asarray(found.tri_verts))
