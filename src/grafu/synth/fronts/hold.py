"""How a front is held: which handle, where on the front, how turned, how large; or a grip cut into the front.

These are values only: `handles` builds handles and `leaves` cuts grips. What real models show: bars of 105 to 480 mm,
knobs of 13 to 32 mm, protrusions of 16 to 38 mm; upright bars near the free edge at any height, and on kitchen doors a
lying bar in the middle of the top edge, which states nothing about the hinge.

What lies inside an opening besides fronts: how shelves lie, dividers, rods, baskets, runners.
"""

from typing import Literal, final

from grafu.dataclass import dataclass

ShelfKind = Literal["full", "short", "glass"]
BasketKind = Literal["none", "wire", "rack"]


@final
@dataclass(frozen=True, slots=True)
class Inside:
    """The inner fittings of one opening; lengths in metres.

    `shelf` states how its shelves are made: over the full depth, over 60 % of it, or of glass. `dividers` upright
    boards part the room below the lowest shelf. A hanging `rod` runs below the top. A `basket` of wire or a plate
    `rack` stands on the floor. With `runners`, slides that belong to no drawer hang on both walls, as in many real
    models; `rails` are level bars along the back wall. Shelves and dividers stand `setback` behind the fronts, 0 where
    they touch them (41003). A lip of height `lip` stands before each shelf's front edge; `cleats` carry the shelves'
    ends (47315), and `blocks` stiffen the upper corners. With `band`, a strip covers each shelf's front edge (41003),
    as the strips before the case's panels do; behind inset fronts and on glass there is none.

    Raises:
        ValueError: if a count or a length is negative.
    """

    shelf: ShelfKind = "full"
    dividers: int = 0
    rod: bool = False
    basket: BasketKind = "none"
    runners: int = 0
    rails: int = 0
    setback: float = 0.01
    lip: float = 0.0
    cleats: bool = False
    blocks: bool = False
    band: bool = False

    def __post_init__(self) -> None:
        if min(self.dividers, self.runners, self.rails, self.setback, self.lip) < 0:
            raise ValueError(f"counts and lengths of `Inside` must not be negative: got {self}")


EMPTY = Inside()


HandleStyle = Literal[
    "bar-round",
    "bar-square",
    "bar-slim",
    "bar-arched",
    "bar-tee",
    "bar-strip",
    "bar-profile",
    "bail",
    "knob-round",
    "knob-flat",
    "knob-mushroom",
    "knob-square",
    "knob-cone",
    "knob-turned",
    "ring",
    "cup-shell",
    "cup-square",
    "cup-slim",
    "none",
]
Grip = Literal["none", "scoop", "slot", "edge channel", "finger hole", "lip"]
Place = Literal["usual", "free edge", "hinge edge", "middle line", "top edge", "bottom edge"]
Orientation = Literal["usual", "upright", "lying"]

MIDDLE, UPPER_THIRD, LOWER_THIRD, UPPER_CORNER, LOWER_CORNER = 0.5, 0.8, 0.2, 1.0, 0.0  # values for `along`


@final
@dataclass(frozen=True, slots=True)
class Hold:
    """Where a front carries its handle, and how large the handle is. The default is a plain, ordinary one.

    Attributes:
        place: the edge that the handle lies at. "usual": a door's free edge, a drawer's middle. "middle line" is the
            upright one through the centre. Drawers have no free edge and no hinge edge.
        along: the handle's middle, as a fraction of that edge's length, upwards or to the right; whatever it
            states, the handle stays clear of the leaf's border, so that 0 and 1 mean the corners. None: 0.65 on a
            door's upright free edge, else 0.5.
        orientation: "usual" is along the free edge of a door, and lying at a top or bottom edge and on drawers.
        length: metres along the handle, at most its template's longest; None: its own. A knob that cannot be so long
            has its own size, so one length can serve bars and knobs; real knobs are 13 to 40 mm wide.
        fraction: the most that the handle takes of the front's side along which it lies, in (0, 1].
        protrusion: metres before the front; None: the handle's own (of a knob: in proportion to its width).
        inset: metres from the edge to the handle's middle; at most a fifth of the front's sides.
        count: 1, or 2 side by side, as on wide drawers.

    Raises:
        ValueError: if a fraction is out of range, a length is not above 0, or the count is neither 1 nor 2.
    """

    place: Place = "usual"
    along: float | None = None
    orientation: Orientation = "usual"
    length: float | None = None
    ratio: float = 0.4
    protrusion: float | None = None
    inset: float = 0.045
    count: Literal[1, 2] = 1

    def __post_init__(self) -> None:
        if self.along is not None and not 0.0 <= self.along <= 1.0:
            raise ValueError(f"`along` must be a fraction in [0, 1]: got {self.along}")
        if not 0.0 < self.ratio <= 1.0:
            raise ValueError(f"`ratio` must be in (0, 1]: got {self.ratio}")
        for name in ("length", "protrusion", "inset"):
            value = getattr(self, name)
            if value is not None and not value > 0.0:
                raise ValueError(f"`{name}` must be above 0 metres: got {value}")
        if self.count not in (1, 2):
            raise ValueError(f"`count` must be 1 or 2: got {self.count}")


USUAL = Hold()
