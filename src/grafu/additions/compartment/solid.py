"""Where a body is solid right behind a door or drawer: by rays, on real meshes. It cuts nothing.

All is measured in a view: x to the right as seen from the side to which the fronts open, y into the furniture, z up.
A body that is drawn as a closed block, or as a closed shell, shows one face behind the whole of a front, and nothing
more until its rear.
"""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import final

import numpy as np

from grafu.additions.carcass.bays import FrontsView, find_views
from grafu.additions.carcass.config import CarcassConfig
from grafu.additions.closed_scene import ClosedScene
from grafu.additions.compartment.config import SolidBodyConfig
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat3, Points, median, vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster, wall_distances

RAYS = 9
"""Rays across a front and upwards."""
PLACES = (0.2, 0.5, 0.8)
"""Where walls around a compartment are looked for, as fractions of its sides."""
_Y = np.array([0.0, 1.0, 0.0])


@final
@dataclass(frozen=True, eq=False)
class SolidBehind:
    """The room to cut into a still part behind fronts: a box in a view, whose axes are the columns of `rotation`.

    The box begins at the part's face, which is level to within `play` metres. `turns` states whether the fronts are
    doors.
    """

    part: str
    fronts: tuple[str, ...]
    rotation: Mat3
    room: Box
    turns: bool
    play: float

    def corners(self) -> Points:
        """Returns the corners of the room in the object frame."""
        return self.room.corners() @ self.rotation.T

    def cut(self) -> Points:
        """Returns the corners of what is cut out, in the object frame: the room, and the play before it."""
        low = np.array(self.room.low) - self.play * _Y
        return Box(low, self.room.high).corners() @ self.rotation.T


def solids_behind(closed: ClosedScene, config: SolidBodyConfig) -> tuple[SolidBehind, ...]:
    """Returns the compartments to cut; lengths of the config fit the scene's scale.

    Two doors side by side share one; each drawer has its own.
    """
    doors = {r.moving for r in closed.requests if r.kind.turns}
    found: list[SolidBehind] = []
    for view in find_views(closed, CarcassConfig()):
        fronts = {name: _local_box(closed.scene.parts[name], view) for name in view.moving_bodies}
        for part in closed.scene.static_parts:
            found += _joined(list(_in_part(part, view, fronts, doors, config)), config.wall)
    return tuple(found)


def _local_box(part: Part, view: FrontsView) -> Box:
    return Box.around(view.local(part.mesh.vertices))


def _in_part(
    part: Part, view: FrontsView, fronts: dict[str, Box], doors: set[str], config: SolidBodyConfig
) -> Iterator[SolidBehind]:
    """Yields a compartment in one part for each front that it is solid behind."""
    around = _local_box(part, view)
    behind = {name: box for name, box in fronts.items() if _may_face(around, box, config)}
    if not behind:
        return
    caster = RayCaster(TriangleMesh(view.local(part.mesh.vertices), part.mesh.faces))
    for name, front in behind.items():
        span = _solid_span(caster, front, config)
        room = None if span is None else _room(caster, front, around, span, config)
        if room is not None:
            yield SolidBehind(part.id, (name,), view.rotation, room, name in doors, config.flat)


def _may_face(part: Box, front: Box, config: SolidBodyConfig) -> bool:
    """Whether a part's box reaches behind nearly the whole of a front, and far enough."""
    lap = (1 - config.middle) / 2 * front.size
    across = all(part.low[i] <= front.low[i] + lap[i] and part.high[i] >= front.high[i] - lap[i] for i in (0, 2))
    return across and float(part.high[1]) >= float(front.low[1]) + config.least_depth


def _solid_span(caster: RayCaster, front: Box, config: SolidBodyConfig) -> tuple[float, float] | None:
    """Returns the y of a part's face right behind a front, and of what comes next of it; None: it is not solid."""
    half = config.middle / 2 * front.size
    across = [(i, np.linspace(front.center[i] - half[i], front.center[i] + half[i], RAYS)) for i in (0, 2)]
    y = float(front.low[1]) - config.start
    first = wall_distances(caster.along, vec3(0.0, y, 0.0), across[0], across[1], 1.0)
    face = median(first)
    if not np.isfinite(face) or y + face > float(front.high[1]) + config.near:
        return None
    level = np.abs(first - face) <= config.flat
    if level.mean() < config.faced:
        return None
    within = y + face + config.flat + config.start
    beyond = wall_distances(caster.along, vec3(0.0, within, 0.0), across[0], across[1], 1.0)[level]
    is_deep = np.isfinite(beyond) & (beyond >= config.least_depth)
    if is_deep.mean() < config.faced:
        return None
    return y + face, within + float(np.quantile(beyond[is_deep], 1 - config.faced))


def _room(caster: RayCaster, front: Box, around: Box, span: tuple[float, float], config: SolidBodyConfig) -> Box | None:
    """Returns the compartment behind a front: within its outline and the part's faces, less the walls."""
    wall = min(config.wall, config.wall_ratio * float(min(front.size[0], front.size[2])))
    low, high = np.array(front.low) + wall / 2, np.array(front.high) - wall / 2
    low[1], high[1] = span
    middle, places = (low + high) / 2, [low[i] + np.array(PLACES) * (high[i] - low[i]) for i in range(3)]
    ends = np.array(low), np.array(high)
    for axis, up in ((0, 2), (2, 0)):
        grid = (1, places[1]), (up, places[up])
        below, above = (float(wall_distances(caster.along, middle, *grid, sign).min()) for sign in (-1.0, 1.0))
        low_wall = middle[axis] - below if np.isfinite(below) else around.low[axis]
        high_wall = middle[axis] + above if np.isfinite(above) else around.high[axis]
        ends[0][axis], ends[1][axis] = max(low[axis], low_wall + wall), min(high[axis], high_wall - wall)
    ends[1][1] -= wall
    size = ends[1] - ends[0]
    if min(size[0], size[2]) < config.least_side or size[1] < config.least_depth:
        return None
    return Box(*ends)


def _joined(found: list[SolidBehind], wall: float) -> Iterable[SolidBehind]:
    """Returns compartments of doors that stand side by side as one."""
    merged: list[SolidBehind] = []
    for one in sorted(found, key=lambda s: float(s.room.low[0])):
        k = next((k for k, other in enumerate(merged) if _one_room(other, one, wall)), None)
        if k is None:
            merged.append(one)
        else:
            both = Box.enclosing([merged[k].room, one.room])
            merged[k] = replace(merged[k], fronts=(*merged[k].fronts, *one.fronts), room=both)
    return merged


def _one_room(a: SolidBehind, b: SolidBehind, wall: float) -> bool:
    """Whether two compartments are of doors, as high as each other, and side by side but for a wall."""
    level = max(abs(a.room.low[2] - b.room.low[2]), abs(a.room.high[2] - b.room.high[2])) <= wall
    apart = max(a.room.low[0], b.room.low[0]) - min(a.room.high[0], b.room.high[0])
    return bool(a.turns and b.turns and level and apart <= 2 * wall)
