"""How much time work may take, and how much room one step of it; loops over geometry ask as they go.

A budget is put in force for a block of code. What is called in it asks `require_time` now and then, and `require_room`
before it makes something large; both raise `TooComplex` where the budget does not hold it, and the caller delivers what
it has. Without a budget, time is unlimited and memory is not: one array may not exceed a computer's memory. As long as
the budget holds, results do not depend on it.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from math import inf
from time import monotonic, process_time
from typing import Generic, ParamSpec, TypeVar, final

from grafu.dataclass import dataclass
from grafu.errors import TooComplex

T = TypeVar("T")
P = ParamSpec("P")

DEFAULT_SECONDS = 120.0
"""For one model: some ten times what large pieces of furniture take."""
_STRETCH, _MOST = 4.0, 0.9  # of the clock on the wall
"""A fraction of the processor's time may take four times as much of the clock's, but never all of it."""
DEFAULT_ROOM = 400 * 2**20
"""Bytes of one step: with what stays beside it, a process keeps below some 1.5 GB."""


_OLD = 0.005  # seconds on the wall after which the processor's time is asked for again: in containers that is slow
_asked = (-inf, 0.0)  # when it was asked for on the wall, and the answer


def _processor_time() -> float:
    """Returns the processor's time of this process, seconds; it may be a few milliseconds old."""
    global _asked
    now = monotonic()
    if not 0 <= now - _asked[0] < _OLD:
        _asked = (now, process_time())
    return _asked[1]


@final
@dataclass(frozen=True, slots=True)
class Budget:
    """A point in time at which work ends, and how many bytes one step of it may take.

    `deadline` is in seconds of the `clock`: the processor's time of this process, so that a busy machine changes no
    result; tests replace it. `latest` is the end by the clock on the wall (`time.monotonic`), whatever the processor
    did. Infinity: there is no end.

    Raises:
        ValueError: if `room` is not above 0.
    """

    deadline: float = inf
    room: int = DEFAULT_ROOM
    clock: Callable[[], float] = _processor_time
    latest: float = inf

    def __post_init__(self) -> None:
        if not self.room > 0:
            raise ValueError(f"`Budget.room` must be above 0 bytes: got {self.room}")

    @classmethod
    def lasting(
        cls, seconds: float = DEFAULT_SECONDS, room: int = DEFAULT_ROOM, clock: Callable[[], float] | None = None
    ) -> "Budget":
        """Returns a budget of so many seconds from now: of the processor, and on the wall; or of the clock given.

        Raises:
            ValueError: if `seconds` is not above 0.
        """
        if not seconds > 0:
            raise ValueError(f"a budget must last more than 0 seconds: got {seconds}")
        if clock is not None:
            return cls(clock() + seconds, room, clock)
        return cls(process_time() + seconds, room, _processor_time, monotonic() + seconds)

    @property
    def left(self) -> float:
        """Seconds until the nearer end; never negative, infinity where there is none."""
        on_wall = inf if self.latest == inf else self.latest - monotonic()
        return max(min(inf if self.deadline == inf else self.deadline - self.clock(), on_wall), 0.0)

    @property
    def is_unlimited(self) -> bool:
        """Whether time has no end."""
        return self.deadline == inf and self.latest == inf

    def fraction(self, part: float) -> "Budget":
        """Returns a budget that ends after this part (0..1) of the time that is left; on the wall after more of it."""
        if self.is_unlimited:
            return self
        deadline = _part_of(part, self.deadline, self.clock)
        return Budget(deadline, self.room, self.clock, _part_of(min(_STRETCH * part, _MOST), self.latest, monotonic))

    @contextmanager
    def in_force(self) -> Iterator[None]:
        """Puts the budget in force for a block of code."""
        before = _present.set(self)
        try:
            yield
        finally:
            _present.reset(before)


def _part_of(part: float, end: float, clock: Callable[[], float]) -> float:
    """Returns the point in time after this part of what is left until an end."""
    return inf if end == inf else (now := clock()) + part * max(end - now, 0.0)


UNLIMITED = Budget()
_present: ContextVar[Budget] = ContextVar("budget", default=UNLIMITED)


def present_budget() -> Budget:
    """Returns the budget in force."""
    return _present.get()


def require_time() -> None:
    """Goes on as long as there is time.

    Raises:
        TooComplex: if the deadline of the budget in force has passed.
    """
    if _present.get().left == 0:
        raise TooComplex("it takes more time than its part of the budget: simplify the meshes, or allow more time")


def has_time() -> bool:
    """Whether the deadline of the budget in force is still to come."""
    return _present.get().left > 0


def require_room(count: int, size: int, what: str) -> None:
    """Goes on where `count` things of `size` bytes each fit into the budget in force; ask before they are made.

    Raises:
        TooComplex: if they do not fit.
    """
    room = _present.get().room
    if count * size > room:
        raise TooComplex(f"{what} would take {count * size / 2**20:,.0f} MiB, more than {room / 2**20:,.0f} at once")


def fits(count: int, size: int) -> bool:
    """Whether `count` things of `size` bytes each fit into the budget in force."""
    return count * size <= _present.get().room


def within(part: float, work: Callable[[], T], instead: Callable[[str], T]) -> T:
    """Returns what `work` makes within this part (0..1) of the time that is left, else what is made `instead`.

    `instead` is given the reason, in words. It runs under the budget that was in force before, which may be spent, too.
    """
    try:
        with _present.get().fraction(part).in_force():
            require_time()
            return work()
    except TooComplex as error:
        why = str(error)
    except MemoryError:
        why = "it takes more memory than there is"
    return instead(why)


@final
class WhileTimeLasts(Generic[P, T]):
    """A function of many things, one after another: `work` while its fraction of the time lasts, then `instead`.

    The fraction is this part (0..1) of the time that is left as it is made. `spared` counts what was done the other
    way. Not a value.
    """

    def __init__(self, part: float, work: Callable[P, T], instead: Callable[P, T]) -> None:
        self.spared = 0
        self._budget = _present.get().fraction(part)
        self._work, self._instead = work, instead

    def __call__(self, *arguments: P.args, **named: P.kwargs) -> T:
        """Returns what either makes of one thing."""
        try:
            with self._budget.in_force():
                require_time()
                return self._work(*arguments, **named)
        except (TooComplex, MemoryError):
            self.spared += 1
        return self._instead(*arguments, **named)
