"""What `functionalize` prints when it is done: what opened, what did not, and where to look. It decides nothing."""

from collections import Counter, defaultdict
from collections.abc import Sequence
from pathlib import Path
from typing import final

from grafu.articulation.motion_kind import motion_kind
from grafu.cli.job import MODEL_PAGE, Failed, Job, JobResult, Succeeded
from grafu.cli.plain_text import TextTable, print_line, print_table
from grafu.dataclass import dataclass
from grafu.pipeline.report_schema import FaultRecord, JointRecord, Report, VerdictRecord
from grafu.pipeline.verdict import fixed_by_user, parts_without_joint, verdict_of
from grafu.pipeline.words import Colour, FaultKind, counted, cut_in_words, hardware_in_words, listed, percent
from grafu.viewer.wording import added, unused_joints

_NOT_BUILT = (FaultKind.NO_JOINT, FaultKind.NOT_BUILT)
_READ_NOTES = 5  # of one input; the report has all
_ALL_ROWS = 20  # inputs up to which each has its row, also where there is nothing to say of it


@final
@dataclass(frozen=True)
class SummaryRow:
    """What the table of several inputs, and the line under it, state of one; `colour` is None where it failed."""

    cells: tuple[str, ...]
    colour: Colour | None = None
    joints: int = 0
    skipped: int = 0
    unused: int = 0
    earlier: bool = False

    @property
    def is_worth_a_row(self) -> bool:
        """Whether there is something to state of it."""
        return self.colour is None or bool(self.cells[-1])


def row_of(result: JobResult) -> SummaryRow:
    """Returns what is stated of a result among several."""
    if isinstance(result, Failed):
        return SummaryRow((result.job.name, "failed", "", "", "", "", f"FAILED: {result.why}"))
    report, verdict = result.report, verdict_of(result.report)
    cells = (result.job.name, *_counts(result), "; ".join(_report_notes(report)))
    unused = report.motion.unused_joints
    return SummaryRow(cells, verdict.colour, len(report.joints), _skipped(verdict), unused, result.earlier)


def print_results(results: Sequence[JobResult]) -> None:
    """Prints one input's joints, or one row per input, on stdout; a single failure prints nothing here."""
    if len(results) > 1:
        print_rows([row_of(result) for result in results])
    elif isinstance(results[0], Succeeded):
        report = results[0].report
        if report.joints or report.skipped or parts_without_joint(report):
            print_table(_joints_table(report))
        for line in _said_of_one(report):
            print_line(line)
        print_place(*_place(results[0].job))


def print_rows(rows: Sequence[SummaryRow]) -> None:
    """Prints a row per input, of many only of those of which there is something to state, and a line on all."""
    from rich.markup import escape  # local: it takes long to import, and of one input nothing is drawn

    from grafu.cli.terminal import plain_table, wide_console

    console = wide_console()
    shown = rows if len(rows) <= _ALL_ROWS else [row for row in rows if row.is_worth_a_row]
    if shown:
        table = plain_table("input", "verdict", "doors", "drawers", "skipped", "seconds", "notes")
        for row in shown:
            table.add_row(*map(escape, row.cells))
        console.print(table)
    console.print(_total(rows))
    for line in _stated(rows):
        console.print(line, highlight=False)


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
    print_line(f"{what} {path}", folds=False)


def _joints_table(report: Report) -> TextTable:
    rows: list[tuple[str, ...]] = []
    for joint in report.joints:
        mechanism = hardware_in_words(joint.count, joint.template, joint.mechanism)
        opening = motion_kind(joint.type).worded(joint.opening)
        rows.append((joint.part, joint.type, mechanism, opening, "; ".join(_joint_notes(joint))))
    for why, requests in _not_built(report).items():
        rows.append((requests[0], "skipped", "", "", why))
        if len(requests) > 1:
            rows.append(("", "", "", "", f"so are {listed(requests[1:])}"))
    rows += [(part, "fixed", "", "", "by the user") for part in fixed_by_user(report)]
    return TextTable(("part", "joint", "mechanism", "opening", "notes"), tuple(rows))


def _not_built(report: Report) -> dict[str, list[str]]:
    """Returns what was not built, doors and drawers that are static among it, by why it was not."""
    by_reason = defaultdict[str, list[str]](list)
    for line in verdict_of(report).lines:
        if line.kind in _NOT_BUILT:
            by_reason[line.why].append(line.part)
    return by_reason


def _counts(result: Succeeded) -> tuple[str, ...]:
    verdict = verdict_of(result.report)
    kinds = [motion_kind(joint.type) for joint in result.report.joints if joint.is_front]
    turning, sliding = sum(kind.turns for kind in kinds), sum(kind.slides for kind in kinds)
    return verdict.colour, str(turning), str(sliding), str(_skipped(verdict)), f"{result.seconds:.1f}"


def _skipped(verdict: VerdictRecord) -> int:
    return sum(line.kind in _NOT_BUILT for line in verdict.lines)


def _total(rows: Sequence[SummaryRow]) -> str:
    done = [row for row in rows if row.colour is not None]
    joints, skipped = sum(row.joints for row in done), sum(row.skipped for row in done)
    colours = Counter(row.colour for row in done)
    lights = ", ".join(f"{colours[colour]} {colour}" for colour in Colour if colours[colour])
    failed = len(rows) - len(done)
    ending = f"; {failed} of {len(rows)} inputs failed" if failed else ""
    ending = f": {lights}{ending}" if lights else ending
    earlier = sum(row.earlier for row in done)
    ending = f" ({earlier} of them done earlier){ending}" if earlier else ending
    return f"{joints} joints built, {skipped} skipped in {len(done)} inputs{ending}"


def _stated(rows: Sequence[SummaryRow]) -> list[str]:
    """Returns in words how many inputs state joints that were not read, if any do."""
    inputs, joints = sum(row.unused > 0 for row in rows), sum(row.unused for row in rows)
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
