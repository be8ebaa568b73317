"""A mesh as a binary PLY file."""

import numpy as np

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
