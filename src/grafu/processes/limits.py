"""How much time and memory one piece of work may take, how much it holds, and how it ended. It enforces nothing.

Memory is what the system counts as really there, not what was asked for. The size of the address space states nothing:
libraries reserve gigabytes that they never touch.
"""

import gc
import os
import sys
from contextlib import suppress
from enum import Enum
from pathlib import Path
from typing import Final, Generic, TypeVar, final

from grafu.dataclass import dataclass

_SPARE: Final = 2**30  # bytes that may be asked for and never be touched
_MUCH: Final = 600 * 10**6  # bytes: a process that holds less is not worth the time of looking for what is unused
_MORE: Final = 100 * 10**6  # bytes: nor is one that has grown by less since it last gave back


def resident_bytes(process: int) -> int:
    """Returns the bytes of memory that a process and its descendants hold now; 0 where it is gone."""
    return sum(map(_resident, (process, *descendants(process))))


def descendants(process: int) -> list[int]:
    """Returns the ids of all processes that a process started, directly or not, and that are there now."""
    if sys.platform != "linux":
        return _descendants_by_psutil(process)
    found: list[int] = []
    for one in _children(process):
        found += (one, *descendants(one))
    return found


def refuse_beyond(memory: int) -> None:
    """Has the system refuse this process what goes far beyond so many bytes, before it is touched.

    One request for more than the machine has would else be granted, and fill it before it can be stopped.
    """
    if sys.platform == "linux":
        import resource

        _, most = resource.getrlimit(resource.RLIMIT_DATA)
        wanted = memory + _SPARE
        if most == resource.RLIM_INFINITY or wanted < most:
            resource.setrlimit(resource.RLIMIT_DATA, (wanted, most))


class _LastGivenBack:
    """What this process held after it last gave back what was unused, or less where it shrank since; not a value."""

    held = 0


def give_back_unused() -> None:
    """Has this process, where it holds much, give back to the system what it does not use any more.

    Values that refer to one another stay until the garbage collector runs, and freed memory stays with the allocator.
    Looking for them takes the longer the more a process holds, also of what is not ours: as in Blender, or beside
    torch. It is done again only where the process has grown.
    """
    held = _resident(os.getpid())
    _LastGivenBack.held = min(_LastGivenBack.held, held)
    if held < max(_MUCH, _LastGivenBack.held + _MORE):
        return
    _collect()
    _LastGivenBack.held = _resident(os.getpid())


def _collect() -> None:
    gc.collect()
    if sys.platform == "linux":
        import ctypes

        with suppress(OSError, AttributeError):  # not every C library has it
            ctypes.CDLL(None).malloc_trim(0)


def _resident(process: int) -> int:
    if sys.platform != "linux":
        return _resident_by_psutil(process)
    import resource

    with suppress(OSError, IndexError, ValueError):
        pages = int(Path(f"/proc/{process}/statm").read_text().split()[1])
        return pages * resource.getpagesize()
    return 0


def _children(process: int) -> list[int]:
    """Returns what the threads of a process started; nothing where the system does not report it."""
    found: list[int] = []
    with suppress(OSError):
        for thread in Path(f"/proc/{process}/task").iterdir():
            with suppress(OSError):
                found += map(int, (thread / "children").read_text().split())
    return found


def _resident_by_psutil(process: int) -> int:
    import psutil

    with suppress(psutil.Error):
        return int(psutil.Process(process).memory_info().rss)
    return 0


def _descendants_by_psutil(process: int) -> list[int]:
    import psutil

    with suppress(psutil.Error):
        return [one.pid for one in psutil.Process(process).children(recursive=True)]
    return []


Result = TypeVar("Result")
PATIENCE: Final = 1.5
"""Work is asked to come to its end within its time, and stopped after so many times that."""


@final
@dataclass(frozen=True)
class ProcessLimits:
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
    """How work ended: with a result, too late, too large, or with the death of its process.

    On several machines also: its process died each time that it was tried, or its machine was lost too often.
    """

    DONE = "done"
    LATE = "late"
    LARGE = "large"
    DIED = "died"
    SET_ASIDE = "set aside"
    LOST = "lost"


@final
@dataclass(frozen=True)
class Outcome(Generic[Result]):
    """How work ended; `results` holds its one result where it is done, and nothing else."""

    ending: Ending
    results: tuple[Result, ...] = ()
