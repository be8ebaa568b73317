"""Upright boards as leaves of a folding door: which stand beside one another in one plane, which meet in a corner."""

from functools import cached_property
from typing import final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.joints.fold_config import FoldConfig
from grafu.scene.border import part_axes

UP = vec3(0.0, 0.0, 1.0)
_UP = 2


@final
@dataclass(frozen=True, eq=False)
class Leaf:
    """An upright board; `front` is the unit direction that its broad face looks to when it is closed."""

    part: str
    mesh: TriangleMesh
    front: Vec3

    @property
    def right(self) -> Vec3:
        """The level direction along the board to its right, as seen from before its front."""
        return np.asarray(np.cross(UP, self.front))

    @cached_property
    def width(self) -> float:
        """Its width, metres."""
        low, high = self.span(self.right)
        return high - low

    @cached_property
    def height(self) -> tuple[float, float]:
        """The heights of its lower and its upper end, metres."""
        return self.span(UP)

    @property
    def back(self) -> float:
        """Where its back lies along its front's direction, metres: no handle stands out of it."""
        return self.span(self.front)[0]

    def span(self, direction: Vec3) -> tuple[float, float]:
        """Returns where it begins and ends along a direction, metres."""
        along = self.mesh.vertices @ direction
        return float(along.min()), float(along.max())

    def along(self, edge: Vec3) -> Vec3:
        """Returns the unit direction along its edge on a side: upright beside it, level above and below it."""
        return self.right if abs(float(edge @ UP)) > abs(float(edge @ self.right)) else UP

    def at(self, edge: Vec3, front: float) -> Vec3:
        """Returns the middle of its edge on a side, so far along its front's direction, metres."""
        along = self.along(edge)
        middle = sum(self.span(along)) / 2
        return np.asarray(edge * self.span(edge)[1] + self.front * front + along * middle)

    def across(self, edge: Vec3) -> float:
        """Returns its size from its edge on a side to the opposite one, metres."""
        low, high = self.span(edge)
        return high - low

    def turned(self, front: Vec3) -> "Leaf":
        """Returns the leaf as it looks to the side of its broad faces that is nearer to a direction."""
        return self if float(self.front @ front) >= 0 else Leaf(self.part, self.mesh, -self.front)


def leaf_of(part: Part, whole: Box, config: FoldConfig) -> Leaf | None:
    """Returns an upright board as a leaf that looks away from the middle of the whole; None where it is no such board.

    In the middle it looks to the front.
    """
    if not len(part.mesh.faces):
        return None
    axes = part_axes(part.mesh)
    local = Box.around(part.mesh.vertices @ axes)
    thin = local.thin_axis
    if thin == _UP or local.size[thin] > config.thin * np.delete(local.size, thin).min():
        return None
    normal = np.asarray(axes[:, thin])
    away = float(normal @ (axes @ local.center - whole.center))
    if abs(away) < local.size[thin] / 2:
        away = float(normal @ vec3(0.0, -1.0, 0.0))
    return Leaf(part.id, part.mesh, normal if away >= 0 else -normal)


def is_beside(leaf: Leaf, other: Leaf, side: Vec3, config: FoldConfig) -> bool:
    """Whether another leaf is at a side of a leaf, with a seam between: in one plane, with ends at the same places."""
    if float(leaf.front @ other.front) < 1 - config.askew or not _ends_alike(leaf, other, leaf.along(side), config):
        return False
    step = abs(leaf.back - other.span(leaf.front)[0])
    seam = other.span(side)[0] - leaf.span(side)[1]
    return step <= config.flush and abs(seam) <= config.seam


def is_as_wide(leaf: Leaf, other: Leaf, side: Vec3, config: FoldConfig) -> bool:
    """Whether two leaves that are at a side of one another are about equally wide, or high, from edge to edge."""
    narrow, wide = sorted((leaf.across(side), other.across(side)))
    return narrow >= (1 - config.width) * wide


def in_corner(leaf: Leaf, other: Leaf, asset: Asset, config: FoldConfig) -> tuple[Leaf, Leaf] | None:
    """Returns two leaves at a right angle that meet in an inner corner, as they look into the room; else None.

    In an inner corner nothing stands between them, nor right above and below that place.
    """
    if abs(float(leaf.front @ other.front)) > config.askew or not _ends_alike(leaf, other, UP, config):
        return None
    a, b = (one.turned(_middle(two) - _middle(one)) for one, two in ((leaf, other), (other, leaf)))
    gaps = (_gap(a, b), _gap(b, a))
    if max(abs(gap) for gap in gaps) > config.corner + max(_thickness(leaf), _thickness(other)):
        return None
    return (a, b) if _is_room(a, b, asset, config) else None


def _gap(leaf: Leaf, other: Leaf) -> float:
    """Returns the distance along a leaf from its end by the corner to the other leaf's front, metres."""
    return leaf.span(-other.front)[1] - (-other.span(other.front)[1])


def _is_room(a: Leaf, b: Leaf, asset: Asset, config: FoldConfig) -> bool:
    """Whether nothing stands above or below the middle of the place between two leaves, as far as they reach."""
    middle = _middle(a) + a.front * float((_middle(b) - _middle(a)) @ a.front)
    height = a.height[1] - a.height[0]
    reach = height / 2 + config.beyond * height
    origin = np.array([middle])
    near = [RayCaster(part.mesh) for part in asset.parts if len(part.mesh.faces) and _covers(part.box, middle)]
    return all(float(caster.along(origin, direction).min()) > reach for caster in near for direction in (UP, -UP))


def _covers(box: Box, point: Vec3) -> bool:
    """Whether a point lies within a box's plan."""
    return bool((box.low[:_UP] <= point[:_UP]).all() and (point[:_UP] <= box.high[:_UP]).all())


def _middle(leaf: Leaf) -> Vec3:
    return np.asarray(leaf.mesh.box.center)


def _thickness(leaf: Leaf) -> float:
    low, high = leaf.span(leaf.front)
    return high - low


def _ends_alike(leaf: Leaf, other: Leaf, along: Vec3, config: FoldConfig) -> bool:
    """Whether two leaves begin and end at the same places along a direction."""
    (low, high), (low_other, high_other) = leaf.span(along), other.span(along)
    return max(abs(low - low_other), abs(high - high_other)) <= config.level * max(high - low, high_other - low_other)
