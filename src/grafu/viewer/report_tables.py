"""The tables of a model's page, from its report: joints, what was missing, added, not built. It decides nothing.

What sets a wrong motion right stands beside it: the options of `grafu functionalize`, as buttons to copy.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from types import MappingProxyType

from grafu.articulation.motion_kind import motion_kind
from grafu.graph.completion import GraphCompletion
from grafu.pipeline.certainty import certainty_words
from grafu.pipeline.report_schema import ClearanceRecord, JointRecord, Report
from grafu.pipeline.verdict import fixed_by_user, reason_of, verdict_of
from grafu.pipeline.words import FaultKind, counted, cut_in_words, hardware_in_words, listed, percent
from grafu.refusal import Reason
from grafu.viewer.shell import Html, joined, tag
from grafu.viewer.wording import added, axis_words, moved_words, remaining_deficiencies

LEAD = (
    "One is wrong? Copy its line, give it to the same command, with --overwrite. Instead of the last word: left, "
    "right, top or bottom (it turns about that side), slides, or not."
)


def correction_buttons(options: tuple[str, ...]) -> Html:
    """Returns a button for each option that copies it; its text can be selected, too."""
    buttons = (tag("button", o, type="button", class_="copy", title="Copy", data_copy=o) for o in options)
    return joined(buttons)


_NOT_BUILT = (FaultKind.NO_JOINT, FaultKind.NOT_BUILT, FaultKind.NOTHING_MOVES)
_SHOWN = 6  # ids in a cell; more of them are counted
_LEAST = 5e-4  # a fraction that is not written as 0.0 %


def plain_rows(columns: Sequence[str], rows: Sequence[Sequence[str]], label: str) -> Html:
    """Returns a table that can be scrolled by keys; on a narrow screen each row becomes a card."""
    head = tag("tr", *(tag("th", name, scope="col") for name in columns))
    body = [
        tag("tr", *(tag("td", tag("div", cell), data_label=name) for name, cell in zip(columns, row, strict=True)))
        for row in rows
    ]
    table = tag("table", tag("thead", head), tag("tbody", *body))
    return tag("div", table, class_="scroll", tabindex=0, role="region", aria_label=label)


def joints_table(
    report: Report, completion: GraphCompletion, corrections: Mapping[str, tuple[str, ...]] = MappingProxyType({})
) -> Html:
    """Returns one row per joint; `corrections` are the options that set it right, by part (none: no column)."""
    columns: tuple[str, ...] = ("part", "moves", "mechanism", "axis", "measured", "confidence", "notes")
    rows = [_joint_row(joint, completion) for joint in report.joints]
    if corrections:
        columns = (*columns, "if it is wrong")
        rows = [
            (*row, correction_buttons(corrections.get(joint.part, ())))
            for row, joint in zip(rows, report.joints, strict=True)
        ]
    return plain_rows(columns, rows, "Joints") if rows else tag("p", "Nothing moves.", class_="none")


def added_table(report: Report) -> Html:
    """Returns what was added, counted as at the top of the page, then one row per joint's hardware and added part."""
    if not (phrases := added(report)):
        return tag("p", "Nothing was added.", class_="none")
    rows = [
        (part_button(j.part), _hardware(j), f"carries {j.part} on {j.mount}", f"{j.count} × {j.template}", j.part)
        for j in report.joints
        if j.count
    ]
    rows += [(part_button(a.part), a.category, a.why, a.style, a.link) for a in report.additions]
    columns = ("part", "category", "why", "style", "moves with")
    return joined([tag("p", f"{listed(phrases)}.", class_="lead"), plain_rows(columns, rows, "Added parts")])


def _hardware(joint: JointRecord) -> str:
    """Returns what a joint runs on, by the same word as it is counted by."""
    return motion_kind(joint.type).hardware


def not_built_table(report: Report) -> Html:
    """Returns one row per door or drawer without a joint, request that was not built, and part that the user fixed."""
    faults = [fault for fault in verdict_of(report).lines if fault.kind in _NOT_BUILT]
    rows = [(fault.part, fault.kind.value, reason_of(report, fault), fault.why) for fault in faults]
    rows += [(part, "as asked", Reason.REJECTED.sentence, "the user fixed it") for part in fixed_by_user(report)]
    columns = ("part or request", "what", "reason", "what was found")
    none = "Every door and drawer has its joint, and all else that was asked for was built."
    return plain_rows(columns, rows, "Not built") if rows else tag("p", none, class_="none")


def deficiencies_table(report: Report) -> Html:
    """Returns one row per kind of thing that was missing: how often before, how often still."""
    before = Counter(lack.kind for lack in report.deficiencies)
    left = remaining_deficiencies(report)
    after = Counter(lack.kind for lack in left)
    rows = [
        (kind.value, str(count), str(after[kind]), _ids([lack.part for lack in left if lack.kind is kind]))
        for kind, count in before.items()
    ]
    columns = ("missing", "before", "after", "still at")
    return plain_rows(columns, rows, "What was missing") if rows else tag("p", "Nothing was missing.", class_="none")


def part_button(part: str) -> Html:
    """Returns a part's name that shows the part in the 3D view."""
    return tag("button", part, type="button", class_="part", data_part=part)


def _joint_row(joint: JointRecord, completion: GraphCompletion) -> tuple[str, ...]:
    reach = f"{motion_kind(joint.type).worded(joint.lower)} to {motion_kind(joint.type).worded(joint.upper)}"
    moves = [tag("span", _hardware(joint), class_=f"kind {_hardware(joint)}"), reach]
    return (
        part_button(joint.part),
        lines([*moves, flag("restricted")] if joint.restricted else moves),
        lines([*_mechanism(joint), f"on {joint.mount}"]),
        lines([
            f"stated {axis_words(joint.initial_axis, joint.type)} ({joint.motion_source})",
            f"built {axis_words(joint.rectified_axis, joint.type)}",
            f"moved {moved_words(joint)}",
        ]),
        lines(_measured(joint)),
        lines(certainty_words(completion, joint.part) or ["stated, not guessed"]),
        lines(_notes(joint)),
    )  # fmt: skip


def _mechanism(joint: JointRecord) -> list[str]:
    """Returns what a joint runs on, and the stays that it has besides."""
    runs_on = hardware_in_words(joint.count, joint.template, joint.mechanism)
    return [runs_on, counted(joint.stays, "stay")] if joint.stays else [runs_on]


def _measured(joint: JointRecord) -> list[str]:
    collision = f"collision {percent(joint.collision_share)}"
    grasp = "no grasp" if joint.grasp == "none" else f"grasp: {joint.grasp}"
    return [
        flag(collision) if joint.collision_share > 0 else collision,
        f"gap {1000 * joint.largest_gap:.1f} mm",
        flag(grasp) if joint.grasp == "none" else grasp,
    ]


def _notes(joint: JointRecord) -> list[str]:
    waits = [f"opens after {listed(joint.after)}"] if joint.after else []
    return [*waits, *(_clearance(cut) for cut in joint.clearances), *joint.notes, *joint.left_out]


def _clearance(cut: ClearanceRecord) -> str:
    """Returns what was taken away: as a depth where material was pressed back, else as a fraction."""
    ratio = f", {_ratios(cut)}" if cut.share >= _LEAST else ", a trace"
    amount = {"trimmed": f" by {1000 * cut.amount:.1f} mm", "joined": "", "closed": ""}
    return f"{cut.part} {cut_in_words(cut.kind)}{amount.get(cut.kind, ratio)}: {cut.why}"


def _ratios(cut: ClearanceRecord) -> str:
    if cut.kind != "carved":
        return f"{cut.share:.1%} of it"
    return f"{cut.surface_share:.1%} of its surface and {cut.volume_share:.1%} of its volume"


def _ids(parts: Sequence[str]) -> str:
    named = [part or "the whole" for part in parts]
    more = [f"{len(named) - _SHOWN} more"] if len(named) > _SHOWN else []
    return listed([*named[:_SHOWN], *more]) or "–"


def flag(text: str) -> Html:
    """Returns a word that calls for a look."""
    return tag("span", text, class_="flag")


def lines(texts: Sequence[str]) -> Html:
    """Returns short texts below one another."""
    return joined(tag("span", text, class_="line") for text in texts) if texts else Html("–")


def timing_words(report: Report) -> str:
    """Returns the seconds of all stages and of each."""
    phrases = [f"{name} {seconds:.2f}" for name, seconds in report.timings.items()]
    return f"{sum(report.timings.values()):.1f} s in {counted(len(phrases), 'stage')}: {', '.join(phrases)}."
