"""Results that were gone through in `grafu edit`: what was decided by hand is the truth. It measures nothing.

The truth is of the parts whose motion was decided, and of no others. What folds or is lifted on arms has no joint of
one line and is left out; so is what was fixed, which no joint stands for.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from grafu.asset.load import load_asset
from grafu.asset.part import AnnotatedJoint, Asset
from grafu.asset.regrouping import regrouped
from grafu.errors import FunctionalizationError, UnreadableAsset
from grafu.evaluation.moving_parts import usual_opening
from grafu.joints.motion_choice import MotionChoice, Moves, axis_of_motion, choice_in_words
from grafu.pipeline.decisions import DECISIONS, Key, decided_before
from grafu.pipeline.motion_choices import corrected, with_moving
from grafu.pipeline.result_folder import REPORT, SETTINGS, read_choices
from grafu.vocabulary import MOTION_WORDS, PartLabel

_OF_ONE_LINE: Final = (Moves.TURNS, Moves.SLIDES, Moves.TILTS)


def is_decided(folder: Path) -> bool:
    """Whether a folder holds a result with decisions made by hand."""
    return (folder / DECISIONS).is_file() and (folder / REPORT).is_file()


def files_of_decided(folder: Path) -> tuple[Path, ...]:
    """Returns the files that a decided model is read from: decisions, settings, and the input where it is there."""
    own = (folder / DECISIONS, folder / SETTINGS)
    try:
        return (*own, read_choices(folder)[2])
    except FunctionalizationError:
        return own


def read_decided(folder: Path) -> Asset:
    """Returns the input of a result, its parts joined, split and labelled as was decided; its joints are the decisions.

    Raises:
        AssetError: if the input is gone or cannot be read, or a decision is damaged or of a part that is not there.
        OptionError: if the settings are damaged.
    """
    _, settings, source = read_choices(folder)
    asset = regrouped(load_asset(source, settings.reading), settings.regrouped)
    decisions = decided_before(folder / DECISIONS, folder.resolve().name)
    try:
        labels = {part: PartLabel(value) for part, value in _answers(decisions, "label").items()}
        words = _answers(decisions, "motion")
        motions = {part: settings.motions.get(part) or _motion(word) for part, word in words.items()}
        seen = with_moving(corrected(asset.without_annotation(), labels), motions, labels)
        openings = _answers(decisions, "opening")
        lines = {part: choice for part, choice in motions.items() if choice.moves in _OF_ONE_LINE}
        joints = tuple(_joint(part, choice, seen, openings.get(part)) for part, choice in lines.items())
    except (ValueError, FunctionalizationError) as error:
        raise UnreadableAsset(f"{folder / DECISIONS} cannot be the truth of {source}: {error}") from None
    return Asset(seen.name, seen.path, seen.kind, seen.parts, seen.frame, joints, seen.notes)


def _answers(decisions: Mapping[Key, Any], question: str) -> dict[str, Any]:
    return {part: value for (part, asked), value in decisions.items() if asked == question}


def _motion(word: object) -> MotionChoice:
    if word not in MOTION_WORDS:
        raise ValueError(f"a motion must be one of {', '.join(MOTION_WORDS)}: got {word!r}")
    return choice_in_words(str(word))


def _joint(part: str, choice: MotionChoice, asset: Asset, opening: object) -> AnnotatedJoint:
    """Returns the decided motion as a joint; it ends where it was decided, else where parts usually end."""
    axis = axis_of_motion(asset.part(part), choice, asset.box)
    if opening is not None and not (isinstance(opening, float | int) and 0 < opening < float("inf")):
        raise ValueError(f"an opening must be a number above 0: got {opening!r}")
    usual = usual_opening(choice.type, axis, asset.part(part).box)
    upper = usual if opening is None else float(opening)
    return AnnotatedJoint(part, choice.type, axis, 0.0, upper, limited=opening is not None)
