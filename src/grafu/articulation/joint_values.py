"""The range of a joint, and how the values of one joint follow from those of another. It moves nothing."""

from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.errors import ArticulationError


@final
@dataclass(frozen=True, slots=True)
class JointLimits:
    """The range of a joint: radians or metres; 0 is closed, positive opens, never negative.

    Raises:
        ArticulationError: if not 0 <= lower <= upper, both finite.
    """

    lower: float
    upper: float

    def __post_init__(self) -> None:
        if not (np.isfinite(self.lower) and np.isfinite(self.upper) and 0 <= self.lower <= self.upper):
            raise ArticulationError(f"limits must satisfy 0 <= lower <= upper: got {self.lower} .. {self.upper}")

    @property
    def range(self) -> float:
        """The opening from lower to upper."""
        return self.upper - self.lower


@final
@dataclass(frozen=True, slots=True)
class Coupling:
    """A joint follows another, its leader: its value is `multiplier` times the leader's, plus `offset`.

    `offset` is in the unit of the joint that follows, `multiplier` in that unit for each unit of the leader's.

    Raises:
        ArticulationError: if a number is not finite, or the multiplier is 0.
    """

    leader: str
    multiplier: float = 1.0
    offset: float = 0.0

    def __post_init__(self) -> None:
        if not (np.isfinite(self.multiplier) and np.isfinite(self.offset) and self.multiplier != 0):
            raise ArticulationError(
                f"a coupling needs finite numbers and a multiplier that is not 0: got {self.multiplier}, {self.offset}"
            )

    def value(self, leader_value: float) -> float:
        """Returns the value at a value of the leader."""
        return self.multiplier * leader_value + self.offset

    def leader_value(self, value: float) -> float:
        """Returns the leader's value at a value of the joint that follows."""
        return (value - self.offset) / self.multiplier

    def ends(self, limits: JointLimits) -> tuple[float, float]:
        """Returns the lowest and the highest value while the leader keeps to its limits."""
        low, high = sorted((self.value(limits.lower), self.value(limits.upper)))
        return low, high
