"""Many oriented boxes at once: what encloses them, how they move, and how deep pairs of them cut into one another.

A solid is here its box alone; `box_frames` states which meshes are boxes.
"""

from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Mat4, Scalars, freeze_arrays
from grafu.shapes import Bool, Float

Rows = Float[np.ndarray, "n 3"]
Rotations = Float[np.ndarray, "n 3 3"]

_CORNER = 1e-6  # fraction of a box's diagonal by which a vertex may miss a corner of its box: float32 inputs
_PARALLEL = 1e-9  # below this length the cross product of two edges gives no direction of its own


@final
@dataclass(frozen=True, eq=False, slots=True)
class BoxStack(ArrayValue):
    """Boxes one below the other: centres and half sizes in metres, axes as the columns of `rotations`."""

    centers: Rows
    halves: Rows
    rotations: Rotations

    def __post_init__(self) -> None:
        freeze_arrays(self, dtype=np.float64)

    def __len__(self) -> int:
        return len(self.centers)

    @classmethod
    def aligned(cls, low: Rows, high: Rows) -> "BoxStack":
        """Returns axis-aligned boxes between these corners."""
        return cls((low + high) / 2, (high - low) / 2, np.broadcast_to(np.eye(3), (len(low), 3, 3)))

    @property
    def reaches(self) -> Rows:
        """Half the sides of the axis-aligned boxes around each box."""
        return np.einsum("nij,nj->ni", np.abs(self.rotations), self.halves)

    def __getitem__(self, rows: np.ndarray | slice) -> "BoxStack":
        return BoxStack(self.centers[rows], self.halves[rows], self.rotations[rows])

    def moved(self, T: Mat4) -> "BoxStack":
        """Returns all boxes moved by one rigid T."""
        return BoxStack(self.centers @ T[:3, :3].T + T[:3, 3], self.halves, T[:3, :3] @ self.rotations)


def stacked(stacks: list[BoxStack]) -> BoxStack:
    """Returns the boxes of several stacks, in order; at least one stack."""
    return BoxStack(
        np.concatenate([s.centers for s in stacks]),
        np.concatenate([s.halves for s in stacks]),
        np.concatenate([s.rotations for s in stacks]),
    )


def overlapping(a: BoxStack, b: BoxStack, depth: float) -> tuple[np.ndarray, np.ndarray]:
    """Returns the rows (of a, of b) of all pairs whose axis-aligned boxes overlap by more than `depth` metres."""
    room = a.reaches[:, None] + b.reaches[None] - np.abs(a.centers[:, None] - b.centers[None])
    rows, others = np.nonzero((room > depth).all(axis=2))
    return rows, others


def penetrations(a: BoxStack, b: BoxStack) -> Scalars:
    """Returns for each pair (row by row) how far one box must be pushed to come free of the other, metres.

    Zero and below: they touch or lie apart. The push is measured along the best of the fifteen separating axes.
    """
    between = b.centers - a.centers
    axes = np.concatenate([a.rotations, b.rotations, _crossed(a.rotations, b.rotations)], axis=2)
    lengths = np.linalg.norm(axes, axis=1)
    usable = lengths > _PARALLEL
    axes = axes / np.where(usable, lengths, 1.0)[:, None]
    reach = _along(a, axes) + _along(b, axes) - np.abs(np.einsum("nik,ni->nk", axes, between))
    return np.where(usable, reach, np.inf).min(axis=1)


def _crossed(a: Rotations, b: Rotations) -> np.ndarray:
    """Returns the nine cross products of two boxes' axes as columns, (n, 3, 9)."""
    first, second = np.repeat(a, 3, axis=2), np.tile(b, (1, 1, 3))
    return np.cross(first, second, axis=1)


def _along(boxes: BoxStack, axes: np.ndarray) -> np.ndarray:
    """Returns how far each box reaches from its centre along each of its row's axes, (n, axes)."""
    return np.einsum("njk,nj->nk", np.abs(np.einsum("nij,nik->njk", boxes.rotations, axes)), boxes.halves)


def box_frames(triangles: Float[np.ndarray, "n 12 3 3"]) -> tuple[Bool[np.ndarray, " n"], BoxStack]:
    """Returns which meshes of twelve triangles are closed boxes, and the boxes around all of them.

    A mesh that is none gets the axis-aligned box around it.

    Args:
        triangles: the corners of twelve triangles for each of n meshes.
    """
    corners = triangles.reshape(len(triangles), 36, 3)
    rotations, is_right = _right_frames(triangles[:, 0])
    local = corners @ rotations
    low, high = local.min(axis=1), local.max(axis=1)
    slack = _CORNER * np.linalg.norm(high - low, axis=1)[:, None, None]
    at_corner = (np.minimum(local - low[:, None], high[:, None] - local) <= slack).all(axis=(1, 2))
    sizes = high - low
    surface = 2 * (sizes * np.roll(sizes, 1, axis=1)).sum(axis=1)
    drawn = _areas(triangles).sum(axis=1)
    middle = np.abs(local.mean(axis=1) - (low + high) / 2).max(axis=1) <= slack[:, 0, 0]  # no side drawn for another
    is_box = is_right & at_corner & middle & (np.abs(drawn - surface) <= 1e-4 * surface) & (sizes.min(axis=1) > 0)
    plain = BoxStack.aligned(corners.min(axis=1), corners.max(axis=1))
    pick = is_box[:, None]
    centers = np.where(pick, np.einsum("nij,nj->ni", rotations, (low + high) / 2), plain.centers)
    return is_box, BoxStack(
        centers, np.where(pick, sizes / 2, plain.halves), np.where(pick[..., None], rotations, plain.rotations)
    )


def _right_frames(triangles: Float[np.ndarray, "n 3 3"]) -> tuple[Rotations, Bool[np.ndarray, " n"]]:
    """Returns right-handed axes along the legs of right-angled triangles, and which triangles have a right angle."""
    sides = np.roll(triangles, -1, axis=1) - triangles
    longest = np.argmax((sides**2).sum(axis=2), axis=1)
    rows = np.arange(len(triangles))
    first, second = sides[rows, (longest + 1) % 3], sides[rows, (longest + 2) % 3]
    lengths = np.linalg.norm(first, axis=1), np.linalg.norm(second, axis=1)
    u, v = (s / np.maximum(n, 1e-300)[:, None] for s, n in zip((first, second), lengths, strict=True))
    is_right = (np.minimum(*lengths) > 0) & (np.abs((u * v).sum(axis=1)) < _CORNER)
    rotations = np.stack([u, v, np.cross(u, v)], axis=2)
    return np.where(is_right[:, None, None], rotations, np.eye(3)), is_right


def _areas(triangles: Float[np.ndarray, "n 12 3 3"]) -> Float[np.ndarray, "n 12"]:
    edges = triangles[:, :, 1:] - triangles[:, :, :1]
    return np.linalg.norm(np.cross(edges[:, :, 0], edges[:, :, 1]), axis=2) / 2
