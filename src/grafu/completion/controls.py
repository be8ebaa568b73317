"""Knobs and dials of appliances: what is called one, and sits on no door or drawer, is asked for no motion of one."""

from dataclasses import replace
from typing import Final

from grafu.asset.labels import APPLIANCES, is_control
from grafu.asset.names import singular, spoken
from grafu.asset.part import Asset
from grafu.graph.completion import GraphCompletion
from grafu.vocabulary import PartLabel, PieceKind

_APPLIANCES: Final = frozenset(
    {PieceKind.OVEN, PieceKind.DISHWASHER, PieceKind.MICROWAVE, PieceKind.REFRIGERATOR, PieceKind.WASHING_MACHINE}
)


def without_controls(completion: GraphCompletion, asset: Asset) -> GraphCompletion:
    """Returns the completion without the refusals of handles of an appliance that are its controls by their names.

    The knob of an oven is no handle that misses its door. On other furniture it may be one, and stays refused.
    """
    is_seen = completion.piece is not None and completion.piece.kind in _APPLIANCES
    if not is_seen and APPLIANCES.isdisjoint(singular(word) for word in spoken(asset.name)):
        return completion
    handles = {node.id for node in completion.completed.labelled(PartLabel.HANDLE)}
    controls = {part.id for part in asset.parts if part.id in handles and is_control(part.source.name)}
    return replace(completion, refused=tuple(r for r in completion.refused if r.part not in controls))
