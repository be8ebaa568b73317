"""The one door between input coordinates and the object frame: decides up, front, scale and place, and says why.

Object frame: metres, Z up, front -Y, standing on z = 0, centred in x and y.
"""

from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.asset.options import LoadOptions
from grafu.asset.orientation import decide_front, front_votes, up_from_parts, vector
from grafu.asset.part import Frame, Part
from grafu.asset.reading import Reading
from grafu.asset.scale import Estimate, estimate_scale, is_normalised, likely_unit
from grafu.errors import AssetError
from grafu.geometry.arrays import Mat4
from grafu.geometry.box import Box
from grafu.geometry.transform import from_rotation

_USUAL_FRONT = {"+Y": "+Z", "-Y": "+Z", "+Z": "-Y", "-Z": "-Y", "+X": "+Z", "-X": "+Z"}


@final
@dataclass(frozen=True)
class _Choice:
    """A decision and what it rests on, in words."""

    value: str
    why: str


def settle_frame(reading: Reading, options: LoadOptions) -> Frame:
    """Returns how the reading's coordinates become the object frame; what the user states wins.

    Raises:
        AssetError: if the user's front lies on the axis that is up, or the object has no height.
    """
    whole = whole_box(reading.parts)
    up = _up(reading, options, whole)
    front = _front(reading, options, whole, up.value)
    rotation = np.stack([np.cross(-vector(front.value), vector(up.value)), -vector(front.value), vector(up.value)])
    scale, size_words = _scale(reading, options, whole, "XYZ".index(up.value[1]))
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
    usual = "+X" if reading.kind == "urdf" and up[1] != "X" else _USUAL_FRONT[up]
    front, why = decide_front(votes, stated, usual)
    reasons = {
        "geometry": "doors, drawers, handles or the back panel face or open there",
        "convention": f"stated by {convention.origin}",
        "habit": "assumed, as nothing tells the sides apart; --front changes it",
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
