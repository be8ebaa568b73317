"""One mesh file to named pieces with surfaces: OBJ with its MTL, PLY, STL.

Of an MTL the library and its images are read, and nothing else.
"""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from grafu.asset.names import spoken
from grafu.asset.obj_parser import ObjData, parse_obj
from grafu.asset.polygons import triangulate
from grafu.asset.reading import MeshFile, MeshPiece
from grafu.asset.resources import ModelFiles
from grafu.asset.scan_files import read_with_trimesh
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.geometry.arrays import Points, first_of_each
from grafu.geometry.mesh import TriangleMesh
from grafu.shapes import Int


def read_mtl(name: str, beside: Path, files: ModelFiles) -> tuple[dict[str, Material], list[str]]:
    """Returns the materials of a library by name, and notes on what could not be read.

    A library or an image that cannot be had is a note, not an error: the shapes are still good.

    Args:
        name: the library as the mesh names it.
        beside: the folder of the mesh.
        files: the files of the model.
    """
    sought = files.seek(name, beside)
    if sought.path is None:
        return {}, [f"material library {name.rpartition('/')[2]} {sought.why}; default materials are used"]
    try:
        text = files.read(sought.path).decode("utf-8", "replace")
    except UnreadableAsset as error:
        return {}, [f"material library {sought.path.name} {error}; default materials are used"]
    materials: dict[str, Material] = {}
    notes: list[str] = []
    for material, entries in _entries(text):
        materials[material] = _material(material, entries, sought.path.parent, files, notes)
    return materials, notes


def _entries(text: str) -> list[tuple[str, dict[str, str]]]:
    found: list[tuple[str, dict[str, str]]] = []
    for line in text.splitlines():
        key, _, value = line.strip().partition(" ")
        if key == "newmtl":
            found.append((value.strip(), {}))
        elif found and key and not key.startswith("#"):
            found[-1][1][key.lower()] = value.strip()
    return found


def _material(name: str, entries: dict[str, str], folder: Path, files: ModelFiles, notes: list[str]) -> Material:
    diffuse = _floats(entries.get("kd", ""), (0.8, 0.8, 0.8))
    alpha = _floats(entries.get("d", ""), (1.0,))[0]
    if "d" not in entries and "tr" in entries:
        alpha = 1.0 - _floats(entries["tr"], (0.0,))[0]
    shininess = _floats(entries.get("ns", ""), (10.0,))[0]
    texture = named_texture(entries["map_kd"], folder, files, notes) if "map_kd" in entries else None
    red, green, blue = (linear_channel(c) for c in diffuse)
    # Exporters write Kd 0 under a texture that is meant to show as it is.
    color = (1.0, 1.0, 1.0) if texture and max(diffuse) <= 0 else (red, green, blue)
    return Material(
        name=name,
        base_color=(*color, min(max(alpha, 0.0), 1.0)),
        roughness=float((2.0 / (max(shininess, 0.0) + 2.0)) ** 0.25),
        base_color_texture=texture,
        alpha_mode="BLEND" if alpha < 0.999 else "OPAQUE",
        double_sided=True,
    )


def named_texture(value: str, folder: Path, files: ModelFiles, notes: list[str]) -> Texture | None:
    """Returns the image that a mesh in `folder` names, checked; None, and a note, where it cannot be had."""
    # Options such as `-s 1 1 1` stand before the file name; names may hold spaces, so the whole value is tried first.
    names = dict.fromkeys((value, value.split()[-1] if value.split() else value))
    tried = [files.seek(name.replace("\\", "/"), folder) for name in names]
    path = next((sought.path for sought in tried if sought.path is not None), None)
    if path is None:
        notes.append(f"texture {value} {tried[-1].why} and was left out")
        return None
    found = files.texture(path)
    if isinstance(found, Texture):
        return found
    notes.append(f"texture {path.name} {found} and was left out")
    return None


def _floats(value: str, default: tuple[float, ...]) -> tuple[float, ...]:
    try:
        numbers = tuple(float(v) for v in value.split()[: len(default)])
    except ValueError:
        return default
    return numbers if len(numbers) == len(default) and all(map(math.isfinite, numbers)) else default


def linear_channel(srgb: float) -> float:
    """Returns a channel of a colour in sRGB as a linear one, both 0..1."""
    c = min(max(srgb, 0.0), 1.0)
    return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4


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
    return MeshPiece(name, tuple(s for s in surfaces if not s.is_empty), _without_material(name, tuple(runs)))


def _without_material(name: str, materials: Sequence[str]) -> str:
    """Returns the name of a group without its material, which exporters write behind it; empty where it has none.

    A name that then holds no word of its own, such as `Cube.012`, keeps the material: that may tell more.
    """
    material = f"_{materials[0]}" if len(materials) == 1 and materials[0] else ""
    own = name.removesuffix(material)
    return own if material and own != name and spoken(own) else ""


def _obj_surface(obj: ObjData, triangles: np.ndarray, material: Material) -> Surface:
    corners = obj.corners[triangles.ravel()]
    return surface_of_corners(corners, obj.vertices, obj.uv, obj.normals, obj.colors, material)


def surface_of_corners(
    corners: Int[np.ndarray, "m 3"],
    vertices: Points,
    uv: np.ndarray,
    normals: np.ndarray,
    colors: np.ndarray | None,
    material: Material,
) -> Surface:
    """Returns triangles as one surface; a vertex is split where texture coordinates or normals differ.

    Args:
        corners: three rows for each triangle: the index of its vertex, of its texture coordinates, and of its normal;
            -1 where it has none.
        vertices: positions.
        uv: texture coordinates, origin at the bottom left.
        normals: normals of any length.
        colors: one colour for each vertex, None where there are none.
        material: the material of all triangles.
    """
    has_uv, has_normals = len(corners) and (corners[:, 1] >= 0).all(), len(corners) and (corners[:, 2] >= 0).all()
    keys = corners[:, 0].copy()
    if has_uv:
        keys = keys * len(uv) + corners[:, 1]
    if has_normals:
        keys = keys * len(normals) + corners[:, 2]
    first, index = first_of_each(keys)
    used = corners[first]
    units = _unit(normals[used[:, 2]]) if has_normals else None
    mesh = TriangleMesh(vertices[used[:, 0]], index.reshape(-1, 3))
    shown = colors[used[:, 0]] if colors is not None else None
    return Surface(mesh, material, uv[used[:, 1]] if has_uv else None, units, shown)


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-300)
