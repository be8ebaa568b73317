"""Cabinets, tables, desks and chests of every construction, one of each: what several tests go through."""

from grafu.synth.cabinets.bureau import Bureau
from grafu.synth.cabinets.cabinet import Cabinet
from grafu.synth.cabinets.chest import Chest
from grafu.synth.cabinets.corner import CornerCabinet, InnerCorner
from grafu.synth.cabinets.rack import Rack
from grafu.synth.case.case import Case
from grafu.synth.case.construction import Back, Base, Bottom, FaceFrame, Sides, Top
from grafu.synth.case.legs import Leg
from grafu.synth.fronts.hold import Inside
from grafu.synth.fronts.layout import Blank, CellRow, Door, Drawer, OpenCell, Pair, Stack, Tilt
from grafu.synth.tables.desk import Desk
from grafu.synth.tables.table import DrawerTable

MIXED = Stack((Pair(shelves=1), CellRow((Drawer(), Drawer()))), (3.0, 1.0))
LEGS = ("square", "tapered", "round", "cone", "turned", "splayed", "hairpin", "cabriole")
FEET = {"block": 0.05, "bun": 0.06, "caster": 0.07, "pad": 0.004}
THREE = Stack((Drawer(),) * 3)


def _posts(stretcher: str, mount: str) -> Cabinet:
    base = Base("posts", 0.4, Leg("square", 0.04), stretcher=stretcher)
    return Cabinet(case=Case(1.0, 0.85, 0.4, base=base), layout=MIXED, mount=mount)


def _kitchen(top: str, layout, **parts) -> Cabinet:
    frame = FaceFrame(0.035, "bars")
    case = Case(0.96, 0.79, 0.56, panel=0.012, base=Base("toe kick"), top=Top(top), frame=frame, **parts)
    return Cabinet(case=case, layout=layout, lap=0.02)


CASES = {
    "toe kick of two boards": Case(base=Base("toe kick", boards=2)),
    "toe kick of four boards": Case(base=Base("toe kick", boards=4)),
    "sled": Case(base=Base("sled")),
    **{f"{s} legs": Case(height=0.9, base=Base("legs", 0.22, Leg(s), inset=0.02)) for s in LEGS},
    **{f"{s} feet": Case(base=Base("legs", high, Leg(s, 0.045))) for s, high in FEET.items()},
    "apron": Case(height=0.9, base=Base("legs", 0.2, Leg("square"), apron=0.08, arched=True)),
    "countertop": Case(base=Base("toe kick"), top=Top("over", 0.04, 0.02, front=0.02)),
    "moulded top": Case(top=Top("over", 0.04, 0.03, edge="moulded")),
    "rounded top": Case(top=Top("over", 0.06, 0.03, edge="rounded", rim=0.06)),
    "chamfered top": Case(top=Top("over", 0.03, edge="chamfered")),
    "glass top": Case(top=Top("over", 0.01, 0.02, glass=True)),
    "panelled sides": Case(sides=Sides("framed")),
    "slatted sides": Case(sides=Sides("slats")),
    "sides before the front": Case(sides=Sides(beyond=0.02)),
    "bottom under the sides": Case(bottom=Bottom("under", 0.035, 0.01), base=Base("plinth")),
    "no bottom": Case(bottom=Bottom("none")),
    "pilasters": Case(1.0, pilaster=0.05, moulding=0.08),
    "split back, planted on": Case(back=Back("split", planted=True)),
    "half back": Case(back=Back("half")),
    "back rails": Case(back=Back("none", rails=3)),
    "edge strips": Case(frame=FaceFrame(0.04, "strips"), back=Back(thickness=0.004, rails=3)),
    "arched frame": Case(frame=FaceFrame(0.05, arched=True)),
    "arched bars": Case(frame=FaceFrame(0.05, "bars", arched=True)),
    "double sides": Case(panel=0.03, sides=Sides("double")),
    "top rail": Case(top=Top("over", overhang=0.02, rail=0.05)),
    "top rail behind strips": Case(frame=FaceFrame(kind="strips"), top=Top(rail=0.04)),
    "posts with a skirt": Case(0.86, 0.6, 0.6, base=Base("posts", 0.08, Leg("square", 0.036), skirt=True)),
    "cornice": Case(top=Top("over", 0.05, 0.03, edge="cornice")),
    "legs with a skirt": Case(base=Base("legs", 0.1, Leg("square", 0.04), skirt=True)),
}
CABINETS = {
    **{name: Cabinet(case=case, layout=MIXED) for name, case in CASES.items()},
    **{f"overlay posts, {s}": _posts(s, "overlay") for s in ("none", "H", "box")},
    **{f"inset posts, {s}": _posts(s, "inset") for s in ("sides", "shelf")},
    "turned posts": Cabinet(case=Case(1.0, 0.85, 0.4, base=Base("posts", 0.4, Leg("turned", 0.05))), layout=THREE),
    "fronts over posts": Cabinet(
        case=Case(0.86, 0.6, 0.6, base=Base("posts", 0.05, Leg("square", 0.036))), layout=THREE, slide_gap=0.014
    ),
    "kitchen stretchers": _kitchen("stretchers", MIXED, bottom=Bottom("sheet")),
    "corner blocks": _kitchen("corner blocks", CellRow((Stack((Door(), Blank()), (3.0, 1.0)), Drawer(runners=True)))),
    "frameless stretchers": Cabinet(case=Case(top=Top("stretchers")), layout=MIXED),
    "sink": Cabinet(case=Case(top=Top("over", 0.03, 0.02, sink=True)), layout=Pair()),
    "metal uprights": Cabinet(
        case=Case(0.6, 1.8, 0.38, sides=Sides("metal"), back=Back("none", 0.0)),
        layout=Stack((Drawer(), Drawer(), OpenCell(3)), (1.0, 1.0, 5.0)),
    ),
    "rods and dividers": Cabinet(
        case=Case(1.0, 2.0, 0.6),
        layout=CellRow((OpenCell(1, Inside(rod=True)), OpenCell(2, Inside("short", dividers=2, rails=2)))),
    ),
    "baskets": Cabinet(
        layout=CellRow((Door(inside=Inside(basket="wire")), OpenCell(1, Inside("glass", basket="rack"))))
    ),
    "runners": Cabinet(layout=CellRow((OpenCell(0, Inside(runners=3)), Stack((Drawer(runners=True),) * 3)))),
    "shoe cabinet": Cabinet(
        case=Case(0.8, 1.1, 0.3), layout=Stack((Tilt(), Tilt(handle="none"), Tilt(tray=False)), between="rail")
    ),
    "inset shoe cabinet": Cabinet(case=Case(0.8, 0.5, 0.3), layout=Tilt(), mount="inset"),
    "drawer boxes": Cabinet(
        layout=Stack((Drawer("floating"), Drawer("four walls"), Drawer("tray"), Drawer("tray", runners=True)))
    ),
    "island": Cabinet(
        case=Case(1.4, 0.9, 0.8, top=Top("over", 0.04, 0.03, back=0.03)),
        layout=MIXED,
        rear=CellRow((OpenCell(1), Door())),
    ),
    "fridge": Cabinet(
        case=Case(0.6, 1.8, 0.55, panel=0.04), front=0.07, layout=Stack((Door(), Door()), (2.0, 1.0), "nothing")
    ),
    "oven": Cabinet(
        layout=Stack((Drawer(), Door("bottom", "glass"), Blank(name="control_panel")), (1.0, 4.0, 0.8), "nothing")
    ),
}
LIPPED = Inside(setback=0.0, lip=0.03, cleats=True, dividers=1, rails=2, blocks=True)
TOUCHING = {
    "shelves against doors": Pair(shelves=3, inside=Inside(setback=0.0)),
    "shelves set back": CellRow(
        (Door(shelves=2, inside=Inside(setback=0.06, cleats=True)), OpenCell(3, Inside("short", lip=0.02)))
    ),
    "lips, cleats and blocks": CellRow((Door(shelves=2, inside=LIPPED), OpenCell(1, LIPPED))),
    "open frames between drawers": Stack(
        (Drawer(), CellRow((Drawer(), Drawer()), between="frame"), Drawer()), between="frame"
    ),
    "flaps that meet fronts": Stack((Drawer(), Door("bottom"), Door("top"), Drawer("tray")), between="nothing"),
}
CABINETS |= {
    **{name: Cabinet(case=Case(0.9, 1.1, 0.4), layout=layout) for name, layout in TOUCHING.items()},
    **{f"{name}, inset": Cabinet(layout=layout, mount="inset") for name, layout in TOUCHING.items()},
    "open frames in a face frame": Cabinet(
        case=Case(frame=FaceFrame(0.04, "bars")), layout=TOUCHING["open frames between drawers"], lap=0.01
    ),
    "lips in a face frame": Cabinet(case=Case(frame=FaceFrame(0.04)), layout=TOUCHING["lips, cleats and blocks"]),
    "fronts flush with the case": Cabinet(layout=MIXED, reveal=0.0),
    "fronts wider than the case": Cabinet(
        case=Case(base=Base("posts", 0.05, Leg("square", 0.036))), layout=THREE, reveal=-0.01
    ),
    "top and bottom that follow swept doors": Cabinet(
        case=Case(0.8, 1.3, 0.3, top=Top("over", 0.04, 0.02), bottom=Bottom("under", 0.04, 0.02)),
        layout=Pair("swept", "none", shelves=2, inside=Inside(setback=0.0)),
    ),
    "doors wider than the case": Cabinet(layout=CellRow((Door("left"), Door("right"))), reveal=-0.02),
}
BUREAUS = {
    "bureau": Bureau(),
    "steep bureau": Bureau(
        lower=Cabinet(case=Case(0.7, 0.7, 0.42, base=Base("legs", 0.15)), layout=Pair(), mount="inset"),
        shelf=0.3,
        flap=Door("bottom", "raised panel"),
        holes=0,
    ),
}
HUTCH = Cabinet(case=Case(1.1, 0.45, 0.25), layout=CellRow((OpenCell(1), Drawer(), OpenCell(1))))
TABLES = {
    **{f"{s} table legs": DrawerTable(leg_shape=s, overhang=0.03) for s in ("square", "tapered", "turned", "cabriole")},
    "splayed table legs": DrawerTable(leg_shape="splayed", overhang=0.05),
    **{f"table stretchers, {s}": DrawerTable(stretcher=s) for s in ("sides", "H", "box", "shelf")},
    "guides": DrawerTable(
        width=0.66, depth=0.53, leg=0.043, overhang=0.08, apron=0.2, guides=True, arch=0.04, layout=Drawer()
    ),
    "round table": DrawerTable(width=0.7, depth=0.7, outline="round", leg=0.04, layout=Drawer()),
    "oval table on hairpins": DrawerTable(height=0.45, outline="round", leg=0.05, leg_shape="hairpin", layout=Drawer()),
    "glass table": DrawerTable(glass=True, top=0.01, overhang=0.05),
    "connectors": DrawerTable(width=2.3, depth=0.9, two_sided=True, layout=CellRow((Drawer(),) * 4)),
    "keyboard tray": DrawerTable(layout=CellRow((Drawer(), Drawer("tray"), Blank()))),
    "long table": DrawerTable(
        width=2.3, depth=0.9, two_sided=True, layout=CellRow((Drawer(),) * 5), spine=True, rails=0.02, moulding=0.05
    ),
    "long table, one side": DrawerTable(
        width=2.2, layout=CellRow((Drawer(),) * 4), spine=True, overhang=0.04, moulding=0.04, has_aprons=False
    ),
    "modesty": DrawerTable(modesty=0.5, stretcher="box", rails=0.02, layout=Drawer()),
    "hairpin table": DrawerTable(leg_shape="hairpin", leg=0.06, apron=0.08),
    "vanity": DrawerTable(mirror=0.6, edge="rounded"),
    "table with a hutch": DrawerTable(hutch=HUTCH),
}
DESKS = {
    "drawers between pedestals": Desk(width=1.6, left=THREE, middle=Drawer(), modesty=0.5, edge="rounded", top=0.05),
    "lifted top": Desk(left=THREE, middle=CellRow((Drawer("tray"), Drawer())), lift=0.07, base=Base("plinth", 0.06)),
    "desk on legs": Desk(legs=Leg("tapered", 0.05), middle=Drawer(), mount="inset"),
    "desk with a return": Desk(wing=0.9, hutch=HUTCH),
}
CHESTS = {
    "domed lid": Chest(dome=0.12, lid=0.03),
    "lid within": Chest(within=True, edge="rounded"),
    "chest with drawers": Chest(box=Case(1.0, 0.6, 0.5), drawers=CellRow((Drawer(), Drawer()))),
    "chest on posts": Chest(box=Case(1.0, 0.6, 0.5, base=Base("posts", 0.1, Leg("square", 0.05))), within=True),
}
RACKS = {
    "ladder rack": Rack(cabinet=Cabinet(case=Case(0.6, 0.5, 0.35), layout=THREE)),
    "rack on poles": Rack(kind="pole", lift=0.3, shelf_depth=1.0),
    "rack of panels": Rack(kind="panel", lift=0.0, metal=False, brackets=False),
}
CORNERS = {
    "angled corner on a toe kick": CornerCabinet(base=0.1, shelves=2, topped=False, height=0.9),
    "inner corner": InnerCorner(),
    "inner corner with two doors": InnerCorner(second=Door(), topped=False, shelves=2),
}
SPECS = {**BUREAUS, **RACKS, **CORNERS, **CABINETS, **TABLES, **DESKS, **CHESTS}
