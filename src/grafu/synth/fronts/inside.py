"""What lies inside an opening besides fronts: how shelves lie, dividers, rods, baskets, runners. It builds nothing."""

from dataclasses import dataclass
from typing import Literal, final

ShelfKind = Literal["full", "short", "glass"]
BasketKind = Literal["none", "wire", "rack"]


@final
@dataclass(frozen=True, slots=True)
class Inside:
    """The inner fittings of one opening; lengths in metres.

    `shelf` says how its shelves are made: over the full depth, over 60 % of it, or of glass. `dividers` upright boards
    part the room below the lowest shelf. A hanging `rod` runs below the top. A `basket` of wire or a plate `rack`
    stands on the floor. With `runners`, slides that belong to no drawer hang on both walls, as in many real models;
    `rails` are level bars along the back wall. Shelves and dividers stand `setback` behind the fronts, 0 where they
    touch them (41003). A lip of height `lip` stands before each shelf's front edge; `cleats` carry the shelves' ends
    (47315), and `blocks` stiffen the upper corners. With `band`, a strip covers each shelf's front edge (41003), as the
    strips before the case's panels do; behind inset fronts and on glass there is none.

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
