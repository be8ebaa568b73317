"""One drawer's search: its frame and body, what it may hit, and how far it is wanted to open. It installs nothing."""

from dataclasses import replace
from functools import cached_property
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.geometry.swept_body import SweptBody
from grafu.joints.config import RealizationConfig
from grafu.joints.limits import (
    PoseFunction,
    all_blockers,
    free_opening,
    in_the_way,
    sweep,
    swept_box,
    widest_free,
)
from grafu.joints.plan import JointRequest
from grafu.joints.rail.body_region import (
    BodyRegion,
    DrawerFrame,
    board_before_rack,
    body_region,
    drawer_frame,
    is_shallow,
    lift_frame,
)
from grafu.joints.rail.spots import front_only_region
from grafu.joints.rail_config import DrawerConfig
from grafu.scene.border import SNAP, part_axes
from grafu.scene.obstacles import Obstacles
from grafu.scene.scene import Scene
from grafu.templates.template import RailTemplate
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True, eq=False)
class DrawerSearch:
    """See the module's docstring; `request.reference` is in metres."""

    request: JointRequest
    scene: Scene
    config: RealizationConfig
    frame: DrawerFrame
    body: SweptBody
    obstacles: Obstacles
    neighbours: Obstacles

    @cached_property
    def mesh(self) -> TriangleMesh:
        """What rails may hold on to: the drawer, and what rides behind its front side (walls, runners of its own)."""
        return carried_mesh(self.request, self.scene, self.config.drawer)

    @property
    def box(self) -> Box:
        """The box of the drawer and all that rides on it, at rest."""
        return self.scene.moving_mesh(self.request.moving).box

    @property
    def axis(self) -> Axis:
        """The sliding axis through the drawer's middle."""
        return Axis(self.mesh.box.center, self.frame.slide)

    @property
    def is_column(self) -> bool:
        """Whether the part is a lifting column; see `is_column`."""
        return is_column(self.scene.parts[self.request.moving].mesh, self.frame.slide, self.config.drawer)

    @cached_property
    def is_leaf(self) -> bool:
        """Whether it is a sliding door, which runs in tracks; see `slides_in_its_plane`."""
        return slides_in_its_plane(
            self.scene.parts[self.request.moving].mesh, np.asarray(self.frame.slide), self.config.drawer
        )

    @property
    def motion(self) -> PoseFunction:
        """The motion from rest at a travel in metres."""
        return self.axis.shift

    @cached_property
    def static_rays(self) -> RayCaster:
        """The static body around the drawer and behind it, prepared for rays."""
        return self.walls_of(())

    def walls_of(self, parts: tuple[str, ...]) -> RayCaster:
        """Returns the static body around the drawer and behind it (or some parts of it alone), prepared for rays."""
        near = self.config.rail.around * float(self.mesh.box.size.max())
        margin = self.scene.extent if is_shallow(self.frame, self.config.drawer) else near
        return RayCaster(self.scene.static_mesh_near(self.mesh.box, margin, parts))

    @cached_property
    def region(self) -> BodyRegion | None:
        """Where rails may run: along the container, or behind a front that has none; None where there is no depth."""
        container = body_region(self.mesh, self.frame, self.config.body_tolerance, self.config.drawer)
        if container is not None and not is_shallow(self.frame, self.config.drawer):
            return container
        reach = self.config.rail.behind.reach * self.scene.extent
        behind = front_only_region(self.frame, self.static_rays, reach, self.config.rail)
        if container is None or (behind is not None and behind.length > self.config.rail.deeper * container.length):
            return behind
        return container

    @property
    def reach(self) -> float:
        """The travel that rails could give, metres: over the container's depth, or the depth behind a mere front.

        A travel that is stated has them lap less, see `RailConfig`.
        Tracks of a sliding door give what is asked for, or its own width, as far as it is free and stays beside the
        static body.
        """
        depth = max(self.frame.depth, self.region.length if self.region else 0.0)
        most = self.config.rail_ratio * self.config.rail.most_of_rail
        usual = max(self.config.rail.travel * depth, min(self._stated, most * depth))
        return max(usual, self._free_beside) if self.is_leaf else usual

    def reach_on(self, rail: RailTemplate) -> float:
        """Returns how far a rail lets the drawer travel, metres: further than usual where that is stated."""
        return max(rail.range, min(self._stated, self.config.rail.most_of_rail * rail.size.length))

    @property
    def _stated(self) -> float:
        return self.request.reference or 0.0

    @cached_property
    def _free_beside(self) -> float:
        most = min(self.request.reference or self.frame.depth, self._room_along)
        return self.travel(most) if most > 0 else 0.0

    @property
    def _room_along(self) -> float:
        """How far it is from the leading edge to the end of the static body, metres; 0 where nothing is static."""
        corners = [obstacle.collider.box.corners() for obstacle in self.scene.static_obstacles]
        if not corners:
            return 0.0
        ends = np.vstack(corners)
        slide = np.asarray(self.frame.slide)
        return float((ends @ slide).max() - (self.mesh.vertices @ slide).max())

    @property
    def wanted(self) -> float:
        """The travel that is asked for, as far as rails could give it, metres."""
        return max(min(self.request.reference or self.reach, self.reach), self.config.rail.least_travel)

    def travel(self, reach: float) -> float:
        """Returns the widest travel, at most `reach`, that is free of the static body."""
        near = in_the_way(self.obstacles, swept_box(self.box, self.motion, reach))
        return widest_free(self.body, self.motion, reach, near, self.config.fine_poses, self.config.short)

    def free_ratio(self) -> float:
        """Returns how much of the wanted travel the drawer slides without hardware, 0..1; 0 if blocked at rest."""
        near = in_the_way(self.obstacles, swept_box(self.box, self.motion, self.wanted))
        return free_opening(self.body, self.motion, self.wanted, near, self.config.fine_poses)[0] / self.wanted

    def met_at_rest(self) -> tuple[str, ...]:
        """Returns what the drawer cuts into before it has moved at all."""
        return sweep(self.body, self.motion, 0.0, in_the_way(self.obstacles, self.box), 1).blockers

    def bodies_in_the_way(self, reach: float) -> tuple[str, ...]:
        """Returns the other moving bodies, at rest, that the drawer runs into."""
        near = in_the_way(self.neighbours, swept_box(self.box, self.motion, reach))
        return all_blockers(self.body, self.motion, reach, near, self.config.coarse_poses)


def slides_in_its_plane(mesh: TriangleMesh, direction: Vec3, config: DrawerConfig = DrawerConfig()) -> bool:
    """Whether a part is an upright board that slides along itself: a sliding door."""
    axes = part_axes(mesh)
    size = np.ptp(mesh.vertices @ axes, axis=0)
    thin = int(np.argmin(size))
    is_upright = thin != int(np.argmax(np.abs(axes[2])))
    is_flat = size[thin] < config.flat * np.delete(size, thin).min()
    return bool(is_upright and is_flat and abs(float(axes[:, thin] @ direction)) < config.flat)


def is_column(mesh: TriangleMesh, direction: Vec3, config: DrawerConfig = DrawerConfig()) -> bool:
    """Whether a part slides up or down in what guides it, and is no board: sashes and shutters run in tracks."""
    return bool(abs(float(direction[2])) > SNAP) and not slides_in_its_plane(mesh, direction, config)


def carried_mesh(request: JointRequest, scene: Scene, config: DrawerConfig = DrawerConfig()) -> TriangleMesh:
    """Returns a drawer with those attached parts that do not stand out before its front; handles never count."""
    drawer, slide = scene.parts[request.moving], np.asarray(request.axis.direction)
    front = float((drawer.mesh.vertices @ slide).max()) + config.stands_out
    attached = [
        scene.parts[member] for member in scene.moving_bodies[request.moving].members if member != request.moving
    ]
    behind = [r.mesh for r in attached if r.label is not PartLabel.HANDLE and (r.mesh.vertices @ slide).max() <= front]
    return merge_meshes([drawer.mesh, *behind]) if behind else drawer.mesh


def drawer_search(
    request: JointRequest, scene: Scene, config: RealizationConfig, ignored: tuple[str, ...] = ()
) -> DrawerSearch | None:
    """Returns the search for one request, None where the part would slide askew; `ignored` is no obstacle.

    The config is in the scale of the scene (`at_scale`).
    """
    mesh = scene.parts[request.moving].mesh
    direction = np.asarray(request.axis.direction)
    lying = slides_in_its_plane(mesh, direction, config.drawer)
    whole = mesh if lying else carried_mesh(request, scene, config.drawer)
    frame = drawer_frame(whole, direction, lying, config.drawer)
    if frame and whole is not mesh and body_region(whole, frame, config.body_tolerance, config.drawer) is None:
        frame = drawer_frame(mesh, direction, lying, config.drawer)  # an open rack has no flanks: rails run beside it
    frame = frame or lift_frame(mesh, direction)
    if frame is None:
        return None
    body = scene.swept_body(request.moving, config.depth * scene.extent, part_axes(mesh))
    obstacles = scene.still_obstacles.without(ignored)
    return DrawerSearch(request, scene, config, frame, body, obstacles, scene.other_bodies(request.moving))


def beside_rack(search: DrawerSearch) -> DrawerSearch | None:
    """Returns the search for rails beside an open rack that is drawn in one mesh with its front; None for others."""
    mesh, config = search.scene.parts[search.request.moving].mesh, search.config
    if search.is_leaf or search.is_column:
        return None
    board = board_before_rack(mesh, search.frame, config.body_tolerance, config.drawer)
    frame = None if board is None else drawer_frame(board, search.frame.slide, False, config.drawer)
    return None if frame is None else replace(search, frame=frame)
