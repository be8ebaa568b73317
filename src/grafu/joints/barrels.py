"""Round barrels of drawn hinges along a door's border, and rods along its lower one: which shells are some."""

from collections.abc import Callable, Iterator, Sequence
from functools import cache
from typing import TypeAlias, final

import numpy as np

from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Points, median, vec3
from grafu.geometry.box import Box
from grafu.geometry.components import connected_parts
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.config import RealizationConfig
from grafu.joints.drawn_config import DrawnConfig
from grafu.joints.plan import JointRequest
from grafu.scene.border import SNAP, BorderFrame
from grafu.scene.scene import Scene
from grafu.shapes import Float
from grafu.vocabulary import PartLabel

_Shells: TypeAlias = Callable[[str], Sequence[TriangleMesh]]
_ALONG = 9  # points of a pin, from end to end, that are looked for in boards
_POINT = 1e-4  # metres: half the side of the cube that stands for the end of a rod


@final
@dataclass(frozen=True, slots=True)
class Barrel:
    """The barrel of a drawn hinge, or a rod, of a part: its pin at (x, y) of a border frame (metres)."""

    part: str
    x: float
    y: float
    low: float
    high: float
    radius: float

    @property
    def length(self) -> float:
        """Its length along the border, metres."""
        return self.high - self.low


@final
@dataclass(frozen=True, eq=False)
class DrawnModel:
    """A scene, the config in its scale, and the shells of its parts; each part is taken apart once."""

    scene: Scene
    config: RealizationConfig
    shells: _Shells

    @property
    def drawn(self) -> DrawnConfig:
        """Returns what counts as a drawn hinge, in the scene's scale."""
        return self.config.hinge.drawn


def drawn_model(scene: Scene, config: RealizationConfig) -> DrawnModel:
    """Returns the model in which barrels are looked for; `config` is in the scene's scale."""
    return DrawnModel(scene, config, cache(lambda part: connected_parts(scene.parts[part].mesh)))


def line_at(frame: BorderFrame, request: JointRequest, model: DrawnModel) -> list[Barrel]:
    """Returns the barrels, or the rod, that carry a part at a border; empty where there are none.

    What slides needs more than barrels near it, which may be its neighbours'.
    """
    if not request.kind.turns and not _is_lower(frame):
        return []
    barrels = list(barrels_near(frame, request.moving, model))
    hinges = hinge_line(frame, barrels, model.drawn) if request.kind.turns else []
    return hinges or [barrel for barrel in barrels if _is_rod(barrel, frame, model)][:1]


def hinge_line(frame: BorderFrame, barrels: Sequence[Barrel], config: DrawnConfig) -> list[Barrel]:
    """Returns the barrels on one line that are spread along a border, the most of them; empty where there are none."""
    lines = [line for line in _lines(barrels, config.line) if len(line) > 1]
    least = config.spread * frame.length
    spread = [line for line in lines if max(b.high for b in line) - min(b.low for b in line) >= least]
    return max(spread, key=len, default=[])


def _is_lower(frame: BorderFrame) -> bool:
    """Whether a border is the lower one of an upright leaf."""
    return bool(frame.rotation[2, 0] > SNAP)


def _is_rod(barrel: Barrel, frame: BorderFrame, model: DrawnModel) -> bool:
    """Whether a barrel runs along the whole lower border of an upright leaf, and is held by static parts at both ends.

    A bar to pull it by ends before the leaf, where nothing holds it; what is called a handle is none.
    """
    if model.scene.parts[barrel.part].label is PartLabel.HANDLE:
        return False
    if not _is_lower(frame) or not model.drawn.rod <= barrel.length / frame.length <= 1 / model.drawn.rod:
        return False
    if barrel.part not in model.scene.moving_ids:
        return True
    ends = frame.to_object(np.array([[barrel.x, barrel.y, z] for z in (barrel.low, barrel.high)]))
    cubes = (TriangleMesh.box_mesh(Box(end - _POINT, end + _POINT)) for end in ends)
    return all(model.scene.is_near_static(cube, model.drawn.bearing) for cube in cubes)


def barrels_near(frame: BorderFrame, moving: str, model: DrawnModel) -> Iterator[Barrel]:
    """Yields the barrels near a border, shells of a moving body or of static parts."""
    scene, reach = model.scene, model.drawn.reach
    own = [scene.parts[name] for name in scene.moving_bodies[moving].members]
    near = [*own, *scene.static_parts_near(_along_border(frame, model))]
    low, high = _in_border_frame([part.box for part in near], frame)
    meets = (low[:, 0] <= reach) & (high[:, 0] >= -reach) & (low[:, 1] <= reach)
    meets &= high[:, 1] >= -frame.thickness - reach
    for part in (near[k] for k in np.flatnonzero(meets)):
        if len(part.mesh.faces) > model.config.carved_faces:
            continue
        is_static = part.id not in scene.moving_ids
        for shell in model.shells(part.id):
            found = _as_barrel(shell, part.id, frame, model.drawn)
            yield from (barrel for barrel in found if not (is_static and _is_buried(barrel, frame, near, model)))


def _is_buried(barrel: Barrel, frame: BorderFrame, near: Sequence[Part], model: DrawnModel) -> bool:
    """Whether a round part lies in static boards all along: it joins them, as dowels, cams and screws do."""
    ends = frame.to_object(np.array([[barrel.x, barrel.y, z] for z in (barrel.low, barrel.high)]))
    direction = (ends[1] - ends[0]) / barrel.length
    beside = barrel.radius * np.sqrt(np.maximum(1.0 - direction**2, 0.0)) - model.drawn.flush
    points = ends[0] + np.linspace(0.0, 1.0, _ALONG)[:, None] * (ends[1] - ends[0])
    fixed = (p.box for p in near if p.id != barrel.part and p.id not in model.scene.moving_ids)
    boards = [box for box in fixed if box.size.min() <= model.drawn.board]
    inside = [(points >= b.low + beside).all(axis=1) & (points <= b.high - beside).all(axis=1) for b in boards]
    return bool(np.any(inside, axis=0).all()) if inside else False


_CORNERS = np.array([[bool(k & 1 << axis) for axis in range(3)] for k in range(8)])


def _in_border_frame(boxes: Sequence[Box], frame: BorderFrame) -> tuple[Points, Points]:
    """Returns the low and high ends of the boxes around boxes, in a border frame."""
    ends = np.array([(box.low, box.high) for box in boxes]).reshape(-1, 2, 1, 3)
    corners = np.where(_CORNERS, ends[:, 1], ends[:, 0])
    local = frame.to_border(corners.reshape(-1, 3)).reshape(corners.shape)
    return local.min(axis=1), local.max(axis=1)


def _along_border(frame: BorderFrame, model: DrawnModel) -> Box:
    """Returns the box around all that may be near a border, however far along it."""
    reach, far = model.drawn.reach, frame.length + 2 * model.scene.extent
    low, high = vec3(-reach, -frame.thickness - reach, -far), vec3(reach, reach, far)
    return Box.around(frame.to_object(Box(low, high).corners()))


def _as_barrel(shell: TriangleMesh, part: str, frame: BorderFrame, config: DrawnConfig) -> Iterator[Barrel]:
    """Yields the barrel of a shell near the border and along it, if it has one with the radius of a hinge's.

    A shell is a cylinder, or a cylinder at an end of a leaf that is no wider.
    """
    local = frame.to_border(shell.vertices)
    box = Box.around(local)
    is_beside = box.low[0] >= -config.reach and box.high[0] <= config.reach
    is_level = box.low[1] >= -frame.thickness - config.reach and box.high[1] <= config.reach
    size = box.size[:2]
    is_round = bool(size.max() * config.round <= size.min())
    radius = float(size.max() if is_round else size.min()) / 2
    if not (is_beside and is_level and config.radii[0] <= radius <= config.radii[1]) or box.size[2] < radius:
        return
    along = int(np.argmax(size))
    for side in (0.0,) if is_round else (-1.0, 1.0):
        middle = box.center[:2].copy()
        middle[along] += side * (float(size[along]) / 2 - radius)
        outer = local[:, :2][
            side * (local[:, along] - middle[along]) >= 0
        ]  # all of a cylinder, the half at a leaf's end
        if _lies_on_rim(outer - middle, radius, config):
            yield Barrel(part, float(middle[0]), float(middle[1]), float(box.low[2]), float(box.high[2]), radius)


def _lies_on_rim(points: Float[np.ndarray, "n 2"], radius: float, config: DrawnConfig) -> bool:
    """Whether points around a pin lie on a rim, but for those of caps, and for those of a bore or a pin within it.

    What lies beyond the rim is of neither: the posts of a bar handle have corners there.
    """
    off = np.hypot(*points.T)
    off, near = off[off > (1 - config.round) * radius], (1 - config.round) * radius
    on_rim = np.abs(off - radius) <= near
    inner = off[~on_rim & (off < radius)]
    in_bore = np.count_nonzero(np.abs(inner - median(inner)) <= near) if len(inner) else 0
    found = int(np.count_nonzero(on_rim))
    return bool(found >= config.corners and found + in_bore >= config.round * len(off))


def _lines(barrels: Sequence[Barrel], within: float) -> list[list[Barrel]]:
    """Returns the barrels that have one pin line, together."""
    lines: list[list[Barrel]] = []
    for one in barrels:
        same = (line for line in lines if np.hypot(one.x - line[0].x, one.y - line[0].y) <= within)
        line = next(same, None)
        if line is None:
            lines.append([one])
        else:
            line.append(one)
    return lines
