"""One mesh file to named pieces with surfaces: OBJ, PLY, STL. It knows no parts, labels or frames."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, final

import numpy as np

from grafu.asset.mtl import read_mtl
from grafu.asset.obj_parser import ObjData, parse_obj
from grafu.asset.options import Limits
from grafu.asset.triangulate import triangulate
from grafu.errors import AssetTooLarge, UnreadableAsset
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.mesh import TriangleMesh

MESH_SUFFIXES = (".obj", ".ply", ".stl")
_DEFAULT = Material()


@final
@dataclass(frozen=True)
class MeshPiece:
    """A named piece of a mesh file; the name is empty where the file gives none."""

    name: str
    surfaces: tuple[Surface, ...]


@final
@dataclass(frozen=True)
class MeshFile:
    """The pieces of a mesh file, in order, and notes on what was left out."""

    pieces: tuple[MeshPiece, ...]
    notes: tuple[str, ...] = ()

    @property
    def surfaces(self) -> tuple[Surface, ...]:
        """All surfaces of all pieces."""
        return tuple(s for piece in self.pieces for s in piece.surfaces)


def read_bytes(path: Path, limits: Limits) -> bytes:
    """Returns a file's content.

    Raises:
        UnreadableAsset: if the file is missing or cannot be read.
        AssetTooLarge: if it is larger than the limit.
    """
    try:
        size = path.stat().st_size
        if size > limits.max_bytes:
            most = f"{limits.max_bytes / 2**20:g} MiB"
            raise AssetTooLarge(f"{path} has {size / 2**20:.0f} MiB: at most {most} are read; simplify the mesh")
        return path.read_bytes()
    except OSError as error:
        reason = error.strerror or str(error)
        raise UnreadableAsset(f"{path} cannot be read ({reason}): expected a readable mesh file") from None


def read_mesh_file(path: Path, limits: Limits, split: bool = True) -> MeshFile:
    """Returns the pieces of an OBJ, PLY or STL file; with `split=False` an OBJ is one piece whatever its groups.

    Raises:
        UnreadableAsset: if the file is missing, damaged, or of another kind.
        AssetTooLarge: if it has more bytes or faces than the limits allow.
    """
    data = read_bytes(path, limits)
    if path.suffix.lower() == ".obj":
        return _read_obj(path, data, limits, split)
    if path.suffix.lower() in MESH_SUFFIXES:
        return _read_with_trimesh(path, data, limits)
    raise UnreadableAsset(f"{path} is not a mesh that is read: expected {', '.join(MESH_SUFFIXES)}")


def check_faces(count: int, where: str, limits: Limits) -> None:
    """Raises AssetTooLarge where `count` faces are more than the limit."""
    if count > limits.max_faces:
        raise AssetTooLarge(f"{where} has {count:,} faces: at most {limits.max_faces:,} are read; simplify the mesh")


def _read_obj(path: Path, data: bytes, limits: Limits, split: bool) -> MeshFile:
    check_faces(data.count(b"\nf "), str(path), limits)
    obj = parse_obj(data, str(path))
    if not len(obj.vertices) and data.strip() and not obj.runs:
        raise UnreadableAsset(f"{path} holds no vertices: expected a Wavefront OBJ mesh; re-export it")
    materials, notes = _materials(path, obj)
    triangles, owners = triangulate(obj.vertices, obj.corners[:, 0], obj.starts)
    check_faces(len(triangles), str(path), limits)
    pieces: dict[str, dict[str, list[np.ndarray]]] = {}
    by_object = len({run.object for run in obj.runs}) > 1
    bounds = np.searchsorted(owners, [[run.first, run.last] for run in obj.runs]) if obj.runs else ()
    for run, (first, last) in zip(obj.runs, bounds, strict=True):
        name = (run.object if by_object else run.group or run.object) if split else ""
        pieces.setdefault(name, {}).setdefault(run.material, []).append(triangles[first:last])
    return MeshFile(tuple(_piece(name, obj, runs, materials) for name, runs in pieces.items()), tuple(notes))


def _materials(path: Path, obj: ObjData) -> tuple[dict[str, Material], list[str]]:
    materials: dict[str, Material] = {}
    notes: list[str] = []
    for library in obj.libraries:
        found, said = read_mtl(path.parent / library)
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


def _read_with_trimesh(path: Path, data: bytes, limits: Limits) -> MeshFile:
    import io

    import trimesh

    kind = path.suffix.lower()[1:]
    _check_declared(data, kind, path, limits)
    try:
        loaded = trimesh.load(io.BytesIO(data), file_type=kind, process=False)
    except Exception:  # trimesh raises whatever its parsers meet
        raise UnreadableAsset(f"{path} is damaged or not {kind.upper()}: expected a triangle mesh") from None
    mesh = loaded if isinstance(loaded, trimesh.Trimesh) else None
    fits = mesh is not None and (not len(mesh.faces) or 0 <= mesh.faces.min() <= mesh.faces.max() < len(mesh.vertices))
    if mesh is None or not fits or not np.isfinite(mesh.vertices).all():
        raise UnreadableAsset(f"{path} holds no triangle mesh with finite coordinates; re-export it")
    visual: Any = mesh.visual
    colors = np.asarray(visual.vertex_colors) if visual.kind == "vertex" else None
    surface = Surface(TriangleMesh.from_trimesh(mesh), colors=colors)
    return MeshFile((MeshPiece("", () if surface.is_empty else (surface,)),))


def _check_declared(data: bytes, kind: str, path: Path, limits: Limits) -> None:
    """Refuses a file whose header declares more than the limit or than the file holds, before memory is taken."""
    if kind == "stl" and data[:5].lower() != b"solid" and len(data) >= 84:
        declared = int.from_bytes(data[80:84], "little")
        check_faces(declared, str(path), limits)
        if 84 + declared * 50 > len(data):
            raise UnreadableAsset(f"{path} is truncated: its header declares {declared} faces; export it again")
    if kind == "ply":
        header = data[: data.find(b"end_header") + 10]
        for line in header.splitlines():
            if line.startswith(b"element ") and line.split()[-1].isdigit():
                count = int(line.split()[-1])
                check_faces(count, str(path), limits)
                if count > len(data):
                    raise UnreadableAsset(f"{path} is truncated: its header declares {count} elements; export it again")
