"""Which joints of a report need somebody's eye: ok, warning or error, and why. It measures nothing anew."""

from collections.abc import Collection
from dataclasses import dataclass
from enum import StrEnum
from typing import final

from grafu.pipeline.report_schema import JointRecord, Report, SkippedRecord
from grafu.realization.report import SkipReason
from grafu.vocabulary import PartLabel

_GAP = 0.005  # of the unit cube: the paper's threshold beyond which a part has come loose


class Level(StrEnum):
    """How a joint turned out."""

    OK = "ok"
    WARNING = "warning"
    ERROR = "error"


@final
@dataclass(frozen=True, slots=True)
class JointState:
    """One door or drawer: the moving part, its joint's id (empty: none was built), its level, and why in words."""

    part: str
    joint: str
    level: Level
    why: str = ""


def joint_states(report: Report, unit: float = 1.0) -> tuple[JointState, ...]:
    """Returns the state of every joint that was built, then of those that could not be.

    `unit` is the object's largest side in metres: gaps count against it.
    """
    built = tuple(_state(joint, unit) for joint in report.joints)
    known = {part.id: part.category for part in report.parts}
    failed = (skip for skip in report.skipped if skip.request in known and skip.reason is not SkipReason.NOT_ADDED)
    missing = {skip.request: _not_built(skip) for skip in failed}
    silent = (name for name, label in known.items() if PartLabel(label).is_movable)
    moving = {joint.part for joint in report.joints}
    still = [
        JointState(name, "", Level.ERROR, "it has no joint") for name in silent if name not in moving | missing.keys()
    ]
    riding = {part.id for part in report.parts if part.link in moving}
    return (*built, *missing.values(), *(state for state in still if state.part not in riding))


def _not_built(skip: SkippedRecord) -> JointState:
    level = Level.OK if skip.reason is SkipReason.REJECTED else Level.ERROR
    return JointState(skip.request, "", level, f"{skip.reason}: {skip.detail}")


def _state(joint: JointRecord, unit: float) -> JointState:
    wrong = []
    if joint.collision_share > 0:
        wrong.append(f"collides in {100 * joint.collision_share:.0f} % of poses")
    if joint.largest_gap > _GAP * unit:
        wrong.append(f"comes loose by {1000 * joint.largest_gap:.1f} mm")
    level = Level.ERROR if wrong else Level.OK
    minor = []
    if joint.restricted:
        minor.append("opens less than 70 % of what was asked for")
    if joint.grasp == "none":
        minor.append("nothing to grasp it by")
    minor += joint.notes
    if minor and level is Level.OK:
        level = Level.WARNING
    return JointState(joint.part, joint.id, level, "; ".join((*wrong, *minor)))


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
    return (_why_not(after, part, "nobody says how it moves: state a motion, or correct its category"),)


def _why_not(report: Report, part: str, otherwise: str) -> str:
    skips = [skip for skip in report.skipped if skip.request == part]
    first = min(skips, key=lambda skip: skip.reason is SkipReason.NOT_ADDED, default=None)  # of the joint itself
    return f"{part}: {otherwise if first is None else first.detail or first.reason.value}"


def newly_skipped(before: Report, after: Report) -> tuple[str, ...]:
    """Returns what was asked for and not built after a change, and was no matter before it: each with the reason."""
    known = {(skip.request, skip.detail) for skip in before.skipped}
    return tuple(f"{s.request}: {s.detail}" for s in after.skipped if (s.request, s.detail) not in known)
