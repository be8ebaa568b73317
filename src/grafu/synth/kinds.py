"""A catalogue of the kinds of furniture on which building mechanisms is hard: a table from name to maker.

Every kind has its true joints. The untidy ones state the same joints as their tidy originals, whatever collides.
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
from grafu.synth.fronts.layout import Bay, Door, Drawer, DrawerBox, Layout, LeafStyle, Pair, Row, Stack
from grafu.synth.fronts.setting import Mount
from grafu.synth.noise import untidy
from grafu.synth.tables.desk import Desk, make_desk
from grafu.synth.tables.table import Table, make_table

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
    return lambda: edit(make_cabinet(Cabinet("untidy", layout=MIXED)))


TIDY: dict[str, Maker] = {
    "overlay pair": _cabinet(Pair(shelves=1), case=Case()),
    "overlay door, hinged right": _cabinet(Door("right")),
    "overlay door without a handle": _cabinet(Door(handle="none")),
    "inset pair": _cabinet(Pair(), "inset", Case(), gap=0.002),
    "inset door, tight": _cabinet(Door(), "inset", gap=0.001),
    "half-overlay doors on one divider": _cabinet(Row((Door("right"), Door("left"))), case=Case()),
    "three doors in a row": _cabinet(Row((Door("left"), Door("left"), Door("right"))), case=Case(1.2)),
    "inset doors in a face frame": _cabinet(Pair(), "inset", Case(frame=FaceFrame(0.04)), gap=0.002),
    "overlay doors on a face frame": _cabinet(Pair(), case=Case(frame=FaceFrame(0.04)), lap=0.012),
    "drawers behind a pair": _cabinet(Pair(behind=Stack((Drawer(handle="knob-round"), Bay()))), case=Case()),
    "drawers behind an inset door": _cabinet(Door(behind=Stack((Drawer(handle="none"),) * 2)), "inset"),
    "drawers with rails between": _cabinet(Stack((Drawer(),) * 3, between="rail"), "inset"),
    "drawers with panels between": _cabinet(Stack((Drawer(),) * 3)),
    "drawers side by side without a wall": _cabinet(Row((Drawer(), Drawer()), between="nothing"), case=Case()),
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
    "table with hanging drawers": lambda: make_table(Table()),
    "table without aprons": lambda: make_table(Table(has_aprons=False)),
    "two-sided table": lambda: make_table(Table(two_sided=True)),
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
    "lying handles at the top": _cabinet(Pair(handle="bar-slim", hold=Hold("top edge", share=0.8)), case=Case()),
    "moulding above": _cabinet(Pair(), case=Case(moulding=0.06)),
    "moulding below": _cabinet(Pair(), case=Case(moulding=0.06, moulding_at="bottom")),
    "muntin between a pair": _cabinet(Pair(muntin=0.04), case=Case()),
}
UNTIDY: dict[str, Maker] = {
    "sheets for panels": _mixed(lambda a: untidy.with_sheets(a, PANELS)),
    "sheets for doors": _mixed(lambda a: untidy.with_sheets(a, ("door",))),
    "open backs": _mixed(untidy.with_open_backs),
    "doubled faces": _mixed(untidy.with_doubled_faces),
    "inverted normals": _mixed(untidy.with_inverted_normals),
    "degenerate faces": _mixed(untidy.with_degenerate_faces),
    "loose faces": _mixed(untidy.with_loose_faces),
    "many shells": _mixed(lambda a: untidy.with_many_shells(a, 4, PANELS)),
    "one still body": _mixed(lambda a: untidy.with_merged(a, PANELS)),
    "doors into the case": _mixed(lambda a: untidy.with_shifted(a, "door_1", vec3(0.0, 0.003, 0.0))),
    "inset door into the side": lambda: untidy.with_swollen(
        make_cabinet(Cabinet(layout=Door(), mount="inset")), "door", vec3(0.006, 0.0, 0.0)
    ),
    "drawer into both walls": lambda: untidy.with_swollen(
        make_cabinet(Cabinet(case=NARROW, layout=Drawer(), mount="inset")), "drawer", vec3(0.005, 0.0, 0.0)
    ),
    "floating door": _mixed(lambda a: untidy.with_shifted(a, "door_1", vec3(0.0, -0.008, 0.0))),
    "names lost": _mixed(untidy.with_labels_lost),
    "handles lost": _mixed(lambda a: untidy.without_parts(a, ("handle",))),
}
KINDS: dict[str, Maker] = {**TIDY, **UNTIDY}
