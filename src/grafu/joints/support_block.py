"""Support blocks: prisms that bridge the gap between a piece of hardware and what carries it; which part that is.

A block starts at a rectangle (a snap plane) and is extruded until it meets a surface; rays say how far that is.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Visual, VisualRole
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import Mat3, Points, Vec3
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.geometry.transform import from_rotation
from grafu.joints.config import BlockConfig
from grafu.joints.plan import JointRequest
from grafu.scene.scene import Scene
from grafu.vocabulary import PartLabel

WOOD = Material("support block", base_color=(0.42, 0.31, 0.2, 1.0), roughness=0.85)
METAL = Material("support plate", base_color=(0.55, 0.56, 0.58, 1.0), metallic=1.0, roughness=0.35)

_GRID = 5  # rays per side of the rectangle (official 7.4 casts 5 x 5)


@final
@dataclass(frozen=True, eq=False, slots=True)
class Footing:
    """A rectangle that looks for a surface: centre, the unit direction to look in, half-extent vectors u and v."""

    center: Vec3
    direction: Vec3
    u: Vec3
    v: Vec3

    def grid(self, face: float) -> Points:
        """Returns points spread over a fraction of the rectangle's sides."""
        steps = np.linspace(-face, face, _GRID)
        s, t = (a.ravel()[:, None] for a in np.meshgrid(steps, steps))
        return self.center + s * self.u + t * self.v

    def gap(self, target: RayCaster, reach: float, config: BlockConfig) -> float:
        """Returns the distance after which a fair fraction of the rectangle rests on the target; infinity if none."""
        distances = np.sort(target.along(self.grid(config.face), self.direction))
        distances = distances[distances <= reach]
        if len(distances) < config.rays:
            return float("inf")
        return float(distances[int(config.rest * len(distances))])


def block(name: str, footing: Footing, length: float, config: BlockConfig, material: Material = WOOD) -> Visual:
    """Returns the prism of the footing extruded by `length` metres, inset by a trace at both ends so that it holds."""
    w = footing.direction
    half = np.array([np.linalg.norm(footing.u), np.linalg.norm(footing.v), (length + 2 * config.lap) / 2])
    axes: Mat3 = np.column_stack([footing.u / half[0], footing.v / half[1], w])
    if np.linalg.det(axes) < 0:
        axes = axes[:, [1, 0, 2]]
        half = half[[1, 0, 2]]
    center = footing.center + w * (length / 2)
    mesh = TriangleMesh.box_mesh(Box(-half, half)).transformed(from_rotation(axes, center))
    return Visual(name, (Surface(mesh, material),), VisualRole.HARDWARE, PartLabel.MISC)


def shortest_bridge(
    footings: Iterable[Footing], target: RayCaster, reach: float, config: BlockConfig
) -> tuple[Footing, float] | None:
    """Returns the footing that meets the target over the shortest gap, and that gap; None where none does."""
    found = [(footing, footing.gap(target, reach, config)) for footing in footings]
    reached = [(footing, gap) for footing, gap in found if np.isfinite(gap)]
    return min(reached, key=lambda pair: pair[1], default=None)


def nearest_part(hardware: Visual, scene: Scene, request: JointRequest, config: BlockConfig) -> str:
    """Returns the id of the static part that hardware sits on, "" where none is near; a wanted mount wins a draw."""
    collider = MeshCollider(hardware.mesh)
    held_by = scene.static_obstacles_of(request.holders)
    near = [o for o in held_by if o.collider.box.overlaps(collider.box, config.near * scene.extent)]
    ranked = sorted((round(collider.distance(o.collider), 4), o.id not in request.mounts, o.id) for o in near)
    return ranked[0][2] if ranked else ""
