"""The one door between input coordinates and the object frame: decides up, front, scale and place, and states why.

Object frame: metres, Z up, front -Y, standing on z = 0, centred in x and y. Up and front are found from labelled boxes;
no joint is asked.
"""

from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.asset.options import DIRECTIONS, LoadOptions
from grafu.asset.part import ROBOTS, Frame, Part
from grafu.asset.reading import Reading
from grafu.asset.scale import Estimate, estimate_scale, is_normalised, likely_unit
from grafu.errors import AssetError
from grafu.geometry.arrays import Mat4, Vec3
from grafu.geometry.box import Box
from grafu.geometry.transform import from_rotation
from grafu.vocabulary import PartLabel

_LYING = (PartLabel.TOP_PANEL, PartLabel.BOTTOM_PANEL, PartLabel.SHELF)
_STANDING = (PartLabel.SIDE_PANEL, PartLabel.BACK_PANEL, PartLabel.DOOR, PartLabel.DIVIDER)

# Moving bodies smaller than this fraction of the object (a tap, a lever) do not tell where its front is.
_TELLING = 0.2
# Nor does a bulky part that ends farther inside than this fraction of the object's largest side.
_REACHES = 0.05
# Evidence overrules a convention only where it is nearly unanimous.
_UNANIMOUS, _NEGLIGIBLE = 0.7, 0.1


def vector(direction: str) -> Vec3:
    """Returns the unit vector that a direction like `-Y` means."""
    unit = np.zeros(3)
    unit["XYZ".index(direction[1])] = 1.0 if direction[0] == "+" else -1.0
    return unit


def spelled(axis: int, positive: bool) -> str:
    """Returns the direction along an axis, like `-Y`."""
    return f"{'+' if positive else '-'}{'XYZ'[axis]}"


def up_from_parts(parts: tuple[Part, ...], whole: Box) -> str | None:
    """Returns the upward direction that labelled parts agree on, or None where they say nothing."""
    axis_votes, sense = np.zeros(3), np.zeros(3)
    for part in parts:
        thin = part.box.thin_axis
        if part.label in _LYING:
            axis_votes[thin] += 1.0
        elif part.label in _STANDING:
            axis_votes[thin] -= 1.0
        offset = (part.box.center - whole.center) / np.maximum(whole.half, 1e-12)
        weight = {PartLabel.TOP_PANEL: 1.0, PartLabel.BOTTOM_PANEL: -1.0, PartLabel.LEG: -1.0}.get(part.label, 0.0)
        sense += weight * offset
    if not axis_votes.any() and not sense.any():
        return None
    score = axis_votes + np.abs(sense)
    axis = int(np.argmax(score))
    if score[axis] <= 0 or (score >= score[axis] - 1e-9).sum() > 1:
        return None
    return spelled(axis, bool(sense[axis] >= 0))


def front_votes(parts: tuple[Part, ...], whole: Box, up: str) -> dict[str, float]:
    """Returns how much speaks for each horizontal direction as the front.

    Doors and drawers vote for the side that they face, handles for the side that they stick out of, back panels for
    the opposite side.
    """
    votes = {d: 0.0 for d in DIRECTIONS if d[1] != up[1]}
    for part in parts:
        if part.label in (PartLabel.DOOR, PartLabel.DRAWER):
            if part.box.size.max() >= _TELLING * whole.size.max():
                _add(votes, _side(part, whole, votes), 1.0)
        elif part.label is PartLabel.HANDLE:
            _add(votes, _nearest_side(part.box, whole, votes), 0.5)
        elif part.label is PartLabel.BACK_PANEL:
            side = _side(part, whole, votes)
            _add(votes, side and spelled("XYZ".index(side[1]), side[0] == "-"), 0.75)
    return votes


def decide_front(votes: dict[str, float], stated: str | None, usual: str) -> tuple[str, str]:
    """Returns the front and, in words, what it rests on: the convention unless nearly everything speaks against it."""
    total = sum(votes.values())
    best = max(votes, key=lambda d: (votes[d], d == usual))
    if stated is not None:
        against = total > 0.9 and votes[best] >= _UNANIMOUS * total and votes.get(stated, 0.0) <= _NEGLIGIBLE * total
        return (best, "geometry") if against else (stated, "convention")
    clear = total > 0 and sum(v >= votes[best] - 1e-9 for v in votes.values()) == 1
    return (best, "geometry") if clear else (usual, "habit")


def _add(votes: dict[str, float], direction: str | None, weight: float) -> None:
    if direction is not None:
        votes[direction] += weight


def _side(part: Part, whole: Box, votes: dict[str, float]) -> str | None:
    """Returns the side of the object that a part's thin axis faces, or for a bulky part the side nearest to it."""
    horizontal = sorted({"XYZ".index(d[1]) for d in votes})
    size = part.box.size[horizontal]
    thin = horizontal[int(np.argmin(size))]
    if size.min() > 0.4 * size.max():
        return _nearest_side(part.box, whole, votes)
    offset = part.box.center[thin] - whole.center[thin]
    return spelled(thin, bool(offset > 0)) if abs(offset) > 0.1 * whole.half[thin] else None


def _nearest_side(box: Box, whole: Box, votes: dict[str, float]) -> str | None:
    """Returns the side of the object that a part reaches most nearly, or None where it reaches two or none."""
    gaps = {}
    for direction in votes:
        axis = "XYZ".index(direction[1])
        outward = whole.high[axis] - box.high[axis] if direction[0] == "+" else box.low[axis] - whole.low[axis]
        gaps[direction] = float(outward) / max(float(whole.size.max()), 1e-12)
    first, second = sorted(gaps.values())[:2]
    return min(gaps, key=lambda d: gaps[d]) if second - first > 0.01 and first <= _REACHES else None


_USUAL_FRONT = {"+Y": "+Z", "-Y": "+Z", "+Z": "-Y", "-Z": "-Y", "+X": "+Z", "-X": "+Z"}


@final
@dataclass(frozen=True)
class _Choice:
    """A decision and what it rests on, in words."""

    value: str
    why: str


def settle_frame(reading: Reading, options: LoadOptions, file: Frame | None = None) -> Frame:
    """Returns how the reading's coordinates become the object frame; what the user states wins.

    Of one piece of a file, `file` is the frame that the file has as a whole: up and scale are the same for all pieces.

    Raises:
        AssetError: if the user's front lies on the axis that is up, or the object has no height.
    """
    whole = whole_box(reading.parts)
    up = _up(reading, options, whole) if file is None else _Choice(file.up, "as in the whole file")
    front = _front(reading, options, whole, up.value)
    rotation = np.stack([np.cross(-vector(front.value), vector(up.value)), -vector(front.value), vector(up.value)])
    if file is None:
        scale, size_words = _scale(reading, options, whole, "XYZ".index(up.value[1]))
    else:
        scale, size_words = file.scale, file.assumed[-1]
    T = _placed(scale, rotation, whole)
    said = (f"up is {up.value}: {up.why}", f"front is {front.value}: {front.why}", size_words)
    return Frame(T, up.value, front.value, scale, said)


def whole_box(parts: tuple[Part, ...]) -> Box:
    """Returns the box around all parts."""
    return Box.enclosing(part.box for part in parts)


def _placed(scale: float, rotation: np.ndarray, whole: Box) -> Mat4:
    linear = scale * rotation
    turned = whole.corners() @ linear.T
    low, high = turned.min(axis=0), turned.max(axis=0)
    return from_rotation(linear, -np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]]))


def _up(reading: Reading, options: LoadOptions, whole: Box) -> _Choice:
    convention = reading.convention
    if options.up is not None:
        return _Choice(options.up, "stated by the user")
    if convention.up is not None:
        return _Choice(convention.up, f"stated by {convention.origin}")
    if options.front is not None and options.front[1] == convention.usual_up[1]:
        other = "+Z" if convention.usual_up == "+Y" else "+Y"
        return _Choice(up_from_parts(reading.parts, whole) or other, "left over by the user's front")
    found = up_from_parts(reading.parts, whole)
    if found is not None:
        return _Choice(found, "from the places and thin sides of labelled panels and legs")
    return _Choice(convention.usual_up, f"assumed by {convention.origin}; --up changes it")


def _front(reading: Reading, options: LoadOptions, whole: Box, up: str) -> _Choice:
    if options.front is not None:
        if options.front[1] == up[1]:
            raise AssetError(f"--front {options.front} lies on the axis that is up ({up}); state --up as well")
        return _Choice(options.front, "stated by the user")
    convention = reading.convention
    stated = convention.front if convention.front is not None and convention.front[1] != up[1] else None
    votes = front_votes(reading.parts, whole, up)
    usual = "+X" if reading.kind in ROBOTS and up[1] != "X" else _USUAL_FRONT[up]
    front, why = decide_front(votes, stated, usual)
    reasons = {
        "geometry": "doors, drawers, handles or the back panel face or open there",
        "convention": f"stated by {convention.origin}",
        "habit": "assumed, as all sides look alike; --front changes it",
    }
    return _Choice(front, reasons[why])


def _scale(reading: Reading, options: LoadOptions, whole: Box, up: int) -> tuple[float, str]:
    height = float(whole.size[up])
    if options.height is not None:
        if height <= 0:
            raise AssetError(
                f"--height {options.height} cannot be met: the object has no extent along its vertical axis"
            )
        return options.height / height, f"scale {options.height / height:.6g} m per unit: the user states the height"
    if options.scale is not None:
        return options.scale, f"scale {options.scale:.6g} m per unit: stated by the user"
    estimate = estimate_scale(reading.parts, whole, up, reading.furniture)
    unit = reading.convention.unit
    size = float(whole.size.max())
    if unit is not None and 0.1 <= size * unit <= 8.0:
        return unit, f"scale {unit:g} m per unit: stated by {reading.convention.origin}"
    if not reading.convention.normalised and not is_normalised(reading.parts, whole):
        common = likely_unit(size, estimate)
        if common is not None:
            why = f"{common[0]} make a {estimate.kind} of plausible size; --scale changes it"
            return common[1], f"scale {common[1]:g} m per unit: {why}"
    return estimate.scale, _estimated(estimate, height)


def _estimated(estimate: Estimate, height: float) -> str:
    basis = ", ".join(estimate.measures[:4])
    metres = f"{height * estimate.scale:.2f} m high"
    return (
        f"scale {estimate.scale:.6g} m per unit ({metres}): estimated for a {estimate.kind} piece from {basis}; "
        "--height changes it"
    )
