"""Wavefront MTL libraries to materials. It reads the library and its images, and nothing else."""

import math
from pathlib import Path

from grafu.asset.resources import ModelFiles
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Material, Texture


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
    texture = _texture(entries["map_kd"], folder, files, notes) if "map_kd" in entries else None
    red, green, blue = (_linear(c) for c in diffuse)
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


def _texture(value: str, folder: Path, files: ModelFiles, notes: list[str]) -> Texture | None:
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


def _linear(srgb: float) -> float:
    c = min(max(srgb, 0.0), 1.0)
    return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4
