"""The still part of a cabinet: sides, top, bottom, back, plinth or legs, face frame, moulding. It knows no fronts."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal, final

from grafu.geometry.appearance import Material
from grafu.geometry.arrays import vec3
from grafu.synth.assembly import Piece
from grafu.synth.finish import Finish, surface_of
from grafu.synth.layout import Edge, Edges, Rect
from grafu.synth.shapes import board, turned
from grafu.vocabulary import PartLabel

Corner = tuple[float, float, float]


@final
@dataclass(frozen=True, slots=True)
class Case:
    """The outer sizes and construction of a case, metres; `depth` is without fronts and overhang.

    `top` lies between the sides, over them (`overhang` beyond them and the front), or is missing. A face frame of
    width `frame` (0: frameless) stands before the case. A moulding of height `moulding` juts out 20 mm before the
    fronts, above or below them.

    Raises:
        ValueError: if a size leaves no room inside.
    """

    width: float = 0.8
    height: float = 0.72
    depth: float = 0.56
    panel: float = 0.018
    back: float = 0.006
    base: Literal["none", "plinth", "legs"] = "none"
    base_height: float = 0.1
    top: Literal["between", "over", "none"] = "between"
    overhang: float = 0.0
    frame: float = 0.0
    moulding: float = 0.0
    moulding_at: Literal["top", "bottom"] = "top"

    def __post_init__(self) -> None:
        free = (self.width - 2 * self.panel, self.depth - self.back, self.height - self.floor - 2 * self.panel)
        if min(*free, self.panel) <= 0:
            size = f"{self.width} x {self.depth} x {self.height}"
            raise ValueError(f"`Case` needs room between its panels: got {size} m with panels of {self.panel} m")

    @property
    def floor(self) -> float:
        """The height of the bottom panel's underside."""
        return 0.0 if self.base == "none" else self.base_height

    @property
    def front(self) -> float:
        """The y of the plane that fronts are mounted on."""
        return -self.depth / 2 - (self.panel if self.frame else 0.0)

    @property
    def inner_back(self) -> float:
        """The y of the back panel's inner face."""
        return self.depth / 2 - self.back

    @property
    def border(self) -> float:
        """The width of what surrounds the opening: the panels' edges, or the face frame."""
        return self.frame or self.panel

    @property
    def opening(self) -> Rect:
        """The clear opening in the front."""
        b = self.border
        top = self.height if self.top == "none" and not self.frame else self.height - max(b, self.panel)
        low = self.floor + b
        if self.moulding:
            low, top = _beside_moulding(self, low, top)
        return Rect(-self.width / 2 + b, self.width / 2 - b, low, top)

    @property
    def edges(self) -> Edges:
        """What borders the opening: fronts stop at an overhang, a moulding, and where there is no top."""
        juts = self.overhang > 0 or (self.top == "none" and not self.frame)
        top = Edge.STOP if juts or (self.moulding and self.moulding_at == "top") else Edge.CASE
        bottom = Edge.STOP if self.moulding and self.moulding_at == "bottom" else Edge.CASE
        return Edges(bottom=bottom, top=top)

    @property
    def crown(self) -> float:
        """The height of the sides' upper edge."""
        return self.height - self.panel if self.top == "over" else self.height


def case_pieces(case: Case, finish: Finish, out: float) -> tuple[Piece, ...]:
    """Returns the still parts of a case; `out` is the y of the fronts' outer faces, which a moulding juts beyond."""
    pieces = (*_panels(case), *_base(case))
    made = [Piece(label, stem, (surface_of(board(low, high), finish.case),)) for label, stem, low, high in pieces]
    if case.base == "legs":
        made += _legs(case, finish.case)
    if case.frame:
        made.append(_face_frame(case, finish.case))
    if case.moulding:
        made.append(_moulding(case, finish.case, out))
    return tuple(made)


def _panels(case: Case) -> Iterator[tuple[PartLabel, str, Corner, Corner]]:
    x, y, t = case.width / 2, case.depth / 2, case.panel
    foot = 0.0 if case.base == "plinth" else case.floor
    yield PartLabel.SIDE_PANEL, "side_panel_left", (-x, -y, foot), (t - x, y, case.crown)
    yield PartLabel.SIDE_PANEL, "side_panel_right", (x - t, -y, foot), (x, y, case.crown)
    yield PartLabel.BOTTOM_PANEL, "bottom_panel", (t - x, -y, case.floor), (x - t, case.inner_back, case.floor + t)
    yield PartLabel.BACK_PANEL, "back_panel", (t - x, case.inner_back, case.floor), (x - t, y, case.crown)
    if case.top == "between":
        yield PartLabel.TOP_PANEL, "top_panel", (t - x, -y, case.height - t), (x - t, case.inner_back, case.height)
    if case.top == "over":
        o = case.overhang
        yield PartLabel.TOP_PANEL, "top_panel", (-x - o, case.front - o, case.crown), (x + o, y, case.height)


def _base(case: Case) -> Iterator[tuple[PartLabel, str, Corner, Corner]]:
    if case.base == "plinth":
        x, y, t = case.width / 2 - case.panel, -case.depth / 2 + 0.05, case.panel
        yield PartLabel.BAR, "plinth", (-x, y, 0.0), (x, y + t, case.floor)


def _legs(case: Case, wood: Material) -> Iterator[Piece]:
    radius = min(0.022, case.width / 8, case.depth / 8)
    x, y = case.width / 2 - 1.5 * radius, case.depth / 2 - 1.5 * radius
    for corner in ((-x, -y), (x, -y), (x, y), (-x, y)):
        mesh = turned(vec3(*corner, 0.0), vec3(*corner, case.floor), ((0.0, 0.6 * radius), (1.0, radius)))
        yield Piece(PartLabel.LEG, "leg", (surface_of(mesh, wood),))


def _face_frame(case: Case, wood: Material) -> Piece:
    x, y, low, high, o = case.width / 2, -case.depth / 2, case.floor, case.crown, case.opening
    boards = (
        board((-x, case.front, low), (o.x0, y, high)),
        board((o.x1, case.front, low), (x, y, high)),
        board((o.x0, case.front, low), (o.x1, y, o.z0)),
        board((o.x0, case.front, o.z1), (o.x1, y, high)),
    )
    return Piece(PartLabel.FACE_FRAME, "face_frame", tuple(surface_of(mesh, wood) for mesh in boards))


def _moulding(case: Case, wood: Material, out: float) -> Piece:
    low = case.crown - case.moulding if case.moulding_at == "top" else case.floor
    x = case.width / 2
    mesh = board((-x, out - 0.02, low), (x, case.front, low + case.moulding))
    return Piece(PartLabel.BAR, "moulding", (surface_of(mesh, wood),))


def _beside_moulding(case: Case, low: float, high: float) -> tuple[float, float]:
    if case.moulding_at == "top":
        return low, min(high, case.crown - case.moulding)
    return max(low, case.floor + case.moulding), high
