"""Surfaces in few bytes, each corner stored once.

A vertex is 8 bytes: three unsigned 16-bit fractions of the mesh's box and a normal as two signed bytes (octahedral).
"""

from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.export.shading import corner_normals
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Points, extremes, first_of_each

_STEPS = 65535  # of 16 bits
_NORMAL_STEPS = 127  # of a signed byte


@final
@dataclass(frozen=True)
class PackedMesh:
    """The bytes of one mesh: `vertices` (8 bytes each), `indices` (16 or 32 bits each), `uv` and `colors` (4 bytes).

    Two surfaces that are the same but for their place and size are equal here.
    """

    vertices: bytes
    indices: bytes
    wide: bool
    uv: bytes = b""
    colors: bytes = b""

    @property
    def count(self) -> int:
        """The number of indices."""
        return len(self.indices) // (4 if self.wide else 2)


@final
@dataclass(frozen=True)
class PackedSurface:
    """A packed mesh and where it lies: low corner and size of its box, metres, and of its texture coordinates."""

    mesh: PackedMesh
    low: tuple[float, float, float]
    size: tuple[float, float, float]
    uv_low: tuple[float, float] = (0.0, 0.0)
    uv_size: tuple[float, float] = (1.0, 1.0)


def pack_surface(surface: Surface, textured: bool) -> PackedSurface:
    """Returns a surface that has faces, packed; texture coordinates (origin top left) only where `textured`."""
    faces, shading = surface.mesh.faces, corner_normals(surface)
    used = surface.mesh.vertices[faces.ravel()]
    low, high = extremes(used)
    size = high - low
    vertices = np.zeros((len(used), 4), np.uint16)
    vertices[:, :3] = _ratios(used, low, size)
    vertices[:, 3] = _octahedral(np.asarray(shading.normals)).view(np.uint16)[:, 0][shading.corners.ravel()]
    keys = [vertices.view(np.uint64)[:, 0]]
    uv, uv_low, uv_size = np.zeros((0, 2), np.uint16), np.zeros(2), np.ones(2)
    if textured and surface.uv is not None:
        flipped = np.nan_to_num(surface.uv, posinf=0.0, neginf=0.0)[faces.ravel()] * [1.0, -1.0] + [0.0, 1.0]
        flipped = flipped - np.floor(extremes(flipped)[0])  # textures repeat: whole turns change nothing
        uv_low, uv_high = extremes(flipped)
        uv_size = uv_high - uv_low
        uv = _ratios(flipped, uv_low, uv_size)
        keys.append(uv.view(np.uint32)[:, 0].astype(np.uint64))
    colors = np.zeros((0, 4), np.uint8) if surface.colors is None else surface.colors[faces.ravel()]
    if len(colors):
        keys.append(np.ascontiguousarray(colors).view(np.uint32)[:, 0].astype(np.uint64))
    first, index = _distinct(keys)
    indices = _whole_triangles(index)
    wide = len(first) > _STEPS
    mesh = PackedMesh(
        vertices[first].tobytes(),
        indices.astype(np.uint32 if wide else np.uint16).tobytes(),
        wide,
        uv[first].tobytes() if len(uv) else b"",
        colors[first].tobytes() if len(colors) else b"",
    )
    (x, y, z), (dx, dy, dz) = low.tolist(), size.tolist()
    (u, v), (du, dv) = uv_low.tolist(), uv_size.tolist()
    return PackedSurface(mesh, (x, y, z), (dx, dy, dz), (u, v), (du, dv))


def _ratios(values: np.ndarray, low: np.ndarray, size: np.ndarray) -> np.ndarray:
    """Returns where values lie between low and low + size, as 16-bit fractions."""
    return np.rint((values - low) / np.where(size > 0, size, 1.0) * _STEPS).astype(np.uint16)


def _octahedral(normals: Points) -> np.ndarray:
    """Returns unit vectors as two signed bytes: folded onto an octahedron, and that onto a square."""
    flat = normals / np.abs(normals).sum(axis=1, keepdims=True)
    sides = np.where(flat[:, :2] >= 0, 1.0, -1.0)
    folded = (1 - np.abs(flat[:, 1::-1])) * sides
    square = np.where(flat[:, 2:] < 0, folded, flat[:, :2])
    return np.ascontiguousarray(np.rint(square * _NORMAL_STEPS).astype(np.int8))


def _distinct(keys: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Returns the first row of each distinct combination of keys, in the order of appearance, and each row's number."""
    combined = keys[0]
    for key in keys[1:]:
        _, left = np.unique(combined, return_inverse=True)
        values, right = np.unique(key, return_inverse=True)
        combined = left * len(values) + right
    first, index = first_of_each(combined)
    order = np.argsort(first)  # neighbours in use are neighbours in memory: it packs better
    number = np.empty_like(order)
    number[order] = np.arange(len(order))
    return first[order], number[index]


def _whole_triangles(index: np.ndarray) -> np.ndarray:
    """Returns the corners of those triangles that still have three corners."""
    t = index.reshape(-1, 3)
    whole = (t[:, 0] != t[:, 1]) & (t[:, 1] != t[:, 2]) & (t[:, 2] != t[:, 0])
    return np.ascontiguousarray(t[whole]).ravel()
