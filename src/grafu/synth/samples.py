"""The furniture that ships with grafu, unarticulated as an artist leaves it: a table from name to maker.

And walls of doors and drawers of any number of parts, for benches.

A catalogue of the kinds of furniture on which building mechanisms is hard: a table from name to maker.

Every kind has its true joints. The noisy ones state the same joints as their tidy originals, whatever collides.
"""

from collections.abc import Callable
from math import radians
from typing import Any

from grafu.asset.edit import yawed
from grafu.asset.part import Asset
from grafu.geometry.arrays import vec3
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.cabinets.chest import Chest, make_chest
from grafu.synth.cabinets.corner import CornerCabinet, make_corner_cabinet
from grafu.synth.case.case import Case
from grafu.synth.case.construction import Back, Base, FaceFrame, Top
from grafu.synth.fronts.hold import Hold
from grafu.synth.fronts.layout import CellRow, Door, Drawer, DrawerBox, Layout, LeafStyle, OpenCell, Pair, Stack
from grafu.synth.fronts.setting import Mount
from grafu.synth.noise import edits
from grafu.synth.pieces.finish import textured_finish
from grafu.synth.tables.desk import Desk, make_desk
from grafu.synth.tables.table import DrawerTable, make_table

Maker = Callable[[], Asset]
NARROW = Case(width=0.45)
PANELS = ("side panel", "top panel", "bottom panel", "back panel")
MIXED = Stack((Pair(), Drawer()), (3.0, 1.0))


def _cabinet(layout: Layout, mount: Mount = "overlay", case: Case = NARROW, **sizes: Any) -> Maker:
    """Returns a maker; `sizes` are further fields of `Cabinet`, metres."""
    return lambda: make_cabinet(Cabinet("cabinet", case, layout, mount, **sizes))


def _leaf(leaf: LeafStyle) -> Maker:
    return _cabinet(Door("left", leaf))


def _box(box: DrawerBox) -> Maker:
    return _cabinet(Stack((Drawer(box), Drawer(box)), between="nothing"))


def _mixed(edit: Callable[[Asset], Asset]) -> Maker:
    return lambda: edit(make_cabinet(Cabinet("noisy", layout=MIXED)))


TIDY: dict[str, Maker] = {
    "overlay pair": _cabinet(Pair(shelves=1), case=Case()),
    "overlay door, hinged right": _cabinet(Door("right")),
    "overlay door without a handle": _cabinet(Door(handle="none")),
    "inset pair": _cabinet(Pair(), "inset", Case(), gap=0.002),
    "inset door, tight": _cabinet(Door(), "inset", gap=0.001),
    "half-overlay doors on one divider": _cabinet(CellRow((Door("right"), Door("left"))), case=Case()),
    "three doors in a row": _cabinet(CellRow((Door("left"), Door("left"), Door("right"))), case=Case(1.2)),
    "inset doors in a face frame": _cabinet(Pair(), "inset", Case(frame=FaceFrame(0.04)), gap=0.002),
    "overlay doors on a face frame": _cabinet(Pair(), case=Case(frame=FaceFrame(0.04)), lap=0.012),
    "drawers behind a pair": _cabinet(Pair(behind=Stack((Drawer(handle="knob-round"), OpenCell()))), case=Case()),
    "drawers behind an inset door": _cabinet(Door(behind=Stack((Drawer(handle="none"),) * 2)), "inset"),
    "drawers with rails between": _cabinet(Stack((Drawer(),) * 3, between="rail"), "inset"),
    "drawers with panels between": _cabinet(Stack((Drawer(),) * 3)),
    "drawers side by side without a wall": _cabinet(CellRow((Drawer(), Drawer()), between="nothing"), case=Case()),
    "drawers tight in their walls": _cabinet(Stack((Drawer(),) * 2), "inset", slide_gap=0.001),
    "whole drawer boxes": _box("whole"),
    "drawer boxes without a bottom": _box("no bottom"),
    "drawer fronts with a shell": _box("shell"),
    "drawer fronts alone": _box("front only"),
    "lift-up flap": _cabinet(Door("top"), case=Case(height=0.4)),
    "drop-down flap": _cabinet(Door("bottom"), case=Case(height=0.4)),
    "inset flap under an overhang": _cabinet(Door("top"), "inset", Case(top=Top("over", overhang=0.03))),
    "chest with a lid": lambda: make_chest(Chest()),
    "corner door at 45 degrees": lambda: make_corner_cabinet(CornerCabinet()),
    "corner door at 30 degrees": lambda: make_corner_cabinet(CornerCabinet(along_x=1.043, along_y=0.75)),
    "cabinet turned by 30 degrees": lambda: yawed(make_cabinet(Cabinet(layout=MIXED)), radians(30)),
    "cabinet that faces +X": lambda: yawed(make_cabinet(Cabinet(layout=MIXED)), radians(90)),
    "table with hanging drawers": lambda: make_table(DrawerTable()),
    "table without aprons": lambda: make_table(DrawerTable(has_aprons=False)),
    "two-sided table": lambda: make_table(DrawerTable(two_sided=True)),
    "desk with a pedestal": lambda: make_desk(Desk()),
    "tall wardrobe": _cabinet(Pair(), case=Case(1.0, 2.2, 0.6, base=Base("plinth"))),
    "thin panels": _cabinet(Pair(), case=Case(panel=0.008, back=Back(thickness=0.003)), front=0.008),
    "thick panels": _cabinet(Pair(), "inset", Case(1.0, panel=0.05), front=0.05, gap=0.003),
    "no top": _cabinet(Pair(), case=Case(top=Top("none"))),
    "chamfered door": _leaf("chamfered"),
    "rounded door": _leaf("rounded"),
    "bowed door": _leaf("bowed"),
    "framed door": _leaf("shaker"),
    "glass door": _leaf("glass"),
    "pair bowed as one": _cabinet(Pair("swept frame"), case=Case()),
    "inset louvred pair": _cabinet(Pair("louvred"), "inset", Case(), gap=0.002),
    "pair under one arch": _cabinet(Pair("half arched"), case=Case()),
    "fronts with lips": _cabinet(
        Stack((Pair(handle="none", grip="lip"), Drawer(handle="none", grip="lip"))), case=Case()
    ),
    "fronts with finger holes": _cabinet(Pair(handle="none", grip="finger hole"), case=Case()),
    "lying handles at the top": _cabinet(Pair(handle="bar-slim", hold=Hold("top edge", ratio=0.8)), case=Case()),
    "moulding above": _cabinet(Pair(), case=Case(moulding=0.06)),
    "moulding below": _cabinet(Pair(), case=Case(moulding=0.06, moulding_at="bottom")),
    "muntin between a pair": _cabinet(Pair(muntin=0.04), case=Case()),
}
NOISY: dict[str, Maker] = {
    "sheets for panels": _mixed(lambda a: edits.with_sheets(a, PANELS)),
    "sheets for doors": _mixed(lambda a: edits.with_sheets(a, ("door",))),
    "open backs": _mixed(edits.with_open_backs),
    "doubled faces": _mixed(edits.with_doubled_faces),
    "inverted normals": _mixed(edits.with_inverted_normals),
    "degenerate faces": _mixed(edits.with_degenerate_faces),
    "loose faces": _mixed(edits.with_loose_faces),
    "many shells": _mixed(lambda a: edits.with_many_shells(a, 4, PANELS)),
    "one still body": _mixed(lambda a: edits.with_merged(a, PANELS)),
    "doors into the case": _mixed(lambda a: edits.with_shifted(a, "door_1", vec3(0.0, 0.003, 0.0))),
    "inset door into the side": lambda: edits.with_swollen(
        make_cabinet(Cabinet(layout=Door(), mount="inset")), "door", vec3(0.006, 0.0, 0.0)
    ),
    "drawer into both walls": lambda: edits.with_swollen(
        make_cabinet(Cabinet(case=NARROW, layout=Drawer(), mount="inset")), "drawer", vec3(0.005, 0.0, 0.0)
    ),
    "floating door": _mixed(lambda a: edits.with_shifted(a, "door_1", vec3(0.0, -0.008, 0.0))),
    "names lost": _mixed(edits.with_labels_lost),
    "handles lost": _mixed(lambda a: edits.without_parts(a, ("handle",))),
}
KINDS: dict[str, Maker] = {**TIDY, **NOISY}


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
            (*(Drawer(),) * fronts, OpenCell(shelves)) if shelves else (Drawer(),) * fronts, (), "nothing"
        )
        return make_cabinet(Cabinet(f"wall_{parts}", Case(0.6, 0.25 * (fronts + 1)), layout))
    extra = [spare // columns + (k < spare % columns) for k in range(columns)]
    layout = CellRow(tuple(_column(shelves) for shelves in extra))
    return make_cabinet(Cabinet(f"wall_{parts}", Case(0.6 * columns, 2.0), layout))


def _column(shelves: int) -> Layout:
    return Stack((*(Drawer(),) * 4, Door(shelves=shelves)), (1.0, 1.0, 1.0, 1.0, 4.0), "nothing")


def kitchen_base() -> Asset:
    """Returns a kitchen base cabinet: two overlay doors under two drawers, a worktop, a plinth."""
    drawers = CellRow((Drawer(), Drawer()))
    layout = Stack((Pair(leaf="shaker", shelves=1), drawers), (3.4, 1.0))
    case = Case(0.9, 0.9, 0.56, base=Base("plinth"), top=Top("over", overhang=0.025))
    return make_cabinet(Cabinet("kitchen_base", case, layout, finish=textured_finish(1)))


def dresser() -> Asset:
    """Returns a dresser on legs: six inset drawers in a face frame, with knobs."""
    row = CellRow((Drawer(handle="knob-round", leaf="chamfered"), Drawer(handle="knob-round", leaf="chamfered")))
    layout = Stack((row, row, row), (1.3, 1.15, 1.0), between="rail")
    case = Case(1.3, 0.85, 0.48, base=Base("legs", 0.14), top=Top("over", overhang=0.02), frame=FaceFrame(0.032))
    return make_cabinet(Cabinet("dresser", case, layout, "inset", gap=0.002, finish=textured_finish(2)))


def wardrobe() -> Asset:
    """Returns a tall wardrobe: a pair of doors and a single one with drawers behind it, under a moulding."""
    chest = Stack(
        (Drawer(handle="knob-round"), Drawer(handle="knob-round"), OpenCell(shelves=2)),
        (1.0, 1.0, 4.0),
        between="nothing",
    )
    layout = CellRow((Pair(leaf="shaker", shelves=1), Door("right", "shaker", behind=chest)), (2.0, 1.0))
    case = Case(1.5, 2.1, 0.58, panel=0.02, base=Base("plinth", 0.08), moulding=0.06)
    return make_cabinet(Cabinet("wardrobe", case, layout, front=0.022, finish=textured_finish(3)))


def sideboard() -> Asset:
    """Returns a sideboard: a glass door, three drawers, a drop-down flap over an open bay."""
    drawers = Stack((Drawer(), Drawer(), Drawer()), between="nothing")
    layout = CellRow((Door("left", "glass", "knob-round", shelves=2), drawers, Stack((OpenCell(), Door("bottom")))))
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
