"""What works and what does not, side by side: the first synthetic pieces of a seed, all of them counted, none chosen.

`python scripts/pictures.py results_works results_wrong` writes both sheets: each piece as a
reader would load it (parts missing, names wrong), built by the network and opened, with its first fault in words. No
training saw the seed.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache, partial
from typing import final

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.errors import FunctionalizationError
from grafu.metrics.motion import MotionAgreement, motion_agreement
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.report import report_of
from grafu.pipeline.verdict import verdict_of
from grafu.pipeline.words import Colour
from grafu.render.camera import three_quarter_view
from grafu.render.picture import Picture, box_of, contact_sheet, opened_values, posed_visuals, render
from grafu.synth.generate import make_specimen
from grafu.templates.gallery import builtin_gallery

SEED = 990_001
PIECES = 60  # at most
EACH = 5  # of those that work, and of those that do not
SIZE, COLUMNS = (300, 240), 5
OPENED = 0.8


@final
@dataclass(frozen=True)
class Shown:
    """A piece as built, and its first fault in a few words; none where all moves as it should and nothing collides."""

    made: ArticulatedObject
    fault: str


@cache
def first_pieces() -> tuple[list[Shown], list[Shown]]:
    """Returns the first pieces that work, and the first that do not."""
    works: list[Shown] = []
    wrong: list[Shown] = []
    for piece in pieces():
        (wrong if piece.fault else works).append(piece)
        if min(len(works), len(wrong)) == EACH:
            break
    print(f"of the first {len(works) + len(wrong)} pieces of seed {SEED} {len(works)} work")
    return works[:EACH], wrong[:EACH]


def pieces() -> Iterator[Shown]:
    """Yields the pieces of the seed; what the whole piece with its annotation becomes is the truth."""
    for index in range(PIECES):
        specimen = make_specimen(SEED, index)
        try:
            truth = functionalize(specimen.whole, MotionSource.ANNOTATION, builtin_gallery()).object
            made = functionalize(specimen.asset, MotionSource.NETWORK, builtin_gallery())
        except FunctionalizationError as error:
            print(f"{specimen.id} is refused: {error}")
            continue
        faults = [fault_of(one) for one in motion_agreement(made.object, truth) if not one.whole]
        if verdict_of(report_of(made)).colour is Colour.RED:
            faults.append("it collides, or is not joined")
        yield Shown(made.object, faults[0] if faults else "")


def fault_of(one: MotionAgreement) -> str:
    """Returns what is wrong with one motion."""
    why = "another side" if one.type else "another motion, or none"
    return f"{one.part}: {why}"


def sheet_of(number: int) -> Picture:
    """Returns the pieces that work (0), or those that do not (1), each with its caption."""
    shown = first_pieces()[number]
    return contact_sheet([opened(one.made) for one in shown], [one.fault or "works" for one in shown], COLUMNS)


def opened(made: ArticulatedObject) -> Picture:
    """Returns a picture of a piece with everything open."""
    visuals = posed_visuals(made, opened_values(made, OPENED))
    return render(visuals, three_quarter_view(box_of(visuals), SIZE[0] / SIZE[1]), SIZE)


SHEETS: dict[str, Callable[[], Picture]] = {
    "results_works": partial(sheet_of, 0),
    "results_wrong": partial(sheet_of, 1),
}
