"""The table of static functionalization: tops, handles and interiors before and after, as judges see them."""

from collections.abc import Callable, Iterable, Sequence
from typing import Final

from grafu.evaluation.bootstrap import Figure, mean_of, ratio_of
from grafu.evaluation.motion_table import (
    HANDLES,
    HANDLES_BEFORE,
    INTERIORS,
    MODELS,
    SOURCE,
    TOPLESS,
    TOPS,
    WITH_ROOMS,
    WITHOUT_ROOMS,
)
from grafu.evaluation.records import CompletenessRecord
from grafu.evaluation.results import Results
from grafu.evaluation.table import Cell, Column, ResultTable
from grafu.judging.coverage import CoverageTestConfig

OPEN: Final = 0.5  # of the plan past the rim from which on furniture lacks a top
_COVERED: Final = CoverageTestConfig().covered
_COLUMNS = (
    Column("method", "Method"),
    Column("measure", "Measure"),
    Column("of", "Of", "count"),
    Column("before", "Before", "ratio", "more"),
    Column("after", "After", "ratio", "more"),
)
_NOTES = (
    f"Coverage: the paper's test, by rays; a top is there where what is covered within 1 % of the greatest height is "
    f"{_COVERED:.0%} or more of what is covered at all. A mirror or back above the top hides it from this test. Open "
    f"from above: {OPEN:.0%} or more of the plan lies below the rim, in a space with walls on three sides or far down. "
    "In closed ones another top would be a second one.",
    "Handles: parts that count with a handle that stands out; carved grips are none, as in the paper. Grasped: moving "
    "bodies with a handle, a recess or a free edge, by the search that decides which get one.",
    "Interiors: 1 to 3 shelves or dividers at random in each compartment, drawn by the model's name, as in the paper. "
    "A panel is sound where both its ends rest on something, it cuts into nothing and blocks no motion. Models without "
    "a compartment are right where rays find no empty room.",
    "All but the search for compartments and grasps is judged by code that builds nothing (`grafu.judging`); the "
    "paper's authors judged by eye. Brackets hold the 95 % interval of a bootstrap over objects.",
)
Found = Sequence[CompletenessRecord]
Row = tuple[Cell, ...]


def static_table(results: Results) -> ResultTable:
    """Returns the rows of each method, and the paper's."""
    run = [method for method, made in results.made.items() if made]
    rows = [(method, *row) for method in run for row in _rows(tuple(results.completeness(method).values()))]
    return ResultTable("static", "Static functionalization", _COLUMNS, (*rows, *_published()), _NOTES)


def _rows(found: Found) -> list[Row]:
    return [*_top_rows(found), *_handle_rows(found), *_panel_rows(found)]


def _top_rows(found: Found) -> list[Row]:
    uncovered = [record for record in found if record.top.covered[0] < _COVERED]
    opened = [record for record in found if record.top.opened[0] >= OPEN]
    closed = [record for record in found if record.top.opened[0] < OPEN]
    return [
        (
            "topless models that are covered (coverage)",
            len(uncovered),
            _mean(False for _ in uncovered),
            _mean(record.top.covered[1] >= _COVERED for record in uncovered),
        ),
        (
            "models open from above that are closed",
            len(opened),
            _mean(False for _ in opened),
            _mean(record.top.opened[1] < OPEN for record in opened),
        ),
        ("closed models that get no other top", len(closed), None, _mean(not record.top.added for record in closed)),
    ]


def _handle_rows(found: Found) -> list[Row]:
    counting = [record for record in found if record.handles]
    moving = [record for record in found if record.grasps]
    with_new = [record for record in found if record.added_handles]
    clear = ratio_of(
        [float(record.added_handles - record.blocked) for record in with_new],
        [float(record.added_handles) for record in with_new],
    )
    parts, bodies = sum(len(r.handles) for r in counting), sum(len(r.grasps) for r in moving)
    return [
        ("parts with a handle", parts, *_both(counting, _with_handle)),
        ("models whose every part has a handle", len(counting), *_whole(counting, _with_handle)),
        ("added handles in the way of nothing", sum(record.added_handles for record in with_new), None, clear),
        ("moving bodies that can be grasped", bodies, *_both(moving, _grasped)),
        ("models whose every moving body can be grasped", len(moving), *_whole(moving, _grasped)),
    ]


def _with_handle(record: CompletenessRecord, time: str) -> list[bool]:
    return [bool(getattr(one, time)) for one in record.handles]


def _grasped(record: CompletenessRecord, time: str) -> list[bool]:
    return [getattr(one, time) != "none" for one in record.grasps]


Held = Callable[[CompletenessRecord, str], list[bool]]


def _both(found: Found, held: Held) -> list[Figure | None]:
    """Returns the fraction of all parts before and after."""
    counts = [float(len(held(record, "before"))) for record in found]
    return [ratio_of([float(sum(held(record, time))) for record in found], counts) for time in ("before", "after")]


def _whole(found: Found, held: Held) -> list[Figure | None]:
    """Returns the fraction of models in which it holds of every part, before and after."""
    return [_mean(all(held(record, time)) for record in found) for time in ("before", "after")]


def _panel_rows(found: Found) -> list[Row]:
    panels = [record.panels for record in found]
    roomy = [one for one in panels if one.compartments]
    bare = [one for one in panels if not one.compartments]
    given = [one for one in roomy if one.placed]
    filled = ratio_of([float(one.filled) for one in roomy], [float(one.compartments) for one in roomy])
    placed = ratio_of([float(one.placed) for one in roomy], [float(one.asked) for one in roomy])
    sound = ratio_of([float(one.placed - one.faulty) for one in given], [float(one.placed) for one in given])
    done = _mean(one.filled == one.compartments and not one.faulty for one in roomy)
    return [
        ("compartments that take panels", sum(one.compartments for one in roomy), None, filled),
        ("panels placed of those asked for", sum(one.asked for one in roomy), None, placed),
        ("placed panels that are sound", sum(one.placed for one in given), None, sound),
        ("models whose every compartment is furnished, all panels sound", len(roomy), None, done),
        ("models without a compartment that have no room", len(bare), None, _mean(not one.rooms for one in bare)),
    ]


def _mean(values: Iterable[bool]) -> Figure | None:
    return mean_of([float(value) for value in values])


def _published() -> list[Row]:
    method = f"GraFu ({SOURCE}, PN-M)"
    return [
        (method, "topless models that are covered (coverage)", TOPLESS, None, TOPS),
        (method, "models whose every part has a handle", MODELS["PN-M"], HANDLES_BEFORE, HANDLES),
        (method, "models whose every compartment is furnished, all panels sound", WITH_ROOMS, None, INTERIORS),
        (method, "models without a compartment that have no room", WITHOUT_ROOMS, None, 1.0),
    ]
