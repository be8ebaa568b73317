"""What is called a door or drawer and sits on the inner side of one, such as the arms of its hinges, is no handle.

It looks at labels and boxes, in any frame of axes.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import final

from grafu.asset.grips import is_inside
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True, slots=True)
class InnerPieceConfig:
    """Which side of a front is its inner one, and what its pieces there are.

    Raises:
        ValueError: if a number is not above 0, or `touch` not between 0 and 1.
    """

    deep: float = 4.0
    """The model reaches this many times as far to the inner side as to the other: a leaf in a wall has none."""
    touch: float = 0.004
    """A piece that lies no farther from a part that stays is held by that, too (fraction of the model's diagonal)."""

    def __post_init__(self) -> None:
        require_positive(self, "deep")
        require_ratios(self, "touch")


def with_sitting_pieces(
    parts: tuple[Part, ...], held: Mapping[str, str], whole: Box, config: InnerPieceConfig = InnerPieceConfig()
) -> tuple[Part, ...]:
    """Returns the parts in which what sits on a front is a handle of it, or, on its inner side, of no category.

    What is inside and reaches a part that stays rides on no front: hinges are of both.

    Args:
        parts: labelled parts in any one frame.
        held: the front that each sits on, by part; both are called doors or drawers.
        whole: the box around all parts.
        config: what counts as inside.
    """
    by_id = {part.id: part for part in parts}
    inside = {name for name, front in held.items() if is_inside(by_id[name].box, by_id[front].box, whole, config.deep)}
    fixed = _reaching(inside, parts, config.touch * whole.diagonal)

    def settled(part: Part) -> Part:
        if part.id not in held:
            return part
        if part.id not in inside:
            return replace(part, label=PartLabel.HANDLE, carried_by=held[part.id])
        return replace(part, label=PartLabel.MISC, carried_by=None if part.id in fixed else held[part.id])

    return tuple(settled(part) for part in parts)


def _reaching(inside: set[str], parts: tuple[Part, ...], touch: float) -> set[str]:
    """Returns the pieces that reach a part that stays, by themselves or by others of them."""
    left = {part.id: part.box for part in parts if part.id in inside}
    queue = [p.box for p in parts if p.id not in inside and not p.label.is_movable and p.label is not PartLabel.HANDLE]
    found: set[str] = set()
    while queue:
        box = queue.pop()
        near = [name for name, other in left.items() if other.overlaps(box, touch)]
        queue += [left.pop(name) for name in near]
        found.update(near)
    return found
