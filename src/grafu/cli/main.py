"""The command `grafu`: reads the arguments and hands them to one verb.

Of the verbs only the one that is asked for is imported, and nothing heavy until it runs, so that `grafu --help` answers
at once. What a user can get wrong ends in one line on stderr and exit code 2, never in a traceback.
"""

import argparse
import sys
from collections.abc import Callable, Sequence
from importlib import import_module
from typing import Final

from grafu.cli.argument_parser import ArgumentParser
from grafu.cli.input_options import join_directions
from grafu.cli.pool import run_supervised
from grafu.cli.verb import EXIT_INTERRUPTED, EXIT_TERMINATED, exit_code, prepare_verb, unread
from grafu.collecting import collect_seldom, end_without_collecting
from grafu.linear_algebra import use_one_thread
from grafu.processes.lifetime import end_requests_heard, keep_private
from grafu.version import __version__

_VERBS: Final = (  # each in the module of its name
    "functionalize",
    "inspect",
    "show",
    "check",
    "edit",
    "templates",
    "doctor",
    "completion",
    "synth",
    "train",
    "ablate",
    "evaluate",
    "dataset",
)
_EPILOG = """\
examples:
  grafu functionalize cabinet.glb --out results
  grafu inspect cabinet.glb
  grafu show results
  grafu check results/cabinet
  grafu doctor
  grafu completion bash
  grafu edit results/cabinet
  grafu templates --out gallery
  grafu synth --count 10000 --out data
  grafu train --out runs/base
  grafu ablate losses --out runs/losses
  grafu evaluate --data models --out results
  grafu dataset results --out furniture

exit codes: 0 done; 1 some of several inputs failed, or an error of our own; 2 bad input or arguments;
130 after Ctrl-C, 141 where the reader of its output ended, 143 after SIGTERM
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command and returns its exit code.

    `arguments` are those of the process (None), or given by a caller, without the program's name: then a single model
    stays in the caller's process, where nothing can stop it, while of several each has a process and limits.
    """
    if arguments is None:
        collect_seldom()
    try:
        try:
            return _run(arguments)
        finally:
            sys.stdout.flush()  # of a help that ends the process, too
            if arguments is None:
                end_without_collecting()
    except BrokenPipeError:
        return unread()


def _run(arguments: Sequence[str] | None) -> int:
    words = _asked(join_directions(sys.argv[1:] if arguments is None else arguments))
    parser = build_parser(words)
    if not words:
        parser.print_help()
        return 0
    options = _parsed(parser, words)
    if begin := getattr(options, "on_begin", None):
        begin(options)
    keep_private()
    if arguments is None:
        use_one_thread()
    with end_requests_heard() as requests:
        code = exit_code(options, _supervised_or_here if arguments is None else _here)
    return EXIT_TERMINATED if code == EXIT_INTERRUPTED and requests.are_made else code


def _asked(words: list[str]) -> list[str]:
    """Returns the arguments with `help VERB` written as `VERB --help`."""
    return [*words[1:], "--help"] if words[:1] == ["help"] else words


def _supervised_or_here(options: argparse.Namespace) -> int:
    """Runs the verb: one about a single model in a process of its own, within the limits that the options state."""
    is_single: Callable[[argparse.Namespace], bool] | None = getattr(options, "is_single", None)
    return run_supervised(options) if is_single is not None and is_single(options) else _here(options)


def _here(options: argparse.Namespace) -> int:
    prepare_verb()
    return int(options.run(options))


def _parsed(parser: ArgumentParser, words: Sequence[str]) -> argparse.Namespace:
    """Returns the options; what none takes is refused by the parser of the verb, which knows its options."""
    options, unknown = parser.parse_known_args(words)
    verb: ArgumentParser = vars(options).pop("parser")
    if unknown:
        verb.refuse(unknown)
    return options


def build_parser(words: Sequence[str] = ()) -> ArgumentParser:
    """Returns the parser of the verb that the words name first, or of all verbs; only these are imported."""
    parser = ArgumentParser(
        prog="grafu",
        description="Makes part-segmented 3D furniture work: hinges, rails, limits, handles, physics.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"grafu {__version__}")
    parser.words = words
    verbs = parser.add_subparsers(title="verbs", metavar="VERB", required=True)
    for name in _named_verbs(words):
        subparser = import_module(f"grafu.cli.{name}").add_parser(verbs)
        subparser.formatter_class = argparse.RawDescriptionHelpFormatter
        subparser.set_defaults(parser=subparser)
        subparser.words = words[1:]
        subparser.add_argument("--debug", action="store_true", help="print the traceback of an internal error")
    if "completion" in verbs.choices:
        verbs.choices["completion"].set_defaults(command=parser)
    return parser


def _named_verbs(words: Sequence[str]) -> Sequence[str]:
    """Returns the verb that the words begin with; all verbs where they begin with none, or with one about all."""
    first = words[0] if words else ""
    return (first,) if first in _VERBS and first != "completion" else _VERBS


if __name__ == "__main__":
    sys.exit(main())
