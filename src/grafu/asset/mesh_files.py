"""One mesh file to named pieces with surfaces: OBJ, PLY, STL. It knows no parts, labels or frames."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from grafu.asset.mesh_pieces import MeshFile, MeshPiece
from grafu.asset.mtl import read_mtl
from grafu.asset.obj_parser import ObjData, parse_obj
from grafu.asset.resources import ModelFiles
from grafu.asset.scan_files import read_with_trimesh
from grafu.asset.triangulate import triangulate
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.mesh import TriangleMesh

MESH_SUFFIXES = (".obj", ".ply", ".stl")
_DEFAULT = Material()


def read_mesh_file(path: Path, files: ModelFiles, split: bool = True) -> MeshFile:
    """Returns the pieces of an OBJ, PLY or STL file; with `split=False` an OBJ is one piece whatever its groups.

    Raises:
        UnreadableAsset: if the file is missing, damaged, or of another kind.
        AssetTooLarge: if the model has more of something than the limits allow.
    """
    suffix = path.suffix.lower()
    if suffix not in MESH_SUFFIXES:
        raise UnreadableAsset(f"{path} is not a mesh that is read: expected {', '.join(MESH_SUFFIXES)}")
    data = files.read(path)
    return _read_obj(path, data, files, split) if suffix == ".obj" else read_with_trimesh(path, data, files)


def _read_obj(path: Path, data: bytes, files: ModelFiles, split: bool) -> MeshFile:
    obj = parse_obj(data, str(path), files.tally)
    if not len(obj.vertices) and data.strip() and not obj.runs:
        raise UnreadableAsset(f"{path} holds no vertices: expected a Wavefront OBJ mesh; re-export it")
    materials, notes = _materials(path, obj, files)
    triangles, owners = triangulate(obj.vertices, obj.corners[:, 0], obj.starts)
    pieces: dict[str, dict[str, list[np.ndarray]]] = {}
    by_object = len({run.object for run in obj.runs}) > 1
    bounds = np.searchsorted(owners, [[run.first, run.last] for run in obj.runs]) if obj.runs else ()
    for run, (first, last) in zip(obj.runs, bounds, strict=True):
        name = (run.object if by_object else run.group or run.object) if split else ""
        pieces.setdefault(name, {}).setdefault(run.material, []).append(triangles[first:last])
    files.tally.add(path, primitives=sum(map(len, pieces.values())))
    return MeshFile(tuple(_piece(name, obj, runs, materials) for name, runs in pieces.items()), tuple(notes))


def _materials(path: Path, obj: ObjData, files: ModelFiles) -> tuple[dict[str, Material], list[str]]:
    materials: dict[str, Material] = {}
    notes: list[str] = []
    for library in dict.fromkeys(obj.libraries):
        found, said = read_mtl(library, path.parent, files)
        materials.update(found)
        notes += said
    return materials, notes


def _piece(name: str, obj: ObjData, runs: dict[str, list[np.ndarray]], materials: Mapping[str, Material]) -> MeshPiece:
    surfaces = []
    for material, chunks in runs.items():
        surface = _obj_surface(obj, np.concatenate(chunks), materials.get(material, _DEFAULT))
        surfaces.append(surface)
    return MeshPiece(name, tuple(s for s in surfaces if not s.is_empty))


def _obj_surface(obj: ObjData, triangles: np.ndarray, material: Material) -> Surface:
    """Returns the triangles as one surface; a vertex is split where texture coordinates or normals differ."""
    corners = obj.corners[triangles.ravel()]
    has_uv, has_normals = len(corners) and (corners[:, 1] >= 0).all(), len(corners) and (corners[:, 2] >= 0).all()
    keys = corners[:, 0].copy()
    if has_uv:
        keys = keys * len(obj.uv) + corners[:, 1]
    if has_normals:
        keys = keys * len(obj.normals) + corners[:, 2]
    _, first, index = np.unique(keys, return_index=True, return_inverse=True)
    used = corners[first]
    normals = _unit(obj.normals[used[:, 2]]) if has_normals else None
    colors = obj.colors[used[:, 0]] if obj.colors is not None else None
    mesh = TriangleMesh(obj.vertices[used[:, 0]], index.reshape(-1, 3))
    return Surface(mesh, material, obj.uv[used[:, 1]] if has_uv else None, normals, colors)


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-300)
