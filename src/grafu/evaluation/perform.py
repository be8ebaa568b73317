"""One task from model to row: read, make, measure. A failure is a row with its error, never the end of a run."""

from functools import lru_cache
from time import perf_counter
from typing import final

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.errors import FunctionalizationError, NotRun
from grafu.evaluation.completeness import completeness_of
from grafu.evaluation.dataset import ModelRef, category_of, given_model, load_model
from grafu.evaluation.distribution import graph_features
from grafu.evaluation.llm.baselines import asked
from grafu.evaluation.llm.config import LanguageModel
from grafu.evaluation.measures import PartMeasure, measure_parts
from grafu.evaluation.methods import Method, made_by, made_with_labels_hidden
from grafu.evaluation.moving_parts import MovingPart, counted_parts, raw_object
from grafu.evaluation.plausible import judge_motion
from grafu.evaluation.records import (
    CompletenessRecord,
    EvaluatedMotion,
    EvaluatedPart,
    Facts,
    MadeFacts,
    MeasureRecord,
    MethodFacts,
    ModelFacts,
    ResultRow,
    TruthRecord,
    TwinFacts,
    UsageRecord,
)
from grafu.evaluation.tasks import MadeTask, MaskTask, MethodTask, ModelTask, Task, TwinTask, key_of
from grafu.evaluation.twins import compare_twins, fingerprint
from grafu.graph.parse import parse_graph
from grafu.metrics.motion import Motion
from grafu.pipeline.functionalize import Functionalized
from grafu.synth.generate import make_specimen


@final
@dataclass(frozen=True)
class TaskOutcome:
    """What a task found, or why it failed or was not run, and what asking a language model used up."""

    facts: Facts | None = None
    error: str = ""
    not_run: str = ""
    usage: UsageRecord | None = None


def perform(task: Task) -> ResultRow:
    """Returns the row of a task; whatever goes wrong but an interruption is said in it."""
    started = perf_counter()
    try:
        outcome = _outcome(task)
    except NotRun as reason:
        outcome = TaskOutcome(not_run=_one_line(str(reason)))
    except FunctionalizationError as fault:
        outcome = TaskOutcome(error=_one_line(str(fault)))
    except MemoryError:
        outcome = TaskOutcome(error="out of memory: run fewer --jobs at once")
    except Exception as fault:  # isolation is this module's task: the next model must still be measured
        why = f"internal error, which is our fault ({type(fault).__name__}: {fault})"
        outcome = TaskOutcome(error=_one_line(why))
    seconds = round(perf_counter() - started, 3)
    return ResultRow(
        key=key_of(task),
        task=task.facts(),
        seconds=seconds,
        error=outcome.error,
        not_run=outcome.not_run,
        usage=outcome.usage,
        facts=outcome.facts,
    )


def failed(task: Task, why: str) -> ResultRow:
    """Returns the row of a task that could not be finished."""
    return ResultRow(key=key_of(task), task=task.facts(), seconds=0.0, error=why)


def _outcome(task: Task) -> TaskOutcome:
    match task:
        case ModelTask():
            return TaskOutcome(model_facts(task))
        case MethodTask(method=Method(model=LanguageModel() as model)):
            return _asked_outcome(task, model)
        case MethodTask():
            asset = _asset(task.model)
            return TaskOutcome(method_facts(asset, made_by(task.method, _given(task, asset), task.model.id)))
        case MaskTask():
            return TaskOutcome(mask_facts(task))
        case TwinTask():
            return TaskOutcome(twin_facts(task))
        case MadeTask():
            made = make_specimen(task.seed, task.number, points=8).asset
            return TaskOutcome(MadeFacts(features=graph_features(parse_graph(made))))


def _asked_outcome(task: MethodTask, model: LanguageModel) -> TaskOutcome:
    asset = _asset(task.model)
    answer = asked(task.method.name, model, asset, task.model.seed)
    facts = next((method_facts(asset, made) for made in answer.values), None)
    return TaskOutcome(facts, _one_line(answer.fault), usage=UsageRecord.of(answer.usage))


def model_facts(task: ModelTask) -> ModelFacts:
    """Returns what is true of a model whatever the method; its features are those of what a method is given."""
    asset = _asset(task.model)
    return ModelFacts(
        category=category_of(task.model),
        parts=tuple(TruthRecord.of(part) for part in counted_parts(asset)),
        fingerprint=fingerprint(asset),
        features=graph_features(parse_graph(asset.without_annotation())),
    )


def method_facts(asset: Asset, result: Functionalized) -> MethodFacts:
    """Returns how good what a method made of a model is: on its axes alone, fixed, and the statics."""
    truth = counted_parts(asset)
    raw = raw_object(result.asset, result.plan)
    measures = measure_parts(raw, truth, asset.extent), measure_parts(result.object, truth, asset.extent)
    skipped = {skip.part: f"{skip.reason.value}: {skip.why}" for skip in result.report.skipped}
    parts = []
    for part, bare, fixed in zip(truth, *measures, strict=True):
        judged = judge_motion(raw, asset, part)
        parts.append(
            EvaluatedPart(
                part=part.id,
                raw=MeasureRecord.of(bare),
                fixed=MeasureRecord.of(fixed),
                plausible=judged.plausible,
                objection=judged.why,
                skipped=_why_standing(part, fixed, result, skipped),
            )
        )
    return MethodFacts(parts=tuple(parts), completeness=CompletenessRecord.of(completeness_of(asset, truth, result)))


def mask_facts(task: MaskTask) -> MethodFacts:
    """Returns the joints that a method makes where labels are hidden."""
    asset = _asset(task.model)
    truth = counted_parts(asset)
    result = made_with_labels_hidden(task.method, _given(task, asset), task.ratio, task.seed)
    measures = measure_parts(result.object, truth, asset.extent, with_touch=False)
    records = (EvaluatedPart(part=part.id, fixed=MeasureRecord.of(m)) for part, m in zip(truth, measures, strict=True))
    return MethodFacts(parts=tuple(records))


def twin_facts(task: TwinTask) -> TwinFacts:
    """Returns whether two models are one geometry, and the motions that they lend each other."""
    found = compare_twins(_asset(task.model), _asset(task.other))

    def records(motions: dict[str, Motion]) -> dict[str, EvaluatedMotion]:
        return {part: EvaluatedMotion.of(motion) for part, motion in motions.items()}

    return TwinFacts(
        same=found.same, for_first=records(dict(found.for_first)), for_second=records(dict(found.for_second))
    )


@lru_cache(maxsize=2)  # tasks of one model come one after the other
def _asset(model: ModelRef) -> Asset:
    return load_model(model)


def _given(task: MethodTask | MaskTask, truth: Asset) -> Asset:
    """Returns what the method is given; the annotation is of the parts as they were."""
    return truth if task.method.name == "annotation" else given_model(task.model, truth)


def _why_standing(part: MovingPart, fixed: PartMeasure, result: Functionalized, skipped: dict[str, str]) -> str:
    if fixed.found is not None:
        return ""
    if part.id in skipped:
        return skipped[part.id]
    label = result.completion.completed.node(part.id).label if part.id in result.completion.completed else None
    return f"no motion was stated: it was taken for {label.value}" if label else "no motion was stated"


def _one_line(text: str) -> str:
    return " ".join(text.split())[:300]
