"""A report in words: what moves, was missing and was added, and axes as people read them. It makes no markup."""

from collections import Counter
from collections.abc import Iterable
from math import acos, degrees

from grafu.additions.step import DeficiencyKind
from grafu.articulation.base import BaseKind
from grafu.articulation.motion_kind import motion_kind
from grafu.pipeline.report_schema import AxisRecord, DeficiencyRecord, JointRecord, Report, Vector
from grafu.pipeline.standing import stability_words
from grafu.pipeline.verdict import fixed_by_user
from grafu.pipeline.words import counted, listed
from grafu.vocabulary import JointType, PartLabel

_MECHANISMS = (DeficiencyKind.HINGE, DeficiencyKind.RAIL, DeficiencyKind.JOINT)
_ADDED_FOR = {
    DeficiencyKind.TOP: PartLabel.TOP_PANEL,
    DeficiencyKind.BACK: PartLabel.BACK_PANEL,
    DeficiencyKind.BOTTOM: PartLabel.BOTTOM_PANEL,
}
_BY_STYLE = (DeficiencyKind.DRAWER_BOX, DeficiencyKind.COMPARTMENT, DeficiencyKind.DOOR_FRAME)
_STRAIGHT = 0.9999  # a direction this near to an axis is called by its name


def facts(report: Report) -> str:
    """Returns what moves, what was missing, and what was added, in a line; whether it is good the verdict states."""
    return " ".join([_moves(report), _lacked(report), _added(report), *_fixed(report)])


def unused_joints(report: Report) -> str:
    """Returns in words that the input states joints that were not read; nothing where there are none."""
    count = report.motion.unused_joints
    them = "it" if count == 1 else "them"
    return f"states {counted(count, 'joint')}; --motion annotation builds {them}" if count else ""


def added(report: Report) -> list[str]:
    """Returns all that was added, by kind: hinges and rails first, then parts; the boards of a drawer's box are one."""
    hinges = sum(joint.count for joint in report.joints if motion_kind(joint.type).turns)
    rails = sum(joint.count for joint in report.joints) - hinges
    boxes = {part.link for part in report.added if part.style == DeficiencyKind.DRAWER_BOX}
    kinds = Counter(part.category for part in report.additions if part.style not in _BY_STYLE)
    hardware = [(hinges, "hinge"), (rails, "rail"), (sum(joint.stays for joint in report.joints), "stay")]
    counts = [*hardware, *((count, kind.value) for kind, count in kinds.items())]
    styles = Counter(part.style for part in report.additions)
    singly = ((styles[kind], kind.value) for kind in _BY_STYLE if kind is not DeficiencyKind.DRAWER_BOX)
    by_style = ((len(boxes), DeficiencyKind.DRAWER_BOX.value), *singly)
    return [counted(count, what) for count, what in (*counts, *by_style) if count]


def remaining_deficiencies(report: Report) -> tuple[DeficiencyRecord, ...]:
    """Returns those of the deficiencies that the result still has; a part that the user fixed lacks nothing."""
    fixed = fixed_by_user(report)
    return tuple(lack for lack in report.deficiencies if lack.part not in fixed and not _mended(lack, report))


def direction_words(direction: Vector) -> str:
    """Returns `+Z` for what runs along an axis, else three numbers."""
    for axis, value in zip("XYZ", direction, strict=True):
        if abs(value) > _STRAIGHT:
            return f"{'+' if value > 0 else '−'}{axis}"
    return "(" + ", ".join(f"{value:.2f}".replace("-", "−") for value in direction) + ")"


def axis_words(axis: AxisRecord, joint_type: JointType) -> str:
    """Returns a line in space: its direction, and for a hinge where it lies, centimetres."""
    if motion_kind(joint_type).slides:
        return f"along {direction_words(axis.direction)}"
    places = zip("xyz", axis.origin, axis.direction, strict=True)
    across = [f"{name} {100 * value:.1f}".replace("-", "−") for name, value, along in places if abs(along) < _STRAIGHT]
    return f"{direction_words(axis.direction)} at {', '.join(across)} cm"


def moved_words(joint: JointRecord) -> str:
    """Returns how far the built axis lies from the stated one: centimetres, degrees."""
    a, b = joint.initial_axis, joint.rectified_axis
    cosine = sum(x * y for x, y in zip(a.direction, b.direction, strict=True))
    turned = degrees(acos(min(max(cosine, -1.0), 1.0)))
    offset = [y - x for x, y in zip(a.origin, b.origin, strict=True)]
    along = sum(x * y for x, y in zip(offset, b.direction, strict=True))
    distance = sum((x - along * y) ** 2 for x, y in zip(offset, b.direction, strict=True)) ** 0.5
    phrases = [f"{100 * distance:.1f} cm"] if motion_kind(joint.type).turns else []
    return ", ".join([*phrases, f"{turned:.1f}°"] if turned > 0.05 or not phrases else phrases)


def size_words(size: Iterable[float]) -> str:
    """Returns width, depth and height in centimetres."""
    return " × ".join(f"{100 * side:.0f}" for side in size) + " cm"


def _moves(report: Report) -> str:
    kinds = [motion_kind(joint.type) for joint in report.joints if not joint.small]
    turning, sliding = sum(kind.turns for kind in kinds), sum(kind.slides for kind in kinds)
    small = sum(joint.small for joint in report.joints)
    phrases = [f"{counted(turning, 'part')} on hinges"] if turning else []
    phrases += [f"{sliding} on rails" if turning else f"{counted(sliding, 'part')} on rails"] if sliding else []
    phrases += [counted(small, "small part")] if small else []
    if not phrases:
        return "Nothing moves."
    return f"{listed(phrases)} {'moves' if turning + sliding + small == 1 else 'move'}."


def _lacked(report: Report) -> str:
    kinds = Counter(lack.kind for lack in report.deficiencies)
    mechanisms = {lack.part for lack in report.deficiencies if lack.kind in _MECHANISMS}
    what = "joints and hardware" if kinds[DeficiencyKind.JOINT] else "hardware"
    phrases = [f"{what} for {counted(len(mechanisms), 'part')}"] if mechanisms else []
    phrases += [_lacked_words(kind, count) for kind, count in kinds.items() if kind not in _MECHANISMS]
    return f"Missing in the input: {listed(phrases)}." if phrases else "Nothing was missing in the input."


def _lacked_words(kind: DeficiencyKind, count: int) -> str:
    return f"the category of {counted(count, 'part')}" if kind is DeficiencyKind.LABEL else counted(count, kind.value)


def _added(report: Report) -> str:
    phrases = added(report)
    return f"Added: {listed(phrases)}." if phrases else "Nothing was added."


def _fixed(report: Report) -> list[str]:
    fixed = fixed_by_user(report)
    return [f"Fixed by the user: {listed(fixed)}."] if fixed else []


def _mended(lack: DeficiencyRecord, report: Report) -> bool:
    joint = next((joint for joint in report.joints if joint.part == lack.part), None)
    if lack.kind in _MECHANISMS:
        return joint is not None
    if lack.kind is DeficiencyKind.HANDLE:
        return joint is not None and joint.grasp != "none"
    if lack.kind is DeficiencyKind.LABEL:
        part = next((part for part in report.parts if part.id == lack.part), None)
        return part is not None and part.category is not PartLabel.UNKNOWN
    if lack.kind is DeficiencyKind.DRAWER_BOX:
        return any(a.link == lack.part and a.category is not PartLabel.HANDLE for a in report.added)
    if lack.kind in _BY_STYLE:
        return any(a.style == lack.kind for a in report.additions)
    return any(added.category is _ADDED_FOR[lack.kind] for added in report.added)


_HELD = {
    BaseKind.FREE: "It stands freely on the floor",
    BaseKind.FIXED: "It is fixed to the world",
    BaseKind.WALL: "It is fixed to a wall",
}


def standing_words(report: Report) -> list[str]:
    """Returns what holds the piece and why, and what tips it over; nothing of reports that do not state it."""
    if report.base is None:
        return []
    held = f"{_HELD[report.base.kind]} ({report.base.why})."
    found = report.base.stability
    if found is None or report.base.kind is BaseKind.WALL:
        return [held]
    words = stability_words(found)
    return [held, f"On its own feet: {words}."]


def catch_words(report: Report) -> list[str]:
    """Returns how many joints have catches and which files do; nothing where there are none."""
    if report.caught is None:
        return []
    kinds = Counter(joint.kind for joint in report.caught.joints)
    said = ", ".join(f"{counted(count, 'joint')} {kind}" for kind, count in kinds.items())
    places = f"in {listed(report.caught.files)}" if report.caught.files else "in no file that was written"
    lost = f"; {listed(report.caught.files_without)} cannot hold them" if report.caught.files_without else ""
    return [f"Catches: {said}, {places}{lost}."]
