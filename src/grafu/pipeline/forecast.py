"""What a run by default would make of an asset: which parts move, how, with what confidence. It builds nothing."""

from functools import partial

from grafu.asset.part import Asset
from grafu.geometry.budget import UNLIMITED, Budget
from grafu.graph.completion import GraphCompletion
from grafu.graph.parse import parse_graph
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.pipeline.certainty import certainty_words, guesses_of
from grafu.pipeline.inspection import ExpectedMotion, Forecast, StaticPart
from grafu.pipeline.mechanisms import with_mechanisms
from grafu.pipeline.motion_methods import MOTIONS, choose_source
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.records import piece_record
from grafu.pipeline.shown_by_shape import shown_by_shape, with_labels_by_shape
from grafu.pipeline.stages import Stages, by_contacts, without_network


def forecast(asset: Asset, budget: Budget = UNLIMITED, config: PipelineConfig = PipelineConfig()) -> Forecast:
    """Returns what is planned for an asset before anything is built; where a joint finds no room, a run states it.

    What the budget does not hold is done in a simpler way, as a run does it.

    Raises:
        WeightsError: if the network's weights are damaged.
    """
    source = choose_source(asset, MotionSource.AUTO)
    bare = with_labels_by_shape(asset.without_annotation())
    plan, completion = _planned(bare, source, Stages(lambda _: None, budget), config)
    confidence: dict[str, float] = {}
    for guess in guesses_of(completion):
        confidence[guess.part] = min(guess.score, confidence.get(guess.part, 1.0))
    return Forecast(
        source=MotionSource(completion.source),
        piece=piece_record(completion),
        motions=tuple(_expected(request, completion, confidence.get(request.moving)) for request in plan.joints),
        static=tuple(StaticPart(part=r.part, reason=str(r.reason), why=r.why) for r in plan.refused),
    )


def _planned(
    asset: Asset, source: MotionSource, stages: Stages, config: PipelineConfig
) -> tuple[RealizationPlan, GraphCompletion]:
    """Returns what is to be built, and the graph that it is planned from."""
    method, joints = MOTIONS[source], config.joints
    parse = partial(parse_graph, asset)
    graph = stages.timed("parse", partial(parse, config.parsing), lambda _: by_contacts(config.parsing, parse))
    complete = partial(method.complete, asset, graph)
    completion = stages.timed("complete", complete, partial(without_network, graph))
    plan, _ = shown_by_shape(method.plan(asset, completion, joints.plan), asset, completion.completed, joints)
    return with_mechanisms(plan, {}, (), completion, asset, joints), completion


def _expected(request: JointRequest, completion: GraphCompletion, confidence: float | None) -> ExpectedMotion:
    decided = tuple(certainty_words(completion, request.moving)) if confidence is not None else ()
    return ExpectedMotion(part=request.moving, type=request.type, confidence=confidence, decided=decided)
