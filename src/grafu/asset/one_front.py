"""Objects that are one door, drawer or handle are joined: those without a name, and those of one name with numbers."""

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from typing import Final, final

import numpy as np

from grafu.asset.appliance_fronts import named_first
from grafu.asset.cutting import is_divided, turn_of
from grafu.asset.part import Frame
from grafu.asset.pieces import in_words, with_pieces
from grafu.asset.reading import Reading
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive
from grafu.geometry.mesh import TriangleMesh
from grafu.segmentation.boxes_in_case import boxes_in_cases
from grafu.segmentation.joining import joined_objects
from grafu.vocabulary import PartLabel

# What Blender calls the others of one name: copies of an object, and the shells into which it was separated.
_COPY: Final = re.compile(r"(?:[-_. ]*\d+)+$")


@final
@dataclass(frozen=True, slots=True)
class HeldTogetherConfig:
    """Which plates a strip across their seam holds together. Lengths along it are multiples of its width.

    Raises:
        ValueError: if a number is not above 0.
    """

    long: float = 6.0
    """Length of a strip at least; what is shorter is a plate."""
    along: float = 2.0
    """How far it reaches along each plate at least ..."""
    on: float = 0.5
    """... and how much of its width lies on it."""
    slack: float = 0.005
    """How far a strip may stand out of the outline of the plates, or before it (fraction of their largest side)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


def joined_where_nameless(reading: Reading, frame: Frame) -> Reading:
    """Returns the reading with objects joined that no name tells and that are one door, drawer or handle; with notes.

    A front that is joined with the boards of a box which stands in its case is a drawer.

    Args:
        reading: what was read.
        frame: how it stands; its unit does not matter.
    """
    if not reading.parts or is_divided(reading):
        return reading
    nameless = [part.label is PartLabel.UNKNOWN and part.carried_by is None for part in reading.parts]
    if sum(nameless) < 2:
        return reading
    T = turn_of(frame)
    meshes = [part.mesh.transformed(T) for part in reading.parts]
    groups = joined_objects(meshes, nameless, handles=[part.label is PartLabel.HANDLE for part in reading.parts])
    drawers = {group[0] for group in _with_boxes(meshes, groups)}
    parts = (
        replace(part, label=PartLabel.DRAWER, labelled_by="shape") if k in drawers else part
        for k, part in enumerate(reading.parts)
    )
    return _joined(replace(reading, parts=tuple(parts)), groups)


def _with_boxes(meshes: Sequence[TriangleMesh], groups: Sequence[tuple[int, ...]]) -> list[tuple[int, ...]]:
    """Returns the groups whose first object is a front, and the others the box of a drawer in its case."""
    fronts, boards = {group[0] for group in groups}, {k for group in groups for k in group[1:]}
    count = range(len(meshes))
    found = boxes_in_cases(meshes, [k in fronts for k in count], [k in boards for k in count])
    return [group for group in groups if group[0] in found and {*found[group[0]]} <= {*group}]


def has_copies(reading: Reading) -> bool:
    """Whether several doors or drawers have one name and numbers."""
    return any(_with_copies(reading)[1])


def joined_where_one_name(reading: Reading, frame: Frame, config: HeldTogetherConfig = HeldTogetherConfig()) -> Reading:
    """Returns the reading with objects joined that are one door or drawer and have one name, numbered; with notes.

    `Door`, `Door.001` and `Door.002` are three doors, or the stiles and the panel of one: an object that was separated
    into its shells. Which, geometry tells as it does where there are no names.
    Handles among them stay objects of their own.
    Plates that a strip of their name lies across, in their outline, cannot move one without the other: a stile over two
    panels. A strip along the seam of two doors hides that seam, and a rail above both carries them.

    Args:
        reading: what was read.
        frame: how it stands; its unit does not matter.
        config: which strips hold plates together.
    """
    stems, shared = _with_copies(reading)
    if not any(shared):
        return reading
    T = turn_of(frame)
    meshes = [part.mesh.transformed(T) for part in reading.parts]
    found = joined_objects(meshes, shared, has_name=True)
    own = (tuple(k for k in group if stems[k] == stems[group[0]]) for group in found)
    groups = [group for group in own if len(group) > 1]
    done = {stems[group[0]] for group in groups}
    for stem in dict.fromkeys(s for s, is_shared in zip(stems, shared, strict=True) if is_shared and s not in done):
        groups += _held_together({k: meshes[k].box for k, s in enumerate(stems) if s == stem and shared[k]}, config)
    seen = {group[0] for group in groups}  # fronts by their shape: what else their names hold no longer matters
    parts = (replace(part, labelled_by="shape") if k in seen else part for k, part in enumerate(reading.parts))
    return _joined(replace(reading, parts=tuple(parts)), groups)


def _held_together(boxes: dict[int, Box], config: HeldTogetherConfig) -> list[tuple[int, ...]]:
    """Returns the plates (Z up, front -Y) that strips hold together, the largest first, with what lies on them."""
    strips = {k: box for k, box in boxes.items() if max(box.size[[0, 2]]) >= config.long * min(box.size[[0, 2]])}
    sets = [{k} for k in boxes if k not in strips]
    for strip in strips.values():
        crossed = [held for held in sets if any(_lies_along(strip, boxes[k], config) for k in held)]
        if len(crossed) > 1 and _is_on(strip, [boxes[k] for held in crossed for k in held], config):
            sets = [held for held in sets if held not in crossed] + [set().union(*crossed)]
    found = []
    for held in (held for held in sets if len(held) > 1):
        plates = [boxes[k] for k in held]
        others = [k for k, box in boxes.items() if k not in held and _is_on(box, plates, config)]
        found.append((*sorted(held, key=lambda k: (-boxes[k].volume, k)), *others))
    return found


def _lies_along(strip: Box, plate: Box, config: HeldTogetherConfig) -> bool:
    """Whether a strip lies on a plate far along itself, and with much of its width."""
    along = 0 if strip.size[0] > strip.size[2] else 2
    common = np.minimum(strip.high, plate.high) - np.maximum(strip.low, plate.low)
    width = float(strip.size[2 - along])
    is_on = common[2 - along] >= config.on * width and common[along] >= config.along * width
    return bool(is_on and common[1] >= 0)


def _is_on(box: Box, plates: Sequence[Box], config: HeldTogetherConfig) -> bool:
    """Whether a box lies in the outline of plates and meets them in depth, and does not stand out before them."""
    whole = Box.enclosing(plates)
    slack = config.slack * float(whole.size.max())
    inside = (box.low[[0, 2]] >= whole.low[[0, 2]] - slack) & (box.high[[0, 2]] <= whole.high[[0, 2]] + slack)
    ahead = float(whole.low[1] - box.low[1])
    return bool(inside.all() and box.high[1] >= whole.low[1] and ahead <= max(slack, float(whole.size[1])))


def _with_copies(reading: Reading) -> tuple[list[str], list[bool]]:
    """Returns the name of each door and drawer without its number, and whether it has that in common with others."""
    if is_divided(reading):
        return [], []
    stems = [_COPY.sub("", part.source.name) if part.label.is_movable else "" for part in reading.parts]
    count = Counter(stems)
    return stems, [bool(s) and count[s] > 1 and p.carried_by is None for s, p in zip(stems, reading.parts, strict=True)]


def _joined(reading: Reading, groups: Sequence[tuple[int, ...]]) -> Reading:
    """Returns the reading with each group joined to its first part, or to that which bears an appliance's name."""
    groups = [named_first(reading.parts, group) for group in groups]
    joined = {k: group[0] for group in groups for k in group[1:]}
    members = {group[0]: [reading.parts[k] for k in group[1:]] for group in groups}
    ids = {reading.parts[k].id: reading.parts[host].id for k, host in joined.items()}
    kept = [k for k in range(len(reading.parts)) if k not in joined]
    parts = tuple(with_pieces(reading.parts[k], members.get(k, []), ids) for k in kept)
    notes = (f"{in_words(found)} joined to {reading.parts[k].source.name}" for k, found in members.items())
    return replace(reading, parts=parts, notes=(*reading.notes, *notes))
