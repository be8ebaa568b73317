"""L-shaped cabinets for a room's corner: two wings along the walls, with a door in both fronts or in one only."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import pi
from typing import final

from grafu.asset.part import Asset
from grafu.geometry.arrays import vec3
from grafu.geometry.transform import from_rotation, rotation_matrix
from grafu.synth.fronts.front import front_pieces
from grafu.synth.fronts.layout import Blank, Cell, Door, Edge, Edges, Rect
from grafu.synth.fronts.setting import Setting
from grafu.synth.pieces.assembly import Piece, assemble
from grafu.synth.pieces.finish import PLAIN, Finish
from grafu.synth.pieces.planks import plank
from grafu.vocabulary import PartLabel

RIGHT_DOOR = Door("right")


@final
@dataclass(frozen=True, slots=True)
class InnerCorner:
    """An L-shaped corner cabinet, metres: `along_x` and `along_y` on its two walls, its wings `depth` deep.

    It fills the corner of two walls at y = 0 and x = 0. The front of the wing along x faces -Y and holds the `door`;
    the front of the other wing faces +X and holds the `second` door, or a blank board. Both hang at the far ends; a
    post `post` wide in the corner keeps them and their handles clear of each other. The case stands on a toe kick
    `base` high (0: none), `recess` behind its fronts; its top may be missing.

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
    return assemble(spec.name, [*_walls(spec), *_levels(spec), *_base(spec), *_fronts(spec)])


def _walls(spec: InnerCorner) -> Iterator[Piece]:
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


def _levels(spec: InnerCorner) -> Iterator[Piece]:
    """Yields the L-shaped bottom, shelves and top."""
    t, low, high = spec.panel, spec.base, spec.height
    yield _level(spec, PartLabel.BOTTOM_PANEL, "bottom_panel", low, 0.0)
    for k in range(spec.shelves):
        z = low + (high - low) * (k + 1) / (spec.shelves + 1) - t / 2
        yield _level(spec, PartLabel.SHELF, "shelf", z, t + 0.005)
    if spec.topped:
        yield _level(spec, PartLabel.TOP_PANEL, "top_panel", high - t, 0.0)


def _level(spec: InnerCorner, label: PartLabel, stem: str, z: float, back: float) -> Piece:
    """Returns an L of two boards at the height `z` that stays `back` behind the fronts' planes."""
    x, y, d, t = spec.along_x, spec.along_y, spec.depth, spec.panel
    first = (t, back - d, z), (x - t, -t, z + t)
    second = (t, t - y, z), (d - back, back - d, z + t)
    return plank(label, stem, spec.finish.case, first, second)


def _base(spec: InnerCorner) -> Iterator[Piece]:
    if spec.base:
        x, y, t, low, wood = spec.along_x, spec.along_y, spec.panel, spec.base, spec.finish.case
        k = spec.depth - spec.recess
        yield plank(PartLabel.SIDE_PANEL, "toe_kick", wood, ((k, -k, 0.0), (x, t - k, low)))
        yield plank(PartLabel.SIDE_PANEL, "toe_kick", wood, ((k - t, -y, 0.0), (k, t - k, low)))


def _fronts(spec: InnerCorner) -> Iterator[Piece]:
    """Yields the front that faces -Y, and the other: made facing -Y, then turned to face +X."""
    d, t = spec.depth, spec.panel
    low, high = spec.base + t, spec.height - (t if spec.topped else 0.0)
    setting = Setting(-d, 0.0, thickness=spec.front, gap=spec.gap, panel=t, finish=spec.finish)
    top = Edge.CASE if spec.topped else Edge.STOP
    near = Rect(d + spec.post, spec.along_x - t, low, high)
    edges = Edges(left=Edge.STOP, top=top)
    yield from front_pieces(Cell(replace(spec.door, hinge="right", shelves=0), near, edges), setting)
    far = Rect(t - spec.along_y, -d - spec.post, low, high)
    leaf = Blank(name="filler") if spec.second is None else replace(spec.second, hinge="left", shelves=0)
    turn = from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), pi / 2))
    for piece in front_pieces(Cell(leaf, far, Edges(right=Edge.STOP, top=top)), setting):
        yield piece.transformed(turn)
