"""Metal and plastic finishes, and surfaces with smooth curved sides and sharp edges. It makes no shapes."""

import numpy as np

from grafu.geometry.appearance import Material, Surface
from grafu.geometry.mesh import TriangleMesh

STEEL = Material("brushed steel", (0.56, 0.57, 0.58, 1.0), metallic=1.0, roughness=0.38)
NICKEL = Material("satin nickel", (0.66, 0.61, 0.53, 1.0), metallic=1.0, roughness=0.3)
BRASS = Material("brass", (0.78, 0.57, 0.25, 1.0), metallic=1.0, roughness=0.28)
BRONZE = Material("antique bronze", (0.20, 0.12, 0.07, 1.0), metallic=1.0, roughness=0.5)
BLACK = Material("blackened iron", (0.03, 0.03, 0.032, 1.0), metallic=0.7, roughness=0.6)
SCREW = Material("screw steel", (0.40, 0.41, 0.42, 1.0), metallic=1.0, roughness=0.3)
ZINC = Material("zinc plate", (0.62, 0.64, 0.67, 1.0), metallic=1.0, roughness=0.45)
COATED = Material("epoxy-coated steel", (0.80, 0.79, 0.75, 1.0), metallic=0.0, roughness=0.5)
NYLON = Material("nylon", (0.86, 0.86, 0.84, 1.0), metallic=0.0, roughness=0.6)

_CREASE = np.cos(np.radians(40.0))  # sides of a 12-gon turn by 30 degrees and look round; a chamfer turns by 45


def finished(mesh: TriangleMesh, material: Material) -> Surface:
    """Returns the mesh in a material, with normals that are smooth across edges flatter than 40 degrees."""
    if not len(mesh.faces):
        return Surface(mesh, material)
    corners = mesh.faces.reshape(-1)
    normals = _corner_normals(mesh, corners)
    rows = np.c_[corners, np.round(normals * 1e6)].astype(np.int64)
    _, first, index = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    split = TriangleMesh(mesh.vertices[corners[first]], index.reshape(-1, 3))
    return Surface(split, material, normals=normals[first])


def _corner_normals(mesh: TriangleMesh, corners: np.ndarray) -> np.ndarray:
    """Returns for each face corner the mean, weighted by corner angles, over nearly coplanar faces at its vertex."""
    one, other = _corner_pairs(corners)
    unit = mesh.face_normals
    weighted = np.repeat(unit, 3, axis=0) * _corner_angles(mesh)[:, None]  # so a quad counts alike however it is split
    smooth = np.einsum("ij,ij->i", unit[one // 3], unit[other // 3]) > _CREASE
    one, other = one[smooth], other[smooth]
    total = np.stack([np.bincount(one, weighted[other, k], len(corners)) for k in range(3)], axis=1)
    return total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), 1e-300)


def _corner_angles(mesh: TriangleMesh) -> np.ndarray:
    """Returns the angle of each face at each of its corners, radians."""
    ahead = np.roll(mesh.triangles, -1, axis=1) - mesh.triangles
    ahead = ahead / np.maximum(np.linalg.norm(ahead, axis=2, keepdims=True), 1e-300)
    back = -np.roll(ahead, 1, axis=1)
    return np.arccos(np.clip(np.einsum("fck,fck->fc", ahead, back), -1.0, 1.0)).reshape(-1)


def _corner_pairs(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns all ordered pairs of corners at the same vertex, each corner with itself too."""
    order = np.argsort(corners, kind="stable")
    counts = np.bincount(corners)
    starts = np.cumsum(counts) - counts
    repeats = counts[corners]
    one = np.repeat(np.arange(len(corners)), repeats)
    within = np.arange(len(one)) - np.repeat(np.cumsum(repeats) - repeats, repeats)
    return one, order[np.repeat(starts[corners], repeats) + within]
