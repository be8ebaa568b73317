"""An inspection as tables for people. It reads nothing."""

from rich.markup import escape
from rich.table import Table

from grafu.articulation.motion_kind import motion_kind
from grafu.cli.tables import plain_table, wide_console
from grafu.pipeline.inspection import InspectedPart, Inspection, StatedJoint


def print_inspection(inspection: Inspection) -> None:
    """Prints parts, frame, joints and deficiencies on stdout."""
    console = wide_console()
    console.print(escape(_heading(inspection)), highlight=False)
    for note in (*inspection.frame.assumed, *inspection.input.notes):
        console.print(f"  {escape(note)}", highlight=False)
    console.print(_parts_table(inspection))
    if inspection.joints:
        console.print(_joints_table(inspection.joints))
    console.print(f"{len(inspection.contacts)} pairs of parts touch")
    if inspection.deficiencies:
        console.print(_deficiencies_table(inspection))


def _heading(inspection: Inspection) -> str:
    x, y, z = inspection.size
    read = inspection.input
    return (
        f"{read.name}: {read.kind}, {read.parts} parts, {x:.3f} x {y:.3f} x {z:.3f} m (width, depth, height); "
        f"up {inspection.frame.up}, front {inspection.frame.front}, {inspection.frame.scale:g} m per unit"
    )


def _parts_table(inspection: Inspection) -> Table:
    table = plain_table("part", "category", "by", "size (cm)", "faces", "rides on")
    for part in inspection.parts:
        mesh = f"{part.faces}{'' if part.closed else ' (open)'}"
        row = (part.id, part.category, part.labelled_by, _size(part), mesh, part.rides_on or "")
        table.add_row(*(escape(cell) for cell in row))
    return table


def _joints_table(joints: tuple[StatedJoint, ...]) -> Table:
    table = plain_table("joint of", "type", "axis", "limits")
    for joint in joints:
        direction = " ".join(f"{c:+.2f}" for c in joint.axis.direction)
        limits = (
            "none stated"
            if joint.lower is None
            else f"{joint.lower:.3f} .. {joint.upper:.3f} {motion_kind(joint.type).unit}"
        )
        table.add_row(escape(joint.part), joint.type, direction, limits)
    return table


def _deficiencies_table(inspection: Inspection) -> Table:
    table = plain_table("missing", "at", "detail")
    for lack in inspection.deficiencies:
        table.add_row(lack.kind, escape(lack.part or "the whole"), escape(lack.detail))
    return table


def _size(part: InspectedPart) -> str:
    return " x ".join(f"{(high - low) * 100:.1f}" for low, high in zip(part.low, part.high, strict=True))
