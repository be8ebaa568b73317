"""The furniture that ships with grafu, unarticulated as an artist leaves it: a table from name to maker.

And walls of doors and drawers of any number of parts, for benches.
"""

from collections.abc import Callable

from grafu.asset.part import Asset
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.cabinets.chest import Chest, make_chest
from grafu.synth.case.case import Case
from grafu.synth.case.construction import Base, FaceFrame, Top
from grafu.synth.fronts.layout import Bay, Door, Drawer, Layout, Pair, Row, Stack
from grafu.synth.pieces.finish import textured_finish
from grafu.synth.tables.desk import Desk, make_desk

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


def kitchen_base() -> Asset:
    """Returns a kitchen base cabinet: two overlay doors under two drawers, a worktop, a plinth."""
    drawers = Row((Drawer(), Drawer()))
    layout = Stack((Pair(leaf="shaker", shelves=1), drawers), (3.4, 1.0))
    case = Case(0.9, 0.9, 0.56, base=Base("plinth"), top=Top("over", overhang=0.025))
    return make_cabinet(Cabinet("kitchen_base", case, layout, finish=textured_finish(1)))


def dresser() -> Asset:
    """Returns a dresser on legs: six inset drawers in a face frame, with knobs."""
    row = Row((Drawer(handle="knob-round", leaf="chamfered"), Drawer(handle="knob-round", leaf="chamfered")))
    layout = Stack((row, row, row), (1.3, 1.15, 1.0), between="rail")
    case = Case(1.3, 0.85, 0.48, base=Base("legs", 0.14), top=Top("over", overhang=0.02), frame=FaceFrame(0.032))
    return make_cabinet(Cabinet("dresser", case, layout, "inset", gap=0.002, finish=textured_finish(2)))


def wardrobe() -> Asset:
    """Returns a tall wardrobe: a pair of doors and a single one with drawers behind it, under a moulding."""
    chest = Stack(
        (Drawer(handle="knob-round"), Drawer(handle="knob-round"), Bay(shelves=2)), (1.0, 1.0, 4.0), between="nothing"
    )
    layout = Row((Pair(leaf="shaker", shelves=1), Door("right", "shaker", behind=chest)), (2.0, 1.0))
    case = Case(1.5, 2.1, 0.58, panel=0.02, base=Base("plinth", 0.08), moulding=0.06)
    return make_cabinet(Cabinet("wardrobe", case, layout, front=0.022, finish=textured_finish(3)))


def sideboard() -> Asset:
    """Returns a sideboard: a glass door, three drawers, a drop-down flap over an open bay."""
    drawers = Stack((Drawer(), Drawer(), Drawer()), between="nothing")
    layout = Row((Door("left", "glass", "knob-round", shelves=2), drawers, Stack((Bay(), Door("bottom")))))
    case = Case(1.6, 0.75, 0.42, base=Base("legs", 0.15))
    return make_cabinet(Cabinet("sideboard", case, layout, finish=textured_finish(4)))


def desk() -> Asset:
    """Returns a desk with three drawers on one side and a door on the other."""
    return make_desk(Desk(left=Door("left", shelves=1), finish=textured_finish(5)))


def chest() -> Asset:
    """Returns a chest with a lid."""
    return make_chest(Chest(finish=textured_finish(6)))


SAMPLES: dict[str, Callable[[], Asset]] = {
    maker.__name__: maker for maker in (kitchen_base, dresser, wardrobe, sideboard, desk, chest)
}
