"""The verb `inspect`: what is read from an input, what it lacks, and what a run would make move. It builds nothing."""

import argparse
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from grafu.cli.input_options import add_input_options, add_limit_option, load_options, with_limits
from grafu.cli.limit_options import add_limit_options

if TYPE_CHECKING:
    from rich.table import Table

    from grafu.pipeline.inspection import Forecast, InspectedPart, Inspection, StatedJoint


_DESCRIPTION = """\
Shows what is read from an input: its parts and their categories, the frame and scale that were detected, which parts
touch, the joints that it states itself, what it lacks, and which parts a run would make move, how, with what
confidence. On a terminal a picture shows it, doors blue, drawers orange, handles red. It writes nothing.
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
    parser.add_argument("--no-picture", action="store_true", help="show no picture; none is shown in a pipe")
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
    from grafu.cli.terminal_picture import print_picture
    from grafu.geometry.budget import UNLIMITED, Budget
    from grafu.graph.parse import parse_graph
    from grafu.pipeline.forecast import forecast
    from grafu.pipeline.inspection import inspect

    asset = load_asset(options.input, with_limits(load_options(options), options))
    budget = Budget.lasting(options.timeout) if options.timeout else UNLIMITED
    inspection = inspect(asset, parse_graph(asset)).with_changes(forecast=forecast(asset, budget))
    if options.json:
        values = inspection.to_json()
        sys.stdout.write(json.dumps(values, indent=1) + "\n")  # ASCII: no name in it steers a terminal
        return 0
    if sys.stdout.isatty() and not options.no_picture:
        print_picture(asset)
    print_inspection(inspection)
    return 0


def print_inspection(inspection: "Inspection") -> None:
    """Prints parts, frame, joints and deficiencies on stdout."""
    from rich.markup import escape

    from grafu.cli.terminal import wide_console

    console = wide_console()
    console.print(escape(_heading(inspection)), highlight=False)
    for note in (*inspection.frame.assumed, *inspection.input.notes):
        console.print(f"  {escape(note)}", highlight=False)
    console.print(_parts_table(inspection))
    if not all(part.closed for part in inspection.parts):
        console.print("* its mesh is not watertight", highlight=False)
    if inspection.joints:
        console.print(_joints_table(inspection.joints))
    console.print(f"{len(inspection.contacts)} pairs of parts touch")
    if inspection.deficiencies:
        console.print(_deficiencies_table(inspection))
    if inspection.forecast is not None:
        _print_forecast(inspection.forecast)


def _heading(inspection: "Inspection") -> str:
    x, y, z = inspection.size
    read = inspection.input
    return (
        f"{read.name}: {read.kind}, {read.parts} parts, {x:.3f} x {y:.3f} x {z:.3f} m (width, depth, height); "
        f"up {inspection.frame.up}, front {inspection.frame.front}, {inspection.frame.scale:g} m per unit"
    )


def _parts_table(inspection: "Inspection") -> "Table":
    from rich.markup import escape

    from grafu.cli.terminal import plain_table

    table = plain_table("part", "category", "by", "size (cm)", "faces", "moves with")
    table.columns[3].no_wrap = True
    for part in inspection.parts:
        mesh = f"{part.faces}{'' if part.closed else ' *'}"
        row = (part.id, part.category, part.labelled_by, _size(part), mesh, part.rides_on or "")
        table.add_row(*(escape(cell) for cell in row))
    return table


def _joints_table(joints: "tuple[StatedJoint, ...]") -> "Table":
    from rich.markup import escape

    from grafu.articulation.motion_kind import motion_kind
    from grafu.cli.terminal import plain_table

    table = plain_table("joint of", "type", "axis", "limits")
    for joint in joints:
        direction = " ".join(f"{c:+.2f}" for c in joint.axis.direction)
        unit = motion_kind(joint.type).unit
        limits = "none stated" if joint.lower is None else f"{joint.lower:.3f} .. {joint.upper:.3f} {unit}"
        table.add_row(escape(joint.part), joint.type, direction, limits)
    return table


def _deficiencies_table(inspection: "Inspection") -> "Table":
    from rich.markup import escape

    from grafu.cli.terminal import plain_table

    table = plain_table("missing", "at", "detail")
    for missing in inspection.deficiencies:
        table.add_row(missing.kind, escape(missing.part or "the whole"), escape(missing.detail))
    return table


def _print_forecast(forecast: "Forecast") -> None:
    """Prints what a run would make move, and what it would not."""
    from rich.markup import escape

    from grafu.cli.terminal import plain_table, wide_console
    from grafu.pipeline.words import counted, percent, piece_words

    console = wide_console()
    if forecast.piece is not None:
        console.print(piece_words(forecast.piece.kind, forecast.piece.score), highlight=False)
    console.print(f"a run would make {counted(len(forecast.motions), 'part')} move, by the {forecast.source}:")
    table = plain_table("part", "joint", "confidence", "decided")
    for motion in forecast.motions:
        confidence = "by shape or name" if motion.confidence is None else percent(motion.confidence)
        table.add_row(escape(motion.part), motion.type, confidence, escape("; ".join(motion.decided)))
    for part in forecast.static:
        table.add_row(escape(part.part), "none", "", escape(f"{part.reason}: {part.why}" if part.why else part.reason))
    if table.row_count:
        console.print(table)


def _size(part: "InspectedPart") -> str:
    return " x ".join(f"{(high - low) * 100:.1f}" for low, high in zip(part.low, part.high, strict=True))
