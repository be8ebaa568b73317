"""The verb `inspect`: what is read from an input, and what it lacks, before anything is done to it."""

import argparse
import json
import sys
from pathlib import Path

from grafu.cli.input_options import add_input_options, add_limit_option, load_options, with_limits
from grafu.cli.limit_options import add_limit_options

_DESCRIPTION = """\
Shows what is read from an input: its parts and their categories, the frame and scale that were detected, which parts
touch, the joints that it states itself, and what it lacks. It writes nothing.
"""
_EXAMPLES = """\
examples:
  grafu inspect cabinet.glb
  grafu inspect models/40453 --json > cabinet.json
"""


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> argparse.ArgumentParser:
    """Adds the verb and returns its parser."""
    parser = verbs.add_parser(
        "inspect", help="show what is read from an input", description=_DESCRIPTION, epilog=_EXAMPLES
    )
    parser.add_argument("input", type=Path, metavar="INPUT", help="a model: file or folder")
    parser.add_argument("--json", action="store_true", help="print JSON instead of tables")
    add_input_options(parser)
    add_limit_option(parser)
    add_limit_options(parser)
    parser.set_defaults(run=run, is_single=_is_single)
    return parser


def _is_single(_: argparse.Namespace) -> bool:
    return True


def run(options: argparse.Namespace) -> int:
    """Prints what is read; returns 0.

    Raises:
        FunctionalizationError: if the input or an option is wrong.
    """
    from grafu.asset.load import load_asset
    from grafu.graph.parse import parse_graph
    from grafu.pipeline.inspection import inspect

    asset = load_asset(options.input, with_limits(load_options(options), options))
    inspection = inspect(asset, parse_graph(asset))
    if options.json:
        values = inspection.model_dump(mode="json", by_alias=True)
        sys.stdout.write(json.dumps(values, indent=1) + "\n")  # ASCII: no name in it steers a terminal
        return 0
    from grafu.cli.inspection_tables import print_inspection

    print_inspection(inspection)
    return 0
