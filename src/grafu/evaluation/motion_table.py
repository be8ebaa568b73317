"""The paper's main table: how right the motions are, how they collide and hang together, raw and fixed, by method."""

from collections.abc import Sequence

from grafu.evaluation.figures import over_objects, over_parts
from grafu.evaluation.published import MODELS, MOTION, SOURCE, PublishedMotion
from grafu.evaluation.results import PartOutcome, Results
from grafu.evaluation.table import Cell, Column, Table

ALL = "all"
_FIGURES = (
    Column("aligned", "GT-aligned", "share", "more"),
    Column("twins", "Reasonable (twins)", "share", "more"),
    Column("reasonable", "Reasonable (or physical)", "share", "more"),
    Column("collision", "Collision", "share", "less"),
    Column("collision_fixed", "Collision + fix", "share", "less"),
    Column("connected", "Connected", "share", "more"),
    Column("connected_fixed", "Connected + fix", "share", "more"),
    Column("aligned_fixed", "Aligned + fix", "share", "more"),
    Column("opening_fixed", "Opening + fix", "share", "more"),
    Column("works", "Works", "share", "more"),
    Column("works_fixed", "Works + fix", "share", "more"),
    Column("touch", "Touch", "share", "less"),
    Column("touch_fixed", "Touch + fix", "share", "less"),
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
    "Rows marked `the paper` are printed there; they were measured on other models by other code.",
)


def motion_table(results: Results) -> Table:
    """Returns a row per method and category, over objects and over parts, and the paper's rows."""
    rows: list[tuple[Cell, ...]] = []
    for method in results.made:
        outcomes = results.outcomes(method)
        rows += _rows(method, ALL, outcomes)
        for category in results.categories if len(results.categories) > 1 else ():
            rows += _rows(method, category, [o for o in outcomes if o.category == category])
    return Table("motion", "Motion correctness, collision and connectivity", _COLUMNS, (*rows, *_published()), _NOTES)


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
