"""Furniture of any number of parts, for benches: walls of doors and drawers."""

from grafu.asset.part import Asset
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Bay, Door, Drawer, Layout, Row, Stack

CASE_PARTS = 5  # two sides, top, bottom, back
COLUMN_PARTS = 11  # a door and four drawers with handles, and the divider to the next column


def furniture_of(parts: int) -> Asset:
    """Returns a wall of drawers and doors with exactly this many parts, at least 7.

    Raises:
        ValueError: if fewer than 7 parts are asked for.
    """
    if parts < CASE_PARTS + 2:
        raise ValueError(f"`parts` must be at least {CASE_PARTS + 2} (a case, a drawer and its handle): got {parts}")
    columns, spare = divmod(parts - CASE_PARTS + 1, COLUMN_PARTS)
    if columns == 0:
        fronts, shelves = divmod(spare - 1, 2)
        layout: Layout = Stack(
            (*(Drawer(),) * fronts, Bay(shelves)) if shelves else (Drawer(),) * fronts, (), "nothing"
        )
        return make_cabinet(Cabinet(f"wall_{parts}", Case(0.6, 0.25 * (fronts + 1)), layout))
    extra = [spare // columns + (k < spare % columns) for k in range(columns)]
    layout = Row(tuple(_column(shelves) for shelves in extra))
    return make_cabinet(Cabinet(f"wall_{parts}", Case(0.6 * columns, 2.0), layout))


def _column(shelves: int) -> Layout:
    return Stack((*(Drawer(),) * 4, Door(shelves=shelves)), (1.0, 1.0, 1.0, 1.0, 4.0), "nothing")
