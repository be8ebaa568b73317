"""What keeps a door or drawer closed: a catch holds it there, or pulls it there over the last centimetres.

Its force is constant near closed, falls to nothing at the end of its range, and is zero beyond: there the part stays
where it is left.
"""

from typing import final

import numpy as np

from grafu.articulation.catch_kind import CatchKind
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Scalars
from grafu.geometry.config_checks import require_positive, require_ratios


@final
@dataclass(frozen=True, slots=True)
class CatchConfig:
    """How strong catches are, and how far they reach.

    Forces and ways are those of the far edge of what moves. Makers state for hold-in detents of runners 5 to 7 N, for
    magnetic catches 2 to 8 lbf (9 to 36 N), for self-closing runners about 30 N over the last 22 to 40 mm; spring
    hinges close a door from about 10 cm.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    force: float = 10.0
    """With this it is held or pulled shut (N): a pull of 20 N opens it all the same, friction included."""
    detent: float = 0.004
    """A detent reaches so far (m) ..."""
    rail: float = 0.04
    """... what closes a drawer by itself so far (m) ..."""
    hinge: float = 0.1
    """... what closes a door by itself so far (m) ..."""
    most: float = 0.5
    """... and none further than this part of the joint's range."""
    fade: float = 0.25
    """Over this last part of its range the force falls to nothing."""
    ease: float = 0.8
    """With friction it takes no more than this part of the pull with which people open things."""
    level: float = 0.2
    """What has one slides no steeper, or hangs on a hinge that leans no further from upright (of a unit vector)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "most", "fade", "ease", "level")


DEFAULT_CATCH_CONFIG = CatchConfig()


@final
@dataclass(frozen=True, slots=True)
class Catch:
    """A force (N, or N m) towards closed, which is the joint value `closed` (m, or rad).

    It is `effort` up to `fade` before the end of its range `reach`, falls evenly to zero there, and is zero beyond.

    Raises:
        ValueError: if a number is not above 0, or the force falls over more than the whole range.
    """

    effort: float
    reach: float
    fade: float
    closed: float = 0.0

    def __post_init__(self) -> None:
        require_positive(self, "effort", "reach", "fade")
        if self.fade > self.reach:
            raise ValueError(f"`Catch.fade` must be at most its reach of {self.reach}: got {self.fade}")

    @property
    def slope(self) -> float:
        """By how much the effort falls for each metre or radian, where it falls."""
        return self.effort / self.fade

    @property
    def end(self) -> float:
        """The joint value from which on it does nothing."""
        return self.closed + self.reach

    def effort_at(self, values: Scalars) -> Scalars:
        """Returns the effort in the sense of the joint, so never above zero, at joint values."""
        return np.clip(self.slope * (values - self.end), -self.effort, 0.0)


def catch_of(
    kind: CatchKind,
    turns: bool,
    limits: tuple[float, float],
    arms: tuple[float, float],
    pull: float,
    friction: float,
    config: CatchConfig,
) -> Catch | None:
    """Returns the catch of a joint; None: there is none, or friction leaves it no force.

    `limits` are the joint's (m, or rad). `arms` are the distances of the far edge and of the grip from the axis (m; 1
    and 1 for a slide), `pull` (N) opens it at the grip, `friction` (N m, or N) is what resists besides.
    """
    (lower, upper), (edge, grip) = limits, arms
    effort = min(config.force * edge, config.ease * pull * grip - friction)
    if kind is CatchKind.NONE or effort <= 0 or edge <= 0 or upper <= lower:
        return None
    closing = config.hinge if turns else config.rail
    reach = min((config.detent if kind is CatchKind.DETENT else closing) / edge, config.most * (upper - lower))
    return Catch(effort, reach, config.fade * reach, lower)
