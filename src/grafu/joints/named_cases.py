"""The case of a chest whose parts all bear its name: `drawer_box`, `drawer_top`, `drawer_bottom`.

What is called a drawer and holds drawers is a case, too, such as the bottom of a refrigerator.
"""

from typing import final

import numpy as np

from grafu.asset.body_link import body_link
from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.joints.framed_leaves import relabelled
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True, slots=True)
class NamedCaseConfig:
    """What counts as a case among parts that are all called drawers.

    Raises:
        ValueError: if a number is not between 0 and 1.
    """

    holds: float = 0.7
    """What of each drawer's box lies in that of the case at least (fraction)."""
    deep: float = 0.2
    """Least thickness of a drawer in it (fraction of its middle side): boards may be those of a drawer."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def with_case_label(asset: Asset, config: NamedCaseConfig = NamedCaseConfig()) -> Asset:
    """Returns the asset in which a part that holds drawers is none, whatever its name; else itself.

    Where every part is called a drawer, it holds all others: something has to stay, without it none of them could move.
    Else it holds two at least, or, on the link of the body of a robot, one of another link.
    """
    parts = [part for part in asset.parts if part.label is not PartLabel.HANDLE]
    drawers = [part for part in parts if part.label is PartLabel.DRAWER and part.labelled_by == "name"]
    if len(drawers) < 2:
        return asset
    body, case = body_link(asset), max(drawers, key=lambda part: float(np.prod(part.box.size)))
    held = [part for part in drawers if part is not case and _is_in(part.box, case.box, config)]
    if len(drawers) == len(parts):
        is_case = len(held) == len(drawers) - 1
    else:
        is_of_body = bool(body) and case.source.link == body
        is_case = len(held) > 1 or (is_of_body and any(part.source.link != body for part in held))
    return relabelled(asset, {case.id: PartLabel.MISC}) if is_case else asset


def _is_in(drawer: Box, case: Box, config: NamedCaseConfig) -> bool:
    """Whether a box that is no board lies mostly in another."""
    thin, middle, _ = np.sort(drawer.size)
    common = np.minimum(drawer.high, case.high) - np.maximum(drawer.low, case.low)
    inside = float(np.prod(np.maximum(common, 0.0))) / max(float(np.prod(drawer.size)), 1e-12)
    return bool(thin >= config.deep * middle and inside >= config.holds)
