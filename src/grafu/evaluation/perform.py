"""One task from model to row: read, make, measure. A failure is a row with its error, never the end of a run."""

from functools import lru_cache
from time import perf_counter

from grafu.asset.part import Asset
from grafu.errors import FunctionalizationError
from grafu.evaluation.completeness import completeness_of
from grafu.evaluation.dataset import ModelRef, category_of, load_model
from grafu.evaluation.distribution import graph_features
from grafu.evaluation.measures import PartMeasure, measure_parts
from grafu.evaluation.methods import made_by, made_with_labels_hidden
from grafu.evaluation.moving_parts import MovingPart, counted_parts, raw_object
from grafu.evaluation.plausible import judge_motion
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
from grafu.evaluation.twins import compare_twins, fingerprint
from grafu.graph.parse import parse_graph
from grafu.metrics.motion import Motion
from grafu.pipeline.functionalize import Functionalized
from grafu.synth.generate import make_specimen


def perform(task: Task) -> ResultRow:
    """Returns the row of a task; whatever goes wrong but an interruption is said in it."""
    started = perf_counter()
    try:
        facts, error = _facts(task), ""
    except FunctionalizationError as fault:
        facts, error = None, _one_line(str(fault))
    except MemoryError:
        facts, error = None, "out of memory: run fewer --jobs at once"
    except Exception as fault:  # isolation is this module's task: the next model must still be measured
        facts, error = None, _one_line(f"internal error, which is our fault ({type(fault).__name__}: {fault})")
    seconds = round(perf_counter() - started, 3)
    return ResultRow(key=key_of(task), task=task.facts(), seconds=seconds, error=error, facts=facts)


def failed(task: Task, why: str) -> ResultRow:
    """Returns the row of a task that could not be finished."""
    return ResultRow(key=key_of(task), task=task.facts(), seconds=0.0, error=why)


def _facts(task: Task) -> ModelFacts | MethodFacts | TwinFacts | MadeFacts:
    match task:
        case ModelTask():
            return model_facts(task)
        case MethodTask():
            return method_facts(task)
        case MaskTask():
            return mask_facts(task)
        case TwinTask():
            return twin_facts(task)
        case MadeTask():
            made = make_specimen(task.seed, task.number, points=8).asset
            return MadeFacts(features=graph_features(parse_graph(made)))


def model_facts(task: ModelTask) -> ModelFacts:
    """Returns what is true of a model whatever the method; its features are those of what a method is given."""
    asset = _asset(task.model)
    return ModelFacts(
        category=category_of(task.model),
        parts=tuple(TruthRecord.of(part) for part in counted_parts(asset)),
        fingerprint=fingerprint(asset),
        features=graph_features(parse_graph(asset.without_annotation())),
    )


def method_facts(task: MethodTask) -> MethodFacts:
    """Returns what a method made of a model: on its axes alone, fixed, and the statics."""
    asset = _asset(task.model)
    truth = counted_parts(asset)
    result = made_by(task.method, asset, task.model.id)
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
    return MethodFacts(parts=tuple(parts), completeness=CompletenessRecord.of(completeness_of(result)))


def mask_facts(task: MaskTask) -> MethodFacts:
    """Returns the joints that a method makes where labels are hidden."""
    asset = _asset(task.model)
    truth = counted_parts(asset)
    result = made_with_labels_hidden(task.method, asset, task.ratio, task.seed)
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


def _why_standing(part: MovingPart, fixed: PartMeasure, result: Functionalized, skipped: dict[str, str]) -> str:
    if fixed.found is not None:
        return ""
    if part.id in skipped:
        return skipped[part.id]
    label = result.completion.completed.node(part.id).label if part.id in result.completion.completed else None
    return f"no motion was stated: it was taken for {label.value}" if label else "no motion was stated"


def _one_line(text: str) -> str:
    return " ".join(text.split())[:300]
