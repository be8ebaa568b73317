"""Wavefront MTL libraries to materials. It reads the library and its images, and nothing else."""

from pathlib import Path

from grafu.geometry.appearance import Material, Texture

_MIMES = {b"\x89PNG": "image/png", b"\xff\xd8\xff": "image/jpeg"}


def texture_from(data: bytes, name: str) -> Texture | None:
    """Returns the image as a texture, or None where it is neither PNG nor JPEG."""
    for magic, mime in _MIMES.items():
        if data.startswith(magic):
            return Texture(name, data, mime)  # type: ignore[arg-type]
    return None


def read_mtl(path: Path) -> tuple[dict[str, Material], list[str]]:
    """Returns the materials of a library by name, and notes on what could not be read.

    A library that is missing is a note, not an error: the shapes are still good.
    """
    if not path.is_file():
        return {}, [f"material library {path.name} is missing; default materials are used"]
    materials: dict[str, Material] = {}
    notes: list[str] = []
    for name, entries in _entries(path.read_text("utf-8", "replace")):
        materials[name] = _material(name, entries, path.parent, notes)
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


def _material(name: str, entries: dict[str, str], folder: Path, notes: list[str]) -> Material:
    diffuse = _floats(entries.get("kd", ""), (0.8, 0.8, 0.8))
    alpha = _floats(entries.get("d", ""), (1.0,))[0]
    if "d" not in entries and "tr" in entries:
        alpha = 1.0 - _floats(entries["tr"], (0.0,))[0]
    shininess = _floats(entries.get("ns", ""), (10.0,))[0]
    texture = _texture(entries["map_kd"], folder, notes) if "map_kd" in entries else None
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


def _texture(value: str, folder: Path, notes: list[str]) -> Texture | None:
    # Options such as `-s 1 1 1` stand before the file name; names may hold spaces, so the whole value is tried first.
    for name in (value, value.split()[-1] if value.split() else value):
        path = folder / name.replace("\\", "/")
        if path.is_file():
            texture = texture_from(path.read_bytes(), path.name)
            if texture is None:
                notes.append(f"texture {path.name} is neither PNG nor JPEG and was left out")
            return texture
    notes.append(f"texture {value} is missing and was left out")
    return None


def _floats(value: str, default: tuple[float, ...]) -> tuple[float, ...]:
    try:
        numbers = tuple(float(v) for v in value.split()[: len(default)])
    except ValueError:
        return default
    return numbers if len(numbers) == len(default) else default


def _linear(srgb: float) -> float:
    c = min(max(srgb, 0.0), 1.0)
    return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4
