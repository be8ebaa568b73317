"""3DS files of the small cabinet, written by our own code: colours, opacity, an image, a hidden object."""

import struct
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from small_assets import AS_IT_IS, CABINET, mesh_of

OAK, GLASS = (153, 102, 51), (255, 255, 255)


def chunk(kind: int, *content: bytes) -> bytes:
    data = b"".join(content)
    return struct.pack("<HI", kind, 6 + len(data)) + data


def text(name: str) -> bytes:
    return name.encode("latin-1") + b"\0"


def table(rows: np.ndarray, dtype: str) -> bytes:
    return struct.pack("<H", len(rows)) + rows.astype(dtype).tobytes()


def material(name: str, colour: tuple[int, int, int], transparent: int = 0, image: str = "") -> bytes:
    held = [chunk(0xA000, text(name)), chunk(0xA020, chunk(0x0011, bytes(colour)))]
    held += [chunk(0xA050, chunk(0x0030, struct.pack("<H", transparent)))] if transparent else []
    held += [chunk(0xA200, chunk(0xA300, text(image)))] if image else []
    return chunk(0xAFFF, *held)


def threed_object(name: str, matrix: np.ndarray, look: str, hidden: bool = False) -> bytes:
    mesh = mesh_of(name)
    faces = np.column_stack([mesh.faces, np.zeros(len(mesh.faces), int)])
    looks = chunk(0x4130, text(look), table(np.arange(len(faces)), "<u2"))
    uv = chunk(0x4140, table(np.tile([[0.0, 0.0], [1.0, 1.0]], (4, 1)), "<f4"))
    points = chunk(0x4110, table(mesh.vertices @ matrix.T, "<f4"))
    held = chunk(0x4100, points, uv, chunk(0x4120, table(faces, "<u2"), looks))
    return chunk(0x4000, text(name), *([chunk(0x4010)] if hidden else []), held)


def threeds_bytes(
    matrix: np.ndarray = AS_IT_IS, looks: Mapping[str, str] | None = None, hidden: str = "", image: str = ""
) -> bytes:
    """Returns the file; `looks` gives parts another material than `oak`, by name."""
    materials = (material("oak", OAK), material("glass", GLASS, 75), material("pictured", OAK, image=image))
    objects = (threed_object(n, matrix, (looks or {}).get(n, "oak"), n == hidden) for n in CABINET)
    version = chunk(0x0002, struct.pack("<I", 3))
    return chunk(0x4D4D, version, chunk(0x3D3D, *materials, *objects))


def write_threeds(folder: Path, data: bytes | None = None) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "cabinet.3ds"
    path.write_bytes(threeds_bytes() if data is None else data)
    return path
