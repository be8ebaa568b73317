"""The stages of one run, one after the other: told as they begin, timed, and kept within their share of the budget.

Shares are of the time that is left when a stage begins, so that a stage that needs little leaves its rest to the next.
"""

from collections.abc import Callable, Mapping
from functools import partial
from time import perf_counter
from types import MappingProxyType
from typing import TypeVar, final

from grafu.geometry.budget import Budget, within

T = TypeVar("T")

SHARES: Mapping[str, float] = MappingProxyType(
    {"parse": 0.25, "complete": 0.3, "body": 0.25, "realize": 0.6, "fittings": 0.5}
)
"""What is left after them is for files and page; a stage that is not named here is short, and never given up."""
_INSTEAD: Mapping[str, str] = MappingProxyType(
    {
        "parse": "contacts were taken from boxes, or left out",
        "complete": "motions come from the rule",
        "body": "no top and no drawer box was looked for",
        "realize": "no joint was built",
        "fittings": "no handle, grip or shelf was looked for",
    }
)


@final
class Stages:
    """Runs stages and keeps what they took; not a value.

    `laps` are seconds per stage, in order; `notes` say which stages were given up, why, and what was done instead.
    """

    def __init__(self, on_stage: Callable[[str], None], budget: Budget) -> None:
        self.laps: list[tuple[str, float]] = []
        self.notes: list[str] = []
        self._given_up: set[str] = set()
        self._on_stage = on_stage
        self._budget = budget

    def timed(self, name: str, stage: Callable[[], T], instead: Callable[[str], T] | None = None) -> T:
        """Returns what a stage makes, or what is made `instead`, given why, where its share does not hold it."""
        self._on_stage(name)
        started = perf_counter()
        if instead is None:
            found = stage()
        else:
            with self._budget.in_force():
                found = within(SHARES[name], stage, partial(self._other, name, instead))
        self.laps.append((name, perf_counter() - started))
        return found

    def gave_up(self, name: str) -> bool:
        """Whether something else was done instead of a stage."""
        return name in self._given_up

    def _other(self, name: str, instead: Callable[[str], T], why: str) -> T:
        self._given_up.add(name)
        self.notes.append(f"{_INSTEAD[name]}: {why}")
        return instead(why)
