"""How many cores one model may use: those of the machine, shared among the processes that work beside each other.

Threads are for work that native libraries do, as they let others run meanwhile: Python itself runs one at a time.
"""

import os
from collections.abc import Callable, Sequence
from contextvars import copy_context
from typing import TypeVar

Item = TypeVar("Item")
Made = TypeVar("Made")

_sharing = 1  # processes of this machine that work at the same time as this one, and itself


def share_cores(processes: int) -> None:
    """States how many processes work at the same time as this one, itself counted."""
    global _sharing
    _sharing = max(processes, 1)


def own_cores() -> int:
    """Returns how many cores this process may use: at least one."""
    allowed = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return max(allowed // _sharing, 1)


def made_of_each(items: Sequence[Item], make: Callable[[Item], Made], threads: int) -> list[Made]:
    """Returns what `make` makes of each item, in order, so many at a time, under the budget that is in force here.

    What it raises is raised here, for the first item that it fails on.
    """
    if min(threads, len(items)) < 2:
        return [make(item) for item in items]
    from concurrent.futures import ThreadPoolExecutor

    with ThreadPoolExecutor(min(threads, len(items))) as pool:
        waiting = [pool.submit(copy_context().run, make, item) for item in items]
        return [one.result() for one in waiting]
