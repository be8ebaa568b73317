"""The still part of a cabinet as a value: outer sizes, construction, the opening that is left."""

from typing import Literal, final

from grafu.dataclass import dataclass
from grafu.synth.case.construction import (
    PANELS,
    PLAIN_BOTTOM,
    PLAIN_TOP,
    STANDING,
    THIN_BACK,
    Back,
    Base,
    Bottom,
    FaceFrame,
    Sides,
    Top,
)
from grafu.synth.fronts.layout import Edge, Edges, Rect
from grafu.synth.fronts.setting import Borders


@final
@dataclass(frozen=True, slots=True)
class Case:
    """The outer sizes and construction of a case, metres; `depth` is without fronts, face frame and overhang.

    A moulding of height `moulding` juts out 20 mm before the fronts, above or below them. A `pilaster` of that width
    stands before either side.

    Raises:
        ValueError: if a size leaves no room inside.
    """

    width: float = 0.8
    height: float = 0.72
    depth: float = 0.56
    panel: float = 0.018
    back: Back = THIN_BACK
    base: Base = STANDING
    top: Top = PLAIN_TOP
    frame: FaceFrame | None = None
    sides: Sides = PANELS
    bottom: Bottom = PLAIN_BOTTOM
    moulding: float = 0.0
    moulding_at: Literal["top", "bottom"] = "top"
    pilaster: float = 0.0

    def __post_init__(self) -> None:
        free = (self.width - 2 * self.side_border, self.depth - self.back.thickness, self.opening_room)
        if min(*free, self.panel) <= 0:
            size = f"{self.width} x {self.depth} x {self.height}"
            raise ValueError(f"`Case` needs room between its panels: got {size} m with panels of {self.panel} m")

    @property
    def floor(self) -> float:
        """The height of the bottom panel's underside."""
        return 0.0 if self.base.kind == "none" else self.base.height

    @property
    def crown(self) -> float:
        """The height of the sides' upper edge."""
        return self.height - self.top_thickness if self.top.kind == "over" else self.height

    @property
    def top_thickness(self) -> float:
        """The top's thickness (stretchers and blocks have the panels'), 0 where there is none."""
        if self.top.kind == "none":
            return 0.0
        return (self.top.thickness if self.top.kind in ("between", "over") else 0.0) or self.panel

    @property
    def bottom_thickness(self) -> float:
        """The bottom's thickness; nothing for a sheet or none."""
        return (self.bottom.thickness or self.panel) if self.bottom.kind in ("between", "under") else 0.0

    @property
    def foot(self) -> float:
        """The height of what stands on the base: the floor, or the top of a bottom that lies under the sides."""
        return self.floor + (self.bottom_thickness if self.lies_under else 0.0)

    @property
    def lies_under(self) -> bool:
        """Whether the bottom lies under the sides; between corner posts it cannot."""
        return self.bottom.kind == "under" and not self.posts

    @property
    def posts(self) -> float:
        """The width of the corner posts, 0 where there are none."""
        return self.base.leg.thick if self.base.kind == "posts" else 0.0

    @property
    def face(self) -> FaceFrame | None:
        """What frames the opening: the face frame, or rails as thick as a panel between corner posts."""
        if self.posts:
            return FaceFrame(self.posts, "bars", self.panel, (self.frame.rail if self.frame else 0.0) or 0.03)
        return self.frame

    @property
    def face_depth(self) -> float:
        """How deep the frame before the opening is."""
        if self.face is None:
            return 0.0
        return self.face.thickness or (0.0 if self.face.kind == "strips" else self.panel)

    @property
    def front(self) -> float:
        """The y of the plane that fronts are mounted on."""
        return -self.depth / 2 if self.posts else -self.depth / 2 - self.face_depth

    @property
    def carcass(self) -> float:
        """The y at which the panels behind a frame begin."""
        return self.front + self.face_depth

    @property
    def inner_back(self) -> float:
        """The y of the back panel's inner face; rails behind it push it forward."""
        back = self.back
        board = 0.0 if back.planted or back.kind == "none" else back.thickness
        return self.depth / 2 - board - (self.panel if back.rails else 0.0)

    @property
    def border(self) -> float:
        """The width of what stands between two openings: a panel's edge, or a bar of the face frame."""
        if self.face is None or self.face.kind == "strips":
            return self.panel
        return min(self.face.width, 0.05) if self.posts else self.face.width

    @property
    def side_border(self) -> float:
        """The width of what stands left and right of the opening."""
        framed = 0.0 if self.face is None or self.face.kind == "strips" else self.face.width
        return max(framed, self.pilaster, self.panel)

    @property
    def rail_border(self) -> float:
        """The height of the frame's rails, 0 without a frame."""
        if self.face is None or self.face.kind == "strips":
            return 0.0
        return self.face.rail or self.face.width

    @property
    def top_rail(self) -> float:
        """The height of the bar below the top, 0 where there is none or a face frame has its own."""
        framed = self.face is not None and self.face.kind != "strips"
        return self.top.rail if self.top.kind in ("between", "over") and not framed else 0.0

    @property
    def opening_room(self) -> float:
        """The height of the opening; not above 0 where there is no room."""
        low, high = self._span
        return high - low

    @property
    def opening(self) -> Rect:
        """The clear opening in the front."""
        b = self.side_border
        return Rect(-self.width / 2 + b, self.width / 2 - b, *self._span)

    @property
    def borders(self) -> Borders:
        """What surrounds the opening."""
        o = self.opening
        return Borders(self.side_border, self.side_border, o.z0 - self.floor, self.height - o.z1)

    @property
    def edges(self) -> Edges:
        """What borders the opening: fronts stop where something juts out, and where there is nothing to cover."""
        top, bottom, side = Edge.CASE, Edge.CASE, Edge.CASE
        juts = self.top.kind == "over" and self.top.overhang + self.top.front > 0
        if juts or (self.top_thickness == 0 and self.rail_border == 0):
            top = Edge.STOP
        if self.bottom_thickness == 0 and self.rail_border == 0:
            bottom = Edge.STOP
        if self.lies_under and self.bottom.overhang > 0:
            bottom = Edge.STOP
        if self.moulding:
            top, bottom = (Edge.STOP, bottom) if self.moulding_at == "top" else (top, Edge.STOP)
        if self.sides.beyond > 0 or self.pilaster > 0 or self.sides.kind == "none":
            side = Edge.STOP
        return Edges(side, side, bottom, top)

    @property
    def _span(self) -> tuple[float, float]:
        rail = self.rail_border
        low, high = self.floor + max(self.bottom_thickness, rail), self.height - max(self.top_thickness, rail)
        high = min(high, self.height - self.top_thickness - self.top_rail)
        if self.top.kind == "over" and rail:  # at least a centimetre of rail shows below the top
            high = min(high, self.crown - 0.01)
        if self.moulding and self.moulding_at == "top":
            high = min(high, self.crown - self.moulding)
        if self.moulding and self.moulding_at == "bottom":
            low = max(low, self.foot + self.moulding)
        return low, high
