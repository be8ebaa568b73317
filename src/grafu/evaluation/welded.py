"""Synthetic furniture whose parts are welded together: a test set for models that were never divided into parts.

Of every second piece, all doors, drawers and handles are one segment; of the others all boards, too, are one mesh. A
method is given what the reader finds in it, as for any input; the truth is that of the piece as it was before. Shells
stay shells: boards that lie on each other are not melted into one surface. It measures nothing.
"""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Final, Literal

import numpy as np

from grafu.asset.options import LoadOptions
from grafu.asset.part import Asset, Part, PartSource
from grafu.asset.reading import Convention, Reading
from grafu.asset.settling import settled
from grafu.errors import UnsegmentedAsset
from grafu.geometry.box import Box
from grafu.vocabulary import PartLabel

WELDED: Final = "welded"
Weld = Literal["fronts in one segment", "all in one mesh"]
SAME: Final = 0.5  # of the union of two boxes that they must have in common to be one part
_CONVENTION: Final = Convention("welded furniture (Z up)", up="+Z", front="-Y", usual_up="+Z")
_AS_IT_IS: Final = LoadOptions(up="+Z", front="-Y", scale=1.0)
_LOOSE: Final = (PartLabel.DOOR, PartLabel.DRAWER, PartLabel.HANDLE)


def weld_of(number: int) -> Weld:
    """Returns what is welded of piece `number`."""
    return "all in one mesh" if number % 2 else "fronts in one segment"


def welded(asset: Asset, how: Weld) -> Asset:
    """Returns what the reader makes of a piece whose parts are welded, without joints.

    What it finds where a part of the piece was has that part's id, so that motions can be compared; its name is left
    out, and labels are those that the reader gives.

    Raises:
        AssetError: if the reader refuses it for another reason than that it finds no front.
    """
    parts = _welded_parts(asset, how)
    reading = Reading("glb", parts, _CONVENTION, None, None, (), grouped=False)
    try:
        found = settled(reading, asset.name, Path(asset.path), _AS_IT_IS)
    except UnsegmentedAsset:  # no front is found in it: it is given as it is, and nothing of it will move
        return replace(asset.without_annotation(), parts=parts)
    return _named_alike(_laid_back(found.without_annotation()), asset)


def _welded_parts(asset: Asset, how: Weld) -> tuple[Part, ...]:
    loose = [part for part in asset.parts if how == "all in one mesh" or part.label in _LOOSE]
    surfaces = tuple(surface for part in loose for surface in part.surfaces)
    body = tuple(replace(part, carried_by=None) for part in asset.parts if part not in loose)
    return (*body, Part(WELDED, PartLabel.UNKNOWN, surfaces, PartSource(WELDED)))


def _laid_back(found: Asset) -> Asset:
    """Returns the asset where the piece stood: the reader centres what it reads."""
    T = np.linalg.inv(found.frame.input_to_output)
    parts = (replace(part, surfaces=tuple(one.transformed(T) for one in part.surfaces)) for part in found.parts)
    return replace(found, parts=tuple(parts))


def _named_alike(found: Asset, truth: Asset) -> Asset:
    """Returns the asset with the ids of the true parts whose boxes its parts have, the best matches first."""
    pairs = sorted(
        ((_overlap(part.box, true.box), part.id, true.id) for part in found.parts for true in truth.parts),
        key=lambda pair: (-pair[0], pair[1], pair[2]),
    )
    ids: dict[str, str] = {}
    for ratio, own, theirs in pairs:
        if ratio >= SAME and own not in ids and theirs not in ids.values():
            ids[own] = theirs
    taken = {part.id for part in truth.parts}
    for part in found.parts:
        name = ids.get(part.id, part.id)
        while part.id not in ids and name in taken:
            name += "_"
        ids.setdefault(part.id, name)
        taken.add(ids[part.id])
    return replace(found, parts=tuple(_renamed(part, ids) for part in found.parts))


def _renamed(part: Part, ids: Mapping[str, str]) -> Part:
    return replace(part, id=ids[part.id], carried_by=ids.get(part.carried_by or ""))


def _overlap(one: Box, other: Box) -> float:
    """Returns the volume that two boxes share over that of both; a flat box is a millimetre thick."""
    low, high = _thick(one), _thick(other)
    sides = [min(a[1], b[1]) - max(a[0], b[0]) for a, b in zip(low, high, strict=True)]
    if min(sides) <= 0:
        return 0.0
    shared = sides[0] * sides[1] * sides[2]
    return shared / (_volume(low) + _volume(high) - shared)


_FLAT: Final = 0.001


def _thick(box: Box) -> list[tuple[float, float]]:
    return [(float(a), max(float(b), float(a) + _FLAT)) for a, b in zip(box.low, box.high, strict=True)]


def _volume(sides: list[tuple[float, float]]) -> float:
    return (sides[0][1] - sides[0][0]) * (sides[1][1] - sides[1][0]) * (sides[2][1] - sides[2][0])
