"""The case of a chest whose parts all bear its name: `drawer_box`, `drawer_top`, `drawer_bottom`."""

from typing import final

import numpy as np

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
    """Returns the asset in which a part that holds all others is no drawer, where every one is called so; else itself.

    Something has to stay: without it none of them could move.
    """
    drawers = [part for part in asset.parts if part.label is not PartLabel.HANDLE]
    if len(drawers) < 2 or any(p.label is not PartLabel.DRAWER or p.labelled_by != "name" for p in drawers):
        return asset
    case = max(drawers, key=lambda part: float(np.prod(part.box.size)))
    held = all(_is_in(part.box, case.box, config) for part in drawers if part is not case)
    return relabelled(asset, {case.id: PartLabel.MISC}) if held else asset


def _is_in(drawer: Box, case: Box, config: NamedCaseConfig) -> bool:
    """Whether a box that is no board lies mostly in another."""
    thin, middle, _ = np.sort(drawer.size)
    common = np.minimum(drawer.high, case.high) - np.maximum(drawer.low, case.low)
    inside = float(np.prod(np.maximum(common, 0.0))) / max(float(np.prod(drawer.size)), 1e-12)
    return bool(thin >= config.deep * middle and inside >= config.holds)
