"""What lies inside a lasso that is drawn over a part as it is seen; faces are cut along it. It reads no files.

The lasso and the eye span a cone of planes. A face that the lasso crosses is cut by the plane of each side that it
crosses; each piece is inside or outside by its middle.
"""

from typing import final

import numpy as np
import shapely

from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface, attribute_rows, from_attributes
from grafu.geometry.arrays import Points, Scalars, Vec3
from grafu.geometry.config_checks import require_positive
from grafu.geometry.face_cuts import NOTHING, split_by_planes
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.shapes import Bool, Float

Corner = tuple[float, float, float]
Triangles = Float[np.ndarray, "n 3 k"]  # rows of corner attributes, of which the first three are the position
MOST_CORNERS = 500
_NO_AREA = 1e-10  # of a lasso as it is seen, in the plane at distance 1: a line that rounding makes wide


@final
@dataclass(frozen=True, slots=True)
class Lasso:
    """A closed line around what is seen from `eye`: its corners in the object frame, metres.

    With `through`, all that lies inside is meant, however far behind; else what is seen and a little behind it.

    Raises:
        ValueError: if there are fewer than three corners or too many, a number is not finite, or the lasso crosses
            itself or encloses nothing as it is seen from the eye.
    """

    eye: Corner
    corners: tuple[Corner, ...]
    through: bool = False

    def __post_init__(self) -> None:
        if not 3 <= len(self.corners) <= MOST_CORNERS:
            raise ValueError(f"a lasso must have 3 to {MOST_CORNERS} corners: got {len(self.corners)}")
        if not np.isfinite(np.array([self.eye, *self.corners])).all():
            raise ValueError("the corners of a lasso must be finite numbers")
        view = _View.of(self)
        if view is None or not view.outline.is_valid or view.outline.area <= _NO_AREA:
            raise ValueError("a lasso must enclose something before the eye and must not cross itself")


@final
@dataclass(frozen=True)
class LassoConfig:
    """How deep a lasso cuts; fractions of the model's largest side.

    Raises:
        ValueError: if a number is not above 0.
    """

    depth: float = 0.06
    """What lies no farther than this behind what is seen belongs to it, as the back of a front does ..."""
    metres: float = 0.05
    """... and no farther than this (metres)."""

    def __post_init__(self) -> None:
        require_positive(self, "depth", "metres")


@final
@dataclass(frozen=True)
class _View:
    """What the eye sees: right, up and forward as rows, and the lasso in the plane at distance 1."""

    eye: Vec3
    axes: Float[np.ndarray, "3 3"]
    outline: shapely.Polygon

    @classmethod
    def of(cls, lasso: Lasso) -> "_View | None":
        """Returns the view of a lasso; None where a corner is not before the eye."""
        eye, corners = np.array(lasso.eye), np.array(lasso.corners)
        forward = corners.mean(axis=0) - eye
        length = float(np.linalg.norm(forward))
        if length <= 0:
            return None
        forward = forward / length
        aside = np.cross(forward, [0.0, 0.0, 1.0] if abs(forward[2]) < 0.9 else [0.0, 1.0, 0.0])
        right = aside / np.linalg.norm(aside)
        axes = np.stack([right, np.cross(right, forward), forward])
        seen = (corners - eye) @ axes.T
        return cls(eye, axes, shapely.Polygon(seen[:, :2] / seen[:, 2:])) if (seen[:, 2] > 0).all() else None

    def seen(self, points: Points) -> tuple[Float[np.ndarray, "n 2"], Bool[np.ndarray, " n"]]:
        """Returns points in the plane at distance 1, and which lie before the eye."""
        local = (points - self.eye) @ self.axes.T
        before = local[:, 2] > NOTHING
        return local[:, :2] / np.where(before, local[:, 2], 1.0)[:, None], before

    def may_meet(self, triangles: Float[np.ndarray, "n 3 3"]) -> Bool[np.ndarray, " n"]:
        """Whether triangles may share a point with what the lasso encloses: by their boxes, as they are seen."""
        flat, before = self.seen(triangles.reshape(-1, 3))
        flat, before = flat.reshape(-1, 3, 2), before.reshape(-1, 3)
        low, high = np.array(self.outline.bounds).reshape(2, 2)
        meets = ((flat.min(axis=1) <= high) & (flat.max(axis=1) >= low)).all(axis=1)
        return (meets & before.any(axis=1)) | (before.any(axis=1) & ~before.all(axis=1))

    def encloses(self, points: Points) -> Bool[np.ndarray, " n"]:
        """Whether points lie inside the lasso, as they are seen."""
        flat, before = self.seen(points)
        return before & shapely.contains_xy(self.outline, flat[:, 0], flat[:, 1])

    def sides(self) -> Float[np.ndarray, "n 2 2"]:
        """Returns both ends of each side of the lasso, in the plane at distance 1; corners that repeat have none."""
        ring = np.array(self.outline.exterior.coords)
        sides = np.stack([ring[:-1], ring[1:]], axis=1)
        return sides[np.abs(sides[:, 1] - sides[:, 0]).max(axis=1) > NOTHING]


def inside_lasso(
    surfaces: tuple[Surface, ...], lasso: Lasso, extent: float, config: LassoConfig = LassoConfig()
) -> tuple[tuple[Surface, ...], tuple[Surface, ...]]:
    """Returns what of the surfaces of a part lies inside a lasso, and what is left of them; `extent` is in metres."""
    view = _View.of(lasso)
    assert view is not None  # a lasso checks itself
    cut = [_cut(surface, view) for surface in surfaces]
    deep = np.inf if lasso.through else min(config.metres, config.depth * extent)
    whole = RayCaster(merge_meshes([surface.mesh for surface in surfaces]))
    chosen = [_chosen(rows[:, :, :3].mean(axis=1), view, whole, deep) for rows in cut]
    taken = (_surface(s, rows[mask]) for s, rows, mask in zip(surfaces, cut, chosen, strict=True) if mask.any())
    left = (
        s if not mask.any() else _surface(s, rows[~mask])
        for s, rows, mask in zip(surfaces, cut, chosen, strict=True)
        if not mask.all()
    )
    return tuple(taken), tuple(left)


def _chosen(middles: Points, view: _View, whole: RayCaster, deep: float) -> Bool[np.ndarray, " n"]:
    """Returns which faces, by their middles, lie inside the lasso and not too far behind what is seen there."""
    inside = view.encloses(middles)
    if np.isinf(deep) or not inside.any():
        return inside
    away = middles[inside] - view.eye
    distance = np.linalg.norm(away, axis=1)
    first: Scalars = whole.distances(np.broadcast_to(view.eye, away.shape).copy(), away / distance[:, None])
    inside[inside] = distance <= np.where(np.isfinite(first), first, distance) + deep
    return inside


def _cut(surface: Surface, view: _View) -> Triangles:
    """Returns the triangles of a surface, those that the lasso crosses cut along its sides."""
    rows = attribute_rows(surface)[surface.mesh.faces]
    near = view.may_meet(rows[:, :, :3])
    triangles = rows[near]
    for start, end in view.sides():
        towards = (np.array([*point, 1.0]) @ view.axes for point in (start, end))
        normal = np.cross(*towards)
        normal /= np.linalg.norm(normal)
        offset = float(normal @ view.eye)
        crossed = _crosses(triangles, view, (start, end), normal, offset)
        if crossed.any():
            found = triangles[crossed]
            plane = np.tile([*normal, offset], (len(found), 1))
            inner, _, outer, _ = split_by_planes(found, np.zeros(len(found), np.int64), plane)
            triangles = np.concatenate([triangles[~crossed], inner, outer])
    return np.concatenate([rows[~near], triangles])


def _surface(like: Surface, triangles: Triangles) -> Surface:
    """Returns triangles as a surface that has the attributes of another one."""
    rows, index = np.unique(triangles.reshape(-1, triangles.shape[2]), axis=0, return_inverse=True)
    return from_attributes(like, rows, index.reshape(-1, 3))


def _crosses(
    triangles: Triangles, view: _View, side: tuple[np.ndarray, np.ndarray], normal: Vec3, offset: float
) -> Bool[np.ndarray, " n"]:
    """Returns which triangles lie on both sides of a plane and, as they are seen, near that side of the lasso."""
    height = triangles[:, :, :3] @ normal - offset
    both = (height.min(axis=1) < -NOTHING) & (height.max(axis=1) > NOTHING)
    if not both.any():
        return both
    flat, before = view.seen(triangles[both][:, :, :3].reshape(-1, 3))
    flat, before = flat.reshape(-1, 3, 2), before.reshape(-1, 3)
    low, high = np.minimum(*side), np.maximum(*side)
    near = ((flat.min(axis=1) <= high) & (flat.max(axis=1) >= low)).all(axis=1)
    both[both] = near | ~before.all(axis=1)
    return both
