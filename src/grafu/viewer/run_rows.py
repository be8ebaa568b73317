"""The reports of a run as the table of its page: one row per input, and the figures of all. It reads no files."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

from grafu.pipeline.report_schema import JointRecord, Report
from grafu.viewer.run_table import Cell, Column, Figure, Run, RunRow, RunTable
from grafu.viewer.wording import listed, not_built, still_lacking
from grafu.vocabulary import JointType

_COLUMNS = (
    Column("model"),
    Column("to look at"),
    Column("doors", "number", about="joints that turn"),
    Column("drawers", "number", about="joints that slide"),
    Column("skipped", "number", about="requests that could not be built"),
    Column("restricted", "number", about="joints that open less than 70 % of what was asked for"),
    Column("collision", "percent", histogram=True, about="the worst joint's share of poses that cut into something"),
    Column("gap, mm", "number", histogram=True, about="the widest gap between a link and what carries it"),
    Column("no grasp", "number", about="joints that nobody could take hold of"),
    Column("added", "number", histogram=True, about="parts that the input did not have"),
    Column("seconds", "seconds", histogram=True, about="from reading to writing"),
)
# What is worse comes first, whatever the numbers below it are.
_FAILED, _SKIPPED, _COLLIDES, _RESTRICTED, _NO_GRASP = 1e9, 1e6, 1e4, 1e2, 1.0


@final
@dataclass(frozen=True)
class RunEntry:
    """One input of a run: its report, or why there is none; its page's relative address, a small picture, seconds."""

    name: str
    report: Report | None
    failure: str = ""
    link: str = ""
    picture: bytes = b""
    seconds: float | None = None


def functionalized_run(title: str, entries: Sequence[RunEntry]) -> Run:
    """Returns the page's content for a run of `functionalize`."""
    rows = tuple(_row(entry) for entry in entries)
    table = RunTable("Models", _COLUMNS, rows, "Worst first; a heading sorts by its column.")
    return Run(title, _figures(entries), (table,))


def _row(entry: RunEntry) -> RunRow:
    if entry.report is None:
        unknown: list[Cell] = [None] * (len(_COLUMNS) - 2)
        return RunRow((entry.name, f"failed: {entry.failure}", *unknown), _FAILED, flagged=True)
    report, joints = entry.report, entry.report.joints
    turning = sum(joint.type is JointType.REVOLUTE for joint in joints)
    restricted, loose = sum(joint.restricted for joint in joints), sum(joint.grasp == "none" for joint in joints)
    collision = max((joint.collision_share for joint in joints), default=None)
    gap = max((1000 * joint.largest_gap for joint in joints), default=None)
    badness = _SKIPPED * len(not_built(report)) + _COLLIDES * sum(joint.collision_share for joint in joints)
    badness += _RESTRICTED * restricted + _NO_GRASP * loose
    cells: tuple[Cell, ...] = (
        entry.name,
        _to_look_at(report),
        turning,
        len(joints) - turning,
        len(not_built(report)),
        restricted,
        collision,
        gap,
        loose,
        len(report.added),
        entry.seconds,
    )
    return RunRow(cells, badness, entry.link, entry.picture, flagged=badness > 0)


def _to_look_at(report: Report) -> str:
    def named(what: str, joints: list[JointRecord]) -> list[str]:
        return [f"{what}: {listed(joint.part for joint in joints)}"] if joints else []

    said = [f"skipped {skip.request} ({skip.reason})" for skip in not_built(report)]
    said += named("collides", [j for j in report.joints if j.collision_share > 0])
    said += named("restricted", [j for j in report.joints if j.restricted])
    said += named("no grasp", [j for j in report.joints if j.grasp == "none"])
    lacking = {lack.kind.value for lack in still_lacking(report)} - {"handle", "hinge", "rail", "joint"}
    said += [f"still without {listed(sorted(lacking))}"] if lacking else []
    return "; ".join(said) or ("" if report.joints else "nothing moves")


def _figures(entries: Sequence[RunEntry]) -> list[Figure]:
    reports = [entry.report for entry in entries if entry.report is not None]
    failed, joints = len(entries) - len(reports), [joint for report in reports for joint in report.joints]
    skipped = sum(len(not_built(report)) for report in reports)
    colliding, restricted = sum(j.collision_share > 0 for j in joints), sum(j.restricted for j in joints)
    return [
        Figure(str(len(reports)), "model done" if len(reports) == 1 else "models done"),
        Figure(str(failed), "failed", failed > 0),
        Figure(str(len(joints)), "joint built" if len(joints) == 1 else "joints built"),
        Figure(str(skipped), "skipped", skipped > 0),
        Figure(str(colliding), "joints that collide", colliding > 0),
        Figure(str(restricted), "joints that are restricted", restricted > 0),
        Figure(str(sum(len(report.added) for report in reports)), "parts added"),
    ]
