"""What the labels of parts tell about how a piece stands in its file: which way is up, and where its front is.

No joint is asked. Coordinates are the input's; directions are spelled like `-Y`.
"""

from collections.abc import Sequence
from math import radians
from typing import final

import numpy as np

from grafu.asset.options import DIRECTIONS
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.raycast import RayCaster, open_ratios
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
    above: float = 0.02
    """How far below the upper end of all that stays a lid may begin (fraction of the height of that)."""
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


@final
@dataclass(frozen=True, slots=True)
class UpEvidenceConfig:
    """When labelled parts overrule the direction that is up by the format.

    Raises:
        ValueError: if a number is not above 0.
    """

    plate: float = 0.35
    """Largest thickness of a part that shows which way it lies (fraction of its middle side)."""
    agree: float = 0.75
    """Fraction of the votes that another axis must have to overrule the stated one, which may have none ..."""
    least: float = 3.0
    """... of so many votes at least: two standing plates whose thin sides differ, and one that lies."""
    turned: float = 1.0
    """Sum of the places of tops, bottoms and legs (each -1..1) from which on a piece stands upside down ..."""
    below: float = 0.5
    """... and from which on where its format states no direction: a worktop under wall units lies below the middle."""
    flat: float = 2.0
    """Doors and panels that would lie flat, from which on another direction is up where the format states none: a
    single one may be the lid of a chest, or drawn open."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, slots=True)
class HeadingConfig:
    """When a piece stands askew in its file, and is turned about its vertical.

    Raises:
        ValueError: if a number is not above 0.
    """

    most: float = 0.5
    """Fraction of the upright area that stands along one direction or across it at least."""
    alike: float = radians(2.0)
    """How far this direction may differ from that of all parts but the largest (radians): a single part that is askew
    is a door drawn ajar."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, eq=False, slots=True)
class UpVotes:
    """What labelled parts say of each axis: how many lie across it, stand along it, and the sense in which tops lie."""

    lying: Vec3
    standing: Vec3
    sense: Vec3

    @property
    def tells_sense(self) -> bool:
        """Whether tops, bottoms and legs lie to one side far enough to tell which axis is up, without any plate."""
        return bool(np.abs(self.sense).max() >= UpEvidenceConfig().turned)

    def stands_along(self, up: str) -> bool:
        """Whether no plate that stands lies across this direction."""
        return not self.standing["XYZ".index(up[1])]

    @property
    def best(self) -> str | None:
        """The upward direction that most agree on, or None where they say nothing."""
        votes = self.lying - self.standing
        if not votes.any() and not self.tells_sense:
            return None
        score = votes + np.abs(self.sense)
        axis = int(np.argmax(score))
        if score[axis] <= 0 or (score >= score[axis] - 1e-9).sum() > 1:
            return None
        return spelled(axis, bool(self.sense[axis] > -UpEvidenceConfig().below))

    def confidence(self, up: str) -> float:
        """Returns which fraction of what lies or stands does so where this direction is up.

        Where there is no plate, it is the fraction of the places of tops, bottoms and legs; 0 where nothing tells.
        """
        axis = "XYZ".index(up[1])
        if not self.lying.any() and not self.standing.any():
            return float(np.abs(self.sense[axis]) / max(np.abs(self.sense).sum(), 1e-12))
        agree = self.lying[axis] + self.standing.sum() - self.standing[axis]
        return float(agree / max(self.lying.sum() + self.standing.sum(), 1.0))

    def stands_instead(self, up: str, usual: str, config: UpEvidenceConfig = UpEvidenceConfig()) -> bool:
        """Whether doors and panels stand with this direction up, and nearly all would lie flat with the `usual` one."""
        axis, other = "XYZ".index(usual[1]), "XYZ".index(up[1])
        flat, lying = self.standing[axis], self.lying[axis]
        return bool(flat >= config.flat and flat >= config.agree * (flat + lying) and not self.standing[other])

    def against(self, stated: str, config: UpEvidenceConfig = UpEvidenceConfig()) -> str | None:
        """Returns the upward direction that nearly everything speaks for instead of a stated one; None: it holds."""
        axis, sign = "XYZ".index(stated[1]), 1.0 if stated[0] == "+" else -1.0
        across = self.lying + np.sum(self.standing) - self.standing  # what lies, and what stands along others
        total = float(self.lying.sum() + self.standing.sum())
        other = int(np.argmax(self.lying - self.standing))
        if other == axis or not self.lying[other]:
            upside_down = sign * self.sense[axis] <= -config.turned and not self.standing[axis]
            return spelled(axis, sign < 0) if upside_down else None
        clear = self.standing[other] == 0 and self.lying[axis] == 0 and self.standing[axis] > 0
        if not clear or total < config.least or across[other] < config.agree * total:
            return None
        return spelled(other, bool(self.sense[other] >= 0))


_PLACES = {PartLabel.TOP_PANEL: 1.0, PartLabel.BOTTOM_PANEL: -1.0, PartLabel.LEG: -1.0}


def up_votes(parts: Sequence[Part], whole: Box, config: UpEvidenceConfig = UpEvidenceConfig()) -> UpVotes:
    """Returns what labelled panels, doors and legs say of the direction that is up."""
    lying, standing, sense = np.zeros(3), np.zeros(3), np.zeros(3)
    for part in parts:
        thin, sides = part.box.thin_axis, np.sort(part.box.size)
        is_plate = sides[0] <= config.plate * sides[1]
        lying[thin] += float(is_plate and part.label in _LYING)
        standing[thin] += float(is_plate and part.label in _STANDING)
        offset = (part.box.center - whole.center) / np.maximum(whole.half, 1e-12)
        sense += _PLACES.get(part.label, 0.0) * offset
    return UpVotes(lying, standing, sense)


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
    boxes = [part.box for part in parts if part.label is not PartLabel.HANDLE]
    body = Box.enclosing(boxes) if boxes else whole  # handles shift the middle of a leaf and its frame
    for part in parts:
        if part.label.is_movable and _is_above_all(part, parts, up, config):
            continue
        if part.label.is_movable:
            ratio = float(part.box.size.max() / whole.size.max())
            seen = _seen_side(part, caster, votes, config) if caster is not None and ratio >= config.small else None
            _add(votes, seen or (_side(part, body, votes, config) if ratio >= config.telling else None), 1.0)
        elif part.label is PartLabel.HANDLE:
            _add(votes, _nearest_side(part.box, whole, votes, config), config.handle)
        elif part.label is PartLabel.BACK_PANEL:
            side = _side(part, whole, votes, config)
            _add(votes, side and spelled("XYZ".index(side[1]), side[0] == "-"), config.back)
    return votes


def _is_above_all(part: Part, parts: Sequence[Part], up: str, config: FrontEvidenceConfig) -> bool:
    """Whether a door lies or stands above all that stays, as a lid does: one that is open leans to the back."""
    upwards, axis = vector(up), "XYZ".index(up[1])
    stays = [p.box for p in parts if not p.label.is_movable and p.label is not PartLabel.HANDLE]
    if not stays:
        return False
    body = Box.enclosing(stays)
    low = float(part.box.center @ upwards - part.box.half[axis])
    return low >= float(body.center @ upwards + (1 - 2 * config.above) * body.half[axis])


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
    """Returns the side that a part's thin axis faces; for a bulky one, such as a low deep drawer, the nearest."""
    horizontal = sorted({"XYZ".index(d[1]) for d in votes})
    size = part.box.size[horizontal]
    thin = horizontal[int(np.argmin(size))]
    if size.min() > min(config.bulky * size.max(), part.box.size.min()):
        return _nearest_side(part.box, whole, votes, config)
    offset = part.box.center[thin] - whole.center[thin]
    return spelled(thin, bool(offset > 0)) if abs(offset) > config.aside * whole.half[thin] else None


def _seen_side(part: Part, caster: RayCaster, votes: dict[str, float], config: FrontEvidenceConfig) -> str | None:
    """Returns the side from which a part is seen, others standing at the opposite one; None where that does not tell.

    Of a plate that is a side of its thin axis, of a bulky part any.
    """
    level = sorted({"XYZ".index(d[1]) for d in votes}, key=lambda axis: float(part.box.size[axis]))
    thin, long = part.box.size[level]
    axes = level if thin > config.bulky * long else level[:1]
    ratios = {axis: open_ratios(caster, part.box, axis) for axis in axes}
    seen = {spelled(axis, high): ratios[axis][high] for axis in axes for high in (False, True)}
    best, second = sorted(seen, key=lambda side: -seen[side])[:2]
    return best if seen[best] - seen[second] >= config.seen else None


def _nearest_side(box: Box, whole: Box, votes: dict[str, float], config: FrontEvidenceConfig) -> str | None:
    """Returns the side of the object that a part reaches most nearly, or None where it reaches two or none."""
    gaps = {}
    for direction in votes:
        axis = "XYZ".index(direction[1])
        outward = whole.high[axis] - box.high[axis] if direction[0] == "+" else box.low[axis] - whole.low[axis]
        gaps[direction] = float(outward) / max(float(whole.size.max()), 1e-12)
    first, second = sorted(gaps.values())[:2]
    return min(gaps, key=lambda d: gaps[d]) if second - first > config.clearly and first <= config.reaches else None
