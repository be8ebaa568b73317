"""Where pivots may lie: on the axis that was asked for, in the corner of a door's border, or further inside it."""

from grafu.geometry.axis import Axis
from grafu.joints.fold_config import FoldConfig
from grafu.joints.hinge.candidates import PIVOTS, PinCandidate, Tolerances, turns_about_itself
from grafu.joints.hinge_config import HingeConfig
from grafu.scene.border import BorderFrame
from grafu.vocabulary import MechanismClass


def pivot_pins(frame: BorderFrame, axis: Axis, tol: Tolerances, config: HingeConfig) -> list[PinCandidate]:
    """Returns the pins that discs at the door's ends could carry: the initial axis itself, then the border's corner."""
    radius = max(tol.radius, config.pin.pivot * min(frame.thickness, frame.width))
    x, y, _ = frame.to_border(axis.closest_point(frame.origin)[None])[0]
    spots = [(float(x), float(y))]
    if not turns_about_itself(frame, axis, config):
        spots.append((config.pin.pivot_inset * radius, -config.pin.pivot_inset * radius))
    return [PinCandidate(MechanismClass.C, 0.0, x, y, radius, radius, PIVOTS, is_pivot=True) for x, y in spots]


def inner_pivots(frame: BorderFrame, axis: Axis, tol: Tolerances, config: HingeConfig) -> list[PinCandidate]:
    """Returns the pins of discs further inside a door: about them its edge comes less near to what is beside it."""
    if turns_about_itself(frame, axis, config):
        return []
    pin, radius = config.pin, max(tol.radius, config.pin.pivot * min(frame.thickness, frame.width))
    spots = [(x * radius, -y * radius) for x, y in zip(pin.inner_across, pin.inner_deep, strict=True)]
    within = [(x, y) for x, y in spots if -y + radius <= frame.thickness and x + radius <= frame.width]
    return [PinCandidate(MechanismClass.C, 0.0, x, y, radius, radius, PIVOTS, is_pivot=True) for x, y in within]


def fold_pin(config: FoldConfig) -> PinCandidate:
    """Returns the pin of slim discs close to the outer edge of a leaf that folds."""
    x, y = config.pivot_edge, -config.pivot
    return PinCandidate(MechanismClass.C, 0.0, x, y, config.pivot, config.pivot, PIVOTS, is_pivot=True)
