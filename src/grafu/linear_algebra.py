"""How the threads of linear algebra wait and how many there are, stated before numpy is loaded: later it is too late.

OpenBLAS, which numpy and scipy come with, starts a thread for each core as it is loaded, and each then looks for work
for about 30 ms of its core's time before it sleeps. Whatever the user states in the environment stays.
"""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

_COUNTS: Final = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS")
_WAIT: Final = "OPENBLAS_THREAD_TIMEOUT"
_SOON: Final = "20"  # 2^20 ticks, half a millisecond; 2^26 otherwise


def use_one_thread() -> None:
    """Has this process and those that it starts compute with one thread each: its matrices are small.

    So are results the same on machines with few cores and with many.
    """
    if not any(name in os.environ for name in _COUNTS):
        os.environ[_COUNTS[0]] = "1"


@contextmanager
def sleeping_soon() -> Iterator[None]:
    """Imports numpy, if it was not: its threads stay as many as they would be, and sleep soon when they have no work.

    Of a program that imports us they are the user's: they compute as before.
    """
    if "numpy" in sys.modules or _WAIT in os.environ:
        yield
        return
    os.environ[_WAIT] = _SOON
    try:
        yield
    finally:
        os.environ.pop(_WAIT, None)
