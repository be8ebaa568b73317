"""A prediction laid over an asset: in which frame it is drawn, and which predicted part covers which of the asset's.

Frames that are known come first, then all quarter turns fitted to the whole box. Furniture is often its own mirror
image: between frames that fit alike, labels and the way in which joints open decide, and then what is likelier: in the
object frame the front is -Y, so drawers slide out there, doors swing out there, lids lift; what sets off sideways is a
little odd, and so is what comes out behind. It mends no joint.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.foreign.agreement import LEAST_OVERLAP, Agreement, Comparison, label_disagrees
from grafu.asset.foreign.frames import FrameGuess, drawn_together, fitted_frames, known_frames, tilted_frames
from grafu.asset.foreign.motions import ForeignJoint, ForeignMotions, JointFrame
from grafu.asset.part import Asset, Part
from grafu.errors import AssetError
from grafu.geometry.arrays import Mat4
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.transform import scale_of
from grafu.vocabulary import JointType, PartLabel

_SMALLEST_SCALE = 1e-60  # of a transform: its cube is still a number
_SIDEWAYS = 0.8  # how much of setting off to the front it is to set off sideways, or out behind


def strangeness(joint_type: JointType, axis: Axis, lower: float, upper: float, box: Box, whole: Box) -> float:
    """Returns from 0 (as expected) to 1 how odd a joint is for a part with this box of an object with that box.

    Half of it is where the part sets off to; of a hinge the other half is how far its axis runs from the part, or
    how much across the part's plane.
    """
    sense = 1.0 if abs(upper) >= abs(lower) else -1.0
    kind = motion_kind(joint_type)
    x, y, z = kind.sets_off(axis, box.center, sense).tolist()
    lifts = z if kind.turns and box.thin_axis == 2 else -1.0
    out_behind = _SIDEWAYS * y if box.center[1] > whole.center[1] else -1.0
    backwards = (1.0 - max(-y, lifts, _SIDEWAYS * abs(x), out_behind)) / 2
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


_EXACT = 0.002  # a residual below which nothing needs to be turned straight, as a fraction of the size
_WHOLE = 0.6  # what fraction of the best overlap as a whole a frame must reach to be looked at
_SOUND = 1e-9  # a residual that is rounding
_GAIN = 0.9  # what must be left of a residual for another round to be worth it
_ALIKE = (1.2, 0.005)  # frames fit alike whose residuals are within this factor and this addition of the best
_SURER = 0.05  # by how much a less likely frame's joints must look better than a likelier one's
_PLAUSIBLE = 0.1  # how odd joints may look and still be as they should: doors of corner cabinets, sliding doors
_DOUBT = 0.05  # doubts that differ by less are none


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


def match_parts(asset: Asset, foreign: ForeignMotions) -> Match:
    """Returns the frame that a prediction is drawn in, and which part is which.

    Raises:
        AssetError: if no frame brings the parts to agree: the prediction is of another object.
    """
    comparison = Comparison(asset, foreign)
    given, *others = known_frames(asset.frame)
    found = [(given, comparison.agreement(given.T_object_foreign))]
    if found[0][1].residual < _EXACT:  # what was made from the same file needs no second look
        return _with_joint_frame(asset, foreign, *found[0])
    others += fitted_frames(foreign, asset.frame, comparison.points, asset.box)
    found += _weighed(comparison, others)
    if min(agreed.residual for _, agreed in found) > _EXACT:
        found += _weighed(comparison, tilted_frames(comparison.points, asset.box))
    found = [refined(comparison, *guess) for guess in _best_of_turns(found)]
    matches = [_with_joint_frame(asset, foreign, guess, agreed) for guess, agreed in _best_of_turns(found)]
    best = max(agreed.overlap for _, agreed in found)
    if best < LEAST_OVERLAP:
        raise AssetError(
            f"{foreign.path} does not fit {asset.name}: in the best of {len(found)} frames its parts overlap the "
            f"asset's by {best:.2f}, at least {LEAST_OVERLAP} is expected; is it a prediction of this object?"
        )
    fitting = [match for match in matches if match.overlap >= min(LEAST_OVERLAP, best)]
    if fitting[0].frame == given:
        return fitting[0]
    return min(fitting, key=lambda match: _doubts(asset, foreign, match))


def _is_usable(T: Mat4) -> bool:
    """Whether a transform can be inverted in floating-point numbers: predictions may be of any size."""
    largest = float(np.abs(T[:3, :3]).max())
    return bool(np.isfinite(T).all()) and _SMALLEST_SCALE < largest < 1 / _SMALLEST_SCALE


def _weighed(comparison: Comparison, guesses: Iterable[FrameGuess]) -> list[tuple[FrameGuess, Agreement]]:
    """Returns the guesses in which the two as a whole are about alike, with what comes of them."""
    usable = (guess for guess in guesses if _is_usable(guess.T_object_foreign))
    wholes = [(guess, comparison.whole_overlap(guess.T_object_foreign)) for guess in usable]
    least = _WHOLE * max((overlap for _, overlap in wholes), default=0.0)
    return [(g, comparison.agreement(g.T_object_foreign)) for g, overlap in wholes if overlap >= least]


def _best_of_turns(found: list[tuple[FrameGuess, Agreement]]) -> list[tuple[FrameGuess, Agreement]]:
    """Returns of frames that fit alike the best of each rotation, likelier ones first."""
    factor, addition = _ALIKE
    most = factor * min(agreed.residual for _, agreed in found) + addition
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


def refined(comparison: Comparison, guess: FrameGuess, agreed: Agreement) -> tuple[FrameGuess, Agreement]:
    """Returns a fitted frame with scale and shift taken from the bodies, where that fits better than the whole did.

    A door that one of the two draws ajar spoils the whole box, but not those of the other bodies.
    """
    while not guess.known and agreed.residual > _SOUND:
        pairs = comparison.matched_boxes(agreed, guess.T_object_foreign)
        better = replace(guess, T_object_foreign=drawn_together(pairs) @ guess.T_object_foreign)
        again = comparison.agreement(better.T_object_foreign)
        if again.residual > _GAIN * agreed.residual:
            break
        guess, agreed = better, again
    return guess, agreed


def _with_joint_frame(asset: Asset, foreign: ForeignMotions, guess: FrameGuess, agreed: Agreement) -> Match:
    """Returns the match with the frame in which the joints look like furniture's: the likeliest that will do."""
    ordered = sorted(foreign.joint_frames, key=lambda frame: not _keeps_up(frame, guess))
    matches = [Match(guess, frame, agreed.part_of, agreed.residual, agreed.overlap) for frame in ordered]
    if len(matches) == 1 or not foreign.joints:
        return matches[0]
    odd = [_strangenesses(asset, foreign, match) for match in matches]
    most = min(float(np.mean(values)) for values in odd) + _SURER
    return next(
        match
        for match, values in zip(matches, odd, strict=True)
        if max(values) <= _PLAUSIBLE or float(np.mean(values)) <= most
    )


def _keeps_up(frame: JointFrame, guess: FrameGuess) -> bool:
    """Whether a frame's own Z is the object's: joints are stated with Z up, if who ran the method said what is up."""
    T = np.asarray(guess.T_object_foreign) @ np.asarray(frame.T_parts_joints)
    return bool(T[2, 2] > 0.9 * np.linalg.norm(T[:3, 2]))


def _strangenesses(asset: Asset, foreign: ForeignMotions, match: Match) -> list[float]:
    """Returns how odd each joint looks that moves a part; 0 where there is none."""
    values = []
    for joint in foreign.joints:
        covered = covered_parts(asset, foreign, match, joint.part)
        if covered:
            box = Box.enclosing(part.box for part in covered)
            placed = match.placed(joint, box)
            values.append(strangeness(placed.type, placed.axis, placed.lower, placed.upper, box, asset.box))
    return values or [0.0]


def _doubts(asset: Asset, foreign: ForeignMotions, match: Match) -> int:
    """Returns what speaks against a frame: labels that do not go together, joints that open backwards."""
    wrong = [
        label_disagrees(part.label, foreign.labels[name], foreign.body_of[name] is not None)
        for part, name in zip(asset.parts, match.part_of, strict=True)
        if name is not None and part.label is not PartLabel.UNKNOWN
    ]
    labels = float(np.mean(wrong)) if wrong else 0.0
    return round((labels + float(np.mean(_strangenesses(asset, foreign, match)))) / _DOUBT)


def covered_parts(asset: Asset, foreign: ForeignMotions, match: Match, body: str) -> tuple[Part, ...]:
    """Returns the asset's parts that move with a predicted jointed part."""
    pairs = zip(asset.parts, match.part_of, strict=True)
    return tuple(part for part, name in pairs if name is not None and foreign.body_of[name] == body)
