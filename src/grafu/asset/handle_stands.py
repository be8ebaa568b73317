"""What a handle stands on: posts, a rose, a plate behind it. They are pieces of the handle, and move with it.

It looks at labels, names and boxes, in any frame of axes.
"""

from dataclasses import replace
from typing import Final, final

import numpy as np

from grafu.asset.labels import sense_of
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.vocabulary import PartLabel

_MAY_BE: Final = frozenset({PartLabel.UNKNOWN, PartLabel.MISC, PartLabel.BACK_PANEL})  # a back plate is one of a handle


@final
@dataclass(frozen=True, slots=True)
class HandleStandConfig:
    """What belongs to a handle that it touches.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    touch: float = 0.0006
    """How far the pieces of a handle lie apart at most (fraction of the diagonal of all)."""
    most: float = 4.0
    """Largest face of such a piece (multiple of the outline of the handle): a front is larger ..."""
    large: float = 0.2
    """... and so is a front whose handle is one mesh with others (fraction of the diagonal of all, of its own)."""

    def __post_init__(self) -> None:
        require_positive(self, "most")
        require_ratios(self, "touch", "large")


def with_handle_stands(
    parts: tuple[Part, ...], whole: Box, config: HandleStandConfig = HandleStandConfig()
) -> tuple[Part, ...]:
    """Returns the parts in which the small ones between a handle and what it sits on are handles, one after the other.

    Hinges, rails and locks stay what they are.

    Args:
        parts: labelled parts in any one frame.
        whole: the box around them, for tolerances.
        config: the tolerances.
    """
    touch = config.touch * whole.diagonal
    may_be = [p for p in parts if p.label in _MAY_BE and p.box.diagonal <= config.large * whole.diagonal]
    left = {p.id: p for p in may_be if not sense_of(p.source.name).is_fitting}
    reached = [(part.box, part.box) for part in parts if part.label is PartLabel.HANDLE]
    found: set[str] = set()
    while reached:
        box, handle = reached.pop()
        near = [p for p in left.values() if p.box.overlaps(box, touch) and _is_piece(p.box, handle, config)]
        for part in near:
            del left[part.id]
            found.add(part.id)
            reached.append((part.box, handle))
    return tuple(replace(p, label=PartLabel.HANDLE, labelled_by="shape") if p.id in found else p for p in parts)


def _is_piece(box: Box, handle: Box, config: HandleStandConfig) -> bool:
    across = np.delete(np.arange(3), box.thin_axis)
    outline = float(np.prod(handle.size[across]))
    return float(np.prod(box.size[across])) <= config.most * outline
