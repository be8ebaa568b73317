"""Means over the steps since the last line of the log: losses, and where the time went. It writes nothing."""

from collections import defaultdict
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from time import perf_counter
from typing import final

from torch import Tensor


@final
class Meter:
    """Sums numbers by name; numbers of a GPU are fetched only when their mean is asked for."""

    def __init__(self) -> None:
        self._begin()

    def add(self, values: Mapping[str, Tensor | float]) -> None:
        """Counts the numbers of one step."""
        self._steps += 1
        for name, value in values.items():
            self._values[name].append(value)

    @contextmanager
    def timed(self, name: str) -> Iterator[None]:
        """Adds the time that the block takes; on a GPU that is until its work is handed over, not until it is done."""
        started = perf_counter()
        try:
            yield
        finally:
            self._seconds[name] += perf_counter() - started

    def take(self) -> dict[str, float]:
        """Returns the means per step, seconds per step as `seconds/NAME`, and `steps_per_second`; then starts again."""
        steps, elapsed = max(1, self._steps), perf_counter() - self._started
        means = {name: sum(float(v) for v in values) / len(values) for name, values in self._values.items()}
        means |= {f"seconds/{name}": seconds / steps for name, seconds in self._seconds.items()}
        means["steps_per_second"] = self._steps / elapsed if elapsed > 0 else 0.0
        self._begin()
        return means

    def _begin(self) -> None:
        self._values: defaultdict[str, list[Tensor | float]] = defaultdict(list)
        self._seconds: defaultdict[str, float] = defaultdict(float)
        self._steps = 0
        self._started = perf_counter()
