"""The lid that lies on a part and on no other: what is below it is the case that the lid closes, and slides nowhere."""

from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.graph.completion import GraphCompletion
from grafu.graph.functional_graph import PartNode
from grafu.vocabulary import PartLabel

_UP = 2


@final
@dataclass(frozen=True, slots=True)
class LidAboveConfig:
    """When a lid lies on a part.

    Raises:
        ValueError: if a number is not between 0 and 1.
    """

    covers: float = 0.5
    """How much of the part a lid covers at least, seen from above (fraction): a seat does not cover its cistern."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def lid_on(node: PartNode, completion: GraphCompletion, touch: float, config: LidAboveConfig = LidAboveConfig()) -> str:
    """Returns the lid that lies on a part and on no other; empty for none.

    A lid is a level plate that the input calls a door. A drawer below one leaves the lid to the case that it is in.
    What is flatter than `touch` is a mirror or a pane in the lid, and carries nothing.

    Args:
        node: the part, guessed to be a door or drawer.
        completion: what was completed; its furniture stands on -Z.
        touch: how far a lid is above what it lies on at most, metres.
        config: what counts as lying on it.
    """
    near = completion.input.neighbours
    for name in sorted(near[node.id]):
        lid = completion.input.node(name)
        if lid.label is not PartLabel.DOOR or lid.box.thin_axis != _UP or not _lies_on(lid.box, node.box, touch):
            continue
        others = (completion.input.node(other) for other in near[name] if other != node.id)
        own = {name, *(edge.child for edge in completion.completed.attachments if edge.parent == name)}
        is_alone = not any(
            _lies_on(lid.box, o.box, touch) for o in others if o.id not in own and o.box.size[_UP] > touch
        )
        if is_alone and _covered(node.box, lid.box) >= config.covers:
            return name
    return ""


def _lies_on(lid: Box, below: Box, touch: float) -> bool:
    return bool(lid.low[_UP] >= below.high[_UP] - touch and below.low[_UP] < lid.low[_UP])


def _covered(box: Box, lid: Box) -> float:
    """Returns how much of a box a lid covers, seen from above (fraction)."""
    shared = np.minimum(lid.high, box.high)[:_UP] - np.maximum(lid.low, box.low)[:_UP]
    return float(np.prod(np.maximum(shared, 0.0) / np.maximum(box.size[:_UP], 1e-9)))
