"""Some faces of a surface, and several surfaces of one material as one; attributes go with them. It cuts nothing."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Indices
from grafu.geometry.mesh import TriangleMesh, merge_meshes

_WIDTHS = {"uv": 2, "normals": 3, "colors": 4}


def selected(surface: Surface, faces: Indices) -> Surface:
    """Returns the surface of some faces, given by number; vertices that none of them uses are dropped."""
    kept = surface.mesh.faces[faces]
    used, index = np.unique(kept, return_inverse=True)
    mesh = TriangleMesh(surface.mesh.vertices[used], index.reshape(kept.shape))
    uv, normals, colors = (None if a is None else a[used] for a in (surface.uv, surface.normals, surface.colors))
    return replace(surface, mesh=mesh, uv=uv, normals=normals, colors=colors)


def joined(like: Surface, pieces: Sequence[Surface]) -> Surface:
    """Returns pieces of one surface, which have the attributes that it has, as one; same vertices become one."""
    mesh = merge_meshes([piece.mesh for piece in pieces])
    widths = {name: width for name, width in _WIDTHS.items() if getattr(like, name) is not None}
    columns = (np.vstack([getattr(piece, name) for piece in pieces]).astype(np.float64) for name in widths)
    rows, index = np.unique(np.hstack([mesh.vertices, *columns]), axis=0, return_inverse=True)
    at, found = 3, {}
    for name, width in widths.items():
        found[name], at = rows[:, at : at + width], at + width
    colors = found["colors"].astype(np.uint8) if "colors" in found else None
    mesh = TriangleMesh(rows[:, :3], index.reshape(-1)[mesh.faces])
    return replace(like, mesh=mesh, uv=found.get("uv"), normals=found.get("normals"), colors=colors)
