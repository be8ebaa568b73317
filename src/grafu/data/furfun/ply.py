"""PLY files of parts: points or a mesh in, text or binary; a binary mesh out. It knows no folders."""

import io
from typing import Any

import numpy as np

from grafu.errors import UnreadableAsset
from grafu.geometry.arrays import Points
from grafu.geometry.mesh import TriangleMesh

_HEADER = """ply
format binary_little_endian 1.0
element vertex {vertices}
property float x
property float y
property float z
element face {faces}
property list uchar int vertex_indices
end_header
"""
_FACE = np.dtype([("count", "u1"), ("corners", "<i4", (3,))])


def mesh_to_ply(mesh: TriangleMesh) -> bytes:
    """Returns a binary PLY with single-precision coordinates, as Blender reads them."""
    faces = np.empty(len(mesh.faces), _FACE)
    faces["count"], faces["corners"] = 3, mesh.faces
    header = _HEADER.format(vertices=len(mesh.vertices), faces=len(mesh.faces))
    return header.encode() + mesh.vertices.astype("<f4").tobytes() + faces.tobytes()


def read_ply(data: bytes, where: str) -> TriangleMesh | Points:
    """Returns the mesh in a PLY file, or its vertices where it has no faces.

    Raises:
        UnreadableAsset: if it is damaged, or states coordinates that are not finite.
    """
    import trimesh  # local: it takes a while to import, and most releases have .npy files

    try:
        loaded: Any = trimesh.load(io.BytesIO(data), file_type="ply", process=False)
        vertices = np.asarray(loaded.vertices, dtype=np.float64).reshape(-1, 3)
        faces = np.asarray(getattr(loaded, "faces", ()), dtype=np.int64).reshape(-1, 3)
    except Exception:  # trimesh raises whatever its parser meets
        raise UnreadableAsset(f"{where} is damaged or no PLY: expected points or a mesh; export it again") from None
    if not np.all(np.isfinite(vertices)) or (len(faces) and not 0 <= faces.min() <= faces.max() < len(vertices)):
        raise UnreadableAsset(f"{where} must hold finite points, and faces between them; export it again")
    return TriangleMesh(vertices, faces) if len(faces) else vertices
