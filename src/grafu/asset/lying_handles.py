"""What lies on a front of another object is its handle where it stands out of it, as pulls do that are one object.

It looks at labels and boxes, in any frame of axes. Hinges reach a border of their front, and plates of locks are flat.
A front that was cut out of an object may be as deep as the box of its drawer: where it looks is known.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final, final

import numpy as np

from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.vocabulary import PartLabel

_FRONTS: Final = frozenset({PartLabel.UNKNOWN, PartLabel.DOOR, PartLabel.DRAWER})


@final
@dataclass(frozen=True, slots=True)
class LyingHandleConfig:
    """What is a handle of the front that it lies on.

    Raises:
        ValueError: if a number is not between 0 and 1.
    """

    plate: float = 0.35
    """How thick a front is at most of which nothing tells where it looks (fraction of its shorter side)."""
    near: float = 0.02
    """How far off its front it begins at most, or in it (fraction of the front's largest side)."""
    border: float = 0.01
    """How far from each border of the front it lies at least (the same fraction): hinges do not."""
    outline: float = 0.25
    """What of the front's outline it covers at most (fraction of area) ..."""
    slender: float = 0.2
    """... and how wide it is at most (fraction of the front's shorter side)."""
    out: float = 0.5
    """How far it stands out at least (fraction of its own shorter side): mouldings and plates are flatter."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def with_lying_handles(
    parts: Sequence[Part],
    lying: Sequence[bool],
    towards: Sequence[Vec3 | None] | None = None,
    config: LyingHandleConfig = LyingHandleConfig(),
) -> tuple[Part, ...]:
    """Returns the parts with those as handles that lie on a front and stand out of it; named ones keep their label.

    Args:
        parts: the parts, in any frame of axes.
        lying: which of them were parted from others because they lie on one front.
        towards: where each looks that was cut out as a front (unit direction in the same frame), None for the others.
        config: what is a handle.
    """
    facing = [None] * len(parts) if towards is None else towards
    fronts = [
        (part.box, None if side is None else int(np.argmax(np.abs(side))))
        for part, lies, side in zip(parts, lying, facing, strict=True)
        if not lies and part.label in _FRONTS
    ]
    return tuple(
        replace(part, label=PartLabel.HANDLE, labelled_by="shape")
        if lies and part.labelled_by == "none" and any(lies_as_handle(*front, part.box, config) for front in fronts)
        else part
        for part, lies in zip(parts, lying, strict=True)
    )


def lies_as_handle(front: Box, facing: int | None, box: Box, config: LyingHandleConfig) -> bool:
    """Whether a box is a handle of a front, which looks along the axis `facing`; None: along its thinnest."""
    axis = front.thin_axis if facing is None else facing
    across = np.delete(np.arange(3), axis)
    sides, own = front.size[across], box.size[across]
    largest = float(sides.max())
    if facing is None and front.size[axis] > config.plate * sides.min():
        return False
    margin, near = config.border * largest, config.near * largest
    inside = (box.low >= front.low + margin)[across].all() and (box.high <= front.high - margin)[across].all()
    gap = max(float(box.low[axis] - front.high[axis]), float(front.low[axis] - box.high[axis]))
    out = max(float(box.high[axis] - front.high[axis]), float(front.low[axis] - box.low[axis]))
    is_small = own.prod() <= config.outline * sides.prod() and own.min() <= config.slender * sides.min()
    return bool(inside and is_small and -near <= gap <= near and out >= config.out * own.min())
