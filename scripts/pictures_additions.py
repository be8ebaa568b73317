"""The contact sheets of docs/additions.md: furniture that we make, before and after something was added to it.

Motions are the synthetic furniture's own, so no weights change a picture. `python scripts/pictures.py` writes the
sheets.
"""

from collections.abc import Callable
from dataclasses import replace
from math import radians

import numpy as np

from grafu.additions.config import NO_ADDITIONS, AdditionConfig
from grafu.additions.grip.config import GripConfig, GripKind
from grafu.additions.handle.config import HandleConfig
from grafu.additions.interior.request import parse_interior
from grafu.additions.top.complete import missing_top
from grafu.additions.top.config import TopConfig, TopShape
from grafu.articulation.articulated_object import Visual
from grafu.asset.edit import as_static_object
from grafu.asset.part import Asset, Part, PartSource
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.pipeline.functionalize import Functionalized, functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.render.camera import Camera, three_quarter_view
from grafu.render.picture import Picture, box_of, contact_sheet, opened_values, posed_visuals, render
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.cabinets.corner import CornerCabinet, InnerCorner, make_corner_cabinet, make_inner_corner
from grafu.synth.case.case import Case
from grafu.synth.case.construction import Base, Top
from grafu.synth.families.table import draw_made
from grafu.synth.fronts.layout import CellRow, Door, Drawer, Layout, OpenCell, Pair, Stack
from grafu.synth.noise.edits import without_parts
from grafu.synth.pieces.finish import textured_finish
from grafu.synth.tables.desk import Desk, make_desk
from grafu.synth.tables.table import DrawerTable, make_table
from grafu.templates.gallery import builtin_gallery
from grafu.templates.handles import HANDLES
from grafu.vocabulary import JointType, PartLabel

Shot = tuple[Picture, str]
Size = tuple[int, int]
View = Callable[[Box, float], Camera]

BARE = Top("none")
PLINTH = Base("toe kick", 0.1)
STEEL = Material("steel", (0.55, 0.56, 0.57, 1.0), metallic=0.6, roughness=0.35)
JUDGED = (  # family and seed; of the last desk, only the top joins what carries it
    ("table with drawers", 1),
    ("table with drawers", 2),
    ("vanity", 1),
    ("kitchen island", 3),
    ("oven", 1),
    ("oven", 3),
    ("fridge", 2),
    ("fridge", 3),
    ("desk", 3),
    ("desk", 2),
)


def tops_sheet() -> Picture:
    """Returns topless furniture beside the tops that it was given: rectangle, L, rounded, chamfered, with a cut-out."""
    shots: list[Shot] = []
    for asset, shape, name, view in _topless():
        after = _made(asset, AdditionConfig(top=TopConfig(shape=shape)))
        shots += _pair(asset, after, (name, f"added: {_style_of(after)}"), view, (300, 240))
    return _sheet(shots, 4)


def judged_sheet() -> Picture:
    """Returns tables and appliances as they were made, without their tops, and with those that they were given."""
    shots: list[Shot] = []
    for family, seed in JUDGED:
        asset = draw_made(np.random.default_rng(seed), family)[1]
        bare = without_parts(asset, ("top panel",))
        whole, after = _made(asset), _made(bare)
        seen = f"{_covered(whole):.0%} covered, {_tops_of(whole)} added"
        shots.append((_picture(_static(asset), (230, 190), _from_above), seen))
        texts = f"{_covered(after):.0%} covered", f"added: {_style_of(after)}"
        shots += _pair(bare, after, texts, _from_above, (230, 190))
    return _sheet(shots, 6)


def handles_sheet() -> Picture:
    """Returns every handle template on the door and the drawer of one cabinet."""
    bare = _cabinet(Stack((Door("left", handle="none"), Drawer(handle="none")), (2.0, 1.0)), Case(0.4, 0.5, 0.36), 2)
    shots: list[Shot] = []
    for template in HANDLES:
        after = _made(bare, AdditionConfig(handles=HandleConfig(style=template.id)))
        shots.append((_picture(_closed(after), (230, 260)), template.id))
    return _sheet(shots, 6)


def grips_sheet() -> Picture:
    """Returns the three kinds of recessed grips close up, carved into a drawer's front."""
    bare = _cabinet(Stack((Door("left", handle="none"), Drawer(handle="none"))), Case(0.5, 0.5, 0.4), 2)
    shots: list[Shot] = []
    for kind in GripKind:
        after = _made(bare, AdditionConfig(handles=None, grips=GripConfig(kind)))
        shots.append((_picture(_closed(after), (380, 280), _close_up), kind.value))
    return _sheet(shots, 3)


def interiors_sheet() -> Picture:
    """Returns empty cabinets, doors open, and what they are furnished with on request."""
    shots: list[Shot] = []
    chest = Stack((Drawer(handle="knob-round"), OpenCell()), (1.0, 3.0))
    for asset, requests in (
        (_cabinet(Pair(), Case(1.1, 2.0, 0.58, base=PLINTH), 3), ("shelves=3", "auto")),
        (_cabinet(Pair(behind=chest), Case(1.1, 1.0, 0.5, base=PLINTH), 1), ("shelves=1", "auto")),
        (_cabinet(CellRow((Pair(), Pair())), Case(1.6, 0.8, 0.45, base=PLINTH), 4), ("shelves=1,dividers=1", "auto")),
    ):
        shots.append((_picture(_doors_open(_made(asset, NO_ADDITIONS)), (340, 260), _from_ahead), "as it was"))
        for request in requests:
            after = _made(asset, AdditionConfig(interior=parse_interior(request)))
            shots.append((_picture(_doors_open(after), (340, 260), _from_ahead), f"--interior {request}"))
    return _sheet(shots, 3)


def drawers_sheet() -> Picture:
    """Returns drawers that were only a front, opened without and with the boxes that they are given."""
    drawer = Drawer("front only", travel=0.75)
    asset = _cabinet(Stack((drawer, drawer), between="nothing"), Case(0.6, 0.55, 0.5), 1)
    before, after = _made(asset, NO_ADDITIONS), _made(asset)
    shots = [
        (_picture(_opened(result), (420, 360), _from_high), caption)
        for result, caption in ((before, "--no-drawer-boxes"), (after, "boxes added"))
    ]
    return _sheet(shots, 2)


SHEETS: dict[str, Callable[[], Picture]] = {
    "tops": tops_sheet,
    "tops_judged": judged_sheet,
    "handles": handles_sheet,
    "grips": grips_sheet,
    "interiors": interiors_sheet,
    "drawer_boxes": drawers_sheet,
}


def _topless() -> list[tuple[Asset, TopShape, str, View]]:
    """Returns furniture without a top, the shape to give it, what it is, and from where it is seen."""
    low = Stack((Pair(), CellRow((Drawer(), Drawer()))), (3.0, 1.0))
    base = Case(0.9, 0.85, 0.56, base=PLINTH, top=BARE)
    sideboard = Case(1.5, 0.72, 0.42, base=Base("legs", 0.14), top=BARE)
    drawers = Stack((CellRow((Drawer(), Drawer())),) * 3, between="rail")
    inner = make_inner_corner(InnerCorner(topped=False, finish=textured_finish(3)))
    corner = make_corner_cabinet(CornerCabinet(topped=False, finish=textured_finish(5)))
    desk = without_parts(make_desk(Desk(left=Door("left"), finish=textured_finish(6))), ("top panel",))
    table = without_parts(make_table(DrawerTable(finish=textured_finish(3))), ("top panel",))
    return [
        (_cabinet(low, base, 1), "rectangle", "base cabinet", _from_above),
        (inner, "rectangle", "inner corner", _from_right),
        (_cabinet(CellRow((Door("left"), Pair())), sideboard, 4), "rounded", "sideboard", _from_above),
        (_cabinet(drawers, Case(1.1, 0.8, 0.48, top=BARE), 2), "chamfered", "chest of drawers", _from_above),
        (corner, "rectangle", "corner cabinet", _from_right),
        (_with_basin(_cabinet(Pair(), base, 1), 0.85), "rectangle", "washstand with a basin", _from_above),
        (desk, "rounded", "desk", _from_above),
        (table, "chamfered", "table", _from_above),
    ]


def _cabinet(layout: Layout, case: Case, seed: int) -> Asset:
    return make_cabinet(Cabinet("cabinet", case, layout, finish=textured_finish(seed)))


def _with_basin(asset: Asset, rim: float) -> Asset:
    """Returns the asset with a basin in its middle whose rim lies a little above its walls."""
    x, y, low, high, t, edge = 0.26, 0.17, rim - 0.15, rim + 0.03, 0.004, 0.02
    spans = [
        ((-x, -y, low), (x, y, low + t)),
        ((-x, -y, low), (t - x, y, high)),
        ((x - t, -y, low), (x, y, high)),
        ((-x, -y, low), (x, t - y, high)),
        ((-x, y - t, low), (x, y, high)),
        ((-x - edge, -y - edge, high - t), (t - x, y + edge, high)),
        ((x - t, -y - edge, high - t), (x + edge, y + edge, high)),
        ((-x, -y - edge, high - t), (x, t - y, high)),
        ((-x, y - t, high - t), (x, y + edge, high)),
    ]
    mesh = merge_meshes([TriangleMesh.box_mesh(Box(vec3(*low), vec3(*high))) for low, high in spans])
    part = Part("basin", PartLabel.MISC, (Surface(mesh, STEEL),), PartSource("basin"), "name")
    return replace(asset, parts=(*asset.parts, part))


def _made(asset: Asset, additions: AdditionConfig | None = None) -> Functionalized:
    config = PipelineConfig(Settings(additions=additions or AdditionConfig()))
    return functionalize(asset, MotionSource.ANNOTATION, builtin_gallery(), config)


def _style_of(result: Functionalized) -> str:
    return next((a.style for a in result.body.additions if a.part.label is PartLabel.TOP_PANEL), "nothing")


def _covered(result: Functionalized) -> float:
    """Returns the ratio of the input's top that was covered before anything was added."""
    return missing_top(result.asset.parts, result.plan.joints).ratio


def _tops_of(result: Functionalized) -> int:
    return sum(addition.part.label is PartLabel.TOP_PANEL for addition in result.additions)


def _static(asset: Asset) -> list[Visual]:
    return posed_visuals(as_static_object(asset))


def _closed(result: Functionalized) -> list[Visual]:
    return posed_visuals(result.object)


def _opened(result: Functionalized) -> list[Visual]:
    return posed_visuals(result.object, opened_values(result.object))


def _doors_open(result: Functionalized) -> list[Visual]:
    """Returns all visuals with doors open and drawers closed."""
    doors = {joint.id for joint in result.object.joints if joint.type is JointType.REVOLUTE}
    values = {name: value for name, value in opened_values(result.object).items() if name in doors}
    return posed_visuals(result.object, values)


def _pair(asset: Asset, after: Functionalized, texts: tuple[str, str], view: View, size: Size) -> list[Shot]:
    """Returns an asset as it came and as it is now, seen by one camera."""
    camera = view(box_of(_closed(after)), size[0] / size[1])
    shown = (_static(asset), _closed(after))
    return [(render(visuals, camera, size), text) for visuals, text in zip(shown, texts, strict=True)]


def _picture(visuals: list[Visual], size: Size, view: View = three_quarter_view) -> Picture:
    return render(visuals, view(box_of(visuals), size[0] / size[1]), size)


def _sheet(shots: list[Shot], columns: int) -> Picture:
    return contact_sheet([picture for picture, _ in shots], [caption for _, caption in shots], columns)


def _from_above(box: Box, aspect: float) -> Camera:
    return three_quarter_view(box, aspect, radians(-30), radians(34))


def _from_right(box: Box, aspect: float) -> Camera:
    return three_quarter_view(box, aspect, radians(28), radians(34))


def _from_high(box: Box, aspect: float) -> Camera:
    return three_quarter_view(box, aspect, radians(-38), radians(40))


def _from_ahead(box: Box, aspect: float) -> Camera:
    return three_quarter_view(box, aspect, radians(-14), radians(14))


def _close_up(box: Box, _: float) -> Camera:
    """Returns a camera before the middle of the front's upper part."""
    target = vec3(float(box.center[0]), float(box.low[1]), float(box.low[2] + 0.9 * box.size[2]))
    return Camera(target + vec3(-0.18, -0.5, 0.3), target)
