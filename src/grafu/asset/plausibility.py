"""What a name states, held against the shape of what it names. It reads no files.

A word is evidence: a `drawer` that holds the rest of the object is its body, a strip of a few millimetres is no door, a
`slide` as large as a door is no hardware. A name that mentions a door or drawer beside what it states it is
(`drawer_stairs`, `drawer_sprocket`) is believed where the part is a plate at the outside.
"""

from dataclasses import replace
from typing import Final, final

import numpy as np

from grafu.asset.labels import is_appliance, sense_of
from grafu.asset.languages import word_set
from grafu.asset.names import spoken
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Scalars
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.vocabulary import PartLabel

BODY: Final = PartLabel.SIDE_PANEL
"""What a body in one piece is labelled, as in what the network was trained on: it carries hinges and rails."""
_CONTROLS = word_set("button buttons switch dial display screen lcd keypad clock timer")
_PANELS = frozenset({"panel", "console"})
_BUTTONS = ("button", "buttons")


@final
@dataclass(frozen=True, slots=True)
class PlausibilityConfig:
    """Which shapes deny what a name states.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    whole: float = 0.85
    """What takes this much of each of the object's sides is the body, if it holds others (fraction)."""
    body: float = 0.5
    """What is called a cabinet, a desk or a bed, and takes this much of each, is the body (fraction)."""
    spare: float = 0.02
    """How far what a body holds may stand out of it (fraction of the object's largest side) ..."""
    alike: float = 0.98
    """... and what takes this much of each of the body's sides is the body again (fraction)."""
    strip: float = 0.025
    """Second largest side of a door or drawer at least (fraction of the object's largest side)."""
    fitting: float = 0.25
    """That of a hinge or a rail at most (fraction of the object's largest side) ..."""
    grasped: float = 0.45
    """... and of a handle (fraction of the object's largest side)."""
    plate: float = 0.07
    """Largest thickness of a front (fraction of the object's largest side) ..."""
    outside: float = 0.06
    """... and how far it may lie from the outside (fraction of the object's largest side)."""
    touch: float = 0.01
    """How far a button may stand off the panel that it sits on (fraction of the object's largest side)."""
    band: float = 0.25
    """Greatest height of a band with several buttons on it (fraction of the object's largest side)."""
    as_high: float = 0.85
    """A control panel beside a door has at least this much of its height, and the door of the panel's (fraction) ..."""
    next_to: float = 0.06
    """... is this far from it at most (fraction of the door's width) ..."""
    narrower: float = 0.6
    """... and at most this wide (fraction of the door's width)."""
    flat: float = 0.15
    """Largest thickness of a blind front (fraction of its next side): one with a grip on it is thicker."""
    in_line: float = 0.05
    """How far a blind front's sides may lie from those of the door below it (fraction of the door's largest side)."""
    thick: float = 0.35
    """Largest thickness of a top, and of a door whose name is blurred (fraction of its middle side)."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True)
class _Scene:
    """The boxes of all parts, and the box around them."""

    whole: Box
    low: np.ndarray
    high: np.ndarray
    config: PlausibilityConfig

    @property
    def extent(self) -> float:
        return max(float(self.whole.size.max()), 1e-12)

    def ratios(self, box: Box) -> Scalars:
        """Returns what fraction a box takes of each side of the whole."""
        return box.size / np.maximum(self.whole.size, 1e-12)

    def held(self, box: Box) -> int:
        """Returns how many other parts, more than specks, lie in a box."""
        spare = self.config.spare * self.extent
        inside = np.all(self.low >= box.low - spare, axis=1) & np.all(self.high <= box.high + spare, axis=1)
        sides = np.sort(self.high - self.low, axis=1)
        others = (sides[:, 1] > self.config.strip * self.extent) & np.any(
            self.high - self.low < self.config.alike * box.size, axis=1
        )
        return int((inside & others).sum())

    def is_seen(self, box: Box, axis: int) -> bool:
        """Whether no other part stands before one of the two faces of a box across an axis; what holds it does not."""
        spare = self.config.spare * self.extent
        holds = np.all(self.low <= box.low + spare, axis=1) & np.all(self.high >= box.high - spare, axis=1)
        across = [k for k in range(3) if k != axis]
        common = np.minimum(self.high, box.high) - np.maximum(self.low, box.low)
        beside = np.all(common[:, across] > spare, axis=1) & ~holds
        before = self.high[:, axis] < box.center[axis], self.low[:, axis] > box.center[axis]
        return any(not (beside & ahead).any() for ahead in before)


def with_plausible_labels(
    parts: tuple[Part, ...], config: PlausibilityConfig = PlausibilityConfig()
) -> tuple[tuple[Part, ...], list[str]]:
    """Returns the parts with the labels that their names give but their shapes deny taken back, and notes on that."""
    if not parts:
        return parts, []
    boxes = [part.box for part in parts]
    low, high = np.array([b.low for b in boxes]), np.array([b.high for b in boxes])
    scene = _Scene(Box(low.min(axis=0), high.max(axis=0)), low, high, config)
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
    """Returns an unlabelled panel or narrow band on which buttons or a display sit as one that is static."""
    if part.label is not PartLabel.UNKNOWN or not controls or _is_body(part.box, scene):
        return part
    held = sum(part.box.overlaps(box, scene.config.touch * scene.extent) for box in controls)
    is_band = held > 1 and float(np.sort(part.box.size)[1]) <= scene.config.band * scene.extent
    is_panel = held and (is_band or not _PANELS.isdisjoint(spoken(part.source.name)))
    return replace(part, label=PartLabel.MISC, labelled_by="name") if is_panel else part


def with_bodies(parts: tuple[Part, ...], config: PlausibilityConfig = PlausibilityConfig()) -> tuple[Part, ...]:
    """Returns the parts with unlabelled ones that hold several doors or drawers as the bodies of these.

    What is called a cabinet or the like is a body where it holds one door; behind one drawer it may be the box of that.
    """
    extent = max((float(np.max(part.box.size)) for part in parts), default=1.0)
    spare = config.spare * extent
    fronts = [part for part in parts if part.label.is_movable]

    def judged(part: Part) -> Part:
        if part.label is not PartLabel.UNKNOWN or float(part.box.size.min()) <= config.plate * extent:
            return part
        low, high = part.box.low - spare, part.box.high + spare
        held = [f for f in fronts if (f.box.low >= low).all() and (f.box.high <= high).all()]
        is_case = bool(held) and held[0].label is PartLabel.DOOR and sense_of(part.source.name).is_container
        return replace(part, label=BODY, labelled_by="shape") if is_case or len(held) > 1 else part

    return tuple(judged(part) for part in parts)


def with_control_panels(parts: tuple[Part, ...], config: PlausibilityConfig = PlausibilityConfig()) -> tuple[Part, ...]:
    """Returns the parts with narrow unlabelled fronts beside a door, with buttons on them, as pieces of the body.

    That is how microwaves are built: the control panel is as high as the door, in its plane, and less wide.
    """
    controls, doors = _controls(parts), [part.box for part in parts if part.label is PartLabel.DOOR]
    if not controls or not doors:
        return parts
    touch = config.touch * max(float(np.max(part.box.size)) for part in parts)

    def judged(part: Part) -> Part:
        is_free = part.label is PartLabel.UNKNOWN and any(_is_narrow_beside(part.box, door, config) for door in doors)
        is_panel = is_free and any(part.box.overlaps(box, touch) for box in controls)
        return replace(part, label=BODY, labelled_by="name") if is_panel else part

    return tuple(judged(part) for part in parts)


def _controls(parts: tuple[Part, ...]) -> list[Box]:
    """Returns the boxes of buttons, switches and displays (`Small_Buttons`, `microbutton`)."""
    named = [(part, spoken(part.source.name)) for part in parts]
    return [part.box for part, said in named if any(w in _CONTROLS or w.endswith(_BUTTONS) for w in said)]


def _is_narrow_beside(box: Box, door: Box, config: PlausibilityConfig) -> bool:
    """Whether a box continues a door's in one direction of its plane, less far than the door itself reaches."""
    thin = door.thin_axis
    common = np.minimum(box.high, door.high) - np.maximum(box.low, door.low)  # negative: a gap
    for along in (k for k in range(3) if k != thin):
        other = 3 - thin - along
        is_as_high = common[other] >= config.as_high * max(box.size[other], door.size[other])
        is_next = abs(common[along]) <= config.next_to * door.size[along]
        if is_as_high and is_next and common[thin] > 0 and box.size[along] <= config.narrower * door.size[along]:
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
    box, config = part.box, scene.config
    second = float(np.sort(box.size)[1]) / scene.extent
    if part.label.is_movable:
        blurred = sense_of(part.source.name).is_blurred
        if _is_body(box, scene):
            return BODY
        is_lump = part.label is PartLabel.DOOR and box.size.min() > config.thick * np.sort(box.size)[1]
        denied = blurred and (is_lump or not _is_front(box, scene))
        return PartLabel.MISC if second < config.strip or denied else part.label
    if part.label is PartLabel.HANDLE:
        return PartLabel.UNKNOWN if second > config.grasped else part.label
    if part.label is PartLabel.MISC and sense_of(part.source.name).is_fitting:
        return PartLabel.UNKNOWN if second > config.fitting else part.label
    if part.label is PartLabel.TOP_PANEL:
        sides = np.sort(box.size)
        return PartLabel.UNKNOWN if sides[0] > config.thick * sides[1] and second > config.strip else part.label
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
    is_body = bool(np.all(scene.ratios(part.box) >= scene.config.body)) and scene.held(part.box) > 0
    sides = np.sort(part.box.size)
    is_case = is_appliance(part.source.name) and sides[0] > scene.config.thick * sides[1]
    if is_body or is_case:
        return BODY
    is_panel = is_appliance(part.source.name) and "panel" in spoken(part.source.name)
    return PartLabel.MISC if is_panel else PartLabel.UNKNOWN


def _is_body(box: Box, scene: _Scene) -> bool:
    return bool(np.all(scene.ratios(box) >= scene.config.whole)) and scene.held(box) > 0


def _is_front(box: Box, scene: _Scene) -> bool:
    """Whether a box is a plate of some size that faces out: at the outside of the object, or nothing stands before it.

    The fronts of a staircase with drawers, or of a desk under a bed, lie far inside the object's own box.
    """
    thin = box.thin_axis
    sides = np.sort(box.size) / scene.extent
    gap = min(box.low[thin] - scene.whole.low[thin], scene.whole.high[thin] - box.high[thin]) / scene.extent
    config = scene.config
    is_plate = bool(sides[0] <= config.plate and sides[1] >= 2 * config.strip)
    return is_plate and (bool(gap <= config.outside) or (thin != 2 and scene.is_seen(box, thin)))


def with_blind_fronts(
    parts: tuple[Part, ...], config: PlausibilityConfig = PlausibilityConfig()
) -> tuple[tuple[Part, ...], tuple[str, ...]]:
    """Returns the parts (object frame, handles attached) with blind fronts static, and notes on that.

    What is called a drawer but is a plate without box or handle, right above a door of its width, is a blind front, as
    above a sink, where all other doors and drawers have handles.
    """
    held = {p.carried_by for p in parts}
    plain = [p for p in parts if p.label is PartLabel.DRAWER and p.id not in held]
    others = [p for p in parts if p.label.is_movable and p not in plain]
    doors = [p.box for p in others if p.label is PartLabel.DOOR]
    blind = [p for p in plain if any(_is_blind(p.box, door, config) for door in doors)]
    if len(others) < 2 or len(blind) < len(plain) or not {p.id for p in others} <= held:
        return parts, ()
    notes = tuple(f"{p.source.name}: taken for a blind front, as it alone has no handle and no box" for p in blind)
    static = {p.id: replace(p, label=PartLabel.FACE_FRAME, labelled_by="shape") for p in blind}
    return tuple(static.get(p.id, p) for p in parts), notes


def _is_blind(front: Box, door: Box, config: PlausibilityConfig) -> bool:
    axis, most = front.thin_axis, config.in_line * float(door.size.max())
    if axis == 2 or front.size[axis] > config.flat * np.delete(front.size, axis).min():
        return False
    apart = np.maximum(abs(front.low - door.low), abs(front.high - door.high))[:2]
    return bool(apart.max() <= most and abs(front.low[2] - door.high[2]) <= most)
