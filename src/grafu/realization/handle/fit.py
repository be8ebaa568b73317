"""Sets a handle on a front: its foot flush with the real surface, as rays find it. It knows no neighbours.

A foot lies on wood or metal, never on a pane, and where the surface is bowed or slants it leans with it.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import final

import numpy as np

from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Mat4, Points
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.geometry.transform import from_rotation
from grafu.realization.handle.relief import Relief
from grafu.realization.handle.spots import Spot
from grafu.realization.scene import Scene

_FOOT = 0.0006  # metres from the foot plane within which vertices belong to a foot
_UNEVEN = 0.0008  # metres by which the surface under a foot may differ from a plane
_PANE = 0.95  # of a colour's alpha: what is clearer is glass
_LEAN = 0.35  # slope of the surface, about 20 degrees: on steeper places no handle is set
_TRUST = 1e-4  # metres: where two casts see the same surface
_MOST_FEET = 400  # points under a foot that are looked at


@final
@dataclass(frozen=True, eq=False)
class Ground:
    """The relief of a front, and what of it can carry a handle."""

    relief: Relief
    solid: RayCaster

    def depths(self, points: Points) -> Points:
        """Returns points, (u, any, v), moved onto the front's first surface; NaN where that is a pane or nothing."""
        lead = points.copy()
        lead[:, 1] = -0.05 * self.relief.factor
        origins, inwards = self.relief.front.to_object(lead), self.relief.front.inwards
        seen, solid = self.relief.moving.along(origins, inwards), self.solid.along(origins, inwards)
        good = np.isfinite(seen) & (solid <= seen + _TRUST)
        found = lead.copy()
        found[:, 1] = np.where(good, lead[:, 1] + np.where(good, seen, 0.0), np.nan)
        return found


def ground_of(scene: Scene, moving_id: str, relief: Relief) -> Ground:
    """Returns the ground for handles on a moving body."""
    members = [scene.parts[m] for m in scene.moving_bodies[moving_id].members]
    solid = [s for p in members for s in p.surfaces if not _is_pane(s)]
    clear = any(_is_pane(s) for p in members for s in p.surfaces)
    return Ground(relief, RayCaster(merge_meshes([s.mesh for s in solid])) if clear else relief.moving)


def _is_pane(surface: Surface) -> bool:
    material = surface.material
    return material.base_color[3] < _PANE or material.alpha_mode == "BLEND"


@final
@dataclass(frozen=True, eq=False)
class Shape:
    """A handle at one size in its own frame, see `grafu.templates.template`."""

    meshes: tuple[TriangleMesh, ...]

    @cached_property
    def mesh(self) -> TriangleMesh:
        """All meshes as one."""
        return merge_meshes(self.meshes)

    @cached_property
    def foot(self) -> Points:
        """Points of the foot plane under the handle's feet."""
        points = self.mesh.vertices
        near = points[points[:, 1] > -_FOOT]
        near = near if len(near) else points[points[:, 1] >= points[:, 1].max() - 1e-9]
        return near[:: max(len(near) // _MOST_FEET, 1)] * (1.0, 0.0, 1.0)


def fitted(ground: Ground, shape: Shape, spot: Spot, place: tuple[float, float]) -> Mat4 | None:
    """Returns the pose, in the object frame, in which a handle sits flush at a place; None: there it cannot sit."""
    u, v = place
    feet = shape.foot @ spot.turn.T
    on = ground.depths(feet + np.array([u, 0.0, v]))
    if not np.isfinite(on).all():
        return None
    across = feet[:, [0, 2]]
    slope, level = _plane_through(across, on[:, 1])
    off = on[:, 1] - level - across @ slope
    if np.ptp(off) > _UNEVEN * max(ground.relief.factor, 1e-9) or float(np.linalg.norm(slope)) > _LEAN:
        return None
    lean = _leaning(slope)
    T = from_rotation(lean @ spot.turn, np.array([u, level + float(off.min()), v]))
    front = ground.relief.front
    return from_rotation(front.rotation, front.origin) @ T


def _plane_through(across: np.ndarray, depth: np.ndarray) -> tuple[np.ndarray, float]:
    """Returns the slopes along u and v, and the depth in the middle, of the plane nearest to some depths."""
    if np.ptp(depth) < 1e-6:
        return np.zeros(2), float(depth.mean())
    rows = np.column_stack([across, np.ones(len(across))])
    found = np.linalg.lstsq(rows, depth, rcond=1e-6)[0]
    return found[:2], float(found[2])


def _leaning(slope: np.ndarray) -> np.ndarray:
    """Returns the rotation of (u, b, v) that lays a level foot on a surface with these slopes."""
    if not slope.any():
        return np.eye(3)
    x = np.array([1.0, slope[0], 0.0])
    x /= np.linalg.norm(x)
    y = np.array([-slope[0], 1.0, -slope[1]])
    y /= np.linalg.norm(y)
    return np.column_stack([x, y, np.cross(x, y)])
