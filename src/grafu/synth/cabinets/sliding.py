"""Cabinets whose doors slide: leaves that pass one another in a case, or one leaf that hangs before it.

They are specimens for tests; families have sliding doors in their layouts (`fronts.gliding`).
"""

from collections.abc import Iterator
from typing import Literal, final

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
from grafu.synth.sampling.chance import between, chance
from grafu.vocabulary import PartLabel

LOW = Case(1.4, 0.7, 0.42)
_BEHIND = 0.01  # metres from the last leaf to the shelves


@final
@dataclass(frozen=True, slots=True)
class SlidingDoors:
    """A cabinet with sliding doors, metres.

    "bypass" leaves stand in the opening, every second one behind the others, and lap each other by `lap`; a "barn" door
    hangs before the left half of the case. Panes of glass are leaves 6 mm thick.

    Raises:
        ValueError: if there are not two or three leaves that pass one another, or one that hangs before the case.
    """

    name: str = "sliding_doors"
    case: Case = LOW
    kind: Literal["bypass", "barn"] = "bypass"
    leaves: int = 2
    front: float = 0.018
    gap: float = 0.003
    lap: float = 0.03
    glass: bool = False
    shelves: int = 1
    finish: Finish = PLAIN

    def __post_init__(self) -> None:
        if self.leaves not in ((2, 3) if self.kind == "bypass" else (1,)):
            raise ValueError(f"`SlidingDoors.leaves` must be 2 or 3, of a barn door 1: got {self.leaves}")

    @property
    def thickness(self) -> float:
        """That of a leaf."""
        return 0.006 if self.glass else self.front


def drawn_sliding_doors(rng: np.random.Generator, name: str) -> SlidingDoors:
    """Returns sliding doors of random kind and size."""
    is_barn = chance(rng, 0.25)
    return SlidingDoors(
        name,
        Case(between(rng, (0.9, 2.2)), between(rng, (0.5, 2.2)), between(rng, (0.35, 0.65))),
        "barn" if is_barn else "bypass",
        1 if is_barn else 2 + chance(rng, 0.3),
        between(rng, (0.015, 0.025)),
        between(rng, (0.002, 0.004)),
        between(rng, (0.02, 0.05)),
        not is_barn and chance(rng, 0.3),
        int(rng.integers(0, 3)),
    )


def make_sliding_doors(spec: SlidingDoors) -> Asset:
    """Returns the cabinet with its leaves' true joints: each goes as far as the others, at rest, let it."""
    spans = list(_bypass(spec) if spec.kind == "bypass" else _barn(spec))
    doors = [_leaf(spec, span, motion) for span, motion in spans]
    front = max(span[1][1] for span, _ in spans) + _BEHIND if spec.kind == "bypass" else spec.case.front
    return assemble(spec.name, [*case_pieces(spec.case, spec.finish, spec.case.front), *_inside(spec, front), *doors])


def _leaf(spec: SlidingDoors, span: Span, motion: PieceMotion) -> PieceDraft:
    material = spec.finish.glass if spec.glass else spec.finish.front
    return PieceDraft(PartLabel.DOOR, "door", plank(PartLabel.DOOR, "door", material, span).surfaces, motion)


def _bypass(spec: SlidingDoors) -> Iterator[tuple[Span, PieceMotion]]:
    opening, step = spec.case.opening, spec.thickness + spec.gap
    width = (opening.width - 2 * spec.gap + (spec.leaves - 1) * spec.lap) / spec.leaves
    for k in range(spec.leaves):
        x = opening.x0 + spec.gap + k * (width - spec.lap)
        y = spec.case.front + spec.gap + (k % 2) * step
        span = ((x, y, opening.z0 + spec.gap), (x + width, y + spec.thickness, opening.z1 - spec.gap))
        meets_one = spec.leaves == 3 and k != 1  # the outer two of three are in one plane
        travel = width - 2 * spec.lap if meets_one else width - spec.lap
        yield span, _slide(span, -1.0 if k == spec.leaves - 1 else 1.0, travel)


def _barn(spec: SlidingDoors) -> Iterator[tuple[Span, PieceMotion]]:
    case = spec.case
    y, middle = case.front - spec.gap - spec.thickness, spec.lap
    span = (
        (-case.width / 2 + spec.gap, y, case.foot + spec.gap),
        (middle, y + spec.thickness, case.crown - spec.gap),
    )
    yield span, _slide(span, 1.0, case.width / 2 - middle - spec.gap)


def _slide(span: Span, sign: float, travel: float) -> PieceMotion:
    center = (np.array(span[0]) + np.array(span[1])) / 2
    return PieceMotion(Slide.joint_type, Axis(center, vec3(sign, 0.0, 0.0)), travel)


def _inside(spec: SlidingDoors, front: float) -> Iterator[PieceDraft]:
    """Yields evenly spaced shelves, and the wall in the middle that a barn door closes against."""
    opening, case, panel = spec.case.opening, spec.case, spec.case.panel
    halves = [(opening.x0, opening.x1)]
    if spec.kind == "barn":
        halves = [(opening.x0, -panel / 2), (panel / 2, opening.x1)]
        wall = ((-panel / 2, front, opening.z0), (panel / 2, case.inner_back, opening.z1))
        yield plank(PartLabel.DIVIDER, "divider", spec.finish.case, wall)
    for k in range(spec.shelves):
        z = opening.z0 + (k + 1) * opening.height / (spec.shelves + 1)
        for x0, x1 in halves:
            board = ((x0, front, z - panel / 2), (x1, case.inner_back, z + panel / 2))
            yield plank(PartLabel.SHELF, "shelf", spec.finish.case, board)
