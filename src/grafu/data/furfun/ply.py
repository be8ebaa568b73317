"""PLY files of parts: points or a mesh in, text or binary; a binary mesh out. It knows no folders."""

import io
from typing import Any

import numpy as np

from grafu.asset.damage import library_call
from grafu.asset.options import Limits
from grafu.asset.scan_files import check_declared
from grafu.asset.tally import Tally
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
_LIMITS = Limits()
_FACE = np.dtype([("count", "u1"), ("corners", "<i4", (3,))])


def mesh_to_ply(mesh: TriangleMesh) -> bytes:
    """Returns a binary PLY with single-precision coordinates, as Blender reads them."""
    faces = np.empty(len(mesh.faces), _FACE)
    faces["count"], faces["corners"] = 3, mesh.faces
    header = _HEADER.format(vertices=len(mesh.vertices), faces=len(mesh.faces))
    return header.encode() + mesh.vertices.astype("<f4").tobytes() + faces.tobytes()


def read_ply(data: bytes, where: str, tally: Tally | None = None) -> TriangleMesh | Points:
    """Returns the mesh in a PLY file, or its vertices where it has no faces.

    Raises:
        UnreadableAsset: if it is damaged, or states coordinates that are not finite.
        AssetTooLarge: if the model has more of something than the limits allow.
    """
    check_declared(data, "ply", where, Tally(_LIMITS) if tally is None else tally)
    import trimesh  # local: it takes a while to import, and most releases have .npy files

    with library_call(where, "PLY with points or a mesh; export it again"):
        loaded: Any = trimesh.load(io.BytesIO(data), file_type="ply", process=False)
        vertices = np.asarray(loaded.vertices, dtype=np.float64).reshape(-1, 3)
        faces = np.asarray(getattr(loaded, "faces", ()), dtype=np.int64).reshape(-1, 3)
    if not np.all(np.isfinite(vertices)) or (len(faces) and not 0 <= faces.min() <= faces.max() < len(vertices)):
        raise UnreadableAsset(f"{where} must hold finite points, and faces between them; export it again")
    return TriangleMesh(vertices, faces) if len(faces) else vertices
