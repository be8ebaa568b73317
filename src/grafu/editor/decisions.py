"""What is decided by hand, as lines of `decisions.jsonl`: what was predicted, with its score, and what was chosen."""

import json
import os
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any, final

from grafu.dataclass import dataclass
from grafu.errors import ExportError
from grafu.joints.motion_choice import MotionChoice, Moves, Side, choice_in_words
from grafu.pipeline.decisions import Key
from grafu.pipeline.report_schema import Report
from grafu.pipeline.settings import Settings
from grafu.version import __version__
from grafu.vocabulary import MOTION_WORDS

_WORDS = {choice_in_words(word): word for word in reversed(MOTION_WORDS)}


@final
@dataclass(frozen=True)
class Prediction:
    """What was predicted of a part: the answer, and its score (0..1; None: it has none)."""

    choice: str
    score: float | None = None


def word_of(choice: MotionChoice) -> str:
    """Returns the word that states a motion; one that opens inwards has the word of its side."""
    is_pull = choice.moves is Moves.SLIDES and choice.side is Side.FRONT
    outwards = MotionChoice(choice.moves, None if is_pull else choice.side)
    return _WORDS.get(outwards, str(choice.moves) if choice.side is None else f"{choice.moves}-{choice.side}")


def decided(settings: Settings) -> dict[Key, Any]:
    """Returns what the settings decide, by part and question, as JSON values."""
    found: dict[Key, Any] = {(part, "motion"): word_of(choice) for part, choice in settings.motions.items()}
    for change in settings.regrouped:
        host, others = change.parts[0], list(change.parts[1:])
        found[host, str(change.do)] = [*found.get((host, str(change.do)), []), *others] if others else True
    found |= {(part, "label"): str(label) for part, label in settings.labels.items()}
    for part, joint in settings.joints.items():
        found |= {(part, "opening"): joint.opening} if joint.opening is not None else {}
        found |= {(part, "template"): joint.template} if joint.template else {}
    for part, handle in settings.additions.fronts.items():
        found[part, "handle"] = {**asdict(handle), "offset": list(handle.offset)}
    found |= {(part, "addition"): "left out" for part in settings.additions.rejected}
    return found


def predictions_of(report: Report, motions: Mapping[str, MotionChoice]) -> dict[Key, Prediction]:
    """Returns what a build predicts of the parts: how they move, with the least score of what that rests on."""
    scores: dict[str, float] = {}
    for guess in report.guesses:
        if guess.question != "label":
            scores[guess.part] = min(guess.score, scores.get(guess.part, 1.0))
    labels = {guess.part: guess.score for guess in report.guesses if guess.question == "label"}
    found = {(part, "motion"): Prediction(word_of(choice), scores.get(part)) for part, choice in motions.items()}
    found |= {
        (part.id, "label"): Prediction(str(part.category), labels.get(part.id))
        for part in report.parts
        if part.labelled_by != "user"
    }
    found |= {(joint.part, "opening"): Prediction(_opening(joint.opening)) for joint in report.joints}
    return found | {(joint.part, "template"): Prediction(joint.template) for joint in report.joints}


def _opening(value: float) -> str:
    return f"{value:.4f}"


def decision_lines(
    model: str, before: Mapping[Key, Any], after: Mapping[Key, Any], predictions: Mapping[Key, Prediction]
) -> list[dict[str, Any]]:
    """Returns a record for everything that is decided otherwise than before, in the order of parts and questions."""
    keys = sorted(key for key in {*before, *after} if before.get(key) != after.get(key))
    return [_record(model, key, after.get(key), predictions.get(key)) for key in keys]


def _record(model: str, key: Key, chosen: Any, prediction: Prediction | None) -> dict[str, Any]:
    part, question = key
    predicted = None if prediction is None else asdict(prediction)
    said = {"model": model, "part": part, "question": question, "predicted": predicted, "chosen": chosen}
    return {**said, "version": __version__}


def append_lines(path: Path, records: list[dict[str, Any]]) -> None:
    """Appends records to a file, all of them by one write, and has the disk keep them.

    Raises:
        ExportError: if the file cannot be written.
    """
    if not records:
        return
    text = "".join(json.dumps(record, ensure_ascii=True) + "\n" for record in records)
    try:
        with open(path, "ab") as stream:
            stream.write(text.encode())
            stream.flush()
            os.fsync(stream.fileno())
    except OSError as error:
        raise ExportError(f"cannot write the decisions `{path}`: {error.strerror or type(error).__name__}") from error
