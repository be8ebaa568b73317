"""Cabinets for a room's corner: five-sided ones with an angled door, and L-shaped ones with two wings along the walls.

An angled door is turned about Z by any angle; L-shaped cabinets have a door in both fronts or in one only.
"""

from collections.abc import Iterator
from dataclasses import replace
from math import atan2, cos, hypot, pi, sin, sqrt
from typing import final

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.transform import from_rotation, rotation_matrix
from grafu.synth.cabinets.carousel import carousel_piece
from grafu.synth.fronts.front import front_pieces
from grafu.synth.fronts.hold import EMPTY
from grafu.synth.fronts.layout import Blank, Cell, Door, Edge, Edges, Rect
from grafu.synth.fronts.setting import Mount, Setting
from grafu.synth.pieces.assembly import PieceDraft, assemble, plank, solid
from grafu.synth.pieces.finish import PLAIN, Finish, surface_of
from grafu.synth.pieces.shapes import framed_opening, prism
from grafu.vocabulary import PartLabel

RIGHT_DOOR = Door("right")
CLEAR = 0.008  # metres between a carousel and what is around it


@final
@dataclass(frozen=True, slots=True)
class InnerCorner:
    """An L-shaped corner cabinet, metres: `along_x` and `along_y` on its two walls, its wings `depth` deep.

    It fills the corner of two walls at y = 0 and x = 0. The front of the wing along x faces -Y and holds the `door`;
    the front of the other wing faces +X and holds the `second` door, or a blank board. Both hang at the far ends; a
    post `post` wide in the corner keeps them and their handles clear of each other. The case stands on a toe kick
    `base` high (0: none), `recess` behind its fronts; its top may be missing. With `trays` a carousel of so many stands
    in the corner; there are no shelves then.

    Raises:
        ValueError: if the wings are no longer than they are deep.
    """

    name: str = "inner_corner"
    along_x: float = 0.95
    along_y: float = 0.95
    depth: float = 0.56
    height: float = 0.82
    panel: float = 0.018
    post: float = 0.06
    door: Door = RIGHT_DOOR
    second: Door | None = None
    shelves: int = 1
    trays: int = 0
    base: float = 0.1
    recess: float = 0.05
    topped: bool = True
    front: float = 0.018
    gap: float = 0.003
    finish: Finish = PLAIN

    def __post_init__(self) -> None:
        if min(self.along_x, self.along_y) <= self.depth + self.post + 0.1:
            size = f"{self.along_x} x {self.along_y} m, {self.depth} m deep"
            raise ValueError(f"`InnerCorner` needs 0.1 m for a door between its post and its ends: got {size}")


def make_inner_corner(spec: InnerCorner) -> Asset:
    """Returns the corner cabinet with its doors' true joints."""
    return assemble(spec.name, [*corner_case(spec), *_fronts(spec)])


def corner_case(spec: InnerCorner) -> list[PieceDraft]:
    """Returns the pieces of an L-shaped corner cabinet without its fronts."""
    return [*_walls(spec), *_levels(spec), *_toe_kicks(spec), *_carousel(spec)]


def _carousel(spec: InnerCorner) -> Iterator[PieceDraft]:
    """Yields the carousel that fills the corner: it clears both backs, and the post in the inner corner."""
    if spec.trays:
        room = (sqrt(2) * (spec.depth - 2 * spec.panel - CLEAR) - CLEAR) / (1 + sqrt(2))
        middle = spec.panel + CLEAR + room
        floor, high = spec.base + spec.panel, spec.height - (spec.panel if spec.topped else 0.0)
        yield carousel_piece((middle, -middle), room, (floor, high), spec.trays, spec.finish)


def _walls(spec: InnerCorner) -> Iterator[PieceDraft]:
    """Yields ends, backs and the post in the corner, seen from above: walls on y = 0 and x = 0."""
    x, y, d, t, wood = spec.along_x, spec.along_y, spec.depth, spec.panel, spec.finish.case
    low, high = spec.base, spec.height
    yield plank(PartLabel.SIDE_PANEL, "side_panel_right", wood, ((x - t, -d, low), (x, 0.0, high)))
    yield plank(PartLabel.SIDE_PANEL, "side_panel_left", wood, ((0.0, -y, low), (d, t - y, high)))
    yield plank(PartLabel.BACK_PANEL, "back_panel_right", wood, ((0.0, -t, low), (x - t, 0.0, high)))
    yield plank(PartLabel.BACK_PANEL, "back_panel_left", wood, ((0.0, t - y, low), (t, -t, high)))
    z0, z1, w = low + t, high - (t if spec.topped else 0.0), spec.post
    boards = ((d - t, -d, z0), (d + w, t - d, z1)), ((d - t, -d - w, z0), (d, -d, z1))
    yield plank(PartLabel.FACE_FRAME, "corner_post", wood, *boards)


def _levels(spec: InnerCorner) -> Iterator[PieceDraft]:
    """Yields the L-shaped bottom, shelves and top."""
    t, low, high = spec.panel, spec.base, spec.height
    yield _level(spec, PartLabel.BOTTOM_PANEL, "bottom_panel", low, 0.0)
    for k in range(0 if spec.trays else spec.shelves):
        z = low + (high - low) * (k + 1) / (spec.shelves + 1) - t / 2
        yield _level(spec, PartLabel.SHELF, "shelf", z, t + 0.005)
    if spec.topped:
        yield _level(spec, PartLabel.TOP_PANEL, "top_panel", high - t, 0.0)


def _level(spec: InnerCorner, label: PartLabel, stem: str, z: float, back: float) -> PieceDraft:
    """Returns an L of two boards at the height `z` that stays `back` behind the fronts' planes."""
    x, y, d, t = spec.along_x, spec.along_y, spec.depth, spec.panel
    first = (t, back - d, z), (x - t, -t, z + t)
    second = (t, t - y, z), (d - back, back - d, z + t)
    return plank(label, stem, spec.finish.case, first, second)


def _toe_kicks(spec: InnerCorner) -> Iterator[PieceDraft]:
    if spec.base:
        x, y, t, low, wood = spec.along_x, spec.along_y, spec.panel, spec.base, spec.finish.case
        k = spec.depth - spec.recess
        yield plank(PartLabel.SIDE_PANEL, "toe_kick", wood, ((k, -k, 0.0), (x, t - k, low)))
        yield plank(PartLabel.SIDE_PANEL, "toe_kick", wood, ((k - t, -y, 0.0), (k, t - k, low)))


def _fronts(spec: InnerCorner) -> Iterator[PieceDraft]:
    """Yields the front that faces -Y, and the other: made facing -Y, then turned to face +X."""
    d, t = spec.depth, spec.panel
    low, high = spec.base + t, spec.height - (t if spec.topped else 0.0)
    setting = Setting(-d, 0.0, thickness=spec.front, gap=spec.gap, panel=t, finish=spec.finish)
    top = Edge.CASE if spec.topped else Edge.STOP
    near = Rect(d + spec.post, spec.along_x - t, low, high)
    edges = Edges(left=Edge.STOP, top=top)
    yield from front_pieces(
        Cell(replace(_before(spec.door, spec.trays), hinge="right", shelves=0), near, edges), setting
    )
    far = Rect(t - spec.along_y, -d - spec.post, low, high)
    leaf = (
        Blank(name="filler")
        if spec.second is None
        else replace(_before(spec.second, spec.trays), hinge="left", shelves=0)
    )
    turn = from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), pi / 2))
    for piece in front_pieces(Cell(leaf, far, Edges(right=Edge.STOP, top=top)), setting):
        yield piece.transformed(turn)


def _before(door: Door, trays: int) -> Door:
    """Returns a door before a carousel, where there is one: nothing else is behind it."""
    return replace(door, shelves=0, inside=EMPTY) if trays else door


ONE_DOOR = Door()
SHELF_ROOM = 0.02  # metres between the face frame and the shelves: an inset door may be thicker than the frame
Outline = tuple[tuple[float, float], ...]


@final
@dataclass(frozen=True, slots=True)
class CornerCabinet:
    """A corner cabinet, metres: it stands `along_x` and `along_y` against two walls, its ends `depth` deep.

    The front runs between the ends, yawed by atan2(along_y - depth, along_x - depth): 45 degrees where both walls are
    alike. The door hangs in a face frame of width `frame`. The case stands on boards `base` high (0: none), the one
    below the door `recess` behind the frame; its top may be missing. `height` is that of the whole. With `trays` a
    carousel of so many stands in it; there are no shelves then.

    Raises:
        ValueError: if the ends leave no room for a front.
    """

    name: str = "corner_cabinet"
    along_x: float = 0.9
    along_y: float = 0.9
    depth: float = 0.35
    height: float = 0.8
    panel: float = 0.018
    frame: float = 0.04
    door: Door = ONE_DOOR
    mount: Mount = "overlay"
    finish: Finish = PLAIN
    shelves: int = 1
    topped: bool = True
    base: float = 0.0
    recess: float = 0.05
    trays: int = 0

    def __post_init__(self) -> None:
        if self.base < 0 or self.base > self.height / 2:
            raise ValueError(f"`CornerCabinet.base` must be at most half the height: got {self.base} m")
        if min(self.along_x, self.along_y) <= self.depth or self.front_width <= 4 * self.frame:
            size = f"{self.along_x} x {self.along_y} m, ends {self.depth} m, frame {self.frame} m"
            raise ValueError(f"`CornerCabinet` needs walls longer than its ends, with room for a door: got {size}")

    @property
    def front_width(self) -> float:
        """The length of the angled front."""
        return hypot(self.along_x - self.depth, self.along_y - self.depth)

    @property
    def yaw(self) -> float:
        """How far the front is turned about Z, radians: 0 faces -Y, pi / 2 faces +X."""
        return atan2(self.along_y - self.depth, self.along_x - self.depth)


def make_corner_cabinet(spec: CornerCabinet) -> Asset:
    """Returns the corner cabinet with its door's true joint."""
    middle = vec3((spec.depth + spec.along_x) / 2, (spec.along_y - spec.depth) / 2, 0.0)
    T = from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), spec.yaw), middle)
    front = (piece.transformed(T) for piece in _front(spec))
    return assemble(spec.name, [*_case(spec), *_base(spec), *_trays(spec), *front])


def _trays(spec: CornerCabinet) -> Iterator[PieceDraft]:
    """Yields the carousel that stands before both backs and behind the shelves' front, as wide as has room."""
    if not spec.trays:
        return
    x, y, t = spec.along_x, spec.along_y, spec.panel
    inwards = -sin(spec.yaw), cos(spec.yaw)
    middle = (spec.depth + x) / 2, (y - spec.depth) / 2
    depth = (t + CLEAR - middle[0]) * inwards[0] + (y - t - CLEAR - middle[1]) * inwards[1] - t - SHELF_ROOM - CLEAR
    radius = min(depth / (1 + inwards[1] - inwards[0]), (min(x, y) - 2 * t) / 2 - CLEAR)
    at = t + CLEAR + radius, y - t - CLEAR - radius
    floor, high = spec.base + t, spec.height - (t if spec.topped else 0.0)
    yield carousel_piece(at, radius, (floor, high), spec.trays, spec.finish)


def _front(spec: CornerCabinet) -> Iterator[PieceDraft]:
    """Yields the frame and the door before they are turned: the plane y = 0, facing -Y, centred in x."""
    half, thick, b, low = spec.front_width / 2, spec.panel, spec.frame, spec.base
    setting = Setting(0.0, spec.depth, spec.mount, lap=0.6 * b, panel=b, finish=spec.finish)
    frame = framed_opening(Box(vec3(-half, 0.0, low), vec3(half, thick, spec.height)), b)
    yield PieceDraft(PartLabel.FACE_FRAME, "face_frame", tuple(surface_of(mesh, spec.finish.case) for mesh in frame))
    yield from front_pieces(
        Cell(_before(spec.door, spec.trays), Rect(b - half, half - b, low + b, spec.height - b), Edges()), setting
    )
    if low:
        span = ((b - half, spec.recess, 0.0), (half - b, spec.recess + thick, low))
        yield plank(PartLabel.SIDE_PANEL, "toe_kick", spec.finish.case, span)


def _base(spec: CornerCabinet) -> Iterator[PieceDraft]:
    """Yields the boards below the ends."""
    if spec.base:
        x, y, d, t, wood = spec.along_x, spec.along_y, spec.depth, spec.panel, spec.finish.case
        for span in (((0.0, 0.0, 0.0), (d - 0.02, t, spec.base)), ((x - t, y - d + 0.02, 0.0), (x, y, spec.base))):
            yield plank(PartLabel.SIDE_PANEL, "base_side_panel", wood, span)


def _case(spec: CornerCabinet) -> Iterator[PieceDraft]:
    x, y, t, h, floor = spec.along_x, spec.along_y, spec.panel, spec.height, spec.base
    flat: dict[str, tuple[PartLabel, Outline]] = {
        "side_panel_left": (PartLabel.SIDE_PANEL, ((t, 0.0), _across(spec, 0.0), _across(spec, t), (t, t))),
        "side_panel_right": (PartLabel.SIDE_PANEL, (_along(spec, x), (x, y - t), (x - t, y - t), _along(spec, x - t))),
        "back_panel_left": (PartLabel.BACK_PANEL, ((0.0, 0.0), (t, 0.0), (t, y - t), (0.0, y - t))),
        "back_panel_right": (PartLabel.BACK_PANEL, ((0.0, y - t), (x, y - t), (x, y), (0.0, y))),
    }
    for stem, (label, outline) in flat.items():
        yield solid(label, stem, spec.finish.case, [prism(outline, floor, h)])
    shelves = 0 if spec.trays else spec.shelves
    pitch = (h - floor) / (shelves + 1)
    levels = [(PartLabel.BOTTOM_PANEL, "bottom_panel", floor)]
    levels += [(PartLabel.SHELF, "shelf", floor + pitch * (k + 1) - t / 2) for k in range(shelves)]
    if spec.topped:
        levels.append((PartLabel.TOP_PANEL, "top_panel", h - t))
    for label, stem, z in levels:
        back = SHELF_ROOM if label is PartLabel.SHELF else 0.0
        outline = (_across(spec, t, back), _along(spec, x - t, back), (x - t, y - t), (t, y - t), (t, t))
        yield solid(label, stem, spec.finish.case, [prism(outline, z, z + t)])


def _across(spec: CornerCabinet, y: float, back: float = 0.0) -> tuple[float, float]:
    """Returns the point at this y on the face frame's inner face, or `back` behind it."""
    return spec.depth + (y * cos(spec.yaw) - spec.panel - back) / sin(spec.yaw), y


def _along(spec: CornerCabinet, x: float, back: float = 0.0) -> tuple[float, float]:
    """Returns the point at this x on the face frame's inner face, or `back` behind it."""
    return x, ((x - spec.depth) * sin(spec.yaw) + spec.panel + back) / cos(spec.yaw)
