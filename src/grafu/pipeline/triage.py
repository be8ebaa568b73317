"""Which joints of a report need attention: ok, warning or error, as in its verdict. It judges nothing."""

from collections.abc import Collection
from enum import StrEnum
from typing import final

from grafu.dataclass import dataclass
from grafu.pipeline.report_schema import NOT_ADDED, FaultRecord, Report
from grafu.pipeline.verdict import fixed_by_user, parts_without_joint, verdict_of
from grafu.pipeline.words import Colour, FaultKind
from grafu.refusal import Asked


class Level(StrEnum):
    """How a joint turned out."""

    OK = "ok"
    WARNING = "warning"
    ERROR = "error"


_LEVELS = {Colour.GREEN: Level.OK, Colour.YELLOW: Level.WARNING, Colour.RED: Level.ERROR}


@final
@dataclass(frozen=True, slots=True)
class JointState:
    """One door or drawer: the moving part, its joint's id (empty: none was built), its level, and why in words."""

    part: str
    joint: str
    level: Level
    why: str = ""


def joint_states(report: Report) -> tuple[JointState, ...]:
    """Returns the state of every joint that was built, then of the parts that should move and are static.

    What the user fixed is no fault. Levels are the colours of the report's verdict.
    """
    lines = [line for line in verdict_of(report).lines if line.kind is not FaultKind.CARVED]
    joints = {joint.part: joint.id for joint in report.joints}
    joints |= {part: joints.get(part, "") for part in (*parts_without_joint(report), *fixed_by_user(report))}
    asked = set(fixed_by_user(report))
    as_asked = {skip.request: skip.detail for skip in report.skipped if skip.request in asked}
    return tuple(
        _state(part, joint, [line for line in lines if line.part == part], as_asked.get(part, ""))
        for part, joint in joints.items()
    )


def _state(part: str, joint: str, lines: list[FaultRecord], otherwise: str) -> JointState:
    level = max((_LEVELS[line.colour] for line in lines), key=list(Level).index, default=Level.OK)
    said = "; ".join(f"{line.kind}: {line.why}" for line in lines)
    return JointState(part, joint, level, said or otherwise)


def lost(before: Report, after: Report, besides: Collection[str] = ()) -> tuple[str, ...]:
    """Returns for joints that stood before and do not after a change, each part and why, in words.

    `besides` are parts that may lose theirs: the change was about them.
    """
    moving = {joint.part for joint in after.joints} | set(besides)
    gone = (joint.part for joint in before.joints if joint.part not in moving)
    return tuple(_why_not(after, part, "it does not move any more") for part in gone)


def not_built(after: Report, part: str) -> tuple[str, ...]:
    """Returns why a part has no joint, in words; empty where it has one."""
    if part in {joint.part for joint in after.joints}:
        return ()
    return (_why_not(after, part, "its motion is unknown: state a motion, or correct its category"),)


def _why_not(report: Report, part: str, otherwise: str) -> str:
    skips = [skip for skip in report.skipped if skip.request == part]
    first = min(skips, key=lambda skip: skip.reason == NOT_ADDED, default=None)  # of the joint itself
    return f"{part}: {otherwise if first is None else first.detail or str(first.reason)}"


def left_out(report: Report) -> tuple[str, ...]:
    """Returns what was to be added and was not: each with the reason in a sentence, and what was found."""
    skips = (skip for skip in report.skipped if skip.reason == NOT_ADDED or skip.what is Asked.ADDITIONS)
    return tuple(f"{skip.request}: {' '.join(said for said in (skip.sentence, skip.detail) if said)}" for skip in skips)


def newly_skipped(before: Report, after: Report) -> tuple[str, ...]:
    """Returns what was asked for and not built after a change, and was no matter before it: each with the reason."""
    known = {(skip.request, skip.detail) for skip in before.skipped}
    new = (skip for skip in after.skipped if (skip.request, skip.detail) not in known)
    return tuple(f"{skip.request}: {skip.detail or skip.sentence}" for skip in new)
