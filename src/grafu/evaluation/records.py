"""The form of a line of `rows.jsonl`, as checked values: what one task found out; and the file. It measures nothing.

Lengths are metres, angles radians, points and directions in the object frame. A line of the file is whole or ignored;
the last of a key counts.
"""

import os
from collections.abc import Iterable, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, FiniteFloat, ValidationError

from grafu.asset.json_files import read_own
from grafu.errors import AssetError, ExportError
from grafu.evaluation.completeness import Completeness
from grafu.evaluation.llm.chat import Usage
from grafu.evaluation.measures import PartMeasure
from grafu.evaluation.moving_parts import MovingPart
from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.axis import Axis
from grafu.metrics.motion import Motion
from grafu.vocabulary import JointType, PartLabel

Vector = tuple[FiniteFloat, FiniteFloat, FiniteFloat]


class EvaluationRecord(BaseModel):
    """Abstract base: frozen, and strict about unknown fields."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class EvaluatedMotion(EvaluationRecord):
    """A motion: positive along or about the axis opens."""

    type: JointType
    point: Vector
    direction: Vector
    center: Vector
    both_ways: bool = False

    @classmethod
    def of(cls, motion: Motion) -> "EvaluatedMotion":
        """Returns the record of a motion."""
        axis = motion.axis
        ends = _vector(axis.point), _vector(axis.direction), _vector(motion.center)
        return cls(type=motion.type, point=ends[0], direction=ends[1], center=ends[2], both_ways=motion.both_ways)

    def motion(self) -> Motion:
        """Returns the motion."""
        axis = Axis(vec3(*self.point), vec3(*self.direction))
        return Motion(self.type, axis, vec3(*self.center), self.both_ways)


class MeasureRecord(EvaluationRecord):
    """What was measured on one part of one result (see `PartMeasure`); null where it is static."""

    found: EvaluatedMotion | None
    aligned: bool
    collision: FiniteFloat | None
    touch: FiniteFloat | None
    gap: FiniteFloat | None
    opening: FiniteFloat
    connected: bool
    works: bool

    @classmethod
    def of(cls, measure: PartMeasure) -> "MeasureRecord":
        """Returns the record of a measure."""
        return cls(
            found=EvaluatedMotion.of(measure.found) if measure.found else None,
            aligned=measure.aligned,
            collision=measure.collision,
            touch=measure.touch,
            gap=measure.gap,
            opening=measure.opening,
            connected=measure.connected,
            works=measure.works,
        )


class EvaluatedPart(EvaluationRecord):
    """One part that counts: on the stated axes alone, and after the geometric fix."""

    part: str
    raw: MeasureRecord | None = None
    fixed: MeasureRecord | None = None
    plausible: bool | None = None
    objection: str = ""
    skipped: str = ""


class GraspRecord(EvaluationRecord):
    """How a moving body can be grasped before and after."""

    part: str
    before: str
    after: str


class HandleRecord(EvaluationRecord):
    """Whether a part that counts has a handle before and after."""

    part: str
    before: bool
    after: bool


class TopRecord(EvaluationRecord):
    """How far a piece is covered from above, and open past its rim, before and after; how many tops were added."""

    covered: tuple[FiniteFloat, FiniteFloat]
    opened: tuple[FiniteFloat, FiniteFloat]
    added: int


class PanelsRecord(EvaluationRecord):
    """What becomes of 1 to 3 shelves or dividers at random in each compartment (see `RandomPanels`)."""

    compartments: int
    filled: int
    asked: int
    placed: int
    faulty: int
    rooms: int


class CompletenessRecord(EvaluationRecord):
    """What of the statics was missing, and what is there now (see `Completeness`)."""

    top: TopRecord
    handles: tuple[HandleRecord, ...]
    grasps: tuple[GraspRecord, ...]
    added_handles: int
    blocked: int
    panels: PanelsRecord

    @classmethod
    def of(cls, found: Completeness) -> "CompletenessRecord":
        """Returns the record of what was found."""
        return cls.model_validate(asdict(found))


class TruthRecord(EvaluationRecord):
    """A part that counts, as it is annotated."""

    part: str
    label: PartLabel
    motion: EvaluatedMotion
    reference: FiniteFloat

    @classmethod
    def of(cls, part: MovingPart) -> "TruthRecord":
        """Returns the record of a part."""
        return cls(part=part.id, label=part.label, motion=EvaluatedMotion.of(part.motion), reference=part.reference)


class ModelFacts(EvaluationRecord):
    """What is true of a model whatever the method."""

    kind: Literal["model"] = "model"
    category: str
    parts: tuple[TruthRecord, ...]
    fingerprint: tuple[FiniteFloat, ...]
    features: tuple[FiniteFloat, ...]


class MethodFacts(EvaluationRecord):
    """What one method made of a model."""

    kind: Literal["method"] = "method"
    parts: tuple[EvaluatedPart, ...]
    completeness: CompletenessRecord | None = None


class TwinFacts(EvaluationRecord):
    """Whether two models are of one geometry, and the motions that each one's annotation gives the other's parts."""

    kind: Literal["twins"] = "twins"
    same: bool
    for_first: dict[str, EvaluatedMotion] = {}
    for_second: dict[str, EvaluatedMotion] = {}


class MadeFacts(EvaluationRecord):
    """The features of one synthetic model of the training distribution."""

    kind: Literal["made"] = "made"
    features: tuple[FiniteFloat, ...]


Facts = Annotated[ModelFacts | MethodFacts | TwinFacts | MadeFacts, Field(discriminator="kind")]


class UsageRecord(EvaluationRecord):
    """What asking a language model about one model used up; tokens are null where the endpoint does not state them."""

    requests: int
    unanswered: int
    tokens_in: int | None
    tokens_out: int | None
    seconds: FiniteFloat

    @classmethod
    def of(cls, usage: Usage) -> "UsageRecord":
        """Returns the record of what was used up."""
        return cls(**asdict(usage))

    def usage(self) -> Usage:
        """Returns what was used up."""
        return Usage(**self.model_dump())


class ResultRow(EvaluationRecord):
    """One line: which task (its key states all that determines it), what it found, or why it failed or was not run."""

    key: str
    task: dict[str, str]
    seconds: FiniteFloat
    error: str = ""
    not_run: str = ""
    usage: UsageRecord | None = None
    facts: Facts | None = None


def _vector(values: Vec3) -> Vector:
    x, y, z = values.tolist()
    return x, y, z


NAME = "rows.jsonl"
_MOST_BYTES = 512 * 2**20
_BEGINNING = b'{"key":'  # of every line, whatever the version


def read_rows(path: Path) -> dict[str, ResultRow]:
    """Returns the rows of a file by key; broken lines and those of another form are left out.

    Raises:
        ExportError: if there is a file that cannot be read.
    """
    found: dict[str, ResultRow] = {}
    for line in _lines(path):
        try:
            row = ResultRow.model_validate_json(line)
        except ValidationError:
            continue
        found[row.key] = row
    return found


def begin_rows(path: Path, anew: bool = False) -> dict[str, ResultRow]:
    """Returns the rows of a run that goes on, none of one that begins `anew`; its folder is there then.

    Raises:
        ExportError: if the folder cannot be made, or the file is none of ours, or cannot be read or taken away.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        held = _lines(path)
        if any(held) and not any(line.startswith(_BEGINNING[: len(line)]) for line in held if line):
            raise ExportError(f"`{path}` holds no rows of grafu's, so it is kept: choose another --out")
        if anew:
            path.unlink(missing_ok=True)
    except OSError as error:
        raise ExportError(f"cannot write into `{path.parent}` ({error.strerror}): choose another --out") from None
    return read_rows(path)


def _lines(path: Path) -> list[bytes]:
    try:
        return read_own(path, "rows of grafu", _MOST_BYTES).split(b"\n") if os.path.lexists(path) else []
    except AssetError as error:
        raise ExportError(f"{error}: choose another --out") from None


def append_rows(path: Path, rows: Iterable[ResultRow]) -> None:
    """Adds rows at the end of a file, each with its line break, after whatever half a line a killed run left.

    Raises:
        ExportError: if it cannot be written.
    """
    text = "".join(f"{row.model_dump_json()}\n" for row in rows)
    try:
        with path.open("a+b") as file:
            if file.seek(0, 2) > 0:
                file.seek(-1, 2)
                if file.read(1) != b"\n":
                    text = "\n" + text
            file.write(text.encode())
            file.flush()
    except OSError as error:
        raise ExportError(f"`{path}` cannot be written ({error.strerror or type(error).__name__})") from error


def done(rows: Mapping[str, ResultRow], key: str) -> bool:
    """Whether a task needs no more work; one that failed, or was not run, is tried again."""
    return key in rows and not rows[key].error and not rows[key].not_run
