"""Whether a piece hangs on a wall: its name states it, or the input drew it hanging above its own floor.

Shape alone is no evidence: many floor units are drawn without their feet.
"""

from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.asset.names import spoken, words
from grafu.asset.part import Asset
from grafu.geometry.config_checks import require_positive

_PHRASES = tuple(
    tuple(phrase.split())
    for phrase in (
        "wall cabinet",
        "wall cupboard",
        "wall unit",
        "wall shelf",
        "wall mounted",
        "wall hung",
        "hanging cabinet",
        "hanging cupboard",
        "upper cabinet",
        "upper cupboard",
        "overhead cabinet",
        "medicine cabinet",
    )
)
_COMPOUNDS = frozenset(["hangeschrank", "hangeelement", "oberschrank", "wallcabinet", "wallmounted"])


@final
@dataclass(frozen=True, slots=True)
class WallUnitConfig:
    """When a piece hangs on a wall; lengths in metres of the output.

    Raises:
        ValueError: if a number is not above 0.
    """

    tallest: float = 1.3
    """What is taller stands, whatever it is called: a `wall unit` is also a wall of storage on the floor."""
    lowest: float = 1.0
    """A piece that is drawn at least this far above the input's own zero hangs: wall cabinets begin at 1.3 m ..."""
    highest: float = 2.3
    """... and none begins above this: there zero is somewhere else."""
    beside: float = 1.0
    """How far the input's zero is from the piece at most, seen from above: farther off it is a place in a room."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


DEFAULT_WALL_UNIT_CONFIG = WallUnitConfig()


def hangs_on_wall(asset: Asset, config: WallUnitConfig = DEFAULT_WALL_UNIT_CONFIG) -> str:
    """Returns the evidence that a piece hangs on a wall, in words; empty where there is none."""
    if float(asset.box.size[2]) > config.tallest:
        return ""
    if _says_so(asset.name):
        return "its name states that it hangs on a wall"
    named = [part for part in asset.parts if _says_so(part.source.name)]
    if 2 * len(named) > len(asset.parts):
        return "the names of its parts say that it hangs on a wall"
    zero = asset.frame.input_to_output[:3, 3]
    hanging = float(asset.box.low[2] - zero[2])
    off = np.maximum(np.maximum(asset.box.low - zero, zero - asset.box.high), 0.0)[:2]
    if config.lowest <= hanging <= config.highest and float(np.linalg.norm(off)) <= config.beside:
        return f"the input has it {hanging:.2f} m above its floor"
    return ""


def _says_so(name: str) -> bool:
    found, plain = spoken(name), words(name)
    said = any(_holds(text, phrase) for text in (found, plain) for phrase in _PHRASES)
    return said or bool(_COMPOUNDS & set(plain))


def _holds(text: tuple[str, ...], phrase: tuple[str, ...]) -> bool:
    return any(text[k : k + len(phrase)] == phrase for k in range(len(text) - len(phrase) + 1))
