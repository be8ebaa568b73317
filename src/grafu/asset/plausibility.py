"""What a name states, held against the shape of what it names. It reads no files.

A word is evidence: a `drawer` that holds the rest of the object is its body, a strip of a few millimetres is no door, a
`slide` as large as a door is no hardware. A name that mentions a door or drawer beside what it states it is
(`drawer_stairs`, `drawer_sprocket`) is believed where the part is a plate at the outside.
"""

from dataclasses import dataclass, replace
from typing import Final, final

import numpy as np

from grafu.asset.labels import is_appliance, sense_of
from grafu.asset.languages import word_set
from grafu.asset.names import spoken
from grafu.asset.part import Part
from grafu.geometry.arrays import Scalars
from grafu.geometry.box import Box
from grafu.vocabulary import PartLabel

BODY: Final = PartLabel.SIDE_PANEL
"""What a body in one piece is labelled, as in what the network was trained on: it carries hinges and rails."""
# Fractions of the object's sides.
_WHOLE = 0.85  # a part that takes this much of each of them is the body, if it holds others
_BODY = 0.5  # what is called a cabinet, a desk, a bed, and takes this much of each, is
_SPARE = 0.02  # how far what a body holds may stand out of it
# Fractions of the object's largest side.
_STRIP = 0.025  # the second largest side of a door or drawer
_FITTING, _GRASPED = 0.25, 0.45  # that of a hinge or a rail, and of a handle
_PLATE, _OUTSIDE = 0.07, 0.06  # how thick a front is, and how far it may lie from the outside
_TOUCH = 0.01  # how far a button may stand off the panel that it sits on
_CONTROLS = word_set("button buttons switch dial display")
_BUTTONS = ("button", "buttons")
# A control panel beside a door: fractions of the door's height and width.
_AS_HIGH, _NEXT, _NARROWER = 0.85, 0.06, 0.6
# A top is a plate: the fraction that its thickness may have of its width.
_THICK = 0.35


@final
@dataclass(frozen=True)
class _Scene:
    """The boxes of all parts, and the box around them."""

    whole: Box
    low: np.ndarray
    high: np.ndarray

    @property
    def extent(self) -> float:
        return max(float(self.whole.size.max()), 1e-12)

    def ratios(self, box: Box) -> Scalars:
        """Returns what fraction a box takes of each side of the whole."""
        return box.size / np.maximum(self.whole.size, 1e-12)

    def held(self, box: Box) -> int:
        """Returns how many other parts, more than specks, lie in a box."""
        spare = _SPARE * self.extent
        inside = np.all(self.low >= box.low - spare, axis=1) & np.all(self.high <= box.high + spare, axis=1)
        sides = np.sort(self.high - self.low, axis=1)
        others = (sides[:, 1] > _STRIP * self.extent) & np.any(self.high - self.low < 0.98 * box.size, axis=1)
        return int((inside & others).sum())


def with_plausible_labels(parts: tuple[Part, ...]) -> tuple[tuple[Part, ...], list[str]]:
    """Returns the parts with the labels that their names give but their shapes deny taken back, and notes on that."""
    if not parts:
        return parts, []
    boxes = [part.box for part in parts]
    low, high = np.array([b.low for b in boxes]), np.array([b.high for b in boxes])
    scene = _Scene(Box(low.min(axis=0), high.max(axis=0)), low, high)
    controls = _controls(parts)
    found = tuple(_judged(part, scene) for part in parts)
    found = tuple(_of_controls(part, controls, scene) for part in found)
    notes = [
        f"{new.source.name} is no {old.label.value} by its shape: {_said(new.label)}"
        for old, new in zip(parts, found, strict=True)
        if new.label is not old.label and old.label is not PartLabel.UNKNOWN
    ]
    return found, notes


def _of_controls(part: Part, controls: list[Box], scene: _Scene) -> Part:
    """Returns an unlabelled panel on which buttons or a display sit as one that is static."""
    if part.label is not PartLabel.UNKNOWN or "panel" not in spoken(part.source.name) or not controls:
        return part
    if _is_body(part.box, scene) or not any(part.box.overlaps(box, _TOUCH * scene.extent) for box in controls):
        return part
    return replace(part, label=PartLabel.MISC, labelled_by="name")


def with_control_panels(parts: tuple[Part, ...]) -> tuple[Part, ...]:
    """Returns the parts with narrow unlabelled fronts beside a door, with buttons on them, as pieces of the body.

    That is how microwaves are built: the control panel is as high as the door, in its plane, and less wide.
    """
    controls, doors = _controls(parts), [part.box for part in parts if part.label is PartLabel.DOOR]
    if not controls or not doors:
        return parts
    touch = _TOUCH * max(float(np.max(part.box.size)) for part in parts)

    def judged(part: Part) -> Part:
        is_free = part.label is PartLabel.UNKNOWN and any(_is_narrow_beside(part.box, door) for door in doors)
        is_panel = is_free and any(part.box.overlaps(box, touch) for box in controls)
        return replace(part, label=BODY, labelled_by="name") if is_panel else part

    return tuple(judged(part) for part in parts)


def _controls(parts: tuple[Part, ...]) -> list[Box]:
    """Returns the boxes of buttons, switches and displays (`Small_Buttons`, `microbutton`)."""
    named = [(part, spoken(part.source.name)) for part in parts]
    return [part.box for part, said in named if any(w in _CONTROLS or w.endswith(_BUTTONS) for w in said)]


def _is_narrow_beside(box: Box, door: Box) -> bool:
    """Whether a box continues a door's in one direction of its plane, less far than the door itself reaches."""
    thin = door.thin_axis
    common = np.minimum(box.high, door.high) - np.maximum(box.low, door.low)  # negative: a gap
    for along in (k for k in range(3) if k != thin):
        other = 3 - thin - along
        is_as_high = common[other] >= _AS_HIGH * max(box.size[other], door.size[other])
        is_next = -_NEXT * door.size[along] <= common[along] <= _NEXT * door.size[along]
        if is_as_high and is_next and common[thin] > 0 and box.size[along] <= _NARROWER * door.size[along]:
            return True
    return False


def _said(label: PartLabel) -> str:
    return "it is static" if label is PartLabel.MISC else f"it may be a {label.value}" if label.is_movable else "open"


def _judged(part: Part, scene: _Scene) -> Part:
    if part.labelled_by not in ("name", "none"):
        return part
    label = _label(part, scene)
    if label is part.label:
        return part
    return replace(part, label=label, labelled_by="none" if label is PartLabel.UNKNOWN else "name")


def _label(part: Part, scene: _Scene) -> PartLabel:
    """Returns the label that name and shape agree on."""
    box = part.box
    second = float(np.sort(box.size)[1]) / scene.extent
    if part.label.is_movable:
        blurred = sense_of(part.source.name).is_blurred
        if _is_body(box, scene):
            return BODY
        return PartLabel.MISC if second < _STRIP or (blurred and not _is_front(box, scene)) else part.label
    if part.label is PartLabel.HANDLE:
        return PartLabel.UNKNOWN if second > _GRASPED else part.label
    if part.label is PartLabel.MISC and sense_of(part.source.name).is_fitting:
        return PartLabel.UNKNOWN if second > _FITTING else part.label
    if part.label is PartLabel.TOP_PANEL:
        sides = np.sort(box.size)
        return PartLabel.UNKNOWN if sides[0] > _THICK * sides[1] and second > _STRIP else part.label
    if part.label is PartLabel.UNKNOWN:
        return _of_container(part, scene)
    return part.label


def _of_container(part: Part, scene: _Scene) -> PartLabel:
    """Returns the label of a part whose name is that of a piece of furniture: its body, or a front in it."""
    sense = sense_of(part.source.name)
    if not sense.is_container:
        return PartLabel.UNKNOWN
    if sense.mention is not None and _is_front(part.box, scene):
        return sense.mention
    is_body = bool(np.all(scene.ratios(part.box) >= _BODY)) and scene.held(part.box) > 0
    sides = np.sort(part.box.size)
    is_case = is_appliance(part.source.name) and sides[0] > _THICK * sides[1]
    if is_body or is_case:
        return BODY
    is_panel = is_appliance(part.source.name) and "panel" in spoken(part.source.name)
    return PartLabel.MISC if is_panel else PartLabel.UNKNOWN


def _is_body(box: Box, scene: _Scene) -> bool:
    return bool(np.all(scene.ratios(box) >= _WHOLE)) and scene.held(box) > 0


def _is_front(box: Box, scene: _Scene) -> bool:
    """Whether a box is a plate of some size at the outside of the object, facing out."""
    thin = box.thin_axis
    sides = np.sort(box.size) / scene.extent
    gap = min(box.low[thin] - scene.whole.low[thin], scene.whole.high[thin] - box.high[thin]) / scene.extent
    return bool(sides[0] <= _PLATE and sides[1] >= 2 * _STRIP and gap <= _OUTSIDE)
