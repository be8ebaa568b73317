"""Support blocks: prisms that bridge the gap between a piece of hardware and what carries it; which part that is.

A block starts at a rectangle (a snap plane) and is extruded until it meets a surface; rays say how far that is, and
how much of a leaf lies on one.
"""

from collections.abc import Iterable, Sequence
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Visual, VisualRole
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import Mat3, Points, Vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.geometry.transform import from_rotation
from grafu.joints.config import BlockConfig
from grafu.joints.hinge_config import FootingConfig
from grafu.joints.plan import JointRequest
from grafu.scene.scene import Scene
from grafu.shapes import Float
from grafu.templates.template import HingeSize, SnapPlane
from grafu.vocabulary import PartLabel

WOOD = Material("support block", base_color=(0.42, 0.31, 0.2, 1.0), roughness=0.85)
METAL = Material("support plate", base_color=(0.55, 0.56, 0.58, 1.0), metallic=1.0, roughness=0.35)

_GRID = 5  # rays per side of the rectangle (the authors cast 5 x 5)
_STEPS = np.linspace(-1.0, 1.0, _GRID)
_ACROSS = np.array([(s, t) for t in _STEPS for s in _STEPS])
_ON_LEAF = 10  # rays per side of a leaf


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
        s, t = face * _ACROSS[:, :1], face * _ACROSS[:, 1:]
        return np.asarray(self.center + s * self.u + t * self.v)

    def gap(self, target: RayCaster, reach: float, config: BlockConfig) -> float:
        """Returns the distance after which a fair fraction of the rectangle rests on the target; infinity if none."""
        return gaps([self], target, reach, config)[0]


def gaps(footings: Sequence[Footing], target: RayCaster, reach: float, config: BlockConfig) -> list[float]:
    """Returns the gap of each of several rectangles, see `Footing.gap`."""
    if not footings:
        return []
    points = np.concatenate([footing.grid(config.face) for footing in footings])
    directions = np.repeat([footing.direction for footing in footings], len(_ACROSS), axis=0)
    distances = np.sort(target.distances(points, directions).reshape(len(footings), -1), axis=1)
    reached = (distances <= reach).sum(axis=1)
    return [
        float(row[int(config.rest * count)]) if count >= config.rays else float("inf")
        for row, count in zip(distances, reached.tolist(), strict=True)
    ]


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
    tried = list(footings)
    found = zip(tried, gaps(tried, target, reach, config), strict=True)
    reached = [(footing, gap) for footing, gap in found if np.isfinite(gap)]
    return min(reached, key=lambda pair: pair[1], default=None)


def resting_width(snap: SnapPlane, pin: Axis, size: HingeSize, target: RayCaster, config: FootingConfig) -> float:
    """Returns the widest leaf, measured from the pin, of which enough lies on one plane of its part; 0: none.

    Leaves are let into what stands before that plane by their thickness, and no deeper. The snap plane may lie
    anywhere on its leaf, with its extents in either order and sense.
    """
    play = config.resting
    steps = (np.arange(_ON_LEAF) + 0.5) / _ON_LEAF
    start = _on_leaf(snap, pin, size, steps) - (size.thickness + play) * snap.normal
    distances = target.along(start, snap.normal).reshape(_ON_LEAF, _ON_LEAF)
    near = distances[distances <= size.thickness + play + config.thickest]
    if not len(near):
        return 0.0
    plane = max(float(np.quantile(near, config.first)), size.thickness + play)
    rests = (distances <= plane + play).mean(axis=1)
    enough = np.flatnonzero(np.cumsum(rests) >= config.rests * np.arange(1, _ON_LEAF + 1))
    if not len(enough):
        return 0.0
    last = int(enough[-1]) + 1
    return size.leaf if last == _ON_LEAF else size.radius + last / _ON_LEAF * (size.leaf - size.radius)


def _on_leaf(snap: SnapPlane, pin: Axis, size: HingeSize, steps: Float[np.ndarray, " k"]) -> Points:
    """Returns points of the plane of a leaf, the nearest to the pin first; `steps` are fractions along each side."""
    away = snap.center - pin.point
    below_pin = pin.point + (away @ snap.normal) * snap.normal + (away @ pin.direction) * pin.direction
    outwards = np.cross(pin.direction, snap.normal)
    outwards *= np.copysign(1.0, outwards @ away)
    across = size.radius + steps * (size.leaf - size.radius)
    x, z = (side.ravel()[:, None] for side in np.meshgrid(across, (steps - 0.5) * size.length, indexing="ij"))
    return np.asarray(below_pin + x * outwards + z * pin.direction)


def nearest_part(hardware: Visual, scene: Scene, request: JointRequest, config: BlockConfig) -> str:
    """Returns the id of the static part that hardware sits on, "" where none is near; a wanted mount wins a draw."""
    collider = MeshCollider(hardware.mesh)
    held_by = scene.static_obstacles_of(request.holders)
    near = held_by.near(collider.box, config.near)
    best = (float("inf"), True, "")
    for least, other in sorted((collider.box_gap(o.collider), k) for k, o in enumerate(near)):
        if round(least, 4) > best[0]:  # no nearer than its box
            break
        found = near[other]
        best = min(best, (round(collider.distance(found.collider), 4), found.id not in request.mounts, found.id))
    return best[2]
