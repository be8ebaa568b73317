"""How much time and memory one piece of work may take, and how it ended. It enforces nothing."""

from dataclasses import dataclass
from enum import Enum
from typing import Final, Generic, TypeVar, final

Result = TypeVar("Result")
PATIENCE: Final = 1.5
"""Work is asked to come to its end within its time, and stopped after so many times that."""


@final
@dataclass(frozen=True)
class Limits:
    """Seconds and bytes that one piece of work may take in its process; None: as much as it likes.

    Raises:
        ValueError: if one is not above 0.
    """

    seconds: float | None = None
    memory: int | None = None

    def __post_init__(self) -> None:
        if not all(limit is None or limit > 0 for limit in (self.seconds, self.memory)):
            raise ValueError(f"limits must be above 0: got {self}")


@final
class Ending(Enum):
    """How work ended: with a result, too late, too large, or with the death of its process."""

    DONE = "done"
    LATE = "late"
    LARGE = "large"
    DIED = "died"


@final
@dataclass(frozen=True)
class Outcome(Generic[Result]):
    """How work ended; `results` holds its one result where it is done, and nothing else."""

    ending: Ending
    results: tuple[Result, ...] = ()
