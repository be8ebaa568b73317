"""A prediction laid over an asset: in which frame it is drawn, and which predicted part covers which of the asset's.

Frames that are known come first, then all quarter turns fitted to the whole box. Furniture is often its own mirror
image: between frames that fit alike, labels and the way in which joints open decide, and then what is likelier: in the
object frame the front is -Y, so drawers slide out there, doors swing out there, lids lift; what sets off sideways is a
little odd, and so is what comes out behind. It mends no joint.
"""

from collections.abc import Iterable
from dataclasses import replace
from typing import final

import numpy as np

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.foreign.agreement import Agreement, AgreementConfig, Comparison, label_disagrees
from grafu.asset.foreign.frames import FrameGuess, drawn_together, fitted_frames, known_frames, tilted_frames
from grafu.asset.foreign.motions import ForeignJoint, ForeignMotions, JointFrame
from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.errors import AssetError
from grafu.geometry.arrays import Mat4
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.transform import scale_of
from grafu.visible import ShortRepr
from grafu.vocabulary import JointType, PartLabel

_SMALLEST_SCALE = 1e-60  # of a transform: its cube is still a number


@final
@dataclass(frozen=True, slots=True)
class MatchConfig(ShortRepr):
    """Which frame of a prediction is believed.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    sideways: float = 0.8
    """How much of setting off to the front it is to set off sideways, or out behind (fraction)."""
    exact: float = 0.002
    """A residual below which nothing needs to be turned straight (fraction of the object's largest side)."""
    whole: float = 0.6
    """What of the best overlap as a whole a frame must reach to be looked at (fraction)."""
    gain: float = 0.9
    """What must be left of a residual, at most, for another round to be worth it (fraction)."""
    alike: float = 1.2
    """Frames fit alike whose residuals are within this factor of the best (ratio) ..."""
    alike_beyond: float = 0.005
    """... and this beyond it (fraction of the object's largest side)."""
    surer: float = 0.05
    """By how much a less likely frame's joints must look better than a likelier one's (strangeness, 0 to 1)."""
    plausible: float = 0.1
    """How odd joints may look and still be as they should: doors of corner cabinets, sliding doors (strangeness)."""
    upright: float = 0.9
    """Least part of a frame's own Z that is the object's, where it keeps what is up (fraction)."""
    doubt: float = 0.05
    """Doubts that differ by less are none (sum of strangeness and of the fraction of labels that disagree)."""
    agreement: AgreementConfig = AgreementConfig()
    """Of parts with parts."""

    def __post_init__(self) -> None:
        require_positive(self, "alike")
        require_ratios(self, *(set(self.__dataclass_fields__) - {"alike", "agreement"}))


_DEFAULT = MatchConfig()


def strangeness(
    joint_type: JointType,
    axis: Axis,
    lower: float,
    upper: float,
    box: Box,
    whole: Box,
    config: MatchConfig = _DEFAULT,
) -> float:
    """Returns from 0 (as expected) to 1 how odd a joint is for a part with this box of an object with that box.

    Half of it is where the part sets off to; of a hinge the other half is how far its axis runs from the part, or
    how much across the part's plane.
    """
    sense = 1.0 if abs(upper) >= abs(lower) else -1.0
    kind = motion_kind(joint_type)
    x, y, z = kind.sets_off(axis, box.center, sense).tolist()
    lifts = z if kind.turns and box.thin_axis == 2 else -1.0
    out_behind = config.sideways * y if box.center[1] > whole.center[1] else -1.0
    backwards = (1.0 - max(-y, lifts, config.sideways * abs(x), out_behind)) / 2
    if not kind.turns:
        return backwards
    across = abs(float(axis.direction[box.thin_axis]))
    return 0.5 * backwards + 0.5 * max(min(_distance(axis, box) / max(box.diagonal, 1e-12), 1.0), across)


def _distance(axis: Axis, box: Box) -> float:
    """Returns how far a line passes a box, measured in the plane across the line."""
    first = np.cross(axis.direction, np.eye(3)[int(np.argmin(np.abs(axis.direction)))])
    first /= np.linalg.norm(first)
    across = np.stack([first, np.cross(axis.direction, first)])
    corners, point = box.corners() @ across.T, across @ axis.point
    outside = np.maximum(np.maximum(corners.min(axis=0) - point, point - corners.max(axis=0)), 0.0)
    return float(np.linalg.norm(outside))


_SOUND = 1e-9  # a residual that is rounding


@final
@dataclass(frozen=True)
class Match:
    """Where a prediction lies.

    `part_of` states for each of the asset's parts, in order, which predicted part covers it (None: none).
    """

    frame: FrameGuess
    joint_frame: JointFrame
    part_of: tuple[str | None, ...]
    residual: float
    overlap: float

    @property
    def T_object_joints(self) -> Mat4:
        """The transform from the joints' coordinates to the object frame."""
        return np.asarray(self.frame.T_object_foreign) @ np.asarray(self.joint_frame.T_parts_joints)

    def placed(self, joint: ForeignJoint, box: Box) -> ForeignJoint:
        """Returns a joint in the object frame; `box` is that of the part it moves, where a code asks for it."""
        T = self.T_object_joints
        axis = joint.axis
        if joint.code is not None:
            back = np.linalg.inv(T)
            axis = joint.code.axis_on(Box.around(box.corners() @ back[:3, :3].T + back[:3, 3]))
        kind = motion_kind(joint.type)
        length = kind.length_scale(scale_of(T))
        return ForeignJoint(
            joint.part,
            joint.type,
            kind.mapped_axis(axis, T),
            joint.lower * length,
            joint.upper * length,
            joint.limited,
        )


def match_parts(asset: Asset, foreign: ForeignMotions, config: MatchConfig = _DEFAULT) -> Match:
    """Returns the frame that a prediction is drawn in, and which part is which.

    Raises:
        AssetError: if no frame brings the parts to agree: the prediction is of another object.
    """
    comparison = Comparison(asset, foreign, config.agreement)
    given, *others = known_frames(asset.frame)
    found = [(given, comparison.agreement(given.T_object_foreign))]
    if found[0][1].residual < config.exact:  # what was made from the same file needs no second look
        return _with_joint_frame(asset, foreign, *found[0], config)
    others += fitted_frames(foreign, asset.frame, comparison.points, asset.box)
    found += _weighed(comparison, others, config)
    if min(agreed.residual for _, agreed in found) > config.exact:
        found += _weighed(comparison, tilted_frames(comparison.points, asset.box), config)
    found = [refined(comparison, *guess, config) for guess in _best_of_turns(found, config)]
    turns = _best_of_turns(found, config)
    matches = [_with_joint_frame(asset, foreign, guess, agreed, config) for guess, agreed in turns]
    best, least = max(agreed.overlap for _, agreed in found), config.agreement.least_overlap
    if best < least:
        raise AssetError(
            f"{foreign.path} does not fit {asset.name}: in the best of {len(found)} frames its parts overlap the "
            f"asset's by {best:.2f}, at least {least} is expected; is it a prediction of this object?"
        )
    fitting = [match for match in matches if match.overlap >= min(least, best)]
    if fitting[0].frame == given:
        return fitting[0]
    return min(fitting, key=lambda match: _doubts(asset, foreign, match, config))


def _is_usable(T: Mat4) -> bool:
    """Whether a transform can be inverted in floating-point numbers: predictions may be of any size."""
    largest = float(np.abs(T[:3, :3]).max())
    return bool(np.isfinite(T).all()) and _SMALLEST_SCALE < largest < 1 / _SMALLEST_SCALE


def _weighed(
    comparison: Comparison, guesses: Iterable[FrameGuess], config: MatchConfig
) -> list[tuple[FrameGuess, Agreement]]:
    """Returns the guesses in which the two as a whole are about alike, with what comes of them."""
    usable = (guess for guess in guesses if _is_usable(guess.T_object_foreign))
    wholes = [(guess, comparison.whole_overlap(guess.T_object_foreign)) for guess in usable]
    least = config.whole * max((overlap for _, overlap in wholes), default=0.0)
    return [(g, comparison.agreement(g.T_object_foreign)) for g, overlap in wholes if overlap >= least]


def _best_of_turns(
    found: list[tuple[FrameGuess, Agreement]], config: MatchConfig
) -> list[tuple[FrameGuess, Agreement]]:
    """Returns of frames that fit alike the best of each rotation, likelier ones first."""
    most = config.alike * min(agreed.residual for _, agreed in found) + config.alike_beyond
    kept: list[tuple[FrameGuess, Agreement]] = []
    for guess, agreed in found:
        if agreed.residual > most:
            continue
        same = next((k for k, (g, _) in enumerate(kept) if np.allclose(g.rotation, guess.rotation, atol=1e-6)), None)
        if same is None:
            kept.append((guess, agreed))
        elif agreed.residual < kept[same][1].residual - 1e-6:
            kept[same] = (guess, agreed)
    return kept


def refined(
    comparison: Comparison, guess: FrameGuess, agreed: Agreement, config: MatchConfig = _DEFAULT
) -> tuple[FrameGuess, Agreement]:
    """Returns a fitted frame with scale and shift taken from the bodies, where that fits better than the whole did.

    A door that one of the two draws ajar spoils the whole box, but not those of the other bodies.
    """
    while not guess.known and agreed.residual > _SOUND:
        pairs = comparison.matched_boxes(agreed, guess.T_object_foreign)
        better = replace(guess, T_object_foreign=drawn_together(pairs) @ guess.T_object_foreign)
        again = comparison.agreement(better.T_object_foreign)
        if again.residual > config.gain * agreed.residual:
            break
        guess, agreed = better, again
    return guess, agreed


def _with_joint_frame(
    asset: Asset, foreign: ForeignMotions, guess: FrameGuess, agreed: Agreement, config: MatchConfig
) -> Match:
    """Returns the match with the frame in which the joints look like furniture's: the likeliest that will do."""
    ordered = sorted(foreign.joint_frames, key=lambda frame: not _keeps_up(frame, guess, config))
    matches = [Match(guess, frame, agreed.part_of, agreed.residual, agreed.overlap) for frame in ordered]
    if len(matches) == 1 or not foreign.joints:
        return matches[0]
    odd = [_strangenesses(asset, foreign, match, config) for match in matches]
    most = min(float(np.mean(values)) for values in odd) + config.surer
    return next(
        match
        for match, values in zip(matches, odd, strict=True)
        if max(values) <= config.plausible or float(np.mean(values)) <= most
    )


def _keeps_up(frame: JointFrame, guess: FrameGuess, config: MatchConfig) -> bool:
    """Whether a frame's own Z is the object's: joints are stated with Z up, if who ran the method said what is up."""
    T = np.asarray(guess.T_object_foreign) @ np.asarray(frame.T_parts_joints)
    return bool(T[2, 2] > config.upright * np.linalg.norm(T[:3, 2]))


def _strangenesses(asset: Asset, foreign: ForeignMotions, match: Match, config: MatchConfig) -> list[float]:
    """Returns how odd each joint looks that moves a part; 0 where there is none."""
    values = []
    for joint in foreign.joints:
        covered = covered_parts(asset, foreign, match, joint.part)
        if covered:
            box = Box.enclosing(part.box for part in covered)
            placed = match.placed(joint, box)
            moved = placed.type, placed.axis, placed.lower, placed.upper
            values.append(strangeness(*moved, box, asset.box, config))
    return values or [0.0]


def _doubts(asset: Asset, foreign: ForeignMotions, match: Match, config: MatchConfig) -> int:
    """Returns what speaks against a frame: labels that do not go together, joints that open backwards."""
    wrong = [
        label_disagrees(part.label, foreign.labels[name], foreign.body_of[name] is not None)
        for part, name in zip(asset.parts, match.part_of, strict=True)
        if name is not None and part.label is not PartLabel.UNKNOWN
    ]
    labels = float(np.mean(wrong)) if wrong else 0.0
    return round((labels + float(np.mean(_strangenesses(asset, foreign, match, config)))) / config.doubt)


def covered_parts(asset: Asset, foreign: ForeignMotions, match: Match, body: str) -> tuple[Part, ...]:
    """Returns the asset's parts that move with a predicted jointed part."""
    pairs = zip(asset.parts, match.part_of, strict=True)
    return tuple(part for part, name in pairs if name is not None and foreign.body_of[name] == body)
