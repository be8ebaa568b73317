"""Clocks that tests turn themselves, so that no test depends on how fast a machine is."""

from dataclasses import dataclass


@dataclass
class Clock:
    """A clock that does not advance until `now` is set; with `step` it goes on by as much whenever it is asked."""

    now: float = 0.0
    step: float = 0.0
    asked: int = 0

    def __call__(self) -> float:
        self.asked += 1
        self.now += self.step
        return self.now
