"""PLY and STL files to surfaces, by trimesh. It knows no materials and no groups."""

import io
import logging
import re
from pathlib import Path
from typing import Any

import numpy as np

from grafu.asset.damage import library_call
from grafu.asset.mesh_pieces import MeshFile, MeshPiece
from grafu.asset.resources import ModelFiles
from grafu.asset.tally import Tally
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Surface
from grafu.geometry.mesh import TriangleMesh

_LARGEST = 1e15  # of a coordinate: squares and products of such stay finite
_UNHEARD = logging.NullHandler()
_ELEMENT = re.compile(rb"^element[ \t]+(\S+)[ \t]+(\d{1,18})[ \t\r]*$", re.MULTILINE)


def read_with_trimesh(path: Path, data: bytes, files: ModelFiles) -> MeshFile:
    """Returns the one piece of a PLY or STL file, read before; `path` says which.

    Raises:
        UnreadableAsset: if it is damaged.
        AssetTooLarge: if the model has more of something than the limits allow.
    """
    kind = path.suffix.lower()[1:]
    check_declared(data, kind, path, files.tally)
    mesh = _loaded(path, data, kind)
    visual: Any = mesh.visual
    colors = np.asarray(visual.vertex_colors) if visual.kind == "vertex" else None
    surface = Surface(TriangleMesh.from_trimesh(mesh), colors=colors)
    return MeshFile((MeshPiece("", () if surface.is_empty else (surface,)),))


def _loaded(path: Path, data: bytes, kind: str) -> Any:
    import trimesh  # local: it takes a while to import

    logging.getLogger("trimesh").addHandler(_UNHEARD)  # what it logs of damaged files is said here in one line
    with library_call(path, f"{kind.upper()}, a triangle mesh"):
        loaded = trimesh.load(io.BytesIO(data), file_type=kind, process=False)
    mesh = loaded if isinstance(loaded, trimesh.Trimesh) else None
    fits = mesh is not None and (not len(mesh.faces) or 0 <= mesh.faces.min() <= mesh.faces.max() < len(mesh.vertices))
    if mesh is None or not fits or not np.abs(mesh.vertices).max(initial=0) < _LARGEST:
        raise UnreadableAsset(f"{path} holds no triangle mesh with finite coordinates; re-export it")
    return mesh


def check_declared(data: bytes, kind: str, where: object, tally: Tally) -> None:
    """Counts what a file's header declares, before memory is taken for it.

    Raises:
        UnreadableAsset: if the file holds less than it declares.
        AssetTooLarge: if the model has more of something than the limits allow.
    """
    if kind == "ply":
        _check_ply(data, where, tally)
    elif data[:5].lower() == b"solid" and data.find(b"facet", 0, 4096) >= 0:
        faces = data.count(b"endfacet") or data.count(b"ENDFACET")
        tally.add(where, faces=faces, vertices=3 * faces)
    elif len(data) >= 84:
        declared = int.from_bytes(data[80:84], "little")
        tally.add(where, faces=declared, vertices=3 * declared)
        if 84 + declared * 50 > len(data):
            raise UnreadableAsset(f"{where} is truncated: its header declares {declared} faces; export it again")


def _check_ply(data: bytes, where: object, tally: Tally) -> None:
    for noun, digits in _ELEMENT.findall(data[: data.find(b"end_header") + 10]):
        count = int(digits)
        # a face with many corners is several triangles, each of four bytes at least
        counts = {"faces": count} if noun == b"face" else {"vertices": count}
        tally.add(where, **counts)
        if count > len(data):
            raise UnreadableAsset(f"{where} is truncated: its header declares {count} elements; export it again")
