"""What was statically missing and is there now: tops, grasps, interiors."""

from collections.abc import Iterable

from grafu.evaluation.bootstrap import Figure, mean_of, ratio_of
from grafu.evaluation.motion_table import HANDLES, INTERIORS, MODELS, SOURCE, TOPS
from grafu.evaluation.records import CompletenessRecord
from grafu.evaluation.results import Results
from grafu.evaluation.table import Cell, Column, Table

_COLUMNS = (
    Column("method", "Method"),
    Column("measure", "Measure"),
    Column("of", "Of", "count"),
    Column("before", "Before", "ratio", "more"),
    Column("after", "After", "ratio", "more"),
)
_NOTES = (
    "Tops: of the models that the coverage test finds open from above, the fraction with a top afterwards.",
    "Parts that can be grasped: fraction of moving bodies with a handle, a recess or a free edge, found by one "
    "search before and after; models: those in which every moving body can be grasped.",
    "Interiors: of the compartments large enough for panels, the fraction that takes a shelf or a divider; models: of "
    "those with such a compartment, the fraction in which every one does.",
    "Brackets hold the 95 % interval of a bootstrap over objects.",
)


def static_table(results: Results) -> Table:
    """Returns five rows per method, and the paper's."""
    rows = [row for method in results.made for row in _rows(method, list(results.completeness(method).values()))]
    return Table("static", "Static functionalization", _COLUMNS, (*rows, *_published()), _NOTES)


def _rows(method: str, found: list[CompletenessRecord]) -> list[tuple[Cell, ...]]:
    topless = [record for record in found if record.topless]
    with_moving = [record for record in found if record.grasps]
    with_rooms = [record for record in found if record.compartments]
    moving_bodies = sum(len(record.grasps) for record in found)
    rooms = sum(record.compartments for record in found)
    before, after = (_of_bodies(with_moving, name) for name in ("before", "after"))
    whole = [_mean(_all_grasped(record, name) for record in with_moving) for name in ("before", "after")]
    filled = ratio_of([float(r.filled) for r in with_rooms], [float(r.compartments) for r in with_rooms])
    return [
        (
            method,
            "topless models with a top",
            len(topless),
            _mean(False for _ in topless),
            _mean(r.topped for r in topless),
        ),
        (method, "parts that can be grasped", moving_bodies, before, after),
        (method, "models whose every moving body can be grasped", len(with_moving), *whole),
        (method, "compartments that take panels", rooms, None, filled),
        (
            method,
            "models whose every compartment does",
            len(with_rooms),
            None,
            _mean(r.filled == r.compartments for r in with_rooms),
        ),
    ]


def _of_bodies(found: list[CompletenessRecord], name: str) -> Figure | None:
    held = [float(sum(getattr(grasp, name) != "none" for grasp in record.grasps)) for record in found]
    return ratio_of(held, [float(len(record.grasps)) for record in found])


def _all_grasped(record: CompletenessRecord, name: str) -> bool:
    return all(getattr(grasp, name) != "none" for grasp in record.grasps)


def _mean(values: Iterable[bool]) -> Figure | None:
    return mean_of([float(value) for value in values])


def _published() -> list[tuple[Cell, ...]]:
    method = f"GraFu ({SOURCE})"
    return [
        (method, "topless models with a top", None, None, TOPS),
        (method, "models paired with graspable handles", MODELS["PN-M"], None, HANDLES),
        (method, "models whose compartments are furnished", 268, None, INTERIORS),
    ]
