"""What a run found out, as values that tables are made of: each part that counts with what each method made of it."""

from collections.abc import Iterable, Mapping
from dataclasses import field
from typing import final

from grafu.dataclass import dataclass
from grafu.evaluation.llm.chat import Usage
from grafu.evaluation.records import (
    CompletenessRecord,
    EvaluatedMotion,
    EvaluatedPart,
    MadeFacts,
    MeasureRecord,
    MethodFacts,
    ModelFacts,
    ResultRow,
    TruthRecord,
    TwinFacts,
)
from grafu.evaluation.tasks import MadeTask, MaskTask, MethodTask, ModelTask, Task, TwinTask, key_of
from grafu.metrics.motion import Motion, compare_motions

Draw = tuple[float, int]
"""A fraction of hidden labels, and the seed of the draw."""


@final
@dataclass(frozen=True)
class Failure:
    """A task that came to nothing, and why."""

    model: str
    what: str
    error: str


@final
@dataclass(frozen=True)
class PartOutcome:
    """One part that counts and what one method made of it; where the method failed on the model, nothing."""

    model: str
    category: str
    truth: TruthRecord
    record: EvaluatedPart
    alternatives: tuple[Motion, ...] = ()
    error: str = ""

    @property
    def agrees_with_a_twin(self) -> bool:
        """Whether the stated motion is what another annotation of the same geometry states."""
        raw = self.record.raw
        if raw is None or raw.found is None:
            return False
        found = {self.truth.part: raw.found.motion()}
        return any(compare_motions(found, {self.truth.part: other})[0].whole for other in self.alternatives)

    @property
    def aligned(self) -> bool:
        """Whether the stated motion is the annotated one."""
        return self.record.raw is not None and self.record.raw.aligned

    @property
    def reasonable(self) -> bool:
        """Whether it is the annotated one, a twin's, or one that people could have meant."""
        return self.aligned or self.agrees_with_a_twin or bool(self.record.plausible)


@final
@dataclass(frozen=True)
class Results:
    """All that the rows of a run say; models that could not be read are in `failures` alone.

    `made` and `masked` are by method (as the command spells it), then, in `masked`, by draw, then by model. `not_run`
    states by method and model why a model was not given to it, `usage` what asking a language model used up.
    """

    models: Mapping[str, ModelFacts]
    made: Mapping[str, Mapping[str, MethodFacts | Failure]] = field(default_factory=dict)
    masked: Mapping[str, Mapping[Draw, Mapping[str, MethodFacts | Failure]]] = field(default_factory=dict)
    alternatives: Mapping[str, Mapping[str, tuple[Motion, ...]]] = field(default_factory=dict)
    twins: tuple[tuple[str, str], ...] = ()
    training: tuple[tuple[float, ...], ...] = ()
    failures: tuple[Failure, ...] = ()
    not_run: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    usage: Mapping[str, Mapping[str, Usage]] = field(default_factory=dict)

    @property
    def categories(self) -> tuple[str, ...]:
        """The categories of the models with parts that count, in order."""
        return tuple(sorted({facts.category for facts in self.models.values() if facts.parts}))

    def outcomes(self, method: str) -> tuple[PartOutcome, ...]:
        """Returns what a method made of every part that counts."""
        return self._outcomes(self.made.get(method, {}))

    def outcomes_masked(self, method: str, draw: Draw) -> tuple[PartOutcome, ...]:
        """Returns what a method made of every part where labels were hidden."""
        return self._outcomes(self.masked.get(method, {}).get(draw, {}))

    def completeness(self, method: str) -> dict[str, CompletenessRecord]:
        """Returns the statics of each model that a method made."""
        made = self.made.get(method, {})
        found = {model: facts.completeness for model, facts in made.items() if isinstance(facts, MethodFacts)}
        return {model: record for model, record in found.items() if record is not None}

    def _outcomes(self, made: Mapping[str, MethodFacts | Failure]) -> tuple[PartOutcome, ...]:
        found = []
        for model, facts in self.models.items():
            result = made.get(model)
            if result is None:
                continue
            error = result.error if isinstance(result, Failure) else ""
            records = {} if isinstance(result, Failure) else {record.part: record for record in result.parts}
            others = self.alternatives.get(model, {})
            for truth in facts.parts:
                record = records.get(truth.part) or EvaluatedPart(part=truth.part, skipped=error)
                found.append(PartOutcome(model, facts.category, truth, record, others.get(truth.part, ()), error))
        return tuple(found)


def collect(tasks: Iterable[Task], rows: Mapping[str, ResultRow]) -> Results:
    """Returns what the rows say about these tasks, in the tasks' order whatever theirs; tasks undone are left out."""
    gathered = _Gathered()
    for task in tasks:
        row = rows.get(key_of(task))
        if row is not None:
            gathered.add(task, row)
    alternatives = {
        model: {part: tuple(motions) for part, motions in by_part.items()}
        for model, by_part in gathered.alternatives.items()
    }
    return Results(
        gathered.models,
        gathered.made,
        gathered.masked,
        alternatives,
        tuple(gathered.twins),
        tuple(gathered.training),
        tuple(gathered.failures),
        gathered.not_run,
        gathered.usage,
    )


class _Gathered:
    """Results in the making."""

    def __init__(self) -> None:
        self.models: dict[str, ModelFacts] = {}
        self.made: dict[str, dict[str, MethodFacts | Failure]] = {}
        self.masked: dict[str, dict[Draw, dict[str, MethodFacts | Failure]]] = {}
        self.alternatives: dict[str, dict[str, list[Motion]]] = {}
        self.twins: list[tuple[str, str]] = []
        self.training: list[tuple[float, ...]] = []
        self.failures: list[Failure] = []
        self.not_run: dict[str, dict[str, str]] = {}
        self.usage: dict[str, dict[str, Usage]] = {}

    def add(self, task: Task, row: ResultRow) -> None:
        """Takes one row in."""
        failure = self._failure(task, row)
        match task, row.facts:
            case ModelTask(model), ModelFacts() as facts:
                self.models[model.id] = facts
            case MethodTask(model, method), facts:
                self._take_method(model.id, method.spelled, row, _method_facts(facts, failure))
            case MaskTask(model, method, ratio, seed), facts:
                draws = self.masked.setdefault(method.spelled, {})
                draws.setdefault((ratio, seed), {})[model.id] = _method_facts(facts, failure)
            case TwinTask(model, other), TwinFacts(same=True) as facts:
                self.twins.append((model.id, other.id))
                self._lend(model.id, facts.for_first)
                self._lend(other.id, facts.for_second)
            case MadeTask(), MadeFacts() as facts:
                self.training.append(facts.features)
        if row.error:
            self.failures.append(failure)

    def _take_method(self, model: str, method: str, row: ResultRow, outcome: MethodFacts | Failure) -> None:
        made = self.made.setdefault(method, {})
        if row.not_run:
            self.not_run.setdefault(method, {})[model] = row.not_run
        else:
            made[model] = outcome
        if row.usage is not None:
            self.usage.setdefault(method, {})[model] = row.usage.usage()

    def _lend(self, model: str, motions: Mapping[str, EvaluatedMotion]) -> None:
        for part, record in motions.items():
            self.alternatives.setdefault(model, {}).setdefault(part, []).append(record.motion())

    def _failure(self, task: Task, row: ResultRow) -> Failure:
        named = ("method", "share", "seed", "other_model")
        facts = {name: text for name, text in task.facts().items() if name in named}
        what = ", ".join([task.facts()["task"], *(f"{name} {text}" for name, text in facts.items())])
        return Failure(task.facts().get("model", ""), what, row.error)


def _method_facts(facts: object, failure: Failure) -> MethodFacts | Failure:
    return facts if isinstance(facts, MethodFacts) else failure


def measured(outcome: PartOutcome, fixed: bool) -> MeasureRecord | None:
    """Returns what was measured on the stated axes alone, or after the fix."""
    return outcome.record.fixed if fixed else outcome.record.raw
