"""The tables of a model's page, drawn from its report: joints, what was added, skipped, missing. It decides nothing."""

from collections import Counter
from collections.abc import Mapping, Sequence
from types import MappingProxyType

from grafu.graph.completion import GraphCompletion
from grafu.pipeline.report_schema import ClearanceRecord, JointRecord, Report
from grafu.viewer.certainty import certainty_words
from grafu.viewer.corrections import correction_buttons
from grafu.viewer.markup import Html, joined, tag
from grafu.viewer.wording import axis_words, counted, listed, moved_words, opening, still_lacking
from grafu.vocabulary import JointType

_SHOWN = 6  # ids in a cell; more of them are counted
_LEAST = 5e-4  # a share that is not written as 0.0 %


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
    columns: tuple[str, ...] = ("part", "moves", "mechanism", "axis", "measured", "how sure", "notes")
    rows = [_joint_row(joint, completion) for joint in report.joints]
    if corrections:
        columns = (*columns, "if it is wrong")
        rows = [
            (*row, correction_buttons(corrections.get(joint.part, ())))
            for row, joint in zip(rows, report.joints, strict=True)
        ]
    return plain_rows(columns, rows, "Joints") if rows else tag("p", "Nothing moves.", class_="none")


def added_table(report: Report) -> Html:
    """Returns one row per added part."""
    rows = [(part_button(a.part), a.category, a.why, a.style, a.link) for a in report.added]
    columns = ("part", "category", "why", "style", "moves with")
    return plain_rows(columns, rows, "Added parts") if rows else tag("p", "Nothing was added.", class_="none")


def skipped_table(report: Report) -> Html:
    """Returns one row per request that was not built."""
    rows = [(s.request, s.reason, s.detail) for s in report.skipped]
    columns = ("request", "reason", "in words")
    return plain_rows(columns, rows, "Skipped") if rows else tag("p", "Nothing was skipped.", class_="none")


def lacks_table(report: Report) -> Html:
    """Returns one row per kind of thing that was missing: how often before, how often still."""
    before = Counter(lack.kind for lack in report.deficiencies)
    left = still_lacking(report)
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
    word = "hinge" if joint.type is JointType.REVOLUTE else "rail"
    reach = f"{opening(joint.type, joint.lower)} to {opening(joint.type, joint.upper)}"
    moves = [tag("span", word, class_=f"kind {joint.type.value}"), reach]
    return (
        part_button(joint.part),
        lines([*moves, flag("restricted")] if joint.restricted else moves),
        lines([f"{joint.count} × {joint.template}", f"class {joint.mechanism}", f"on {joint.mount}"]),
        lines([
            f"stated {axis_words(joint.initial_axis, joint.type)} ({joint.motion_source})",
            f"built {axis_words(joint.rectified_axis, joint.type)}",
            f"moved {moved_words(joint)}",
        ]),
        lines(_measured(joint)),
        lines(certainty_words(completion, joint.part) or ["stated, not guessed"]),
        lines(_notes(joint)),
    )  # fmt: skip


def _measured(joint: JointRecord) -> list[str]:
    collision = f"collision {joint.collision_share:.0%}"
    grasp = "no grasp" if joint.grasp == "none" else f"grasp: {joint.grasp}"
    return [
        flag(collision) if joint.collision_share > 0 else collision,
        f"gap {1000 * joint.largest_gap:.1f} mm",
        flag(grasp) if joint.grasp == "none" else grasp,
    ]


def _notes(joint: JointRecord) -> list[str]:
    waits = [f"opens after {listed(joint.after)}"] if joint.after else []
    return [*waits, *(_clearance(cut) for cut in joint.clearances), *joint.notes]


def _clearance(cut: ClearanceRecord) -> str:
    """Returns what was taken away: as a depth where material was pressed back, else as a share."""
    share = f", {cut.share:.1%} of it" if cut.share >= _LEAST else ", a trace"
    amount = {"trimmed": f" by {1000 * cut.amount:.1f} mm", "joined": "", "closed": ""}
    return f"{cut.part} {cut.kind}{amount.get(cut.kind, share)}: {cut.why}"


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
    told = [f"{name} {seconds:.2f}" for name, seconds in report.timings.items()]
    return f"{sum(report.timings.values()):.1f} s in {counted(len(told), 'stage')}: {', '.join(told)}."
