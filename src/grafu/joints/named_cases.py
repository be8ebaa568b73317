"""The case of a chest whose parts all bear its name: `drawer_box`, `drawer_top`, `drawer_bottom`.

What is called a drawer and holds drawers is a case, too, such as the bottom of a refrigerator.
"""

from collections.abc import Sequence
from typing import final

import numpy as np

from grafu.asset.body_link import body_link
from grafu.asset.part import Asset, Part
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
    """Returns the asset in which parts that hold drawers are none, whatever their names; else itself.

    Where every part is called a drawer, the largest holds all others: something has to stay, without it none of them
    could move. Else a case holds two at least, or, on the link of the body of a robot, one of another link. Beside the
    largest one there may be others, such as that of the trays in a refrigerator; those of a robot are on that link.
    """
    parts = [part for part in asset.parts if part.label is not PartLabel.HANDLE]
    drawers = [part for part in parts if part.label is PartLabel.DRAWER and part.labelled_by == "name"]
    if len(drawers) < 2:
        return asset
    body, largest = body_link(asset), max(drawers, key=lambda part: float(np.prod(part.box.size)))
    held = {case.id: [p for p in drawers if p is not case and _is_in(p.box, case.box, config)] for case in drawers}
    if len(drawers) == len(parts):
        cases = [largest.id] if len(held[largest.id]) == len(drawers) - 1 else []
    else:
        cases = [c.id for c in drawers if _holds_enough(c, held[c.id], body) and (c is largest or _stays(c, body))]
    return relabelled(asset, dict.fromkeys(cases, PartLabel.MISC)) if cases else asset


def _holds_enough(case: Part, held: Sequence[Part], body: str) -> bool:
    apart = [part for part in held if part.source.link != body]
    return len(held) > 1 or (bool(body) and case.source.link == body and bool(apart))


def _stays(case: Part, body: str) -> bool:
    """Whether no link of its own tells that a part moves."""
    return not body or case.source.link == body


def _is_in(drawer: Box, case: Box, config: NamedCaseConfig) -> bool:
    """Whether a box that is no board lies mostly in another."""
    thin, middle, _ = np.sort(drawer.size)
    common = np.minimum(drawer.high, case.high) - np.maximum(drawer.low, case.low)
    inside = float(np.prod(np.maximum(common, 0.0))) / max(float(np.prod(drawer.size)), 1e-12)
    return bool(thin >= config.deep * middle and inside >= config.holds)
