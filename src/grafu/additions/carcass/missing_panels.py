"""What a carcass lacks: a back or a bottom that should close the space behind doors and drawers. It adds nothing.

Tables, racks and open shelves have no carcass here: only what stands behind a door, or behind drawers that fill a good
part of the height under them, between walls on both sides, is looked at. Whether the open back was meant so (a cabinet
around pipes, say) cannot be known; it is reported all the same.
"""

from typing import final

import numpy as np

from grafu.additions.carcass.bays import Bay, FrontsView, find_bays, find_views
from grafu.additions.carcass.config import CarcassConfig
from grafu.additions.closed_scene import ClosedScene, closed_scene
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.config_checks import at_scale
from grafu.joints.plan import RealizationPlan
from grafu.joints.rail_config import DrawerConfig
from grafu.scene.scene import Scene
from grafu.shapes import Bool
from grafu.vocabulary import PartLabel

RAY_GRID = np.linspace(0.12, 0.88, 13)
"""Places of rays on a back or bottom, as fractions of a bay's sides: walls and edges lie outside."""
NAMED = 3
"""Doors and drawers that a sentence names."""


@final
@dataclass(frozen=True, eq=False)
class MissingPanel:
    """A board that a carcass lacks, behind or below which doors and drawers: `covered` is the fraction that is there.

    `view` and `bay` say where, for `complete_carcass`.
    """

    what: PartLabel
    moving_bodies: tuple[str, ...]
    covered: float
    why: str
    view: FrontsView
    bay: Bay


def missing_panels(
    scene: Scene,
    plan: RealizationPlan,
    config: CarcassConfig = CarcassConfig(),
    drawers: DrawerConfig = DrawerConfig(),
) -> tuple[MissingPanel, ...]:
    """Returns the backs and bottoms that the bodies behind the doors and drawers of a plan lack.

    `drawers` states what counts as a drawer.
    """
    closed = closed_scene(scene, plan, drawers)
    return panels_missing(closed, at_scale(config, closed.scene.metre))


def panels_missing(closed: ClosedScene, config: CarcassConfig) -> tuple[MissingPanel, ...]:
    """Returns what the bodies lack, all moving bodies closed; `config` is at the scale of the scene."""
    found: list[MissingPanel] = []
    for view in find_views(closed, config):
        bays = [
            bay
            for bay in find_bays(view, closed, config)
            if bay.walled >= config.walled and _is_carcass(bay, closed.scene, config)
        ]
        for bay in bays:
            covered = _back_covered(view, bay, config.behind_frame)
            if covered < config.covered:
                found.append(_missing_panel(PartLabel.BACK_PANEL, bay, covered, view))
            if not any(_under(other, bay) for other in bays):
                covered = _bottom_covered(view, bay, config)
                if covered < config.covered:
                    found.append(_missing_panel(PartLabel.BOTTOM_PANEL, bay, covered, view))
    return tuple(found)


def _missing_panel(what: PartLabel, bay: Bay, covered: float, view: FrontsView) -> MissingPanel:
    side = "back" if what is PartLabel.BACK_PANEL else "bottom"
    named = ", ".join(bay.moving_bodies[:NAMED]) + (" and others" if len(bay.moving_bodies) > NAMED else "")
    return MissingPanel(
        what, bay.moving_bodies, covered, f"the {side} behind {named} is covered to {covered:.0%}", view, bay
    )


def _is_carcass(bay: Bay, scene: Scene, config: CarcassConfig) -> bool:
    """Whether a bay is that of a body: it has a door, or drawers fill enough of the height down to the floor."""
    if bay.has_door:
        return True
    filled = float(bay.outline[3] - bay.outline[2])
    return filled >= config.filled * max(float(bay.outline[3]) - scene.floor, config.least_height)


def _back_covered(view: FrontsView, bay: Bay, behind: float) -> float:
    """Returns the fraction of a bay's back at which something stands, seen through the fronts.

    It is looked for from this fraction of the bay's depth on. A hole in a back, for cables, belongs to that back.
    """
    (x0, y0, z0), (x1, _, z1) = bay.low.tolist(), bay.high.tolist()
    x, z = (a.ravel() for a in np.meshgrid(x0 + RAY_GRID * (x1 - x0), z0 + RAY_GRID * (z1 - z0), indexing="ij"))
    y = y0 + behind * (float(bay.high[1]) - y0)
    hits = view.cast_through(np.column_stack([x, np.full(x.size, y), z]), vec3(0.0, 1.0, 0.0))
    return float(_without_holes(np.isfinite(hits).reshape(len(RAY_GRID), -1)).mean())


def _without_holes(covered: Bool[np.ndarray, "x z"]) -> Bool[np.ndarray, "x z"]:
    """Returns what is covered, and what that encloses."""
    outside = np.pad(np.zeros_like(covered), 1, constant_values=True)
    free = np.pad(~covered, 1, constant_values=True)
    for _ in range(covered.size):
        grown = outside.copy()
        for axis in (0, 1):
            grown |= np.roll(outside, 1, axis) | np.roll(outside, -1, axis)
        grown &= free
        if (grown == outside).all():
            break
        outside = grown
    inner: Bool[np.ndarray, "x z"] = ~outside[1:-1, 1:-1]
    return inner


def _bottom_covered(view: FrontsView, bay: Bay, config: CarcassConfig) -> float:
    """Returns the fraction of a bay's bottom at which something stands below it."""
    (x0, y0, z0), (x1, y1, _) = bay.low.tolist(), bay.high.tolist()
    x, y = (a.ravel() for a in np.meshgrid(x0 + RAY_GRID * (x1 - x0), y0 + RAY_GRID * (y1 - y0), indexing="ij"))
    start = z0 + min(config.bottom_above * bay.lowest, config.bottom_above_most)
    hits = view.cast(np.column_stack([x, y, np.full(x.size, start)]), vec3(0.0, 0.0, -1.0))
    return float(np.isfinite(hits).mean())


def _under(other: Bay, bay: Bay) -> bool:
    """Whether another bay lies below a bay: that one has the bottom."""
    below = other is not bay and float(other.outline[2]) < float(bay.outline[2]) - 1e-6
    shared = min(other.high[0], bay.high[0]) - max(other.low[0], bay.low[0])
    return bool(below and shared > 0.5 * (bay.high[0] - bay.low[0]))
