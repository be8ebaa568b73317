"""Which parts that are called a whole drawer are only boards of one: they hang on a named front, behind it.

Names such as `drawer_7` or `Schublade_3` may number drawers, or the boards of drawers whose fronts have a word of their
own (`drawer_front_2`). Coordinates are the input's; no joint is asked.
"""

from collections.abc import Sequence

import numpy as np

from grafu.asset.part import Part


def behind_fronts(fronts: Sequence[tuple[Part, int]], others: Sequence[Part], reach: float, slack: float) -> list[Part]:
    """Returns those of the others that lie in the outline of a front and hang together with it.

    Args:
        fronts: the parts that are called fronts, each with the axis along which it faces.
        others: parts that are called a drawer, without a word for a piece of one.
        reach: how far apart parts touch (input units).
        slack: how far a board may stand out of the outline of its front (input units).
    """
    found: dict[str, Part] = {}
    for front, axis in fronts:
        covered = [part for part in others if part.id not in found and _covers(front, part, axis, slack)]
        reached = [front]
        while reached:
            around = reached.pop().box.grown(reach)
            new = [part for part in covered if part.id not in found and around.overlaps(part.box)]
            found |= {part.id: part for part in new}
            reached += new
    return list(found.values())


def _covers(front: Part, part: Part, axis: int, slack: float) -> bool:
    beyond = np.maximum(front.box.low - part.box.low, part.box.high - front.box.high)
    return float(np.delete(beyond, axis).max()) <= slack
