"""Pantry units whose slim front pulls out with the rack behind it: specimens for tests.

Families have pull-outs in their layouts (`fronts.gliding`).
"""

from collections.abc import Iterator
from typing import final

import numpy as np

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.graph.edges import Slide
from grafu.synth.case.carcass import case_pieces
from grafu.synth.case.case import Case
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, Span, assemble, plank
from grafu.synth.pieces.finish import PLAIN, Finish
from grafu.synth.sampling.chance import between
from grafu.vocabulary import PartLabel

SLIM = Case(0.3, 2.0, 0.55)
_WIRE = 0.006  # metres: how thick what the rack is made of is


@final
@dataclass(frozen=True, slots=True)
class PullOutUnit:
    """A unit, metres: one front over a slim case, and behind it a rack of `trays` that comes out with it.

    Raises:
        ValueError: if there is no tray.
    """

    name: str = "pull_out"
    case: Case = SLIM
    trays: int = 4
    front: float = 0.018
    gap: float = 0.003
    play: float = 0.013
    finish: Finish = PLAIN

    def __post_init__(self) -> None:
        if self.trays < 1:
            raise ValueError(f"`PullOutUnit.trays` must be at least 1: got {self.trays}")


def drawn_pull_out(rng: np.random.Generator, name: str) -> PullOutUnit:
    """Returns a unit of random size."""
    height = between(rng, (0.7, 2.2))
    case = Case(between(rng, (0.18, 0.4)), height, between(rng, (0.45, 0.6)))
    return PullOutUnit(name, case, max(2, int(height / between(rng, (0.3, 0.5)))), between(rng, (0.016, 0.022)))


def make_pull_out(spec: PullOutUnit) -> Asset:
    """Returns the unit with the true joint of its front; the pieces of the rack ride on it."""
    case, gap = spec.case, spec.gap
    y = case.front - 0.001 - spec.front
    x = case.width / 2 - gap
    span = ((-x, y, case.foot + gap), (x, y + spec.front, case.crown - gap))
    axis = Axis(vec3(0.0, y, (case.foot + case.crown) / 2), vec3(0.0, -1.0, 0.0))
    motion = PieceMotion(Slide.joint_type, axis, 0.75 * (case.inner_back - case.front))
    door = plank(PartLabel.DOOR, "door", spec.finish.front, span)
    bar = ((-0.08, y - 0.03, 0.0), (0.08, y, 0.012))
    z = case.foot + 0.6 * (case.crown - case.foot)
    handle = plank(PartLabel.HANDLE, "handle", spec.finish.metal, *((_raised(bar, z)),))
    front = PieceDraft(PartLabel.DOOR, "door", door.surfaces, motion, (handle, *_rack(spec, y + spec.front)))
    return assemble(spec.name, [*case_pieces(case, spec.finish, case.front), front])


def _raised(span: Span, z: float) -> Span:
    (x0, y0, z0), (x1, y1, z1) = span
    return (x0, y0, z0 + z), (x1, y1, z1 + z)


def _rack(spec: PullOutUnit, y: float) -> Iterator[PieceDraft]:
    """Yields two uprights behind the front, one at the back, and the trays between them."""
    opening, steel = spec.case.opening, spec.finish.metal
    x = opening.width / 2 - spec.play - 0.02
    low, high = opening.z0 + 0.05, opening.z1 - 0.05
    far = y + 0.8 * (spec.case.inner_back - y)
    for at in (y, far - 2 * _WIRE):
        yield plank(PartLabel.MISC, "upright", steel, ((-x, at, low), (x, at + 2 * _WIRE, high)))
    for k in range(spec.trays):
        z = low + (k + 0.5) * (high - low) / spec.trays
        floor = ((-x, y + 2 * _WIRE, z), (x, far - 2 * _WIRE, z + _WIRE))
        sides = [
            ((s * x - (s > 0) * _WIRE, floor[0][1], z + _WIRE), (s * x + (s < 0) * _WIRE, floor[1][1], z + 0.05))
            for s in (-1, 1)
        ]
        yield plank(PartLabel.MISC, "tray", steel, floor, *sides)
