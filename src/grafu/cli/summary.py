"""What `functionalize` prints when it is done: what opened, what did not, and where to look. It decides nothing."""

from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path

from rich.markup import escape
from rich.table import Table

from grafu.cli.job import MODEL_PAGE, Failed, Job, JobResult, Succeeded
from grafu.cli.tables import plain_table, wide_console
from grafu.pipeline.report_schema import JointRecord, Report
from grafu.viewer.wording import added_parts, listed, not_built, opening, stopped
from grafu.vocabulary import JointType

_ALL_ROWS = 20  # inputs up to which each has its row, also where there is nothing to say of it


def print_results(results: Sequence[JobResult]) -> None:
    """Prints one input's joints, or one row per input, on stdout; a single failure prints nothing here."""
    console = wide_console()
    if len(results) > 1:
        shown = results if len(results) <= _ALL_ROWS else [result for result in results if _is_worth_a_row(result)]
        if shown:
            console.print(_inputs_table(shown))
        console.print(_total(results))
    elif isinstance(results[0], Succeeded):
        report = results[0].report
        if report.joints or report.skipped:
            console.print(_joints_table(report))
        else:
            console.print("nothing moves: no part is a door or a drawer (see `grafu inspect`)")
        for line in _said_of_one(report):
            console.print(line, markup=False, highlight=False)
        print_place(*_place(results[0].job))


def _said_of_one(report: Report) -> list[str]:
    """Returns what was added, and what was guessed of the input and can be stated instead."""
    added = [f"added: {listed(added_parts(report))}"] if report.added else []
    return added + [f"guessed: {line}" for line in report.frame.assumed if "changes it" in line]


def _place(job: Job) -> tuple[str, Path]:
    page = job.folder / MODEL_PAGE
    return ("look at", page) if job.options.page else ("written to", job.folder)


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
    for why, requests in _skipped(report).items():
        table.add_row(requests[0], "skipped", "", "", escape(why))
        if len(requests) > 1:
            table.add_row("", "", "", "", escape(f"so are {listed(requests[1:])}"))
    for part in stopped(report):
        table.add_row(part, "still", "", "", "as asked")
    return table


def _skipped(report: Report) -> dict[str, list[str]]:
    """Returns what could not be built by why it was."""
    by_reason = defaultdict[str, list[str]](list)
    for skip in not_built(report):
        by_reason[f"{skip.reason}: {skip.detail}" if skip.detail else skip.reason].append(skip.request)
    return by_reason


def _inputs_table(results: Sequence[JobResult]) -> Table:
    table = plain_table("input", "doors", "drawers", "skipped", "seconds", "notes")
    for result in results:
        if isinstance(result, Failed):
            table.add_row(escape(result.job.name), "", "", "", "", escape(f"FAILED: {result.why}"))
        else:
            table.add_row(escape(result.job.name), *_counts(result), escape("; ".join(_report_notes(result.report))))
    return table


def _is_worth_a_row(result: JobResult) -> bool:
    return isinstance(result, Failed) or bool(_report_notes(result.report))


def _counts(result: Succeeded) -> tuple[str, str, str, str]:
    types = [joint.type for joint in result.report.joints]
    turning, sliding = types.count(JointType.REVOLUTE), types.count(JointType.PRISMATIC)
    return str(turning), str(sliding), str(len(not_built(result.report))), f"{result.seconds:.1f}"


def _total(results: Sequence[JobResult]) -> str:
    done = [result for result in results if isinstance(result, Succeeded)]
    joints = sum(len(result.report.joints) for result in done)
    skipped = sum(len(not_built(result.report)) for result in done)
    failed = len(results) - len(done)
    ending = f"; {failed} of {len(results)} inputs failed" if failed else ""
    earlier = sum(result.earlier for result in done)
    ending = f" ({earlier} of them done earlier){ending}" if earlier else ending
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
    notes = [f"{skip.request} skipped ({skip.reason})" for skip in not_built(report)]
    notes += [f"restricted: {', '.join(restricted)}"] if restricted else []
    return notes + ([f"touching: {', '.join(touching)}"] if touching else [])
