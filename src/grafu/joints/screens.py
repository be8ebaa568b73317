"""Folding screens: panels of one height that stand side by side on the floor, and nothing else but what is on them.

The middle panel stays, and each other one turns about the seam with the panel next to it, towards the middle. Panels
that hang on a moving one go with that. Cases, beds and walls have other parts.
"""

from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import Final, final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.config_checks import at_scale, require_positive, require_ratios
from grafu.graph.edges import Hinge
from grafu.joints.framed_leaves import SOURCE, relabelled
from grafu.joints.plan import JointRequest, RealizationPlan, moved_instead
from grafu.scene.scale import metre_on
from grafu.vocabulary import PartLabel

_WIDTH: Final = 0
_DEPTH: Final = 1
_UP: Final = 2


@final
@dataclass(frozen=True)
class ScreenConfig:
    """What is a folding screen; lengths are metres.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("seam",)
    panels: int = 3
    """So many panels stand side by side at least: two are a pair of doors."""
    high: float = 1.2
    """Least height of the whole, over its width for each panel (ratio): panels are slender ..."""
    thin: float = 0.12
    """... and as thin as this at most (fraction of their width)."""
    alike: float = 0.05
    """How much they differ in height, in width and in what they stand on (fraction of height or width)."""
    seam: float = 0.02
    """How far they are from one another at most (metres)."""
    small: float = 0.15
    """What else is there has less surface than this (fraction of a panel's): hinges and feet."""

    def __post_init__(self) -> None:
        require_positive(self, "panels", "high", "seam")
        require_ratios(self, "thin", "alike", "small")


def screen_of(asset: Asset, config: ScreenConfig = ScreenConfig()) -> tuple[Part, ...]:
    """Returns the panels of a folding screen from left to right; empty where an asset is none."""
    config = at_scale(config, metre_on(asset.extent))
    height = float(asset.box.size[_UP])
    panels = [part for part in asset.parts if part.box.size[_UP] >= (1 - config.alike) * height]
    least = min((part.mesh.area for part in panels), default=0.0)
    others = [part for part in asset.parts if part not in panels]
    if len(panels) < config.panels or any(part.mesh.area > config.small * least for part in others):
        return ()
    panels.sort(key=lambda part: float(part.box.center[_WIDTH]))
    sizes = np.array([part.box.size for part in panels])
    lows, highs = (np.array([end(part) for part in panels]) for end in (_low, _high))
    width = float(np.median(sizes[:, _WIDTH]))
    is_slender = height >= config.high * width and bool((sizes[:, _DEPTH] <= config.thin * width).all())
    is_alike = bool((np.abs(sizes[:, _WIDTH] - width) <= config.alike * width).all())
    is_level = max(float(np.ptp(lows[:, _UP])), float(np.ptp(highs[:, _UP]))) <= config.alike * height
    stands = float(lows[:, _UP].max() - asset.box.low[_UP]) <= config.alike * height
    gaps = np.abs(lows[1:, _WIDTH] - highs[:-1, _WIDTH])
    in_plane = float(np.ptp(lows[:, _DEPTH])) <= config.thin * width
    found = is_slender and is_alike and is_level and stands and in_plane and bool((gaps <= config.seam).all())
    return tuple(panels) if found else ()


def _low(part: Part) -> np.ndarray:
    return part.box.low


def _high(part: Part) -> np.ndarray:
    return part.box.high


def with_screen_labels(asset: Asset) -> Asset:
    """Returns the asset in which the panels of a folding screen but the middle one are doors; else the asset itself."""
    panels = screen_of(asset)
    middle = len(panels) // 2
    labels = {p.id: PartLabel.SIDE_PANEL if k == middle else PartLabel.DOOR for k, p in enumerate(panels)}
    return relabelled(asset, labels) if panels else asset


def with_screen(plan: RealizationPlan, asset: Asset, settled: Collection[str] = ()) -> RealizationPlan:
    """Returns the plan in which the panels of a folding screen turn about their seams; any other plan as it is.

    Args:
        plan: the joints.
        asset: all parts, labelled (`with_screen_labels`).
        settled: the parts whose motions the user states.
    """
    panels = screen_of(asset)
    if not panels or {part.id for part in panels} & {*settled}:
        return plan
    middle = len(panels) // 2
    left, right = panels[:middle][::-1], panels[middle + 1 :]
    requests = [*_chain(panels[middle], left, -1.0), *_chain(panels[middle], right, 1.0)]
    return moved_instead(plan, {part.id for part in panels}, requests)


def _chain(middle: Part, outwards: Sequence[Part], side: float) -> list[JointRequest]:
    """Returns the joints of the panels on one side of the middle one; `side` is where they lie, along X.

    The first fold to the front (-Y), and the next, which hang on them, to the back.
    """
    found: list[JointRequest] = []
    inner = middle
    for k, panel in enumerate(outwards):
        front = k % 2 == 0
        at = panel.box.low if side > 0 else panel.box.high
        depth = float(panel.box.low[_DEPTH] if front else panel.box.high[_DEPTH])
        point = vec3(float(at[_WIDTH]), depth, float(panel.box.center[_UP]))
        axis = Axis(point, vec3(0.0, 0.0, -side if front else side))
        riding = tuple(part.id for part in outwards[k + 1 :])
        parent = inner.id if inner is not middle else ""
        joint = JointRequest(panel.id, Hinge.joint_type, axis, SOURCE, attached=riding, parent=parent)
        found.append(replace(joint, carriers=() if parent else (middle.id,)))
        inner = panel
    return found
