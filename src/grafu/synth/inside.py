"""What lies inside an opening besides fronts and shelves: dividers, rods, baskets, runners. It builds no geometry."""

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
    stands on the floor. With `runners`, slides that belong to no drawer hang on both walls, as in many real models.

    Raises:
        ValueError: if `dividers` is negative.
    """

    shelf: ShelfKind = "full"
    dividers: int = 0
    rod: bool = False
    basket: BasketKind = "none"
    runners: int = 0
    rails: int = 0  # level rails along the back wall

    def __post_init__(self) -> None:
        if min(self.dividers, self.runners, self.rails) < 0:
            raise ValueError(f"counts of `Inside` must not be negative: got {self}")


EMPTY = Inside()
