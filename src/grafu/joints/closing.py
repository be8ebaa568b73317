"""How far drawers stand open as they are drawn, found from the meshes, and the plan in which all are closed first.

A drawer stands open where it can be pushed in, and its place is plain: level with drawers like it, or until its front
lies on what stands around its opening, or until its front is level with that on all sides. What blocks it on the way,
but for the runners that it is drawn on, leaves it as it is drawn.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Points, median
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale
from grafu.geometry.mesh import TriangleMesh, mesh_near
from grafu.geometry.raycast import RayCaster
from grafu.geometry.swept_body import SweptBody
from grafu.joints.closing_doors import drawn_angles
from grafu.joints.config import RealizationConfig
from grafu.joints.limits import blockers_at, in_the_way, is_free, swept_box, widest_free
from grafu.joints.nesting import bodies_of
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.joints.rail.body_region import DrawerFrame
from grafu.joints.rail.search import drawer_search
from grafu.joints.rail_config import ClosingConfig
from grafu.scene.obstacles import Obstacle
from grafu.scene.scene import Scene

_ALONG = np.linspace(-0.4, 0.4, 5)
_SIDES = ((-1.0, 0.0), (1.0, 0.0), (0.0, -1.0), (0.0, 1.0))


def closed_plan(plan: RealizationPlan, asset: Asset, config: RealizationConfig) -> RealizationPlan:
    """Returns the plan in which each door and drawer that stands open states so, whoever requested its joint.

    What a request states of itself stays: a value at which its part is drawn, a leader that it follows.
    """
    scene = Scene({p.id: p for p in asset.parts if len(p.mesh.faces)}, bodies_of(plan.joints), asset.extent)
    config = at_scale(config, scene.metre)
    doors = drawn_angles(plan.joints, scene, config)
    drawers = {d.request.moving: d for d in _drawers(plan.joints, scene, config)}
    found = _openings(drawers, drawers.values())
    closed = tuple(name for name in scene.moving_bodies if name not in found)
    found = _openings({name: replace(drawers[name], closed=closed) for name in found}, drawers.values())
    joints = tuple(_ajar(r, found[r.moving]) if r.moving in found else r for r in plan.joints)
    joints = tuple(
        _ajar(replace(r, axis=doors[r.moving].axis), doors[r.moving].angle) if r.moving in doors else r for r in joints
    )
    return replace(plan, joints=joints) if found or doors else plan


def _openings(drawers: Mapping[str, "_Drawer"], all_drawers: Iterable["_Drawer"]) -> dict[str, float]:
    """Returns how far those drawers stand open that do, by the id of the moving part."""
    openings = {name: _drawn_opening(drawer, all_drawers) for name, drawer in drawers.items()}
    return {name: opening for name, opening in openings.items() if opening > 0}


def _ajar(request: JointRequest, opening: float) -> JointRequest:
    is_chosen = request.choice.opening is not None
    reference = request.reference if is_chosen or request.reference is None else request.reference + opening
    return replace(request, drawn_at=opening, reference=reference)


@final
@dataclass(frozen=True, eq=False)
class _Drawer:
    """A drawer as it is drawn; `front` is how far ahead its front's face lies along its slide, metres.

    `closed` are the moving bodies that are known to be drawn closed: their fronts stand around its own.
    """

    request: JointRequest
    scene: Scene
    config: RealizationConfig
    frame: DrawerFrame
    body: SweptBody
    front: float
    closed: tuple[str, ...] = ()

    @property
    def closing(self) -> ClosingConfig:
        return self.config.closing

    @property
    def least(self) -> float:
        """By how much it stands open at least, metres: less is how it was drawn."""
        return max(self.closing.least, self.closing.least_ratio * self.frame.depth)

    def is_parallel(self, other: "_Drawer") -> bool:
        """Whether it opens in the direction of another."""
        return float(self.frame.slide @ other.frame.slide) > self.closing.parallel

    @property
    def own(self) -> Part:
        return self.scene.parts[self.request.moving]

    def inwards(self, value: float) -> np.ndarray:
        return self.request.kind.along(self.request.axis)(-value)

    @cached_property
    def near(self) -> list[Obstacle]:
        """What stands where it would be pushed to."""
        box = swept_box(self.scene.moving_mesh(self.request.moving).box, self.inwards, self.frame.depth)
        return in_the_way(self.scene.static_obstacles, box)

    @cached_property
    def around(self) -> TriangleMesh:
        """What stands around it: static parts and closed moving bodies."""
        scene = self.scene
        meshes = [part.mesh for part in scene.static_parts] + [scene.moving_mesh(name) for name in self.closed]
        return mesh_near(meshes, scene.moving_mesh(self.request.moving).box.grown(self.frame.depth))

    @cached_property
    def at_rest(self) -> frozenset[str]:
        """What it cuts into as it is drawn."""
        return frozenset(blockers_at(self.body, self.inwards(0.0), self.near))

    @cached_property
    def runners(self) -> frozenset[str]:
        """What it cuts into as it is drawn that lies beside or below it, hidden by its front: runners, drawn."""
        return frozenset(name for name in self.at_rest if self.hides(self.scene.parts[name]))

    def hides(self, part: Part) -> bool:
        """Whether a part lies within the outline of its front, and is lower than it: a runner."""
        local = Box.around((part.mesh.vertices - self.frame.origin) @ self.frame.rotation)
        half = np.array([self.frame.width, self.frame.height]) / 2 + self.closing.beside
        across = np.array([np.abs([b[0], b[2]]) for b in (local.low, local.high)]).max(axis=0)
        return bool(np.all(across <= half) and local.size[2] <= self.closing.runner * self.frame.height)

    def is_free(self, opening: float, ignored: frozenset[str], poses: int = 0) -> bool:
        """Whether it can be pushed in by an opening, metres."""
        obstacles = [o for o in self.near if o.id not in ignored]
        return is_free(self.body, self.inwards, opening, obstacles, poses or self.config.coarse_poses)


def _drawers(requests: Iterable[JointRequest], scene: Scene, config: RealizationConfig) -> Iterable[_Drawer]:
    for request in requests:
        is_stated = request.drawn_at > 0 or request.coupling is not None or request.parent
        if is_stated or not request.kind.slides or request.moving not in scene.parts:
            continue
        search = drawer_search(request, scene, config)
        if search is not None and _is_drawer(search.frame, config):
            front = _front_level(search.mesh, search.frame, config.closing)
            yield _Drawer(request, scene, config, search.frame, search.body, front)


def _is_drawer(frame: DrawerFrame, config: RealizationConfig) -> bool:
    """Whether what slides is a drawer with some depth: no sliding door, no button."""
    is_upright = abs(float(frame.rotation[2, 2])) > config.drawer.level
    return is_upright and frame.depth >= config.closing.shallowest


def _front_level(mesh: TriangleMesh, frame: DrawerFrame, config: ClosingConfig) -> float:
    """Returns how far ahead the face of a front lies along its slide: handles before it are too small to count."""
    ahead = mesh.face_normals @ frame.slide
    faces = np.flatnonzero(ahead > config.faces_front)
    levels = mesh.triangles[faces].mean(axis=1) @ frame.slide
    order = np.argsort(-levels)
    areas = np.cumsum((mesh.face_areas[faces] * ahead[faces])[order])
    enough = np.searchsorted(areas, config.front_area * frame.width * frame.height)
    return float(levels[order][enough]) if enough < len(order) else float((mesh.vertices @ frame.slide).max())


def _drawn_opening(drawer: _Drawer, drawers: Iterable[_Drawer]) -> float:
    """Returns how far a drawer stands open as it is drawn, metres; 0 where it is closed, or nothing tells."""
    if not drawer.is_free(drawer.least, drawer.at_rest, 2):
        return 0.0
    around = [drawer.front - level for level in _frame_levels(drawer) if np.isfinite(level)]
    sides = drawer.closing.sides
    if sum(ahead < drawer.closing.flush for ahead in around) >= sides:
        return 0.0
    is_told = len(around) >= sides and not _is_by_design(drawer, drawers, min(around))
    level = _level_with_frame(drawer, min(around)) if is_told else 0.0
    return max(_level_with_sibling(drawer, drawers), _onto_frame(drawer), level)


def _is_by_design(drawer: _Drawer, drawers: Iterable[_Drawer], ahead: float) -> bool:
    """Whether a front that stands a little ahead of its case has another front in its plane: all are drawn so."""
    config = drawer.closing
    others = (o for o in drawers if o.request.moving != drawer.request.moving and o.is_parallel(drawer))
    in_plane = any(abs(other.front - drawer.front) < config.plane for other in others)
    return in_plane and ahead < config.plainly


def _level_with_sibling(drawer: _Drawer, drawers: Iterable[_Drawer]) -> float:
    """Returns how far it can be pushed in until it is level with the deepest drawer of its size; 0 where it cannot."""
    config = drawer.closing
    size = drawer.own.box.size
    alike = [
        other
        for other in drawers
        if other.is_parallel(drawer)
        and np.all(np.abs(other.own.box.size - size) <= config.alike * size)
        and drawer.least <= drawer.front - other.front <= config.widest * drawer.frame.depth
    ]
    if not alike:
        return 0.0
    sibling = min(alike, key=lambda other: other.front)
    opening = drawer.front - sibling.front
    return opening if drawer.is_free(opening, drawer.at_rest | sibling.at_rest) else 0.0


def _onto_frame(drawer: _Drawer) -> float:
    """Returns how far it can be pushed in until its front lies on what stands around its opening; 0 where it cannot."""
    config, reach = drawer.closing, drawer.closing.widest * drawer.frame.depth
    if drawer.at_rest - drawer.runners:
        return 0.0
    obstacles = [o for o in drawer.near if o.id not in drawer.runners]
    free = widest_free(drawer.body, drawer.inwards, reach, obstacles, drawer.config.coarse_poses)
    if not drawer.least <= free < reach:
        return 0.0
    thinnest, thickest = config.front_thickness
    behind = [drawer.front - level for level in _frame_levels(drawer, -1.0)]
    return free if any(thinnest <= distance - free <= thickest for distance in behind) else 0.0


def _level_with_frame(drawer: _Drawer, ahead: float) -> float:
    """Returns how far it can be pushed in until its front is level with what stands around it; 0 where it cannot.

    `ahead` is how far the front stands ahead of that, of the foremost of it, metres.
    """
    least = max(drawer.least, drawer.closing.proud)
    is_open = least <= ahead <= drawer.closing.widest * drawer.frame.depth
    is_clean = drawer.at_rest <= drawer.runners
    return ahead if is_open and is_clean and drawer.is_free(ahead, drawer.runners) else 0.0


def _frame_levels(drawer: _Drawer, sense: float = 1.0) -> Sequence[float]:
    """Returns the level along the slide of what stands beside a front: left, right, below, above; -inf: nothing.

    With a `sense` of -1 it is what lies behind the front along its borders.
    """
    frame, config = drawer.frame, drawer.closing
    depth = drawer.frame.depth
    rays = RayCaster(drawer.around)
    start = depth  # ahead of the front
    found = []
    for across, up in _SIDES:
        points = np.vstack([_beside(frame, across, up, sense * offset) for offset in config.offsets])
        origins = frame.to_object(points - np.array([0.0, start, 0.0]))
        away = rays.distances(origins, np.tile(-frame.slide, (len(origins), 1))).reshape(len(config.offsets), -1)
        away = np.where(away <= start + config.widest * depth, away, np.inf)
        hits = away.min(axis=0)
        hit = median(hits)
        ahead = float(frame.origin @ frame.slide) + start - hit
        found.append(ahead)
    return found


def _beside(frame: DrawerFrame, across: float, up: float, offset: float) -> Points:
    """Returns points in a row beside one side of a front, in the drawer's frame."""
    x = across * (frame.width / 2 + offset) if across else _ALONG * frame.width
    z = up * (frame.height / 2 + offset) if up else _ALONG * frame.height
    return np.column_stack(np.broadcast_arrays(x, 0.0, z)).reshape(len(_ALONG), 3)
