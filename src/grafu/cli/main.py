"""The command `grafu`: reads the arguments and hands them to one verb. It knows no geometry.

Nothing heavy is imported until a verb runs, so that `grafu --help` answers at once. What a user can get wrong ends in
one line on stderr and exit code 2, never in a traceback.
"""

import argparse
import sys
from collections.abc import Sequence
from importlib import import_module

from grafu.cli import ablate, evaluate, functionalize, inspect, synth, templates, train
from grafu.cli.input_options import join_directions
from grafu.cli.interruption import interruption_held
from grafu.cli.messages import INTERRUPTED, complain, internal_fault
from grafu.errors import FunctionalizationError
from grafu.version import __version__

EXIT_DONE, EXIT_FAILED, EXIT_BAD_INPUT, EXIT_INTERRUPTED = 0, 1, 2, 130

_EPILOG = """\
examples:
  grafu functionalize cabinet.glb --out results
  grafu inspect cabinet.glb
  grafu templates --out gallery
  grafu synth --count 10000 --out data
  grafu train --out runs/base
  grafu ablate losses --out runs/losses
  grafu evaluate --data models --out results

exit codes: 0 done; 1 some of several inputs failed, or an error of our own; 2 bad input or arguments
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command and returns its exit code (`arguments`: without the program's name; None: the process's)."""
    options = build_parser().parse_args(join_directions(sys.argv[1:] if arguments is None else arguments))
    try:
        with interruption_held():
            import_module("trimesh")
        return int(options.run(options))
    except FunctionalizationError as error:
        complain(str(error))
        return EXIT_BAD_INPUT
    except KeyboardInterrupt:
        complain(INTERRUPTED)
        return EXIT_INTERRUPTED
    except Exception as error:  # the last door: whatever reaches it is our fault, and the user gets one line
        complain(internal_fault(error, "grafu", options.debug))
        return EXIT_FAILED


def build_parser() -> argparse.ArgumentParser:
    """Returns the parser of all verbs."""
    parser = argparse.ArgumentParser(
        prog="grafu",
        description="Furniture that only looks right goes in; furniture that works comes out.",
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
