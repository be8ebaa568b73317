"""Meshes that are plain boxes, or reach into all corners of their box: quick answers that spare long questions."""

import numpy as np

from grafu.geometry.mesh import TriangleMesh


def is_plain_box(mesh: TriangleMesh) -> bool:
    """Whether a mesh is the plain closed box that most boards are: a quick answer to spare the long question."""
    at_low, at_high = np.abs(mesh.vertices - mesh.box.low) < 1e-6, np.abs(mesh.vertices - mesh.box.high) < 1e-6
    a, b, c = mesh.box.size
    return bool(np.all(at_low | at_high)) and mesh.area > 1.98 * float(a * b + b * c + c * a)


def has_all_corners(mesh: TriangleMesh) -> bool:
    """Whether a mesh has a vertex at each of the eight corners of its box."""
    box = mesh.box
    at_low, at_high = np.abs(mesh.vertices - box.low) < 1e-9, np.abs(mesh.vertices - box.high) < 1e-9
    corners = at_high[(at_low | at_high).all(axis=1)] @ [1, 2, 4]
    return bool(np.bincount(corners, minlength=8).all())
