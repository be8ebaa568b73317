"""Ctrl-C while libraries are imported: some take it for a missing library of their own, and go on without either."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def interruption_held() -> Iterator[None]:
    """Holds an interruption back until the body is done; one that is ignored stays ignored.

    Raises:
        KeyboardInterrupt: after the body, if one came.
    """
    on_main_thread = threading.current_thread() is threading.main_thread()
    if not on_main_thread or signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        yield
        return
    seen: list[int] = []
    earlier = signal.signal(signal.SIGINT, lambda number, _: seen.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, earlier)
    if seen:
        raise KeyboardInterrupt
