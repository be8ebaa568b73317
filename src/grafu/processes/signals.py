"""Ctrl-C and requests to end: what hears them, and when."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import final

from grafu.processes.lifetime import started_by_main_thread


@final
class Terminated(KeyboardInterrupt):
    """SIGTERM reached this process; it ends as after Ctrl-C."""


@final
class Requests:
    """Whether this process was asked to end."""

    def __init__(self) -> None:
        self.are_made = False

    def hear(self, _: int, __: FrameType | None) -> None:
        """Takes SIGTERM, as its handler.

        Raises:
            Terminated: always.
        """
        self.are_made = True
        raise Terminated


END_REQUESTS = Requests()
"""Of this process: signals are the process's, too."""


@contextmanager
def end_requests_heard() -> Iterator[Requests]:
    """Makes SIGTERM raise `Terminated` in the main thread; where it is ignored, or heard already, that stays."""
    END_REQUESTS.are_made = False
    if not started_by_main_thread() or signal.getsignal(signal.SIGTERM) is not signal.SIG_DFL:
        yield END_REQUESTS
        return
    signal.signal(signal.SIGTERM, END_REQUESTS.hear)
    try:
        yield END_REQUESTS
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)


@contextmanager
def interrupts_later() -> Iterator[None]:
    """Puts Ctrl-C off; a process that is started meanwhile never hears of it, not even while it imports modules."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def leave_interrupts_to_parent() -> None:
    """Has a worker ignore Ctrl-C, and end at once when it is asked to: its parent states what there is to say."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
