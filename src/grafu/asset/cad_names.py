"""Whether the names of a file are those that a CAD program gives to bodies: these have Z up in any format."""

import re
from collections.abc import Sequence
from typing import Final, final

from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios

_WORDS: Final = "solid|body|component|compound|extrude|extrusion|fillet|chamfer|pocket|revolve|loft|part__feature"
_NUMBERED: Final = re.compile(rf"(?:{_WORDS})[ _#]?\d+(?:[:_.]\d+)*$", re.IGNORECASE)


@final
@dataclass(frozen=True, slots=True)
class CadNamesConfig:
    """When the names of a file are those of a CAD program.

    Raises:
        ValueError: if `least` is not above 0, or a fraction not between 0 and 1.
    """

    least: int = 3
    """So many bodies have such a name at least ..."""
    most: float = 0.6
    """... and this many of all (fraction): the rest was named by a person."""

    def __post_init__(self) -> None:
        require_positive(self, "least")
        require_ratios(self, "most")


def are_of_cad(parts: Sequence[Part], config: CadNamesConfig = CadNamesConfig()) -> bool:
    """Whether most parts are called like `Solid1:3`, `Body12`, `Component#4` or `Extrude3`."""
    found = sum(_NUMBERED.match(part.source.name.strip()) is not None for part in parts)
    return found >= config.least and found >= config.most * len(parts)
