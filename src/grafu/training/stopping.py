"""Being asked to stop: Ctrl-C and termination end a run after the step at hand, with everything saved."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import final

from grafu.processes.signals import END_REQUESTS

_SIGNALS = (signal.SIGINT, signal.SIGTERM)


@final
class StopRequest:
    """Whether somebody asked. A second Ctrl-C interrupts at once."""

    def __init__(self) -> None:
        self.is_made = False

    def hear(self, number: int, _: FrameType | None) -> None:
        """Takes a signal, as its handler."""
        if self.is_made and number == signal.SIGINT:
            raise KeyboardInterrupt
        self.is_made = True
        END_REQUESTS.are_made |= number == signal.SIGTERM


@contextmanager
def stop_requests() -> Iterator[StopRequest]:
    """Yields what says whether a signal came; outside of the main thread none can come."""
    request = StopRequest()
    if threading.current_thread() is not threading.main_thread():
        yield request
        return
    before = {number: signal.signal(number, request.hear) for number in _SIGNALS}
    try:
        yield request
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
