"""A verb in this process: whatever goes wrong ends in one line on stderr and an exit code, never in a traceback.

Signals while libraries are imported: some take Ctrl-C for a library that is missing, and go on without either.

Errors go to stderr. What steers a terminal is shown as an escape in every line: names of files and parts are others'
text.
"""

import argparse
import os
import signal
import sys
import tempfile
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from importlib import import_module

from grafu.cli.telling import beneath, clear_line, telling
from grafu.errors import FunctionalizationError, OptionError
from grafu.processes.lifetime import started_by_main_thread
from grafu.visible import visible

INTERRUPTED = "interrupted; no half-written output is left"


def complain(message: str) -> None:
    """Prints one line on stderr, whatever line breaks the message holds."""
    clear_line()
    print(f"grafu: {visible(one_line(message))}", file=sys.stderr)


def say(line: str) -> None:
    """Prints one line on stdout, at once."""
    print(visible(line), flush=True)


def one_line(message: str) -> str:
    """Returns the message with every run of white space, line breaks too, as one space."""
    return " ".join(message.split())


def internal_fault(error: BaseException, doing: str, debug: bool) -> str:
    """Returns the line for an error that is our fault; the traceback goes to stderr (`debug`) or into a kept log."""
    lines = "".join(traceback.format_exception(error)).splitlines()
    text = "".join(f"{visible(line)}\n" for line in lines)
    said = one_line(f"{type(error).__name__}: {error}")[:200]
    if debug:
        print(text, file=sys.stderr)
        return f"internal error in {doing}, which is our fault, not yours ({said})"
    return f"internal error in {doing}, which is our fault, not yours ({said}); traceback kept in {_keep_log(text)}"


def _keep_log(text: str) -> str:
    try:
        with tempfile.NamedTemporaryFile("w", prefix="grafu-", suffix=".log", delete=False, encoding="utf-8") as log:
            log.write(text)
        return log.name
    except OSError:
        return "no file, for no temporary folder can be written: use --debug"


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


EXIT_DONE, EXIT_FAILED, EXIT_BAD_INPUT, EXIT_INTERRUPTED, EXIT_UNREAD, EXIT_TERMINATED = 0, 1, 2, 130, 141, 143


def prepare_verb() -> None:
    """Imports what every verb needs, and what would take an interruption for a missing library of its own."""
    with interruption_held():
        import_module("numpy")


def run_verb(options: argparse.Namespace) -> int:
    """Runs the verb that the arguments name; returns its exit code."""
    return exit_code(options, options.run)


def exit_code(options: argparse.Namespace, run: Callable[[argparse.Namespace], int]) -> int:
    """Returns what `run` returns, or states in one line what it raises; all that is printed goes where they ask."""
    try:
        with telling(options):
            return _exit_code(options, run)
    except OptionError as error:  # the log cannot be written
        complain(str(error))
        return EXIT_BAD_INPUT


def _exit_code(options: argparse.Namespace, run: Callable[[argparse.Namespace], int]) -> int:
    try:
        code = int(run(options))
        sys.stdout.flush()
        return code
    except BrokenPipeError:
        return unread()
    except FunctionalizationError as error:
        complain(str(error))
        return EXIT_BAD_INPUT
    except KeyboardInterrupt:
        complain(INTERRUPTED)
        return EXIT_INTERRUPTED
    except Exception as error:  # the last door: whatever reaches it is our fault, and the user gets one line
        complain(internal_fault(error, "grafu", options.debug))
        return EXIT_FAILED


def unread() -> int:
    """Returns the exit code where what reads stdout has ended, as `head` does; nothing more is written there."""
    with suppress(OSError, ValueError):  # a stdout that is no file
        os.dup2(os.open(os.devnull, os.O_WRONLY), beneath(sys.stdout).fileno())
    return EXIT_UNREAD
