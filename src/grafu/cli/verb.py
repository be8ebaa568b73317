"""A verb in this process: whatever goes wrong ends in one line on stderr and an exit code, never in a traceback.

Signals while libraries are imported: some take Ctrl-C for a library that is missing, and go on without either.
"""

import argparse
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib import import_module

from grafu.cli.messages import INTERRUPTED, complain, internal_fault
from grafu.errors import FunctionalizationError
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


EXIT_DONE, EXIT_FAILED, EXIT_BAD_INPUT, EXIT_INTERRUPTED, EXIT_TERMINATED = 0, 1, 2, 130, 143


def prepare_verb() -> None:
    """Imports what every verb needs, and what would take an interruption for a missing library of its own."""
    with interruption_held():
        import_module("trimesh")


def run_verb(options: argparse.Namespace) -> int:
    """Runs the verb that the arguments name; returns its exit code."""
    return exit_code(options, options.run)


def exit_code(options: argparse.Namespace, run: Callable[[argparse.Namespace], int]) -> int:
    """Returns what `run` returns, or states in one line what it raises."""
    try:
        return int(run(options))
    except FunctionalizationError as error:
        complain(str(error))
        return EXIT_BAD_INPUT
    except KeyboardInterrupt:
        complain(INTERRUPTED)
        return EXIT_INTERRUPTED
    except Exception as error:  # the last door: whatever reaches it is our fault, and the user gets one line
        complain(internal_fault(error, "grafu", options.debug))
        return EXIT_FAILED
