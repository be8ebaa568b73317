"""How a case is put together, as values: its base, top, sides, back, bottom and face frame. It builds no geometry.

Lengths are metres. A size of 0 means "as thick as the case's panels" where it states it.
"""

from typing import Literal, final

from grafu.dataclass import dataclass
from grafu.synth.case.legs import Leg

BaseKind = Literal["none", "plinth", "toe kick", "legs", "posts", "sled"]
Stretcher = Literal["none", "sides", "H", "box", "shelf"]
TopKind = Literal["between", "over", "none", "stretchers", "corner blocks"]
TopEdge = Literal["square", "chamfered", "rounded", "moulded", "cornice"]
SideKind = Literal["panel", "double", "framed", "slats", "metal", "none"]
BackKind = Literal["full", "half", "split", "none"]
BottomKind = Literal["between", "under", "sheet", "none"]
FrameKind = Literal["one", "bars", "strips"]
LEG = Leg()


@final
@dataclass(frozen=True, slots=True)
class Base:
    """What a case stands on, `height` above the floor.

    A plinth is one board that stands `recess` behind the front; a toe kick has `boards` of them (2 front and back,
    3 front and sides, 4 all around), labelled side panel as in real kitchens. Posts are legs that run up to the top at
    the corners, the case between them. Legs stand `inset` from the outer corner; `stretcher` bars join them at
    `stretcher_at` of the height ("shelf": boards across the side bars); an `apron` board of that height hangs in front
    below the case, its lower edge arched where `arched`. With a `skirt`, boards between square legs or posts close the
    room below the case on all four sides, in place of stretchers and apron (22692).
    """

    kind: BaseKind = "none"
    height: float = 0.1
    leg: Leg = LEG
    inset: float = 0.008
    recess: float = 0.05
    boards: Literal[1, 2, 3, 4] = 4
    stretcher: Stretcher = "none"
    stretcher_at: float = 0.3
    apron: float = 0.0
    arched: bool = False
    skirt: bool = False

    def __post_init__(self) -> None:
        if not (self.height >= 0 and 0 <= self.stretcher_at <= 1 and 0 <= self.apron <= self.height):
            sizes = f"{self.height}, {self.stretcher_at}, {self.apron}"
            raise ValueError(f"`Base` needs a height, a fraction and an apron that fit: got {sizes}")


@final
@dataclass(frozen=True, slots=True)
class Top:
    """The top: between the sides, over them, missing, or replaced by flat bars or blocks in the corners (`width` wide).

    `thickness` 0 means the case's panel. A top over the sides juts out by `overhang` beyond the front and the sides,
    by `front` and `sides` more, and by `back` behind. A moulded edge is two stacked boards, the lower one smaller; of
    a cornice, the lower one is a part of its own. The front edge bulges by `belly` in the middle where it is square. A
    raised edge of height `rim` stands at the back. With `sink`, a basin hangs in a cut-out. Below a top between or
    over the sides of a case without a face frame, a bar of height `rail` spans the front.
    """

    kind: TopKind = "between"
    thickness: float = 0.0
    overhang: float = 0.0
    front: float = 0.0
    sides: float = 0.0
    back: float = 0.0
    edge: TopEdge = "square"
    rim: float = 0.0
    sink: bool = False
    glass: bool = False
    width: float = 0.07  # of stretchers: the usual flat bar of kitchen cabinets
    rail: float = 0.0
    belly: float = 0.0


@final
@dataclass(frozen=True, slots=True)
class Sides:
    """The sides: one panel each or two of half the thickness, framed panels, slats, metal uprights with bars, or none.

    They stand `beyond` before the case's front; `thickness` 0 means the case's panel.
    """

    kind: SideKind = "panel"
    beyond: float = 0.0
    frame: float = 0.05
    slats: int = 7


@final
@dataclass(frozen=True, slots=True)
class Back:
    """The back: full, the lower half, two panels side by side, or none; and level `rails` across it.

    It lies between the sides, or is planted on behind them (`planted`).
    """

    kind: BackKind = "full"
    thickness: float = 0.006
    rails: int = 0
    rail: float = 0.085
    planted: bool = False

    def __post_init__(self) -> None:
        if self.thickness < 0 or self.rails < 0:
            raise ValueError(f"`Back` must have no negative size: got {self.thickness} m, {self.rails} rails")


@final
@dataclass(frozen=True, slots=True)
class Bottom:
    """The bottom: between the sides, under them, a sheet without thickness, or none.

    `thickness` 0 means the case's panel; one under the sides juts out by `overhang` to the front and the sides, its
    front edge by `belly` more in the middle.
    """

    kind: BottomKind = "between"
    thickness: float = 0.0
    overhang: float = 0.0
    belly: float = 0.0


@final
@dataclass(frozen=True, slots=True)
class FaceFrame:
    """A frame before the case: stiles and rails `width` wide (`rail` where rails differ), `thickness` deep.

    It is one part, bars of their own, or strips on the panels' front edges, as wide as the panels and next to nothing
    thick. `thickness` 0 means the case's panel (strips: a sheet without thickness).
    """

    width: float = 0.04
    kind: FrameKind = "one"
    thickness: float = 0.0
    rail: float = 0.0
    arched: bool = False  # the lower rail has an arched lower edge

    def __post_init__(self) -> None:
        if self.width <= 0 or min(self.thickness, self.rail) < 0:
            raise ValueError(f"`FaceFrame` needs a width above 0: got {self.width}, {self.thickness}, {self.rail}")


STANDING = Base()
PLAIN_TOP = Top()
PANELS = Sides()
THIN_BACK = Back()
PLAIN_BOTTOM = Bottom()
