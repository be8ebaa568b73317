"""What `functionalize` prints when it is done: what opened, what did not, and where to look. It decides nothing."""

from collections import Counter, defaultdict
from collections.abc import Sequence
from pathlib import Path

from rich.markup import escape
from rich.table import Table

from grafu.articulation.motion_kind import motion_kind
from grafu.cli.job import MODEL_PAGE, Failed, Job, JobResult, Succeeded
from grafu.cli.terminal import plain_table, wide_console
from grafu.pipeline.report_schema import FaultRecord, JointRecord, Report, VerdictRecord
from grafu.pipeline.verdict import fixed_by_user, parts_without_joint, verdict_of
from grafu.pipeline.words import Colour, FaultKind, counted, cut_in_words, hardware_in_words, listed, percent
from grafu.viewer.wording import added, unused_joints

_NOT_BUILT = (FaultKind.NO_JOINT, FaultKind.NOT_BUILT)
_READ_NOTES = 5  # of one input; the report has all
_ALL_ROWS = 20  # inputs up to which each has its row, also where there is nothing to say of it


def print_results(results: Sequence[JobResult]) -> None:
    """Prints one input's joints, or one row per input, on stdout; a single failure prints nothing here."""
    console = wide_console()
    if len(results) > 1:
        shown = results if len(results) <= _ALL_ROWS else [result for result in results if _is_worth_a_row(result)]
        if shown:
            console.print(_inputs_table(shown))
        console.print(_total(results))
        for line in _stated(results):
            console.print(line, highlight=False)
    elif isinstance(results[0], Succeeded):
        report = results[0].report
        if report.joints or report.skipped or parts_without_joint(report):
            console.print(_joints_table(report))
        for line in _said_of_one(report):
            console.print(line, markup=False, highlight=False)
        print_place(*_place(results[0].job))


def _said_of_one(report: Report) -> list[str]:
    """Returns the verdict with what may set it right, what was added, not used, cut or guessed."""
    verdict, given = verdict_of(report), added(report)
    said = [f"{verdict.colour}: {verdict.sentence}", *map(_fault, verdict.lines)]
    said += [f"added: {listed(given)}"] if given else []
    said += [f"the input {unused}"] if (unused := unused_joints(report)) else []
    said += _read(report.input.notes)
    return said + [f"guessed: {line}" for line in report.frame.assumed if "changes it" in line]


def _read(notes: Sequence[str]) -> list[str]:
    """Returns what happened to the input while it was read: what was cut, joined, renamed or left out."""
    shown = [f"input: {note}" for note in notes[:_READ_NOTES]]
    more = len(notes) - len(shown)
    return [*shown, f"input: {more} more notes (report.json)"] if more else shown


def _fault(line: FaultRecord) -> str:
    """Returns one fault, with its option; why something was not built stands in the table."""
    why = "" if line.kind in _NOT_BUILT else f": {line.why}"
    return f"  {line.part or 'the whole'} {line.kind}{why}{f' ({line.option})' if line.option else ''}"


def _place(job: Job) -> tuple[str, Path]:
    page = job.folder / MODEL_PAGE
    return ("look at", page) if job.options.page else ("written to", job.folder)


def print_place(what: str, path: Path) -> None:
    """Prints where something was written; a path is never folded."""
    wide_console().print(f"{what} {path}", soft_wrap=True, markup=False, highlight=False)


def _joints_table(report: Report) -> Table:
    table = plain_table("part", "joint", "mechanism", "opening", "notes")
    for joint in report.joints:
        mechanism = hardware_in_words(joint.count, joint.template, joint.mechanism)
        table.add_row(
            joint.part,
            joint.type,
            mechanism,
            motion_kind(joint.type).worded(joint.opening),
            escape("; ".join(_joint_notes(joint))),
        )
    for why, requests in _not_built(report).items():
        table.add_row(requests[0], "skipped", "", "", escape(why))
        if len(requests) > 1:
            table.add_row("", "", "", "", escape(f"so are {listed(requests[1:])}"))
    for part in fixed_by_user(report):
        table.add_row(part, "fixed", "", "", "by the user")
    return table


def _not_built(report: Report) -> dict[str, list[str]]:
    """Returns what was not built, doors and drawers that are static among it, by why it was not."""
    by_reason = defaultdict[str, list[str]](list)
    for line in verdict_of(report).lines:
        if line.kind in _NOT_BUILT:
            by_reason[line.why].append(line.part)
    return by_reason


def _inputs_table(results: Sequence[JobResult]) -> Table:
    table = plain_table("input", "verdict", "doors", "drawers", "skipped", "seconds", "notes")
    for result in results:
        if isinstance(result, Failed):
            table.add_row(escape(result.job.name), "failed", "", "", "", "", escape(f"FAILED: {result.why}"))
        else:
            table.add_row(escape(result.job.name), *_counts(result), escape("; ".join(_report_notes(result.report))))
    return table


def _is_worth_a_row(result: JobResult) -> bool:
    return isinstance(result, Failed) or bool(_report_notes(result.report))


def _counts(result: Succeeded) -> tuple[str, ...]:
    verdict = verdict_of(result.report)
    kinds = [motion_kind(joint.type) for joint in result.report.joints if joint.is_front]
    turning, sliding = sum(kind.turns for kind in kinds), sum(kind.slides for kind in kinds)
    return verdict.colour, str(turning), str(sliding), str(_skipped(verdict)), f"{result.seconds:.1f}"


def _skipped(verdict: VerdictRecord) -> int:
    return sum(line.kind in _NOT_BUILT for line in verdict.lines)


def _total(results: Sequence[JobResult]) -> str:
    done = [result for result in results if isinstance(result, Succeeded)]
    joints = sum(len(result.report.joints) for result in done)
    verdicts = [verdict_of(result.report) for result in done]
    skipped = sum(map(_skipped, verdicts))
    colours = Counter(verdict.colour for verdict in verdicts)
    lights = ", ".join(f"{colours[colour]} {colour}" for colour in Colour if colours[colour])
    failed = len(results) - len(done)
    ending = f"; {failed} of {len(results)} inputs failed" if failed else ""
    ending = f": {lights}{ending}" if lights else ending
    earlier = sum(result.earlier for result in done)
    ending = f" ({earlier} of them done earlier){ending}" if earlier else ending
    return f"{joints} joints built, {skipped} skipped in {len(done)} inputs{ending}"


def _stated(results: Sequence[JobResult]) -> list[str]:
    """Returns in words how many inputs state joints that were not read, if any do."""
    unused = [result.report.motion.unused_joints for result in results if isinstance(result, Succeeded)]
    inputs, joints = sum(count > 0 for count in unused), sum(unused)
    states = "states" if inputs == 1 else "state"
    words = f"{counted(inputs, 'input')} {states} {counted(joints, 'joint')}; --motion annotation builds such"
    return [words] if joints else []


def _joint_notes(joint: JointRecord) -> list[str]:
    notes = ["restricted"] if joint.restricted else []
    if joint.collision_share > 0:
        notes.append(f"collides in {percent(joint.collision_share)} of its poses")
    notes += [f"{c.part} {cut_in_words(c.kind)}" for c in joint.clearances]
    if joint.after:
        notes.append(f"opens after {', '.join(joint.after)}")
    return notes + list(joint.notes)


def _report_notes(report: Report) -> list[str]:
    """Returns the faults, by kind with their parts."""
    parts = defaultdict[str, list[str]](list)
    for line in verdict_of(report).lines:
        parts[line.kind].append(line.part)
    return [f"{kind}: {listed(filter(None, dict.fromkeys(names)))}".removesuffix(": ") for kind, names in parts.items()]
