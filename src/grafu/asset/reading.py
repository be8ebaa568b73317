"""What a reader hands on: parts as the input has them, before the frame is settled. It decides nothing."""

from dataclasses import dataclass
from typing import Literal, final

from grafu.asset.part import Annotation, AssetKind, Part

Furniture = Literal["storage", "table"]


@final
@dataclass(frozen=True, slots=True)
class Convention:
    """What the format or the dataset says about its coordinates; None where it says nothing.

    `unit` is metres per input unit. `normalised` says that the unit has no meaning, because the dataset scales every
    model to one size. `origin` names who says so, in words for the report.
    """

    origin: str
    up: str | None = None
    front: str | None = None
    unit: float | None = None
    normalised: bool = False
    usual_up: str = "+Y"


@final
@dataclass(frozen=True)
class Reading:
    """An input in its own coordinates: every `Part` and joint here is still to be mapped to the object frame.

    `parts` are what it holds without its joints; the `annotation` is what it says of its motions, None where nothing.
    `grouped` says that the parts are segmented by hand: pieces of doors and drawers are not joined by where they lie.
    """

    kind: AssetKind
    parts: tuple[Part, ...]
    convention: Convention
    annotation: Annotation | None = None
    furniture: Furniture | None = None
    notes: tuple[str, ...] = ()
    grouped: bool = False
