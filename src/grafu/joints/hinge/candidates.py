"""Where a door may turn: hinge class by hinge class, the pins that the surroundings allow.

Each class is a row of `_RULES` (paper, figure Hinge Configurations). `roll` turns the template about its pin: 0 mounts
it from the door's front, 90 degrees from the side (the seam behind an overlay door).

Fits hinges of one template to one pin: size, count, heights, and the hardware in the object frame.

It builds; whether the hardware is in anything's way is judged by `place`.
"""

from collections.abc import Callable, Iterator
from functools import cached_property
from math import ceil, pi
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Visual, VisualRole
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat4, vec3
from grafu.geometry.axis import Axis
from grafu.geometry.bvh import share_shape
from grafu.geometry.transform import from_rotation, rotation_matrix
from grafu.joints.concealed_config import ConcealedConfig
from grafu.joints.hinge.survey import BorderSurvey
from grafu.joints.hinge_config import HingeConfig, PinConfig
from grafu.scene.border import BorderFrame
from grafu.templates.template import HingeModel, HingeSize, HingeTemplate, TemplateEnd
from grafu.vocabulary import MechanismClass, PartLabel

PIVOTS, MAKESHIFT = 4, 5  # preferences: of pivots after C, F, P and inset leaves, of makeshift mounts after all
_HEIGHT_SHIFTS = (0.0, 0.04, -0.04, 0.08, -0.08, 0.12, -0.12, 0.2, -0.2, 0.28, -0.28, 0.31, -0.31)


@final
@dataclass(frozen=True, slots=True)
class PinCandidate:
    """A pin at (x, y) of the border frame with the class that would carry it.

    `leaf_room` is how far a leaf may reach from the pin before it leaves the narrower of its two faces, `radius` that
    of the barrel, for which the pin's place is right; `preference`
    orders classes (lower is better: C, F, P as in the paper, then pivots, then makeshift mounts). `inset` states that
    the static leaf is carried on through the seam into what stands behind the door; `is_pivot` that discs at its ends
    carry the door, `is_concealed` that cup hinges do.
    """

    mechanism: MechanismClass
    roll: float
    x: float
    y: float
    leaf_room: float
    radius: float
    preference: int
    inset: bool = False
    is_pivot: bool = False
    is_concealed: bool = False


@final
@dataclass(frozen=True, slots=True)
class Tolerances:
    """Metres: widest seam that counts as contact, largest step that counts as flush, barrel radius of the hinge."""

    contact: float
    flush: float
    radius: float


_Rule = Callable[[BorderFrame, BorderSurvey, Tolerances, PinConfig], PinCandidate | None]


def _contact_front(frame: BorderFrame, s: BorderSurvey, tol: Tolerances, config: PinConfig) -> PinCandidate | None:
    """C beside an inset door: the leaves lie in the seam, the barrel in front of it."""
    seam = min(tol.contact, config.widest_seam * tol.radius)
    if not (s.side_gap <= seam and s.side_top <= config.proud * tol.radius):
        return None
    depth = min(frame.board, s.side_depth) if s.side_depth > 0 else frame.board
    room = tol.radius + config.edge_leaf * depth
    return PinCandidate(MechanismClass.C, 0.0, -max(s.side_gap, 0.0) / 2, tol.radius, room, tol.radius, 0)


def _contact_behind(frame: BorderFrame, s: BorderSurvey, tol: Tolerances, config: PinConfig) -> PinCandidate | None:
    """C behind an overlay door: the leaves lie between its back and the carcass, the barrel beside both.

    Where the carcass is wider than the door, the barrel stands beside it, off the door by that much.
    """
    strip = max(0.0, -s.side_face)
    seam = min(tol.contact, config.widest_seam * tol.radius)
    if not (s.back_gap <= seam and strip <= config.widest_strip * tol.radius):
        return None
    room = tol.radius + strip + max(config.edge_leaf * s.back_width, 2 * tol.radius)
    y = -frame.thickness - max(s.back_gap, 0.0) / 2
    return PinCandidate(MechanismClass.C, pi / 2, -strip - tol.radius, y, room, tol.radius, 0)


def _flush_front(frame: BorderFrame, s: BorderSurvey, tol: Tolerances, config: PinConfig) -> PinCandidate | None:
    """F across the seam of an inset door: both leaves on the fronts."""
    if not (s.side_gap <= tol.contact and abs(s.side_top) <= tol.flush):
        return None
    y = max(0.0, s.side_top) + tol.radius
    room = config.front_leaf * frame.width
    return PinCandidate(MechanismClass.F, 0.0, -max(s.side_gap, 0.0) / 2, y, room, tol.radius, 1)


def _flush_side(frame: BorderFrame, s: BorderSurvey, tol: Tolerances, config: PinConfig) -> PinCandidate | None:
    """F across the seam behind an overlay door: both leaves on the outer sides."""
    if not (s.back_gap <= tol.contact and abs(s.side_face) <= tol.flush):
        return None
    x = min(0.0, s.side_face) - tol.radius
    y = -frame.thickness - max(s.back_gap, 0.0) / 2
    room = max(config.edge_leaf * frame.board, 2 * tol.radius)
    return PinCandidate(MechanismClass.F, pi / 2, x, y, room, tol.radius, 1)


def _corner_front(frame: BorderFrame, s: BorderSurvey, tol: Tolerances, config: PinConfig) -> PinCandidate | None:
    """P in the corner between an inset door's front and a side that stands out beyond it."""
    if not (s.side_gap <= tol.contact and s.side_top >= 2 * tol.radius):
        return None
    room = min(s.side_top, config.front_leaf * frame.width)
    return PinCandidate(MechanismClass.P, 0.0, tol.radius - max(s.side_gap, 0.0), tol.radius, room, tol.radius, 2)


def _corner_side(frame: BorderFrame, s: BorderSurvey, tol: Tolerances, config: PinConfig) -> PinCandidate | None:
    """P in the corner between an overlay door's edge and the frame that it lies on."""
    strip = max(s.beside_width, -s.side_face if np.isfinite(s.side_face) else 0.0)
    if not (s.back_gap <= tol.contact and strip >= config.corner_strip * tol.radius):
        return None
    y = -frame.thickness - max(s.back_gap, 0.0) + tol.radius
    room = min(strip - tol.radius, frame.board)
    return PinCandidate(MechanismClass.P, pi / 2, -tol.radius, y, max(room, 2 * tol.radius), tol.radius, 2)


def _inset_front(frame: BorderFrame, s: BorderSurvey, tol: Tolerances, config: PinConfig) -> PinCandidate | None:
    """C at a door's front edge, its static leaf inset in what stands behind: for doors that meet over one divider.

    Elsewhere the leaf shows edge-on between the door and what it lies on: a last resort.
    """
    if not np.isfinite(s.back_gap):
        return None
    room = tol.radius + config.edge_leaf * frame.board
    preference = 3 if s.meets else MAKESHIFT
    return PinCandidate(MechanismClass.C, 0.0, 0.0, tol.radius, room, tol.radius, preference, inset=True)


def _overhung(frame: BorderFrame, s: BorderSurvey, tol: Tolerances, config: PinConfig) -> PinCandidate | None:
    """P in the corner under the border of a lid that stands out behind its case: one leaf under it, one on the case."""
    if not config.corner_strip * tol.radius <= s.overhang < frame.width / 2:
        return None
    x, y = s.overhang - tol.radius, -frame.thickness - tol.radius
    return PinCandidate(MechanismClass.P, pi, x, y, min(x, config.front_leaf * frame.width), tol.radius, 3)


_RULES: tuple[_Rule, ...] = (
    _contact_front,
    _contact_behind,
    _flush_front,
    _flush_side,
    _corner_front,
    _corner_side,
    _inset_front,
    _overhung,
)


def ruled_pins(frame: BorderFrame, s: BorderSurvey, tol: Tolerances, config: PinConfig) -> list[PinCandidate]:
    """Returns a pin for every hinge class that the surroundings allow."""
    return [candidate for rule in _RULES if (candidate := rule(frame, s, tol, config)) is not None]


def turns_about_itself(frame: BorderFrame, axis: Axis, config: HingeConfig) -> bool:
    """Whether a part is no board and its axis runs through it: a tap, a revolving shelf; not a deep lid."""
    if frame.thickness <= config.chunky * frame.width:
        return False
    x, y, _ = frame.to_border(axis.closest_point(frame.origin)[None])[0]
    ratios = (float(x) / max(frame.width, 1e-9), -float(y) / max(frame.thickness, 1e-9))
    return all(config.inside < ratio < 1 - config.inside for ratio in ratios)


def makeshift_pins(frame: BorderFrame, tol: Tolerances, config: PinConfig) -> Iterator[PinCandidate]:
    """Yields pins at the corners of the border and around them; support blocks will have to reach the body."""
    step = max(tol.radius, config.step * frame.board)
    room = max(config.narrowest * tol.radius, min(config.makeshift_leaf * frame.width, config.widest * tol.radius))
    for x in (steps * step for steps in config.inwards):
        for y in (steps * step + tol.radius for steps in config.before):
            yield PinCandidate(MechanismClass.F, 0.0, x, y, room, tol.radius, MAKESHIFT)
    for x in (-tol.radius, -step - tol.radius):
        for y in (-frame.thickness, -frame.thickness - step, -frame.thickness / 2):
            yield PinCandidate(MechanismClass.F, pi / 2, x, y, room, tol.radius, MAKESHIFT + 1)


def concealed_pins(frame: BorderFrame, config: ConcealedConfig) -> list[PinCandidate]:
    """Returns the axes for a door on concealed hinges, nearest to the linkage's motion first; none for a small door."""
    if frame.thickness < config.thinnest or frame.width < config.narrowest or frame.length < config.shortest:
        return []
    (x, depth), radius = config.axis, config.axis[1]
    return [
        PinCandidate(
            MechanismClass.P, 0.0, ratio * x, -ratio * depth, frame.width, radius, MAKESHIFT, is_concealed=True
        )
        for ratio in config.nearer
    ]


@final
@dataclass(frozen=True)
class FittedHinge:
    """One hinge in the object frame: the template as built and its pose; its two ends are mapped when asked for."""

    template: HingeTemplate
    T_object_template: Mat4

    @cached_property
    def static(self) -> Visual:
        """The static end."""
        return self._visual("hinge_static", self.template.static)

    @cached_property
    def dynamic(self) -> Visual:
        """The moving end."""
        return self._visual("hinge_dynamic", self.template.dynamic)

    def _visual(self, name: str, end: TemplateEnd) -> Visual:
        T = self.T_object_template
        visual = Visual(name, tuple(s.transformed(T) for s in end.surfaces), VisualRole.HARDWARE, PartLabel.MISC)
        share_shape(visual.mesh, end.mesh, T)
        return visual


def barrel_radius(frame: BorderFrame, config: HingeConfig) -> float:
    """Returns the barrel radius that suits a door, metres; a door drawn without thickness counts as a thin board."""
    return max(config.smallest, min(config.radius, config.radius_ratio * frame.board))


def hinge_count(length: float, config: HingeConfig) -> int:
    """Returns how many hinges a border of this length takes, metres: two up to a length, and one more per another."""
    return 2 + max(0, ceil((length - config.two_up_to) / config.one_more_per - 1e-9))


def hinge_heights(length: float, count: int) -> np.ndarray:
    """Returns the z of each hinge: the i-th of N at i / (N + 1) of the height (supplement, Search and Snap)."""
    return (np.arange(1, count + 1) / (count + 1) - 0.5) * length


def heights_to_try(frame: BorderFrame, count: int) -> Iterator[list[float]]:
    """Yields for each hinge the z in the frame at which to try it, its own first.

    From the lowest hinge up, and each shifted up before down: where a pair of doors has to shift hinges, it shifts both
    doors' alike, though the frame of one stands on its head.
    """
    up = -1 if frame.rotation[2, 2] < 0 and abs(frame.rotation[2, 2]) > abs(frame.rotation[:2, 2]).max() else 1
    for z in hinge_heights(frame.length, count)[::up]:
        yield [float(z) + up * ratio * frame.length for ratio in _HEIGHT_SHIFTS]


def hinge_size(
    model: HingeModel, frame: BorderFrame, pin: PinCandidate, count: int, config: HingeConfig, scale: float = 1.0
) -> HingeSize | None:
    """Returns the size at which a model fits a pin; None where its leaves would be no wider than its barrel.

    `scale` multiplies what suits the door; the pin's radius has it already, and hinges still must find room.
    """
    radius = pin.radius
    wanted = scale * min(model.natural.length, config.length_ratio * frame.length)
    length = min(wanted, config.spacing * frame.length / (count + 1))
    leaf = min(scale * model.natural.leaf, pin.leaf_room)
    thickness = min(scale * model.natural.thickness, config.leaf_thickness * radius)
    if not is_leaf(leaf, radius, config) or length < 2 * radius:
        return None
    return HingeSize(length, leaf, thickness, radius)


def is_leaf(width: float, radius: float, config: HingeConfig) -> bool:
    """Whether a leaf so wide, metres from the pin, reaches far enough beyond a barrel of a radius."""
    return width >= config.narrowest_leaf * radius + config.leaf_margin


def fit_hinge(model: HingeModel, size: HingeSize, frame: BorderFrame, pin: PinCandidate, z: float) -> FittedHinge:
    """Returns one hinge of `model` at height z of a pin; names are given by `named`."""
    template = model.build(size)
    T = frame.T_object_border @ from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), pin.roll), vec3(pin.x, pin.y, z))
    return FittedHinge(template, T)
