"""Whether a piece hangs on a wall or leans on one: by its name, by where the input drew it, or by its balance.

The first of these is that its name states it, the second that the input drew it hanging above its own floor. A shape
that could stand is no evidence: many floor units are drawn without their feet. One that falls backwards is.
"""

from typing import final

import numpy as np

from grafu.asset.names import spoken, words
from grafu.asset.part import Asset
from grafu.dataclass import dataclass
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
    feet: float = 0.06
    """What ends no higher than this above the lowest point is a foot: feet are drawn too short, or are left out ..."""
    behind: float = 0.02
    """... and a piece whose middle is at least so far behind all feet leans on the wall."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


DEFAULT_WALL_UNIT_CONFIG = WallUnitConfig()


def hangs_on_wall(asset: Asset, config: WallUnitConfig = DEFAULT_WALL_UNIT_CONFIG) -> str:
    """Returns the evidence that a piece hangs on a wall or leans on one, in words; empty where there is none."""
    if (behind := _behind_feet(asset, config)) >= config.behind:
        return f"its middle is {1000 * behind:.0f} mm behind all that stands on the floor: it leans on a wall"
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


def _behind_feet(asset: Asset, config: WallUnitConfig) -> float:
    """Returns how far the middle of all surfaces is behind the rearmost foot, metres; negative: in front of it.

    Boards and sheets weigh as their surfaces do, and this is asked before anything is weighed. Doors and drawers are no
    feet.
    """
    parts = [part for part in asset.parts if len(part.mesh.faces)]
    still = [part.mesh.vertices for part in parts if not part.label.is_movable]
    area = sum(part.mesh.area for part in parts)
    if not still or not area > 0:
        return -np.inf
    middle = sum(float(part.mesh.face_areas @ part.mesh.triangles.mean(axis=1)[:, 1]) for part in parts) / area
    points = np.vstack(still)
    return float(middle - points[points[:, 2] <= points[:, 2].min() + config.feet, 1].max())
