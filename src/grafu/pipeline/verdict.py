"""The verdict on a result: green, yellow or red, with its reasons, as all pages and lists show it.

It reads the figures of a report and measures nothing. A part that the user fixed is no fault.
"""

from collections import Counter
from collections.abc import Iterator
from math import prod
from typing import final

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.reading import tells_of_lost_mesh
from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.joints.motion_choice import TURNING_SIDES
from grafu.pipeline.report_schema import (
    NOT_ADDED,
    FaultRecord,
    GuessRecord,
    JointRecord,
    Report,
    SkippedRecord,
    VerdictRecord,
)
from grafu.pipeline.words import Colour, FaultKind, counted, listed, percent
from grafu.refusal import OF_GUESSES, Reason
from grafu.vocabulary import PartLabel

_NAMED = 4  # parts that a sentence names
_FRONTS = ("door", "sliding door", "drawer", "small part")


@final
@dataclass(frozen=True)
class VerdictConfig:
    """From where on something is a fault. All pages and lists use the defaults, so that they agree.

    Raises:
        ValueError: if a fraction is not between 0 and 1, or a length is not positive.
    """

    least_confidence: float = 0.8
    """A decision with a lower score is a guess that the user should check."""
    least_opening: float = 0.7
    """A joint that opens less than this fraction of what it should is restricted ..."""
    least_motion: float = 0.3
    """... and below this fraction it does not open."""
    most_carved: float = 0.05
    """A part that lost more than this fraction, of what is seen of it or of its volume, is carved too much."""
    most_gap: float = 0.005
    """A part comes loose where the gap to what carries it is wider than this fraction of the object's largest side."""
    tallest: float = 6.0
    """What is higher stands in no room (m): the unit of a stated height or scale may be wrong ..."""
    smallest: float = 0.05
    """... and so where the largest side is shorter than this (m)."""

    def __post_init__(self) -> None:
        lengths = ("tallest", "smallest")
        require_ratios(self, *(name for name in self.__dataclass_fields__ if name not in lengths))
        require_positive(self, *lengths)


def verdict_of(report: Report, config: VerdictConfig = VerdictConfig()) -> VerdictRecord:
    """Returns the verdict on a report: the colour of its worst fault, and green without any."""
    faults = tuple(sorted(_faults(report, config), key=lambda fault: fault.colour is not Colour.RED))
    colours = {fault.colour for fault in faults}
    worst = next((colour for colour in (Colour.RED, Colour.YELLOW) if colour in colours), Colour.GREEN)
    return VerdictRecord(
        colour=worst,
        sentence=_sentence(report, faults),
        lines=faults,
        least_confidence=config.least_confidence,
        least_opening=config.least_opening,
        most_carved=config.most_carved,
    )


def with_notes(report: Report, *notes: str) -> Report:
    """Returns a report with more notes of what was done in a simpler way, or left out, and the verdict on all."""
    noted = report.with_changes(notes=(*report.notes, *notes))
    return noted.with_changes(verdict=verdict_of(noted)) if notes else report


def not_built(report: Report) -> tuple[SkippedRecord, ...]:
    """Returns what was asked for and could not be built; what the user fixed is no fault."""
    return tuple(skip for skip in report.skipped if skip.reason is not Reason.REJECTED)


def fixed_by_user(report: Report) -> tuple[str, ...]:
    """Returns the parts that are static because the user fixed them."""
    return tuple(skip.request for skip in report.skipped if skip.reason is Reason.REJECTED)


def reason_of(report: Report, fault: FaultRecord) -> str:
    """Returns the reason for something that was not built, in a plain sentence; empty where the report states none."""
    told = (skip for skip in report.skipped if skip.request == fault.part and skip.detail in fault.why)
    return next((skip.sentence for skip in told), "")


def parts_without_joint(report: Report) -> dict[str, str]:
    """Returns the parts that should move and do not, and why: doors and drawers, and others that were to move."""
    category = {part.id: part.category for part in report.parts}
    moving = {joint.part for joint in report.joints}
    carried = {part.id for part in report.parts if part.link in moving}
    fronts = [p.id for p in report.parts if p.category.is_movable and p.link]
    wanted = {
        skip.request: f"{skip.reason}: {skip.detail}" if skip.detail else str(skip.reason)
        for skip in reversed(not_built(report))
        if _is_motion(skip) and category.get(skip.request, PartLabel.HANDLE) is not PartLabel.HANDLE
        if skip.reason not in OF_GUESSES
    }
    without = dict.fromkeys(fronts, "it has no joint") | wanted
    answered = moving | carried | set(fixed_by_user(report))
    return {part: why for part, why in without.items() if part not in answered}


def _faults(report: Report, config: VerdictConfig) -> Iterator[FaultRecord]:
    without = parts_without_joint(report)
    yield from (_fault(report, part, FaultKind.NO_JOINT, why) for part, why in without.items())
    for joint in report.joints:
        yield from _faults_of(joint, report, config)
    told = {*without, *(skip.request for skip in report.skipped if skip.reason in OF_GUESSES)}
    yield from (_guessed(guess, report, config) for guess in _unsure(report, config) if guess.part not in told)
    yield from _carved(report, config)
    for skip in not_built(report):
        if not (_is_motion(skip) and skip.request in without):
            yield _fault(report, skip.request, FaultKind.NOT_BUILT, skip.detail or skip.sentence or str(skip.reason))
    yield from _sized(report, config)
    lost = (note for note in report.input.notes if tells_of_lost_mesh(note))
    yield from (_fault(report, "", FaultKind.NOTED, note, "") for note in (*report.notes, *lost))
    if not (report.joints or without or fixed_by_user(report)):
        yield _fault(report, "", FaultKind.NOTHING_MOVES, "no part is a door or a drawer")


def _sized(report: Report, config: VerdictConfig) -> Iterator[FaultRecord]:
    """Yields what is wrong with the size, where no furniture has it."""
    if report.size and (report.size[2] > config.tallest or max(report.size) < config.smallest):
        why = f"it is {report.size[2]:.4g} m high: if that is wrong, state the height with its unit, such as 72cm"
        yield _fault(report, "", FaultKind.NOTED, why, "--height")


def _is_motion(skip: SkippedRecord) -> bool:
    """Whether a skip is of a part's motion, not of something that was to be added to it."""
    return skip.reason != NOT_ADDED


def _fault(report: Report, part: str, kind: FaultKind, why: str, option: str | None = None) -> FaultRecord:
    said = next(iter(report.moves.get(part, ())), "") if option is None else option
    return FaultRecord(part=part, kind=kind, colour=kind.colour, why=why, option=said)


def _faults_of(joint: JointRecord, report: Report, config: VerdictConfig) -> Iterator[FaultRecord]:
    if joint.collision_share > 0:
        yield _fault(report, joint.part, FaultKind.COLLIDES, f"in {percent(joint.collision_share)} of its poses")
    if joint.largest_gap > config.most_gap * max(report.size or (1.0,)):
        yield _fault(report, joint.part, FaultKind.LOOSE, f"by {1000 * joint.largest_gap:.1f} mm")
    yield from _short(joint, report, config)
    if joint.grasp == "none":
        yield _fault(report, joint.part, FaultKind.NO_GRASP, "it has no handle, grip or free edge", "")
    yield from (_fault(report, joint.part, FaultKind.NOTED, note, "") for note in joint.notes)


def _short(joint: JointRecord, report: Report, config: VerdictConfig) -> Iterator[FaultRecord]:
    ratio = joint.opening / joint.wanted if joint.wanted else 1.0
    said = f"it opens by {motion_kind(joint.type).worded(joint.opening)}"
    if joint.wanted:
        said += f" of {motion_kind(joint.type).worded(joint.wanted)}"
    if ratio < config.least_motion or joint.opening <= 0:
        yield _fault(report, joint.part, FaultKind.SHUT, said)
    elif ratio < config.least_opening or joint.restricted:
        yield _fault(report, joint.part, FaultKind.RESTRICTED, said)


def _unsure(report: Report, config: VerdictConfig) -> Iterator[GuessRecord]:
    """Yields for each part the least sure of the decisions that its motion rests on, where it is not sure enough."""
    unsure = sorted((g for g in report.guesses if g.score < config.least_confidence), key=lambda g: g.score)
    yield from {guess.part: guess for guess in reversed(unsure)}.values()


def _guessed(guess: GuessRecord, report: Report, config: VerdictConfig) -> FaultRecord:
    what = {"label": "category", "border": "hinge side", "sign": "opening direction"}
    sure = f"confidence {percent(guess.score)}, below {percent(config.least_confidence)}"
    other = f"; {guess.runner_up}: {percent(guess.runner_up_score)}" if guess.runner_up else ""
    why = f"{what.get(guess.question, 'slide direction')} {guess.choice}: {sure}{other}"
    is_side = guess.question == "border" and guess.runner_up in TURNING_SIDES and guess.part in report.moves
    option = f"--move {guess.part}={guess.runner_up}" if is_side else None  # the next likeliest, not the other side
    return _fault(report, guess.part, FaultKind.GUESSED, why, option)


def _carved(report: Report, config: VerdictConfig) -> Iterator[FaultRecord]:
    """Yields the parts of which more went, for all joints together, than should."""
    cuts = [cut for joint in report.joints for cut in joint.clearances if cut.kind == "carved"]
    for part in dict.fromkeys(cut.part for cut in cuts):
        of_part = [cut for cut in cuts if cut.part == part]
        lost = 1.0 - prod(1.0 - cut.share for cut in of_part)
        if lost > config.most_carved:
            by = ", ".join(dict.fromkeys(cut.why for cut in of_part))
            yield _fault(report, part, FaultKind.CARVED, f"{percent(lost)} of it was cut away: {by}", "--no-trim")


def _sentence(report: Report, faults: tuple[FaultRecord, ...]) -> str:
    """Returns one sentence that states the same as the faults: what works, what to look at, or what does not work."""
    fronts = _fronts_words(report)
    if not fronts:
        why = "the user fixed all parts" if fixed_by_user(report) else "no part is a door or a drawer"
        return f"Nothing moves: {why}."
    if not faults:
        return f"Everything works: {fronts}; nothing collides, nothing comes loose."
    red = tuple(fault for fault in faults if fault.colour is Colour.RED)
    if red:
        return f"Does not work: {_names(red)}, of {fronts}."
    return f"Works, but check {_names(faults)}."


def _names(faults: tuple[FaultRecord, ...]) -> str:
    """Returns the parts, each with its faults: the first few, and how many more."""
    kinds: dict[str, list[str]] = {}
    for fault in faults:
        kinds.setdefault(fault.part or "the whole", []).append(fault.kind.value)
    said = [f"{part} ({', '.join(dict.fromkeys(words))})" for part, words in kinds.items()]
    more = [f"{len(said) - _NAMED} more"] if len(said) > _NAMED else []
    return listed([*said[:_NAMED], *more])


def _fronts_words(report: Report) -> str:
    """Returns how many doors, sliding doors, drawers and small parts should move; empty where there is none."""
    category = {part.id: part.category for part in report.parts}
    kinds = [
        "small part" if joint.small else _front_word(category.get(joint.part), motion_kind(joint.type).slides)
        for joint in report.joints
        if joint.small or joint.is_front
    ]
    kinds += ["drawer" if category.get(part) is PartLabel.DRAWER else "door" for part in parts_without_joint(report)]
    counts = Counter(kinds)
    return listed(counted(counts[kind], kind) for kind in _FRONTS if counts[kind])


def _front_word(category: PartLabel | None, slides: bool) -> str:
    if slides:
        return "sliding door" if category is PartLabel.DOOR else "drawer"
    return "door"
