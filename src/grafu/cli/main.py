"""The command `grafu`: reads the arguments and hands them to one verb.

Nothing heavy is imported until a verb runs, so that `grafu --help` answers at once. What a user can get wrong ends in
one line on stderr and exit code 2, never in a traceback.
"""

import argparse
import sys
from collections.abc import Callable, Sequence
from typing import NoReturn, final

from grafu.cli import ablate, evaluate, functionalize, inspect, synth, templates, train
from grafu.cli.input_options import join_directions
from grafu.cli.pool import run_supervised
from grafu.cli.verb import EXIT_INTERRUPTED, EXIT_TERMINATED, exit_code, prepare_verb
from grafu.processes.lifetime import end_requests_heard, keep_private
from grafu.version import __version__
from grafu.visible import visible

_EPILOG = """\
examples:
  grafu functionalize cabinet.glb --out results
  grafu inspect cabinet.glb
  grafu templates --out gallery
  grafu synth --count 10000 --out data
  grafu train --out runs/base
  grafu ablate losses --out runs/losses
  grafu evaluate --data models --out results

exit codes: 0 done; 1 some of several inputs failed, or an error of our own; 2 bad input or arguments;
130 after Ctrl-C, 143 after SIGTERM
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command and returns its exit code.

    `arguments` are those of the process (None), or given by a caller, without the program's name: then a single model
    stays in the caller's process, where nothing can stop it, while of several each has a process and limits.
    """
    options = build_parser().parse_args(join_directions(sys.argv[1:] if arguments is None else arguments))
    keep_private()
    with end_requests_heard() as requests:
        code = exit_code(options, _supervised_or_here if arguments is None else _here)
    return EXIT_TERMINATED if code == EXIT_INTERRUPTED and requests.are_made else code


def _supervised_or_here(options: argparse.Namespace) -> int:
    """Runs the verb: one about a single model in a process of its own, within the limits that the options state."""
    is_single: Callable[[argparse.Namespace], bool] | None = getattr(options, "is_single", None)
    return run_supervised(options) if is_single is not None and is_single(options) else _here(options)


def _here(options: argparse.Namespace) -> int:
    prepare_verb()
    return int(options.run(options))


@final
class _Parser(argparse.ArgumentParser):
    """Says what is wrong with the arguments with nothing in them that steers a terminal."""

    def error(self, message: str) -> NoReturn:
        """Prints the usage and the message, and ends with exit code 2."""
        super().error(visible(message))


def build_parser() -> argparse.ArgumentParser:
    """Returns the parser of all verbs."""
    parser = _Parser(
        prog="grafu",
        description="Makes part-segmented 3D furniture work: hinges, rails, limits, handles, physics.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"grafu {__version__}")
    verbs = parser.add_subparsers(title="verbs", metavar="VERB", required=True)
    for verb in (functionalize, inspect, templates, synth, train, ablate, evaluate):
        subparser = verb.add_parser(verbs)
        subparser.formatter_class = argparse.RawDescriptionHelpFormatter
        subparser.add_argument("--debug", action="store_true", help="print the traceback of an internal error")
    return parser


if __name__ == "__main__":
    sys.exit(main())
