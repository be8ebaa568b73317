"""What a drawer has of a box behind its front, told by rays on its real meshes. It adds nothing.

All is measured in the drawer's frame (`DrawerFrame`): x across, y from the front into the cabinet, z up. A board counts
where rays meet it on its side of the drawer: the bottom from above, sides and back from outside. Solid blocks are met
everywhere and lack nothing; flat trays and pull-out boards have no walls and want none.
"""

from dataclasses import replace
from typing import Literal, final

import numpy as np

from grafu.additions.drawer_box.config import BoxProbeConfig, DrawerBoxConfig
from grafu.dataclass import dataclass
from grafu.geometry.arrays import median, vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.joints.rail.body_region import DrawerFrame, is_board
from grafu.joints.rail_config import DrawerConfig

BoxKind = Literal[
    "whole",  # nothing is missing, or what it is wants no box (a solid block, a tray, a pull-out board)
    "front only",  # no board of a box is there
    "incomplete",  # some boards are there, others not
    "no drawer",  # it slides sideways in its own plane, or up and down
]
BoardName = Literal["side_left", "side_right", "back", "bottom"]
BOARDS: tuple[BoardName, ...] = ("side_left", "side_right", "back", "bottom")

COLUMNS = 16
"""Rays along a board."""
FACE_RAYS = 9
"""Rays along each side of a front that look for its inner face."""
LEVELS = 32
"""Rays over the height of a wall."""
RAY_START = 1e-3
"""Distance from the outline at which rays start, metres."""


@final
@dataclass(frozen=True, slots=True)
class _Wall:
    """What makes a wall: the z above which it is measured, and the least height above it.

    `inner` and `outer` are the fractions of the half width within which the back and beyond which a side is.
    """

    above: float
    height: float
    inner: float
    outer: float


@final
@dataclass(frozen=True, slots=True)
class BoxVerdict:
    """What a drawer has: the fraction of each board of its box that is there (0..1), and the boards that are missing.

    `inner_front` is the y of the front's inner face, metres in the drawer's frame; `why` states in words what was seen.
    """

    drawer: str
    kind: BoxKind
    ratios: tuple[tuple[BoardName, float], ...] = ()
    missing: tuple[BoardName, ...] = ()
    inner_front: float = 0.0
    why: str = ""


def box_verdict(
    drawer: str, mesh: TriangleMesh, frame: DrawerFrame, config: DrawerBoxConfig, drawers: DrawerConfig
) -> BoxVerdict:
    """Returns what a drawer has of a box; `mesh` is the drawer with what rides behind its front, in its own frame.

    `drawers` states what counts as one.
    """
    if is_board(frame, drawers):
        return _front_only(drawer, frame, f"it is {frame.depth:.3f} m deep: a front")
    caster = RayCaster(mesh)
    inner = _inner_front(caster, frame, config.probe)
    bottom, floor = _bottom(caster, frame, inner, config)
    if bottom >= config.covered and frame.height < config.tray * min(frame.width, frame.depth):
        return BoxVerdict(drawer, "whole", (("bottom", bottom),), (), inner, "it is a board or a tray")
    wall = _Wall(-frame.height, config.wall_height * frame.height, config.inner_ratio, config.outer_ratio)
    if bottom >= config.covered and floor < (config.block - 0.5) * frame.height:
        rim = min(max(config.rim, config.rim_ratio * frame.height), config.most_rim * frame.height)
        wall = replace(wall, above=floor, height=rim)
    left, right = (_side(caster, frame, inner, sign, wall, config.probe) for sign in (-1.0, 1.0))
    ratios = {"side_left": left, "side_right": right, "back": _back(caster, frame, inner, wall), "bottom": bottom}
    missing = tuple(name for name in BOARDS if ratios[name] < config.covered)
    if len(missing) == len(BOARDS):
        return _front_only(drawer, frame, "no board of a box is behind it")
    stated = tuple((name, round(ratios[name], 3)) for name in BOARDS)
    if not missing:
        return BoxVerdict(drawer, "whole", stated, (), inner, "bottom, sides and back are there")
    said = ", ".join(f"{name} covered to {ratios[name]:.0%}" for name in missing)
    return BoxVerdict(drawer, "incomplete", stated, missing, inner, said)


def _front_only(drawer: str, frame: DrawerFrame, why: str) -> BoxVerdict:
    return BoxVerdict(drawer, "front only", tuple((name, 0.0) for name in BOARDS), BOARDS, frame.depth, why)


def as_front_only(verdict: BoxVerdict, frame: DrawerFrame, behind: float) -> BoxVerdict:
    """Returns the verdict on a shallow part that turned out to stand before a space `behind` metres deep."""
    return _front_only(
        verdict.drawer, frame, f"it is {frame.depth:.3f} m deep before a space of {behind:.3f} m: a front with its pull"
    )


def _inner_front(caster: RayCaster, frame: DrawerFrame, config: BoxProbeConfig) -> float:
    """Returns the y of the front's inner face, seen from the middle of the box."""
    middle, unseen = 0.5 * frame.depth, min(config.front, config.front_ratio * frame.depth)
    x, z = _grid(config.middle * frame.width / 2, config.middle * frame.height / 2, FACE_RAYS, FACE_RAYS)
    hits = caster.along(np.column_stack([x, np.full(x.size, middle), z]), vec3(0.0, -1.0, 0.0))
    found = hits[hits <= middle + RAY_START]
    if len(found) < 0.5 * len(hits):
        return unseen
    inner = middle - median(found)
    return inner if inner > config.thinnest else unseen  # a solid block shows its outer face


def _bottom(caster: RayCaster, frame: DrawerFrame, inner: float, config: DrawerBoxConfig) -> tuple[float, float]:
    """Returns the fraction of the bottom that is there, and the z of its upper side."""
    x, y = (
        a.ravel()
        for a in np.meshgrid(
            np.linspace(-config.inner_ratio, config.inner_ratio, COLUMNS) * frame.width / 2,
            _along(frame, inner, config.probe),
            indexing="ij",
        )
    )
    half = frame.height / 2 + RAY_START
    above = half - caster.along(np.column_stack([x, y, np.full(x.size, half)]), vec3(0.0, 0.0, -1.0))
    hit = np.isfinite(above)
    return float(hit.mean()), median(above[hit]) if hit.any() else 0.0


def _side(
    caster: RayCaster, frame: DrawerFrame, inner: float, sign: float, wall: _Wall, config: BoxProbeConfig
) -> float:
    """Returns the fraction of one side's length at which a wall stands."""
    y, z = (a.ravel() for a in np.meshgrid(_along(frame, inner, config), _levels(frame), indexing="ij"))
    outside = frame.width / 2 + RAY_START
    origins = np.column_stack([np.full(y.size, sign * outside), y, z])
    hits = caster.along(origins, vec3(-sign, 0.0, 0.0)) <= outside - wall.outer * frame.width / 2
    return _high_enough(hits & (z > wall.above), frame, wall)


def _back(caster: RayCaster, frame: DrawerFrame, inner: float, wall: _Wall) -> float:
    """Returns the fraction of the back's width at which a wall stands."""
    x = np.linspace(-wall.inner, wall.inner, COLUMNS) * frame.width / 2
    x, z = (a.ravel() for a in np.meshgrid(x, _levels(frame), indexing="ij"))
    origins = np.column_stack([x, np.full(x.size, frame.depth + RAY_START), z])
    hits = caster.along(origins, vec3(0.0, -1.0, 0.0)) <= 0.5 * (frame.depth - inner) + RAY_START
    return _high_enough(hits & (z > wall.above), frame, wall)


def _high_enough(hits: np.ndarray, frame: DrawerFrame, wall: _Wall) -> float:
    heights = hits.reshape(COLUMNS, LEVELS).sum(axis=1) * frame.height / LEVELS
    return float((heights > wall.height).mean())


def _along(frame: DrawerFrame, inner: float, config: BoxProbeConfig) -> np.ndarray:
    """Returns values of y behind the front, short of the back."""
    room = frame.depth - inner
    back = max(config.ends * room, min(config.back, config.back_ratio * room))
    return np.linspace(inner + config.ends * room, frame.depth - back, COLUMNS)


def _levels(frame: DrawerFrame) -> np.ndarray:
    return ((np.arange(LEVELS) + 0.5) / LEVELS - 0.5) * frame.height


def _grid(x: float, z: float, columns: int, rows: int) -> tuple[np.ndarray, np.ndarray]:
    xs, zs = np.meshgrid(np.linspace(-x, x, columns), np.linspace(-z, z, rows), indexing="ij")
    return xs.ravel(), zs.ravel()
