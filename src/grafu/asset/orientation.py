"""Which way is up and where the front is, from labelled boxes. It applies no transform and asks no joints."""

import numpy as np

from grafu.asset.options import DIRECTIONS
from grafu.asset.part import Part
from grafu.geometry.arrays import Vec3
from grafu.geometry.box import Box
from grafu.vocabulary import PartLabel

_LYING = (PartLabel.TOP_PANEL, PartLabel.BOTTOM_PANEL, PartLabel.SHELF)
_STANDING = (PartLabel.SIDE_PANEL, PartLabel.BACK_PANEL, PartLabel.DOOR, PartLabel.DIVIDER)

# Moving bodies smaller than this fraction of the object (a tap, a lever) do not tell where its front is.
_TELLING = 0.2
# Nor does a bulky part that ends farther inside than this share of the object's largest side.
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
