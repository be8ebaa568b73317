"""One shelf or divider cut to a compartment: its edges lie where rays meet the walls.

A panel is a prism. Its ends follow walls that are straight, also where they run askew; other walls carry no panel.

Whether a panel stands free: at rest of all parts and hardware, and of everything that moves along its whole path.
"""

from dataclasses import replace
from functools import cached_property
from typing import final

import numpy as np

from grafu.additions.interior.compartments import Compartment
from grafu.additions.interior.config import InteriorConfig, Sizes
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Points, Scalars, Vec3
from grafu.geometry.box import Box
from grafu.geometry.free_space import SomePoints
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.geometry.swept_body import SweptBody
from grafu.joints.limits import in_the_way, opening_values, swept_box
from grafu.refusal import Reason, Refusal
from grafu.scene.border import part_axes
from grafu.scene.obstacles import Obstacle
from grafu.scene.scene import Scene
from grafu.vocabulary import PartLabel

RAYS_ALONG_EDGE = 16
"""Rays along an edge of a panel."""
EDGE_MARGIN = 0.02
"""Fraction of an edge at either end in which no ray lies."""
EDGE_LEVELS = (-0.98, 0.0, 0.98)
"""Levels at which a panel's edges are looked for, as fractions of half its thickness."""

ALIKE = 0.9
"""Fraction of the smaller box's sides by which two panels overlap that stand in one place."""
CORNERS = 8
"""Of a panel that four edges bound."""
FLAT = 1e-6
"""Fraction of a panel's thickness by which its corners may lie off its faces."""


@final
class Clearing:
    """A scene prepared for trying panels in it; not a value."""

    def __init__(self, scene: Scene, depth: float, poses: int) -> None:
        self._scene = scene
        self._depth = depth
        self._poses = poses
        self._panels: list[tuple[Obstacle, bool]] = []

    def add(self, name: str, mesh: TriangleMesh) -> None:
        """Makes a panel stand in the way of those that follow."""
        self._panels.append((Obstacle(name, MeshCollider(mesh)), _is_plain(mesh)))

    def blocker(self, mesh: TriangleMesh) -> str:
        """Returns the id of something that a panel would cut into or stop along its path; empty: it stands free."""
        is_plain = _is_plain(mesh)
        for other, is_other_plain in self._panels:  # alike and in one place, two would not cut each other's surface
            gaps = mesh.box.axis_gaps(other.collider.box)
            least = np.minimum(mesh.box.size, other.collider.box.size)
            deepest = self._depth if is_plain and is_other_plain else ALIKE * least
            if (gaps < -deepest).all():
                return other.id
        body = SweptBody(mesh, self._depth)
        body.place(np.eye(4))
        others = [*(panel for panel, _ in self._panels), *self._at_rest]
        near = [*in_the_way(self._scene.still_obstacles, mesh.box), *in_the_way(others, mesh.box)]
        met = body.penetrated([obstacle.collider for obstacle in near])
        if met:
            return near[met[0]].id
        panel = MeshCollider(mesh)
        return next((moving for moving in self._scene.joint_motions if self._stops(panel, body, moving)), "")

    @cached_property
    def _at_rest(self) -> list[Obstacle]:
        return [obstacle for moving in self._scene.moving_bodies for obstacle in self._scene.body_obstacles(moving)]

    def _stops(self, panel: MeshCollider, body: SweptBody, moving: str) -> bool:
        """Whether a panel stands in the way of a moving body or of the hardware that it carries."""
        joint_motion = self._scene.joint_motions[moving]
        motion = joint_motion.kind.along(joint_motion.axis)
        values = opening_values(joint_motion.upper, self._poses)
        mesh = self._scene.moving_mesh(moving)
        if swept_box(mesh.box, motion, joint_motion.upper).overlaps(panel.box):
            swept = self._scene.swept_body(moving, self._depth, part_axes(self._scene.parts[moving].mesh))
            for value in values:
                swept.place(motion(value))
                if swept.penetrates(panel):
                    return True
        for visual in self._scene.hardware_of(moving):
            if not swept_box(visual.mesh.box, motion, joint_motion.upper).overlaps(panel.box):
                continue
            collider = MeshCollider(visual.mesh)
            for value in values:
                collider.place(motion(value))
                if body.penetrates(collider):
                    return True
        return False


def _is_plain(mesh: TriangleMesh) -> bool:
    """Whether a panel has two level faces of four corners: what its box holds is the panel."""
    across = mesh.vertices[:, int(np.argmin(mesh.box.size))]
    low, high = float(across.min()), float(across.max())
    ends = np.minimum(across - low, high - across)
    return len(mesh.vertices) == CORNERS and bool((ends < FLAT * (high - low)).all())


def clearing_of(scene: Scene, config: InteriorConfig) -> Clearing:
    """Returns the scene prepared for panels."""
    return Clearing(scene, config.depth * scene.extent, config.poses)


@final
@dataclass(frozen=True)
class PanelPlace:
    """Where a panel is to be.

    `at` is its middle along the axis that panels are stacked on, `inset` how far its front edge stands back from the
    opening, metres. A shelf's front edge lies lower by `angle` radians, its middle at `at`.
    """

    compartment: Compartment
    label: PartLabel
    at: float
    inset: float
    angle: float = 0.0

    @property
    def stack(self) -> int:
        """The axis across the panel."""
        return 2 if self.label is PartLabel.SHELF else self.compartment.side_axis

    @property
    def reach(self) -> int:
        """The axis along which the panel spans from wall to wall."""
        return 3 - self.stack - self.compartment.depth_axis


@final
@dataclass(frozen=True, eq=False)
class WallRays:
    """The meshes that panels may rest on, prepared for rays; not a value."""

    casters: tuple[RayCaster, ...]

    def along(self, origins: Points, direction: Vec3) -> Scalars:
        """Returns the distances of many origins along one unit direction to the first face hit; infinity: none."""
        nearest = [caster.along(origins, direction) for caster in self.casters]
        return np.minimum.reduce(nearest)

    def and_also(self, mesh: TriangleMesh) -> "WallRays":
        """Returns these walls and one more mesh."""
        return WallRays((*self.casters, RayCaster(mesh)))


def cut_panel(place: PanelPlace, walls: WallRays, sizes: Sizes, config: InteriorConfig) -> TriangleMesh | Refusal:
    """Returns a panel that touches the walls at both ends, or why there is none. `walls` are the still meshes."""
    box, depth = place.compartment.box, place.compartment.depth_axis
    inward = -1.0 if place.compartment.opening % 2 else 1.0
    front = float(box.high[depth] if inward < 0 else box.low[depth]) + inward * place.inset
    back = _back(place, walls, sizes, config, inward)
    if inward * (back - front) < sizes.least_side / 2:
        return Refusal("", Reason.NO_ROOM, "it is too shallow")
    margin = EDGE_MARGIN * abs(back - front)
    along = np.linspace(front + inward * margin, back - inward * margin, RAYS_ALONG_EDGE)
    ends = []
    for sense in (-1.0, 1.0):
        found = _distances(place, walls, sizes, config, along, sense)
        edge = _edge(along, found, sizes, config)
        if edge is None:
            if np.isfinite(found).any():
                return Refusal("", Reason.UNEVEN, "its walls are open or uneven there")
            return Refusal("", Reason.NO_SUPPORT, "it has no wall to rest on")
        middle = float(box.center[place.reach])
        at_front, at_back = (middle + sense * float(np.polyval(edge, end)) for end in (front, back))
        ends.append((at_front, at_back))
    return _prism(place, sizes.thickness, (front, back), ends[0], ends[1])


def _back(place: PanelPlace, walls: WallRays, sizes: Sizes, config: InteriorConfig, inward: float) -> float:
    """Returns where a panel ends at the back: at the wall, else at the compartment's end."""
    box, depth = place.compartment.box, place.compartment.depth_axis
    end = float(box.low[depth] if inward < 0 else box.high[depth])
    span = 1 - 2 * EDGE_MARGIN
    across = box.center[place.reach] + box.half[place.reach] * np.linspace(-span, span, RAYS_ALONG_EDGE)
    origins = _origins(place, sizes.thickness, place.reach, across)
    direction = np.zeros(3)
    direction[depth] = inward
    found = walls.along(origins, direction)
    hit = found <= abs(end - origins[0, depth]) + config.askew_cells * sizes.cell
    if hit.mean() < config.back_ratio:
        return end
    return float(origins[0, depth] + inward * found[hit].min())


def _distances(
    place: PanelPlace, walls: WallRays, sizes: Sizes, config: InteriorConfig, along: Scalars, sense: float
) -> Scalars:
    """Returns how far the wall is from the compartment's middle along a panel's end; infinity where there is none."""
    origins = _origins(place, sizes.thickness, place.compartment.depth_axis, along)
    direction = np.zeros(3)
    direction[place.reach] = sense
    found = walls.along(origins, direction).reshape(len(along), len(EDGE_LEVELS)).min(axis=1)
    limit = place.compartment.box.half[place.reach] + config.askew_cells * sizes.cell
    return np.where(found <= limit, found, np.inf)


def _origins(place: PanelPlace, thickness: float, axis: int, values: Scalars) -> SomePoints:
    """Returns points in the middle of a compartment at a panel's levels, spread over values along an axis."""
    levels = place.at + thickness / 2 * np.array(EDGE_LEVELS)
    grid = np.stack(np.meshgrid(values, levels, indexing="ij"), axis=-1).reshape(-1, 2)
    points = np.tile(place.compartment.box.center, (len(grid), 1))
    points[:, axis], points[:, place.stack] = grid[:, 0], grid[:, 1]
    return points


def _edge(along: Scalars, found: Scalars, sizes: Sizes, config: InteriorConfig) -> tuple[float, float] | None:
    """Returns the straight edge (as of `polyval`) that touches a wall at front and back and is never beyond it."""
    met = np.isfinite(found)
    if met.sum() < 2:
        return None
    slope = float(np.polyfit(along[met], found[met], 1)[0])
    for tilt in (0.0, slope):
        edge = tilt, float((found[met] - tilt * along[met]).min())
        close = met & (found - np.polyval(edge, along) <= sizes.touch)
        half = len(along) // 2
        if min(close[:half].mean(), close[half:].mean()) >= config.carried:
            return edge
    return None


def _prism(
    place: PanelPlace, thickness: float, depth: tuple[float, float], low: tuple[float, float], high: tuple[float, float]
) -> TriangleMesh:
    """Returns the closed panel; `low` and `high` are its ends at the front and at the back edge (`depth`)."""
    reach, axis = place.reach, place.compartment.depth_axis
    corner = np.zeros((2, 3))
    corner[:, axis] = sorted(depth)
    corner[:, place.stack] = place.at - thickness / 2, place.at + thickness / 2
    corner[:, reach] = 0.0, 1.0
    mesh = TriangleMesh.box_mesh(Box(corner[0], corner[1]))
    vertices = mesh.vertices.copy()
    at_back = np.abs(vertices[:, axis] - depth[1]) < np.abs(vertices[:, axis] - depth[0])
    is_high = vertices[:, reach] > 0.5
    ends = np.array([[low[0], low[1]], [high[0], high[1]]])
    vertices[:, reach] = ends[is_high.astype(int), at_back.astype(int)]
    return TriangleMesh(vertices, mesh.faces)


def moved_to(place: PanelPlace, at: float, inset: float) -> PanelPlace:
    """Returns the same panel at another place along its stack, set back by another inset."""
    return replace(place, at=at, inset=inset)
