"""How a front is divided: rows and stacks of doors, drawers and open bays, down to rectangles. It builds no geometry.

A layout is a tree. `divide` turns it into cells (a leaf and its clear opening) and partitions (the panels between).
All rectangles lie in the front's plane: x to the right, z up, metres.
"""

from collections.abc import Iterator
from enum import Enum
from math import radians
from typing import Literal, final

from grafu.dataclass import dataclass
from grafu.synth.fronts.gliding import Folding, Lift, PullOut, Sliding, WasteBins
from grafu.synth.fronts.hold import EMPTY, USUAL, Grip, HandleStyle, Hold, Inside
from grafu.synth.fronts.leaf_style import CURVED as CURVED
from grafu.synth.fronts.leaf_style import LeafStyle as LeafStyle
from grafu.synth.fronts.leaf_style import Side as Side
from grafu.synth.fronts.leaf_style import check_grip

DrawerBox = Literal["whole", "no bottom", "shell", "front only", "floating", "tray", "four walls"]
Between = Literal["panel", "rail", "frame", "nothing"]


@final
@dataclass(frozen=True, slots=True)
class Door:
    """One door or flap, hinged on one side of its opening; `opening` in radians; `behind` lies inside the opening.

    Raises:
        ValueError: if a curved leaf has a level hinge, or a leaf that is not a slab a grip.
    """

    hinge: Side = "left"
    leaf: LeafStyle = "slab"
    handle: HandleStyle = "bar-round"
    opening: float = radians(100)
    shelves: int = 0
    behind: "Layout | None" = None
    inside: Inside = EMPTY
    hold: Hold = USUAL
    grip: Grip = "none"

    def __post_init__(self) -> None:
        check_grip(self.grip, self.leaf)
        if self.leaf in CURVED and self.hinge in ("top", "bottom"):
            raise ValueError(
                f"a {self.leaf} leaf needs an upright hinge (its belly would strike above a flap's): {self.hinge}"
            )


@final
@dataclass(frozen=True, slots=True)
class Pair:
    """Two doors that meet in the middle; a static `muntin` of that width may stand between them.

    Raises:
        ValueError: if a leaf that is not a slab has a grip.
    """

    leaf: LeafStyle = "slab"
    handle: HandleStyle = "bar-round"
    opening: float = radians(100)
    shelves: int = 0
    muntin: float = 0.0
    behind: "Layout | None" = None
    inside: Inside = EMPTY
    hold: Hold = USUAL
    grip: Grip = "none"

    def __post_init__(self) -> None:
        check_grip(self.grip, self.leaf)


@final
@dataclass(frozen=True, slots=True)
class Drawer:
    """A drawer; `travel` is the fraction of its depth that it slides.

    Its box keeps to the opening ("four walls": one of them behind the front), hangs in it with centimetres to spare
    ("floating"), or is a shallow tray without a front. With `runners`, slides hang on both walls as parts of their
    own. `depth` is the fraction of the room behind it that the box fills.
    """

    box: DrawerBox = "whole"
    leaf: LeafStyle = "slab"
    handle: HandleStyle = "bar-round"
    travel: float = 0.8
    runners: bool = False
    depth: float = 1.0
    hold: Hold = USUAL
    grip: Grip = "none"

    def __post_init__(self) -> None:
        check_grip(self.grip, self.leaf)
        if self.hold.place in ("free edge", "hinge edge"):
            raise ValueError(f"a drawer has no hinge: its `place` must be another than {self.hold.place}")
        if self.leaf in ("swept", "swept frame", "half arched"):
            raise ValueError(f"a drawer has no free side: its leaf must be another than {self.leaf}")


@final
@dataclass(frozen=True, slots=True)
class Tilt:
    """A tilting front, as of shoe cabinets: hinged below, it opens by `opening` radians and takes a tray along."""

    leaf: LeafStyle = "slab"
    handle: HandleStyle = "bar-round"
    opening: float = radians(40)
    tray: bool = True
    hold: Hold = USUAL
    grip: Grip = "none"

    def __post_init__(self) -> None:
        check_grip(self.grip, self.leaf)


@final
@dataclass(frozen=True, slots=True)
class Blank:
    """A board that stands where a front might and does not move: a false drawer front, a filler, a control panel."""

    leaf: LeafStyle = "slab"
    name: Literal["false_front", "filler", "control_panel"] = "false_front"
    handle: HandleStyle = "none"
    hold: Hold = USUAL


@final
@dataclass(frozen=True, slots=True)
class OpenCell:
    """An opening without a front."""

    shelves: int = 0
    inside: Inside = EMPTY


@final
@dataclass(frozen=True, slots=True)
class CellRow:
    """Cells from left to right; `weights` share the width (none: equally)."""

    cells: tuple["Layout", ...]
    weights: tuple[float, ...] = ()
    between: Between = "panel"

    def __post_init__(self) -> None:
        _check_weights("CellRow", self.cells, self.weights)


@final
@dataclass(frozen=True, slots=True)
class Stack:
    """Cells from bottom to top; `weights` share the height (none: equally)."""

    cells: tuple["Layout", ...]
    weights: tuple[float, ...] = ()
    between: Between = "panel"

    def __post_init__(self) -> None:
        _check_weights("Stack", self.cells, self.weights)


Leaf = Door | Pair | Drawer | Tilt | Blank | OpenCell | Sliding | Folding | Lift | PullOut | WasteBins
Layout = Leaf | CellRow | Stack


class Edge(Enum):
    """What borders an opening on one side, and so how far a front may reach there."""

    CASE = "case"  # an outer panel: an overlay front covers it
    SHARED = "shared"  # a panel with another cell on its far side: an overlay front covers half of it
    SEAM = "seam"  # nothing: the next front follows at once
    STOP = "stop"  # something that juts out: the front ends before it


@final
@dataclass(frozen=True, slots=True)
class Rect:
    """A rectangle in the front's plane."""

    x0: float
    x1: float
    z0: float
    z1: float

    def __post_init__(self) -> None:
        if not (self.x1 > self.x0 and self.z1 > self.z0):
            raise ValueError(f"the layout leaves no room: got an opening of {self.width:.4f} x {self.height:.4f} m")

    @property
    def width(self) -> float:
        """The size along x."""
        return self.x1 - self.x0

    @property
    def height(self) -> float:
        """The size along z."""
        return self.z1 - self.z0

    @property
    def center(self) -> tuple[float, float]:
        """The middle, (x, z)."""
        return (self.x0 + self.x1) / 2, (self.z0 + self.z1) / 2


@final
@dataclass(frozen=True, slots=True)
class Edges:
    """The four edges of an opening."""

    left: Edge = Edge.CASE
    right: Edge = Edge.CASE
    bottom: Edge = Edge.CASE
    top: Edge = Edge.CASE


@final
@dataclass(frozen=True, slots=True)
class Cell:
    """A leaf of the layout and its clear opening."""

    leaf: Leaf
    opening: Rect
    edges: Edges


@final
@dataclass(frozen=True, slots=True)
class Partition:
    """A panel, a front rail or an open frame between cells, upright in a row and level in a stack."""

    rect: Rect
    upright: bool
    kind: Literal["panel", "rail", "frame"]


def divide(layout: Layout, opening: Rect, edges: Edges, thickness: float) -> Iterator[Cell | Partition]:
    """Yields the cells and the partitions (of this thickness) of a layout, left to right and bottom to top.

    Raises:
        ValueError: if a cell or partition is left no room.
    """
    if not isinstance(layout, CellRow | Stack):
        yield Cell(layout, opening, edges)
        return
    row = isinstance(layout, CellRow)
    spans = list(_spans(layout, opening.width if row else opening.height, thickness))
    inner = Edge.SEAM if layout.between == "nothing" else Edge.SHARED
    for k, (start, end) in enumerate(spans):
        first, last = k == 0, k == len(spans) - 1
        rect = _slice(opening, row, start, end)
        yield from divide(layout.cells[k], rect, _inner_edges(edges, row, inner, first, last), thickness)
        if not last and layout.between != "nothing":
            yield Partition(_slice(opening, row, end, spans[k + 1][0]), row, layout.between)


def _spans(layout: CellRow | Stack, length: float, thickness: float) -> Iterator[tuple[float, float]]:
    gap = 0.0 if layout.between == "nothing" else thickness
    weights = layout.weights or (1.0,) * len(layout.cells)
    free, start = length - gap * (len(weights) - 1), 0.0
    for weight in weights:
        end = start + free * weight / sum(weights)
        yield start, end
        start = end + gap


def _slice(opening: Rect, row: bool, start: float, end: float) -> Rect:
    if row:
        return Rect(opening.x0 + start, opening.x0 + end, opening.z0, opening.z1)
    return Rect(opening.x0, opening.x1, opening.z0 + start, opening.z0 + end)


def _inner_edges(edges: Edges, row: bool, inner: Edge, first: bool, last: bool) -> Edges:
    if row:
        return Edges(edges.left if first else inner, edges.right if last else inner, edges.bottom, edges.top)
    return Edges(edges.left, edges.right, edges.bottom if first else inner, edges.top if last else inner)


def _check_weights(what: str, cells: tuple[Layout, ...], weights: tuple[float, ...]) -> None:
    if not cells or (weights and len(weights) != len(cells)) or any(weight <= 0 for weight in weights):
        raise ValueError(f"`{what}` needs cells, and as many weights above 0 or none: got {len(cells)}, {weights}")
