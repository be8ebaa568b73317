"""A model's shape as a row of numbers, by which copies of it are known.

The numbers are the same for a copy that is moved, scaled, mirrored in X, cut into other triangles, or has its parts and
vertices in another order: they state how much of the surface lies in each cell of a grid on the model's box, and which
way it faces there, and the proportions of the box.
"""

from collections.abc import Iterable, Iterator
from hashlib import blake2b
from itertools import product
from typing import Final, TypeAlias

import numpy as np

from grafu.dataset.config import DescriptorConfig
from grafu.geometry.mesh import TriangleMesh
from grafu.shapes import Float, Int

Triangles: TypeAlias = Float[np.ndarray, "n 3 3"]
Grid: TypeAlias = Float[np.ndarray, "across deep up facing"]
Descriptor: TypeAlias = Float[np.ndarray, " numbers"]
_NEXT_CORNER: Final = np.array([1, 2, 0])


def describe(meshes: Iterable[TriangleMesh], config: DescriptorConfig = DescriptorConfig()) -> Descriptor:
    """Returns the descriptor of what the meshes, in the object frame, are together; zeros where nothing has an area."""
    triangles = np.concatenate([np.zeros((0, 3, 3)), *(m.vertices[m.faces] for m in meshes if len(m.faces))])
    cells = np.zeros((config.cells_across, config.cells_deep, config.cells_up, 3))
    if not len(triangles):
        return _joined(cells, np.zeros(3), config)
    low, high = triangles.min(axis=(0, 1)), triangles.max(axis=(0, 1))
    sides = (high - low) / (float((high - low).max()) or 1.0)
    counted = np.array(cells.shape[:3])
    cell = np.maximum(sides, config.thinnest) / counted
    for some in _in_small_pieces((triangles - low) / (float((high - low).max()) or 1.0) / cell, config):
        _add_areas(cells, some, cell)
    return _joined(cells, sides, config)


def geometric_hash(descriptor: Descriptor, config: DescriptorConfig = DescriptorConfig()) -> str:
    """Returns a word of 16 hexadecimal digits that is the same for models of about the same proportions and spread."""
    numbers = [*descriptor[:3] / config.proportion_weight, *_outline(descriptor, config)]
    steps = np.rint(np.array(numbers) / config.hash_step).astype(np.int32)
    return blake2b(steps.astype("<i4").tobytes(), digest_size=8).hexdigest()


def _outline(descriptor: Descriptor, config: DescriptorConfig) -> Iterator[float]:
    """Yields how much of the surface faces along each axis, and lies in each half of the grid's depth and height."""
    shape = (config.cells_across // 2, config.cells_deep, config.cells_up, 3)
    halves = descriptor[3:].reshape(2, *shape) ** 2  # squares of sums and differences: together the areas
    areas = halves.sum(axis=0)
    yield from areas.sum(axis=(0, 1, 2))
    for axis in (0, 1, 2):
        low, _ = np.array_split(np.moveaxis(areas, axis, 0), 2)
        yield float(low.sum())


def _joined(cells: Grid, proportions: Float[np.ndarray, "3"], config: DescriptorConfig) -> Descriptor:
    """Returns proportions, sums and differences of the halves of the grid: a mirrored copy has the same."""
    total = cells.sum()
    roots = np.sqrt(cells / total) if total > 0 else cells
    here, there = np.split(roots, 2)
    there = there[::-1]
    halves = (here + there) / np.sqrt(2), np.abs(here - there) / np.sqrt(2)
    numbers = np.concatenate([config.proportion_weight * proportions, *(half.ravel() for half in halves)])
    return np.asarray(np.rint(numbers / config.rounding) * config.rounding, dtype=np.float32)


def _in_small_pieces(triangles: Triangles, config: DescriptorConfig) -> Iterator[Triangles]:
    """Yields the triangles, each halved across its longest edge until that is short enough, some at a time."""
    for start in range(0, len(triangles), config.faces_at_once):
        some = triangles[start : start + config.faces_at_once]
        while len(some):
            edges = np.linalg.norm(some[:, _NEXT_CORNER] - some, axis=2)
            is_small = edges.max(axis=1) <= config.longest_edge
            yield some[is_small]
            some = _halved(some[~is_small], edges[~is_small].argmax(axis=1))


def _halved(triangles: Triangles, edge: Int[np.ndarray, " n"]) -> Float[np.ndarray, "twice_n 3 3"]:
    """Returns two triangles for each, parted in the middle of the edge that begins at the corner of this number."""
    rows = np.arange(len(triangles))
    first, second, third = (triangles[rows, (edge + k) % 3] for k in range(3))
    middle = (first + second) / 2
    return np.concatenate([np.stack([first, middle, third], axis=1), np.stack([middle, second, third], axis=1)])


def _add_areas(cells: Grid, triangles: Triangles, cell: Float[np.ndarray, "3"]) -> None:
    """Adds to each cell the area near its middle, by how squarely it faces along each axis; cells blend linearly."""
    if not len(triangles):
        return
    normals = np.cross((triangles[:, 1] - triangles[:, 0]) * cell, (triangles[:, 2] - triangles[:, 0]) * cell) / 2
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    facing = normals**2 / np.maximum(lengths, np.finfo(float).tiny)  # adds up to the area
    counts = np.array(cells.shape[:3])
    place = np.clip(triangles.mean(axis=1) - 0.5, 0, counts - 1)
    first = np.minimum(place.astype(int), np.maximum(counts - 2, 0))
    beyond = place - first
    for corner in product((0, 1), repeat=3):
        weight = np.where(corner, beyond, 1 - beyond).prod(axis=1)
        where = np.ravel_multi_index(tuple(np.minimum(first + np.array(corner), counts - 1).T), tuple(counts))
        for axis in range(3):
            sums = np.bincount(where, facing[:, axis] * weight, counts.prod())
            cells[..., axis] += sums.reshape(tuple(counts))
