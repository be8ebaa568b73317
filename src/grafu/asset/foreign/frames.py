"""Which frames a prediction may be drawn in: the ways from its file's coordinates to an asset's object frame.

Likelier ones come first. It weighs nothing: `grafu.asset.foreign.agreement` does.
"""

from collections.abc import Iterator, Sequence
from itertools import permutations, product
from typing import final

import numpy as np

from grafu.asset.foreign.motions import ForeignMotions
from grafu.asset.foreign.particulate import UP_ROTATIONS
from grafu.asset.part import Frame
from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Mat3, Mat4, Points, frozen_array
from grafu.geometry.box import Box, yaw_of
from grafu.geometry.transform import from_rotation, is_mirror, rotation_matrix, scale_of

_ROUNDS = 30  # of weighing again; ten bring millimetres, thirty the last digits
_Y_UP_Z_FRONT = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
_Z_UP_X_FRONT = np.array([[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]])
_Z_UP_X_BACK = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])  # PartNet-Mobility's URDF root: front -X


@final
@dataclass(frozen=True, eq=False, slots=True)
class FrameGuess(ArrayValue):
    """A frame's name in words, the transform from it to the object frame, and whether it is known to the last digit.

    One that is not `known` is only turned so; scale and place are fitted to the whole boxes.
    """

    name: str
    T_object_foreign: Mat4
    known: bool

    def __post_init__(self) -> None:
        object.__setattr__(self, "T_object_foreign", frozen_array(self.T_object_foreign))

    @property
    def rotation(self) -> Mat3:
        """The rotation alone."""
        T = np.asarray(self.T_object_foreign)
        return T[:3, :3] / scale_of(T)


def known_frames(frame: Frame) -> tuple[FrameGuess, ...]:
    """Returns the frames that an asset's own reading knows: its input's, and the object frame."""
    given = FrameGuess("the input's own coordinates", np.asarray(frame.input_to_output), True)
    return given, FrameGuess("the object frame", np.eye(4), True)


def fitted_frames(foreign: ForeignMotions, frame: Frame, points: Points, whole: Box) -> tuple[FrameGuess, ...]:
    """Returns all 24 ways to turn the predicted parts by quarter turns and lay their whole box over the asset's.

    Args:
        foreign: the prediction, whose format states which turns are likely.
        frame: how the asset's input became the object frame.
        points: the prediction's points.
        whole: the asset's box.
    """
    turns = [*_likely_turns(foreign, frame), *(("turned to fit", R) for R in quarter_turns())]
    distinct: list[tuple[str, Mat3]] = []
    for name, R in turns:
        if not any(np.allclose(R, other, atol=1e-6) for _, other in distinct):
            distinct.append((name, R))
    return tuple(
        FrameGuess(f"{name}, laid over the whole box", _laid_over(points, R, whole), False) for name, R in distinct
    )


def tilted_frames(points: Points, whole: Box) -> tuple[FrameGuess, ...]:
    """Returns frames for a prediction whose sides run along no axis: turned straight about each axis, then fitted."""
    found = []
    for axis in np.eye(3):
        R = _up_to_z(axis)
        straight = rotation_matrix(np.array([0.0, 0.0, 1.0]), -yaw_of(points @ R.T)) @ R
        found += [
            FrameGuess("turned straight", _laid_over(points, Q @ straight, whole), False) for Q in _yaws_and_flips()
        ]
    return tuple(found)


def drawn_together(pairs: Sequence[tuple[Box, Box]]) -> Mat4:
    """Returns the scale and shift that lay the second boxes of pairs over the first; what fits badly counts little."""
    if not pairs:
        return np.eye(4)
    wanted, given = (np.array([[pair[k].low, pair[k].high] for pair in pairs]).reshape(-1, 3) for k in (0, 1))
    weights = np.ones(wanted.shape)
    scale, shift = 1.0, np.zeros(3)
    for _ in range(_ROUNDS):
        total = np.maximum(weights.sum(axis=0), 1e-300)
        middles = (weights * given).sum(axis=0) / total, (weights * wanted).sum(axis=0) / total
        spread, there = given - middles[0], wanted - middles[1]
        scale = float((weights * spread * there).sum() / max(float((weights * spread**2).sum()), 1e-300))
        shift = middles[1] - scale * middles[0]
        errors = np.abs(scale * given + shift - wanted)
        weights = 1.0 / np.maximum(errors, 1e-9 * float(np.ptp(wanted)) + 1e-300)  # least distances, not least squares
    return from_rotation(scale * np.eye(3), shift)


def quarter_turns() -> Iterator[Mat3]:
    """Yields the 24 rotations that map axes to axes, those about Z first."""
    turns = []
    for order, signs in product(permutations(range(3)), product((1.0, -1.0), repeat=3)):
        R = np.zeros((3, 3))
        R[range(3), order] = signs
        if not is_mirror(from_rotation(R)):
            turns.append(R)
    yield from sorted(turns, key=lambda R: (R[2, 2] < 1, -np.trace(R)))


def _yaws_and_flips() -> list[Mat3]:
    """Returns the 8 quarter turns that keep Z vertical, upright ones first."""
    return [R for R in quarter_turns() if abs(R[2, 2]) > 0.5]


def _up_to_z(axis: np.ndarray) -> Mat3:
    """Returns a rotation that maps a coordinate axis to Z."""
    return next(R for R in quarter_turns() if np.allclose(R @ axis, [0.0, 0.0, 1.0]))


def _likely_turns(foreign: ForeignMotions, frame: Frame) -> Iterator[tuple[str, Mat3]]:
    T = np.asarray(frame.input_to_output)
    given = T[:3, :3] / scale_of(T)
    if foreign.source == "particulate":
        stated = frame.up.removeprefix("+")
        for up in (stated, *(up for up in UP_ROTATIONS if up != stated)):
            yield f"Particulate's normalised frame, up_dir {up}", given @ UP_ROTATIONS[up].T
    if foreign.source == "singapo":
        yield "Y up, Z front", _Y_UP_Z_FRONT
    yield "turned as the input", given
    yield "turned as the object frame", np.eye(3)
    if foreign.source == "urdf":
        yield "Z up, -X front", _Z_UP_X_BACK
        yield "Z up, X front", _Z_UP_X_FRONT


def _laid_over(points: Points, R: Mat3, whole: Box) -> Mat4:
    """Returns the rotation R with the scale and shift that bring the points' box nearest to `whole`."""
    box = Box.around(points @ R.T)
    scale = float(box.size @ whole.size) / max(float(box.size @ box.size), 1e-30)
    return from_rotation(scale * R, whole.center - scale * box.center)
