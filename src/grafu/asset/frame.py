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
from grafu.asset.scale import Estimate, ScaleConfig, estimate_scale, is_normalised, likely_unit
from grafu.errors import AssetError
from grafu.geometry.arrays import Mat4, Vec3
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.raycast import RayCaster, open_ratios
from grafu.geometry.transform import from_rotation
from grafu.vocabulary import PartLabel

_LYING = (PartLabel.TOP_PANEL, PartLabel.BOTTOM_PANEL, PartLabel.SHELF)
_STANDING = (PartLabel.SIDE_PANEL, PartLabel.BACK_PANEL, PartLabel.DOOR, PartLabel.DIVIDER)


@final
@dataclass(frozen=True, slots=True)
class FrontEvidenceConfig:
    """Which parts show where the front is, and when they overrule what the format or data set states.

    Raises:
        ValueError: if a number is not above 0.
    """

    telling: float = 0.2
    """Largest side of a door or drawer that shows it, over that of the object: a tap or a lever is smaller."""
    reaches: float = 0.05
    """How far inside the object a bulky part may end and still show it (fraction of the object's largest side) ..."""
    clearly: float = 0.01
    """... where it is farther by this from every other side (fraction of the object's largest side)."""
    bulky: float = 0.4
    """Thinner level side over the longer one from which on a part is bulky (ratio)."""
    aside: float = 0.1
    """How far from the object's middle a thin part lies at least to show it (fraction of the object's half side)."""
    handle: float = 0.5
    """Vote of a handle; that of a door or drawer is 1."""
    back: float = 0.75
    """Vote of a back panel, for the opposite side."""
    least: float = 0.9
    """Sum of votes below which they overrule nothing."""
    unanimous: float = 0.7
    """Fraction of the votes that one side must have to overrule what is stated ..."""
    negligible: float = 0.1
    """... and that the stated side may have at most."""
    small: float = 0.08
    """Largest side of a door or drawer that shows it where one of its faces is seen, over that of the object."""
    seen: float = 0.5
    """How much more of one face of a door or drawer than of the other must be seen from outside (fraction)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


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


def front_votes(
    parts: tuple[Part, ...], whole: Box, up: str, config: FrontEvidenceConfig = FrontEvidenceConfig()
) -> dict[str, float]:
    """Returns how much speaks for each horizontal direction as the front.

    Doors and drawers vote for the side that they face, handles for the side that they stick out of, back panels for
    the opposite side. Where these disagree, or say nothing, doors and drawers vote for the side that is seen.
    """
    votes = _votes(parts, whole, up, config)
    if max(votes.values()) > config.unanimous * sum(votes.values()) or not any(p.label.is_movable for p in parts):
        return votes
    return _votes(parts, whole, up, config, RayCaster(merge_meshes([part.mesh for part in parts])))


def _votes(
    parts: tuple[Part, ...], whole: Box, up: str, config: FrontEvidenceConfig, caster: RayCaster | None = None
) -> dict[str, float]:
    votes = {d: 0.0 for d in DIRECTIONS if d[1] != up[1]}
    for part in parts:
        if part.label.is_movable:
            ratio = float(part.box.size.max() / whole.size.max())
            seen = _seen_side(part, caster, votes, config) if caster is not None and ratio >= config.small else None
            _add(votes, seen or (_side(part, whole, votes, config) if ratio >= config.telling else None), 1.0)
        elif part.label is PartLabel.HANDLE:
            _add(votes, _nearest_side(part.box, whole, votes, config), config.handle)
        elif part.label is PartLabel.BACK_PANEL:
            side = _side(part, whole, votes, config)
            _add(votes, side and spelled("XYZ".index(side[1]), side[0] == "-"), config.back)
    return votes


def decide_front(
    votes: dict[str, float], stated: str | None, usual: str, config: FrontEvidenceConfig = FrontEvidenceConfig()
) -> tuple[str, str]:
    """Returns the front and, in words, what it rests on: the convention unless nearly everything speaks against it."""
    total = sum(votes.values())
    best = max(votes, key=lambda d: (votes[d], d == usual))
    if stated is not None:
        for_another = votes[best] >= config.unanimous * total
        against = total > config.least and for_another and votes.get(stated, 0.0) <= config.negligible * total
        return (best, "geometry") if against else (stated, "convention")
    clear = total > 0 and sum(v >= votes[best] - 1e-9 for v in votes.values()) == 1
    return (best, "geometry") if clear else (usual, "habit")


def _add(votes: dict[str, float], direction: str | None, weight: float) -> None:
    if direction is not None:
        votes[direction] += weight


def _side(part: Part, whole: Box, votes: dict[str, float], config: FrontEvidenceConfig) -> str | None:
    """Returns the side of the object that a part's thin axis faces, or for a bulky part the side nearest to it."""
    horizontal = sorted({"XYZ".index(d[1]) for d in votes})
    size = part.box.size[horizontal]
    thin = horizontal[int(np.argmin(size))]
    if size.min() > config.bulky * size.max():
        return _nearest_side(part.box, whole, votes, config)
    offset = part.box.center[thin] - whole.center[thin]
    return spelled(thin, bool(offset > 0)) if abs(offset) > config.aside * whole.half[thin] else None


def _seen_side(part: Part, caster: RayCaster, votes: dict[str, float], config: FrontEvidenceConfig) -> str | None:
    """Returns the side to which a plate is open, while something stands behind it; None where that does not tell."""
    thin = part.box.thin_axis
    if not any("XYZ"[thin] == direction[1] for direction in votes):
        return None
    low, high = open_ratios(caster, part.box, thin)
    return spelled(thin, high > low) if abs(high - low) >= config.seen else None


def _nearest_side(box: Box, whole: Box, votes: dict[str, float], config: FrontEvidenceConfig) -> str | None:
    """Returns the side of the object that a part reaches most nearly, or None where it reaches two or none."""
    gaps = {}
    for direction in votes:
        axis = "XYZ".index(direction[1])
        outward = whole.high[axis] - box.high[axis] if direction[0] == "+" else box.low[axis] - whole.low[axis]
        gaps[direction] = float(outward) / max(float(whole.size.max()), 1e-12)
    first, second = sorted(gaps.values())[:2]
    return min(gaps, key=lambda d: gaps[d]) if second - first > config.clearly and first <= config.reaches else None


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
    size, believed = float(whole.size.max()), ScaleConfig()
    if unit is not None and believed.smallest <= size * unit <= believed.largest_stated:
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
