"""Pull-out trays: boards with a rim behind doors that turn about a side. They slide out once the doors are open."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import combinations
from typing import final

import numpy as np

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale, require_positive, require_ratios
from grafu.geometry.mesh import merge_meshes
from grafu.graph.functional_graph import FunctionalGraph
from grafu.joints.behind_fronts import groups_within, is_within_outline, sliding_out, static_boxes
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.joints.waste_bins import is_bucket
from grafu.scene.scale import metre_on

SOURCE = "rule"
"""`JointRequest.source` of a tray: its rim, and the gaps at its sides, show that it slides."""
_ACROSS, _DEPTH, _UP = 0, 1, 2


@final
@dataclass(frozen=True)
class TrayConfig:
    """What counts as a tray behind doors; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("clear", "apart", "joined", "rim")
    upright: float = 0.9
    """From this cosine on to the vertical a door turns about a side."""
    clear: float = 0.01
    """A tray stays this far within the outline of its doors (metres): what comes nearer to it is the body."""
    joined: float = 0.02
    """Two doors whose sides are this near to each other, and level, close one opening (metres)."""
    wide: float = 0.5
    """Least width of a tray (fraction of its opening's)."""
    deep: float = 0.5
    """Least depth of a tray (fraction of the depth of the whole)."""
    rim: float = 0.02
    """Least height of a tray (metres), and ..."""
    shallow: float = 0.4
    """... its greatest (fraction of its shorter other side): a basin is deeper."""
    apart: float = 0.003
    """Least gap between a tray and what stands beside it (metres): a shelf fills its compartment."""
    beside: float = 0.5
    """What stands beside a tray is at least this high (fraction of the tray's height): lower things are runners."""

    def __post_init__(self) -> None:
        require_positive(self, "clear", "joined", "rim", "apart")
        require_ratios(self, "upright", "wide", "deep", "shallow", "beside")


def with_trays(
    plan: RealizationPlan, asset: Asset, graph: FunctionalGraph, config: TrayConfig = TrayConfig()
) -> RealizationPlan:
    """Returns the plan in which trays behind doors slide out; joints that it has stay as they are."""
    doors = [asset.part(r.moving).box for r in plan.joints if _turns_at_a_side(r, asset.part(r.moving).box, config)]
    if not doors:
        return plan
    config = at_scale(config, metre_on(asset.extent))
    moving = {part for request in plan.joints for part in (request.moving, *request.attached)}
    static = static_boxes(asset, moving)
    openings = (*doors, *_pairs(doors, config))
    found = {tray.moving: tray for opening in openings for tray in _trays(opening, static, asset, graph, config)}
    return replace(plan, joints=(*plan.joints, *found.values())) if found else plan


def _turns_at_a_side(request: JointRequest, door: Box, config: TrayConfig) -> bool:
    upright = request.kind.turns and abs(float(request.axis.direction[_UP])) >= config.upright
    return bool(upright and door.thin_axis == _DEPTH)


def _pairs(doors: Iterable[Box], config: TrayConfig) -> list[Box]:
    """Returns the openings that two doors side by side close together."""
    found = []
    for first, second in combinations(doors, 2):
        between = max(first.low[_ACROSS], second.low[_ACROSS]) - min(first.high[_ACROSS], second.high[_ACROSS])
        level = np.abs(np.array([first.low - second.low, first.high - second.high])[:, [_DEPTH, _UP]])
        if abs(float(between)) <= config.joined and (level <= config.joined).all():
            found.append(Box.enclosing((first, second)))
    return found


def _trays(
    opening: Box, static: Mapping[str, Box], asset: Asset, graph: FunctionalGraph, config: TrayConfig
) -> list[JointRequest]:
    within = {name: box for name, box in static.items() if is_within_outline(box, opening, config.clear)}
    loose = [name for name, box in within.items() if not _is_held(box, static, within, config)]  # no runners
    found = []
    for group in groups_within(loose, graph):
        parts = [asset.part(name) for name in group]
        box = Box.enclosing(part.box for part in parts)
        if not _fits(box, opening, asset.box, config) or _is_held(box, static, group, config):
            continue
        if not is_bucket(merge_meshes([part.mesh for part in parts])):
            continue
        found.append(sliding_out(parts, SOURCE))
    return found


def _fits(tray: Box, opening: Box, whole: Box, config: TrayConfig) -> bool:
    """Whether a box has the proportions of a tray in an opening."""
    wide = tray.size[_ACROSS] >= config.wide * opening.size[_ACROSS]
    deep = tray.size[_DEPTH] >= config.deep * whole.size[_DEPTH]
    high = config.rim <= tray.size[_UP] <= config.shallow * tray.size[:_UP].min()
    return bool(wide and deep and high)


def _is_held(tray: Box, static: Mapping[str, Box], own: Iterable[str], config: TrayConfig) -> bool:
    """Whether something of at least half the tray's height stands right beside it."""
    for name in static.keys() - {*own}:
        box = static[name]
        common = np.minimum(tray.high, box.high) - np.maximum(tray.low, box.low)
        is_beside = common[_DEPTH] > 0 and common[_UP] >= config.beside * tray.size[_UP]
        if is_beside and common[_ACROSS] > -config.apart:
            return True
    return False
