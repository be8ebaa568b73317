"""Visuals as glTF meshes: one mesh each, one primitive per surface. It knows no links and no joints."""

from typing import Any

import numpy as np

from grafu.articulation.articulated_object import Visual
from grafu.export.gltf_buffer import VERTEX_DATA, GltfBuffer
from grafu.export.gltf_material import GltfMaterials
from grafu.export.shading import corner_normals
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Points, Vec3


def to_y_up(vectors: Points) -> Points:
    """Returns vectors of the object frame (Z up, front -Y) in glTF's (Y up, front +Z); exact in every digit."""
    return np.column_stack([vectors[:, 0], vectors[:, 2], -vectors[:, 1]])


def mesh_of(visual: Visual, origin: Vec3, writer: tuple[GltfBuffer, GltfMaterials], crease: float) -> dict[str, Any]:
    """Returns the glTF mesh of a visual relative to `origin` (metres, object frame); it may have no primitives."""
    primitives = [_primitive(s, origin, writer, crease) for s in visual.surfaces if not s.is_empty]
    return {"name": visual.name, "primitives": primitives}


def _primitive(
    surface: Surface, origin: Vec3, writer: tuple[GltfBuffer, GltfMaterials], crease: float
) -> dict[str, Any]:
    buffer, materials = writer
    shading = corner_normals(surface, crease)
    vertex, normal, corners = _split(surface, np.asarray(shading.corners), len(shading.normals))
    attributes = {
        "POSITION": buffer.add_array(_floats(to_y_up(surface.mesh.vertices[vertex] - origin)), VERTEX_DATA, True),
        "NORMAL": buffer.add_array(_floats(to_y_up(shading.normals[normal])), VERTEX_DATA),
    }
    if surface.uv is not None:
        uv = np.clip(np.nan_to_num(surface.uv[vertex], posinf=0.0, neginf=0.0), -1e6, 1e6)
        flipped = uv * [1.0, -1.0] + [0.0, 1.0]  # glTF's origin is the top left
        attributes["TEXCOORD_0"] = buffer.add_array(_floats(flipped), VERTEX_DATA)
    if surface.colors is not None:
        attributes["COLOR_0"] = buffer.add_array(np.ascontiguousarray(surface.colors[vertex]), VERTEX_DATA)
    return {
        "attributes": attributes,
        "indices": buffer.add_indices(corners.ravel()),
        "material": materials.index_of(surface.material, surface.uv is not None),
    }


def _split(surface: Surface, corners: np.ndarray, normals: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Splits vertices so that each has one normal: the old vertex and the normal of each new one, and the new faces.

    Faces that name one vertex twice are left out: they have no area in any pose and validators refuse them.
    """
    faces = surface.mesh.faces
    whole = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    faces, corners = (faces, corners) if whole.all() or not whole.any() else (faces[whole], corners[whole])
    keys, index = np.unique(faces.ravel() * normals + corners.ravel(), return_inverse=True)
    return keys // normals, keys % normals, index.reshape(faces.shape)


def _floats(values: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(values, dtype=np.float32)
