"""A command about one model in a process of its own, so that nothing that the model does to it goes without a word.

The process is there before anything heavy is imported: nothing is started twice, or imported twice.
"""

import argparse
import sys
from contextlib import closing
from pathlib import Path

from grafu.cli.limit_options import limits_of, why_stopped
from grafu.cli.messages import complain
from grafu.cli.verb import EXIT_BAD_INPUT, EXIT_FAILED, prepare_verb, run_verb
from grafu.processes.limits import Ending
from grafu.processes.worker import quick_start, run_each

_CLEAR_LINE = "\r\x1b[2K\x1b[?25h"  # the line of a progress that nobody ended, and the cursor that it hid


def run_supervised(options: argparse.Namespace) -> int:
    """Runs the verb within the limits that the options state; returns its exit code, or says why it was stopped."""
    limits = limits_of(options)
    try:
        with closing(run_each([options], 1, run_verb, limits, prepare_verb, quick_start())) as ended:
            [(_, outcome)] = ended
    except BaseException:
        _tidy(options)
        raise
    if outcome.ending is Ending.DONE:
        return outcome.results[0]
    _tidy(options)
    complain(f"{why_stopped(outcome.ending, limits)}")
    return EXIT_FAILED if outcome.ending is Ending.DIED else EXIT_BAD_INPUT


def _tidy(options: argparse.Namespace) -> None:
    """Takes away what a process that was killed left: hidden files, and a line on the terminal."""
    if sys.stderr.isatty():
        sys.stderr.write(_CLEAR_LINE)
    out: Path | None = getattr(options, "out", None)
    if out is not None:
        from grafu.export.whole_file import clear_remains

        clear_remains(out)
