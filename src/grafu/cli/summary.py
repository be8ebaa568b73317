"""What `functionalize` prints when it is done: what opened, what did not, and where to look. It decides nothing."""

from collections.abc import Sequence
from pathlib import Path

from rich.markup import escape
from rich.table import Table

from grafu.cli.job import Failed, JobResult, Succeeded
from grafu.cli.tables import plain_table, wide_console
from grafu.pipeline.report_schema import JointRecord, Report
from grafu.viewer.wording import opening
from grafu.vocabulary import JointType


def print_results(results: Sequence[JobResult]) -> None:
    """Prints one input's joints, or one row per input, on stdout; a single failure prints nothing here."""
    console = wide_console()
    if len(results) > 1:
        console.print(_inputs_table(results))
        console.print(_total(results))
    elif isinstance(results[0], Succeeded):
        report = results[0].report
        if report.joints or report.skipped:
            console.print(_joints_table(report))
        else:
            console.print("nothing moves: no part is a door or a drawer (see `grafu inspect`)")
        print_place("written to", results[0].job.folder)


def print_place(what: str, path: Path) -> None:
    """Prints where something was written; a path is never folded."""
    wide_console().print(f"{what} {path}", soft_wrap=True, markup=False, highlight=False)


def _joints_table(report: Report) -> Table:
    table = plain_table("part", "joint", "mechanism", "opening", "notes")
    for joint in report.joints:
        mechanism = f"{joint.count} x {joint.template} ({joint.mechanism})"
        table.add_row(
            joint.part,
            joint.type,
            mechanism,
            opening(joint.type, joint.opening),
            escape("; ".join(_joint_notes(joint))),
        )
    for skip in report.skipped:
        table.add_row(
            skip.request, "skipped", "", "", escape(f"{skip.reason}: {skip.detail}" if skip.detail else skip.reason)
        )
    return table


def _inputs_table(results: Sequence[JobResult]) -> Table:
    table = plain_table("input", "doors", "drawers", "skipped", "seconds", "notes")
    for result in results:
        if isinstance(result, Failed):
            table.add_row(escape(result.job.name), "", "", "", "", escape(f"FAILED: {result.why}"))
        else:
            table.add_row(escape(result.job.name), *_counts(result), escape("; ".join(_report_notes(result.report))))
    return table


def _counts(result: Succeeded) -> tuple[str, str, str, str]:
    types = [joint.type for joint in result.report.joints]
    turning, sliding = types.count(JointType.REVOLUTE), types.count(JointType.PRISMATIC)
    return str(turning), str(sliding), str(len(result.report.skipped)), f"{result.seconds:.1f}"


def _total(results: Sequence[JobResult]) -> str:
    done = [result for result in results if isinstance(result, Succeeded)]
    joints = sum(len(result.report.joints) for result in done)
    skipped = sum(len(result.report.skipped) for result in done)
    failed = len(results) - len(done)
    ending = f"; {failed} of {len(results)} inputs failed" if failed else ""
    return f"{joints} joints built, {skipped} skipped in {len(done)} inputs{ending}"


def _joint_notes(joint: JointRecord) -> list[str]:
    notes = ["restricted"] if joint.restricted else []
    if joint.collision_share > 0:
        notes.append(f"still touches in {joint.collision_share:.0%} of its poses")
    notes += [f"{c.part} {c.kind}" for c in joint.clearances]
    if joint.after:
        notes.append(f"opens after {', '.join(joint.after)}")
    return notes + list(joint.notes)


def _report_notes(report: Report) -> list[str]:
    restricted = [joint.part for joint in report.joints if joint.restricted]
    touching = [joint.part for joint in report.joints if joint.collision_share > 0]
    notes = [f"{skip.request} skipped ({skip.reason})" for skip in report.skipped]
    notes += [f"restricted: {', '.join(restricted)}"] if restricted else []
    return notes + ([f"touching: {', '.join(touching)}"] if touching else [])
