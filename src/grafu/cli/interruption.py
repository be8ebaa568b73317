"""Signals while libraries are imported: some take Ctrl-C for a library that is missing, and go on without either."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager

from grafu.processes.lifetime import started_by_main_thread


@contextmanager
def interruption_held() -> Iterator[None]:
    """Holds an interruption, or a request to end that raises one, back until the body is done; ignored ones stay so.

    Raises:
        KeyboardInterrupt: after the body, if one came.
    """
    if not started_by_main_thread():
        yield
        return
    seen: list[int] = []
    handlers = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    held = {number: handler for number, handler in handlers.items() if callable(handler)}
    for number in held:
        signal.signal(number, lambda got, _: seen.append(got))
    try:
        yield
    finally:
        for number, handler in held.items():
            signal.signal(number, handler)
    if seen:
        signal.raise_signal(seen[0])
