"""The paper's main table: how right the motions are, how they collide and hang together, raw and fixed, by method.

The paper's own rows (its table Quantitative evaluation, its masking table and its text), to stand beside ours.

`MODELS` counts its models of PartNet-Mobility's storage furniture and of HSSD; figures are fractions, not per cent.
"""

from collections import Counter
from collections.abc import Sequence
from typing import Final, final

from grafu.dataclass import dataclass
from grafu.evaluation.figures import over_objects, over_parts
from grafu.evaluation.results import PartOutcome, Results
from grafu.evaluation.table import Cell, Column, ResultTable

SOURCE = "the paper"
MODELS: Final = {"PN-M": 345, "HSSD": 50}


@final
@dataclass(frozen=True, slots=True)
class PublishedMotion:
    """A row of the paper's table; raw figures, then with its geometric fix. None: not printed."""

    method: str
    data: str
    aligned: float | None
    reasonable: float | None
    collision: float | None
    collision_fixed: float | None
    connected: float | None
    connected_fixed: float | None


MOTION: Final = (
    PublishedMotion("Particulate", "PN-M", 0.876, 0.965, 0.079, 0.055, 0.132, 0.965),
    PublishedMotion("SINGAPO", "PN-M", 0.878, 0.93, 0.287, 0.270, 0.484, 0.738),
    PublishedMotion("GT annotation", "PN-M", None, None, 0.192, 0.052, 0.491, 0.972),
    PublishedMotion("GraFu", "PN-M", 0.870, 0.963, None, 0.044, None, 0.981),
    PublishedMotion("Particulate", "HSSD", 0.274, None, 0.290, 0.287, 0.628, 0.580),
    PublishedMotion("SINGAPO", "HSSD", 0.594, None, 0.287, 0.246, 0.517, 0.981),
    PublishedMotion("GT annotation", "HSSD", None, None, 0.250, 0.250, 0.821, 0.977),
    PublishedMotion("GraFu", "HSSD", 0.858, None, None, 0.151, None, 0.986),
)
# rate: aligned, collision, connected on PN-M, then on HSSD
MASKING: Final = {
    0.1: ((0.8623, 0.0449, 0.9828), (0.7268, 0.1471, 0.9872)),
    0.3: ((0.8576, 0.0436, 0.9788), (0.7033, 0.1602, 0.9853)),
    0.5: ((0.8544, 0.0446, 0.9783), (0.6268, 0.1682, 0.9693)),
    1.0: ((0.8207, 0.053, 0.9679), (0.5287, 0.218, 0.9610)),
}
OUTCOMES: Final = (266 / 345, 62 / 345, 17 / 345)  # of its 345 models: aligned, reasonable, wrong
TOPS, HANDLES_BEFORE, HANDLES, INTERIORS = 1.0, 310 / 345, 329 / 345, 264 / 268
TOPLESS, WITH_ROOMS, WITHOUT_ROOMS = 164, 268, 77  # models without a top, with compartments, without


ALL = "all"
_FIGURES = (
    Column("aligned", "GT-aligned", "ratio", "more"),
    Column("twins", "Reasonable (twins)", "ratio", "more"),
    Column("reasonable", "Reasonable (or physical)", "ratio", "more"),
    Column("collision", "Collision", "ratio", "less"),
    Column("collision_fixed", "Collision + fix", "ratio", "less"),
    Column("connected", "Connected", "ratio", "more"),
    Column("connected_fixed", "Connected + fix", "ratio", "more"),
    Column("aligned_fixed", "Aligned + fix", "ratio", "more"),
    Column("opening_fixed", "Opening + fix", "ratio", "more"),
    Column("works", "Works", "ratio", "more"),
    Column("works_fixed", "Works + fix", "ratio", "more"),
    Column("touch", "Touch", "ratio", "less"),
    Column("touch_fixed", "Touch + fix", "ratio", "less"),
)
_COLUMNS = (
    Column("method", "Method"),
    Column("data", "Data"),
    Column("over", "Mean over"),
    Column("objects", "Objects", "count"),
    Column("parts", "Parts", "count"),
    *_FIGURES,
)
_NOTES = (
    "A figure over objects is the mean over each object's parts first, then over objects; brackets hold the 95 % "
    "interval of a bootstrap over objects.",
    "Plain columns: the stated axes and ranges on the meshes as they are. `+ fix`: what the geometric realization "
    "built of them, hardware included.",
    "Rows `not run` state on how many models a method was not run, and why; they count in none of its figures.",
    "Rows marked `the paper` are printed there; they were measured on other models by other code.",
)


def motion_table(results: Results) -> ResultTable:
    """Returns a row per method and category, over objects and over parts, and the paper's rows."""
    rows: list[tuple[Cell, ...]] = []
    for method in results.made:
        outcomes = results.outcomes(method)
        rows += _rows(method, ALL, outcomes) if outcomes else []
        rows += _not_run(method, results)
        for category in results.categories if len(results.categories) > 1 and outcomes else ():
            rows += _rows(method, category, [o for o in outcomes if o.category == category])
    return ResultTable(
        "motion", "Motion correctness, collision and connectivity", _COLUMNS, (*rows, *_published()), _NOTES
    )


def _not_run(method: str, results: Results) -> list[tuple[Cell, ...]]:
    """Returns the row of a method that was not run on some models or all: on how many, and why."""
    reasons = Counter(results.not_run.get(method, {}).values())
    nothing = (None,) * len(_FIGURES)
    return [(method, f"not run: {why}", "objects", number, None, *nothing) for why, number in reasons.items()]


def _rows(method: str, data: str, outcomes: Sequence[PartOutcome]) -> list[tuple[Cell, ...]]:
    counts = len({o.model for o in outcomes}), len(outcomes)
    return [
        (method, data, "objects", *counts, *(over_objects(outcomes, c.name) for c in _FIGURES)),
        (method, data, "parts", *counts, *(over_parts(outcomes, c.name) for c in _FIGURES)),
    ]


def _published() -> list[tuple[Cell, ...]]:
    return [_published_row(row) for row in MOTION]


def _published_row(row: PublishedMotion) -> tuple[Cell, ...]:
    known: dict[str, float | None] = {
        "aligned": row.aligned,
        "twins": row.reasonable,
        "collision": row.collision,
        "collision_fixed": row.collision_fixed,
        "connected": row.connected,
        "connected_fixed": row.connected_fixed,
    }
    figures = (known.get(column.name) for column in _FIGURES)
    return (f"{row.method} ({SOURCE})", row.data, "objects", MODELS[row.data], None, *figures)
