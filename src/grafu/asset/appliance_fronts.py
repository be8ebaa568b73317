"""The plate that bears the name of an appliance among kitchen units is its door: `oven` between two drawers.

Whole appliances are far thicker, and what is named door besides needs no such guess.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.appliance_names import appliances
from grafu.asset.part import Frame, Part
from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_ratios
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True, slots=True)
class ApplianceFrontConfig:
    """Which plates are such doors.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    thick: float = 0.2
    """Its thickness at most (fraction of the shorter of its other sides)."""
    high: float = 0.5
    """Its height at least (fraction of its width): what is lower is a drawer or a control panel."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def with_appliance_fronts(
    parts: tuple[Part, ...], frame: Frame, config: ApplianceFrontConfig = ApplianceFrontConfig()
) -> tuple[Part, ...]:
    """Returns the parts with upright plates without a label as doors that are called by an appliance and nothing else.

    Args:
        parts: of an input, some of them labelled.
        frame: how it stands; its unit does not matter.
        config: which plates are such doors.
    """
    if len(parts) < 2:
        return parts
    up = "XYZ".index(frame.up[1])
    taken = {word for part in parts if part.label is PartLabel.DOOR for word in appliances(part.source.name)}
    return tuple(
        replace(part, label=PartLabel.DOOR, labelled_by="name") if _is_front(part, up, taken, config) else part
        for part in parts
    )


def named_first(parts: Sequence[Part], group: tuple[int, ...]) -> tuple[int, ...]:
    """Returns the members of a group with that first which alone is called by an appliance: its name is that of all."""
    named = [k for k in group if appliances(parts[k].source.name)]
    return group if len(named) != 1 else (named[0], *(k for k in group if k != named[0]))


def _is_front(part: Part, up: int, taken: set[str], config: ApplianceFrontConfig) -> bool:
    named = appliances(part.source.name)
    if part.label is not PartLabel.UNKNOWN or not named or named & taken:
        return False
    size, thin = part.box.size, part.box.thin_axis
    level = next(axis for axis in range(3) if axis not in (up, thin)) if thin != up else up
    is_plate = float(size[thin]) <= config.thick * float(np.sort(size)[1])
    return thin != up and is_plate and float(size[up]) >= config.high * float(size[level])
