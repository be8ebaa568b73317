"""Metal and plastic finishes, and surfaces with smooth curved sides and sharp edges. It makes no shapes."""

import numpy as np
from scipy.sparse import coo_matrix

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
    count = len(corners)
    faces = np.repeat(np.arange(len(mesh.faces)), 3)
    order = np.argsort(corners, kind="stable")
    normals = _corner_normals(mesh, corners, faces, order)
    rows = np.c_[corners, np.round(normals * 1e6)].astype(np.int64)
    _, first, index = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    split = TriangleMesh(mesh.vertices[corners[first]], index.reshape(count // 3, 3))
    return Surface(split, material, normals=normals[first])


def _corner_normals(mesh: TriangleMesh, corners: np.ndarray, faces: np.ndarray, order: np.ndarray) -> np.ndarray:
    """Returns for each face corner the area-weighted mean over the faces at its vertex that are nearly coplanar."""
    at = coo_matrix((np.ones(len(order)), (faces, corners)), shape=(len(mesh.faces), len(mesh.vertices))).tocsr()
    pairs = (at @ at.T).tocoo()  # faces that share a vertex
    unit = mesh.face_normals
    smooth = np.einsum("ij,ij->i", unit[pairs.row], unit[pairs.col]) > _CREASE
    near = coo_matrix((np.ones(int(smooth.sum())), (pairs.row[smooth], pairs.col[smooth])), shape=pairs.shape).tocsr()
    total = np.zeros((len(corners), 3))
    for corner in range(3):
        total[corner::3] = _mean_normals(mesh, near, at, mesh.faces[:, corner])
    return total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), 1e-300)


def _mean_normals(mesh: TriangleMesh, near: coo_matrix, at: coo_matrix, vertices: np.ndarray) -> np.ndarray:
    """Returns for each face the summed cross products of its near faces that hold the given vertex of it."""
    weighted = mesh.face_normals * mesh.face_areas[:, None]
    holds = at[:, vertices].T.minimum(1.0)  # row i: the faces around vertex i
    return near.multiply(holds).tocsr() @ weighted
