"""Chests: a box whose lid turns about its back edge, over its rim or within it, drawers below where there are any."""

from collections.abc import Iterator
from dataclasses import replace
from math import radians
from typing import final

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.synth.case.carcass import case_pieces
from grafu.synth.case.case import Case
from grafu.synth.case.construction import Top, TopEdge
from grafu.synth.case.tops import top_meshes
from grafu.synth.fronts.front import front_pieces, partition_pieces
from grafu.synth.fronts.layout import Cell, Edges, Layout, Rect, divide
from grafu.synth.fronts.setting import Setting
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, assemble, plank
from grafu.synth.pieces.finish import PLAIN, Finish, surface_of
from grafu.synth.pieces.shapes import domed_board
from grafu.vocabulary import JointType, PartLabel

LOW_BOX = Case(width=1.0, height=0.45, depth=0.5, top=Top("none"))


@final
@dataclass(frozen=True, slots=True)
class Chest:
    """A chest, metres: a box that a front board and a lid close.

    The lid lies `seat` above the box and juts out by `overhang` at the front and the sides; with `within`, it lies
    flush between the box's walls, `gap` from them. One above the box may be a dome, `dome` higher in the middle. Inset
    `drawers` fill the lower `drawers_ratio` of the front.

    Raises:
        ValueError: if the box is not deep enough for a lid between its walls.
    """

    name: str = "chest"
    box: Case = LOW_BOX
    lid: float = 0.02
    seat: float = 0.001
    overhang: float = 0.015
    opening: float = radians(95)
    finish: Finish = PLAIN
    within: bool = False
    gap: float = 0.003
    edge: TopEdge = "square"
    drawers: Layout | None = None
    drawers_ratio: float = 0.4
    dome: float = 0.0

    def __post_init__(self) -> None:
        if min(self.box.depth, self.box.width) <= 2 * self.box.panel + 4 * self.gap + 0.05:
            raise ValueError(f"`Chest.box` needs room for a lid: got {self.box.width} x {self.box.depth} m")


def make_chest(spec: Chest) -> Asset:
    """Returns the chest with its lid's true joint; a top, a frame or a moulding that the box had is left away.

    Raises:
        ValueError: if the drawers leave some cell no room.
    """
    box = replace(spec.box, top=Top("none"), frame=None, moulding=0.0, pilaster=0.0)
    return assemble(spec.name, [*case_pieces(box, spec.finish, -box.depth / 2), *_front(box, spec), _lid(box, spec)])


def _front(box: Case, spec: Chest) -> Iterator[PieceDraft]:
    """Yields the front board and, below it, a floor and the drawers."""
    x, y, t = box.width / 2 - max(box.panel, box.posts), -box.depth / 2, box.panel
    low, z = box.opening.z0, box.opening.z1
    if spec.drawers is not None:
        top = low + spec.drawers_ratio * (z - low)
        wide = box.width / 2 - max(box.panel, box.posts)
        yield plank(
            PartLabel.SHELF, "chest_floor", spec.finish.case, ((-wide, y, top), (wide, box.inner_back, top + t))
        )
        setting = Setting(y, box.inner_back, "inset", panel=t, gap=spec.gap, finish=spec.finish)
        for item in divide(spec.drawers, Rect(-x, x, low, top), Edges(), t):
            yield from front_pieces(item, setting) if isinstance(item, Cell) else partition_pieces(item, setting)
        low = top + t
    yield plank(PartLabel.SIDE_PANEL, "front_panel", spec.finish.case, ((-x, y, low), (x, y + t, z)))


def _lid(box: Case, spec: Chest) -> PieceDraft:
    """Returns the lid; within the walls it turns about its upper back edge, so that it clears the back."""
    x, y, o, z = box.width / 2, box.depth / 2, spec.overhang, box.height
    if spec.within:
        inset, rear = max(box.panel, box.posts) + spec.gap, box.inner_back - spec.gap
        front = (box.panel if not box.posts else box.posts) + spec.gap - y
        shape = Box(vec3(inset - x, front, z - spec.lid), vec3(x - inset, rear, z))
        pin = vec3(0.0, rear, z)
    else:
        low = z + spec.seat
        shape = Box(vec3(-x - o, -y - o, low), vec3(x + o, y, low + spec.lid))
        pin = vec3(0.0, y, low)
    domed = spec.dome > 0 and not spec.within
    meshes = [domed_board(shape, spec.dome)] if domed else top_meshes(Top("over", edge=spec.edge), shape)
    motion = PieceMotion(JointType.REVOLUTE, Axis(pin, vec3(-1.0, 0.0, 0.0)), spec.opening)
    return PieceDraft(PartLabel.DOOR, "lid", tuple(surface_of(mesh, spec.finish.front) for mesh in meshes), motion)
