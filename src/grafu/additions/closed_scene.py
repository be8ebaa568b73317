"""The scene with every moving body closed, which drawer boxes and carcass boards are looked for in."""

from collections.abc import Iterable
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.joints.rail.body_region import DrawerFrame, drawer_frame
from grafu.joints.rail.search import carried_mesh, slides_in_its_plane
from grafu.joints.rail_config import DrawerConfig
from grafu.scene.scene import MovingBody, Scene


@final
@dataclass(frozen=True, eq=False)
class ClosedScene:
    """The parts as they stand with every moving body closed, and who moves how; `scene` holds no hardware.

    `drawers` states what counts as a drawer.
    """

    scene: Scene
    requests: tuple[JointRequest, ...]
    drawers: DrawerConfig

    @property
    def body(self) -> tuple[Part, ...]:
        """The still parts: what new boards look like."""
        return self.scene.static_parts

    def triangles(self, request: JointRequest, frame: DrawerFrame) -> tuple[np.ndarray, np.ndarray]:
        """Returns the triangles (n, 3, 3) of the still parts, and of the other moving bodies, in a drawer's frame."""
        own = set(self.scene.moving_bodies[request.moving].members)
        moving = [self.scene.parts[i] for i in sorted(self.scene.moving_ids) if i not in own]
        return _local_triangles(self.scene.static_parts, frame), _local_triangles(moving, frame, frame.height / 2)

    def limit_behind(self, request: JointRequest, frame: DrawerFrame, opposite: float) -> float:
        """Returns the y up to which a box may reach for the sake of a front that faces the other way behind it.

        Two fronts do so where the negative cosine between their directions is at least `opposite`.
        """
        nearest = float("inf")
        for other in self.requests:
            cosine = float(np.asarray(other.axis.direction) @ np.asarray(request.axis.direction))
            if other.moving == request.moving or not other.kind.slides or cosine > -opposite:
                continue
            local = (self.scene.parts[other.moving].mesh.vertices - frame.origin) @ frame.rotation
            low, high = local.min(axis=0), local.max(axis=0)
            beside = abs(low[0] + high[0]) < frame.width + high[0] - low[0]
            level = abs(low[2] + high[2]) < frame.height + high[2] - low[2]
            if beside and level and high[1] > frame.depth:
                nearest = min(nearest, (frame.depth + max(float(low[1]), frame.depth)) / 2)
        return nearest

    def slides_in_its_plane(self, request: JointRequest) -> bool:
        """Whether a part is a board that slides along itself."""
        direction = np.asarray(request.axis.direction)
        return slides_in_its_plane(self.scene.parts[request.moving].mesh, direction, self.drawers)

    def framed(self, request: JointRequest) -> tuple[DrawerFrame, TriangleMesh] | None:
        """Returns a drawer's frame, and the drawer with what rides behind its front in it; None where it is none."""
        if self.slides_in_its_plane(request):
            return None
        mesh = carried_mesh(request, self.scene, self.drawers)
        frame = drawer_frame(mesh, np.asarray(request.axis.direction), config=self.drawers)
        if frame is None or min(frame.width, frame.height) <= 0:
            return None
        return frame, TriangleMesh(np.asarray((mesh.vertices - frame.origin) @ frame.rotation), mesh.faces)

    def with_members(self, moving_id: str, members: Iterable[str]) -> "ClosedScene":
        """Returns the closed scene in which some still parts ride on a moving body."""
        return replace(self, scene=self.scene.with_attached((moving_id, member) for member in members))

    def with_parts(self, parts: Iterable[Part]) -> "ClosedScene":
        """Returns the closed scene with some more parts; those that ride on a moving body move with it."""
        return replace(self, scene=self.scene.with_parts(parts))


def closed_scene(scene: Scene, plan: RealizationPlan, drawers: DrawerConfig = DrawerConfig()) -> ClosedScene:
    """Returns a scene with every moving body of a plan closed, once for all steps; parts without faces are left out."""
    return scene.once(_closed, plan.joints, at_scale(drawers, scene.metre))


def _closed(scene: Scene, joints: tuple[JointRequest, ...], drawers: DrawerConfig) -> ClosedScene:
    known = {part.id: part for part in scene.parts.values() if len(part.mesh.faces)}
    requests = tuple(r for r in joints if r.moving in known)
    moving_bodies = {
        r.moving: MovingBody(r.moving, (r.moving, *(i for i in r.attached if i in known))) for r in requests
    }
    for request in requests:
        for member in moving_bodies[request.moving].members:
            known[member] = closed_part(known[member], request)
    whole = Box.enclosing(part.box for part in known.values())
    return ClosedScene(Scene(known, moving_bodies, float(whole.size.max())), requests, drawers)


def closed_part(part: Part, request: JointRequest) -> Part:
    """Returns a part that moves with a joint as it stands when the joint is closed."""
    if request.drawn_at <= 0:
        return part
    T = request.kind.transform(request.axis, -request.drawn_at)
    return replace(part, surfaces=tuple(s.transformed(T) for s in part.surfaces))


def _local_triangles(parts: Iterable[Part], frame: DrawerFrame, above: float = np.inf) -> np.ndarray:
    """Returns the triangles of the parts that reach behind a drawer's front, or up to `above` over it, in its frame."""
    wide, low_z = frame.width / 2, -frame.height / 2
    found = []
    for part in parts:
        corners = (part.box.corners() - frame.origin) @ frame.rotation
        low, high = corners.min(axis=0), corners.max(axis=0)
        if low[0] < wide and high[0] > -wide and high[1] > 0 and low[2] < above and high[2] > low_z:
            found.append(((part.mesh.vertices - frame.origin) @ frame.rotation)[part.mesh.faces])
    return np.concatenate(found) if found else np.zeros((0, 3, 3))
