"""What each source of motions does: how it completes a graph and plans what to build, and which one is used."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import final

from grafu.asset.part import Asset
from grafu.completion.session import has_shipped_weights
from grafu.dataclass import dataclass
from grafu.errors import OptionError
from grafu.graph.completion import GraphCompletion
from grafu.graph.functional_graph import FunctionalGraph
from grafu.joints.make_plan import plan_from_annotation, plan_from_completion
from grafu.joints.plan import PlanConfig, RealizationPlan
from grafu.pipeline.complete import complete_by_annotation, complete_by_shape, complete_by_weights
from grafu.pipeline.motion_source import AUTO_ORDER, FOREIGN, MotionSource


@final
@dataclass(frozen=True, slots=True)
class MotionMethod:
    """How one source of motions completes a graph and plans what to build.

    `answers` states whether it can do so for an asset. Where `reads_annotation` is false the source is given the parts
    alone, as they are read without joints, so that what the input states of its motions cannot show.
    """

    complete: Callable[[Asset, FunctionalGraph], GraphCompletion]
    plan: Callable[[Asset, GraphCompletion, PlanConfig], RealizationPlan]
    answers: Callable[[Asset], bool] = lambda _: True
    reads_annotation: bool = True


def _plan_completion(asset: Asset, completion: GraphCompletion, config: PlanConfig) -> RealizationPlan:
    return plan_from_completion(completion, asset, config)


def _plan_annotation(asset: Asset, _: GraphCompletion, config: PlanConfig) -> RealizationPlan:
    return plan_from_annotation(asset, config)


MOTIONS: dict[MotionSource, MotionMethod] = {
    MotionSource.ANNOTATION: MotionMethod(
        complete_by_annotation, _plan_annotation, lambda asset: bool(asset.stated_joints)
    ),
    MotionSource.NETWORK: MotionMethod(
        complete_by_weights, _plan_completion, lambda _: has_shipped_weights(), reads_annotation=False
    ),
    MotionSource.RULE: MotionMethod(complete_by_shape, _plan_completion, reads_annotation=False),
    **{
        source: MotionMethod(partial(complete_by_annotation, source=source.value), _plan_annotation)
        for source in FOREIGN
    },
}
"""A foreign source's row is the annotation's: its joints were attached to the asset before."""


def choose_source(asset: Asset, source: MotionSource, weights: Path | None = None) -> MotionSource:
    """Returns the source to use; `auto` is the first of `AUTO_ORDER` that can answer, or the network of `weights`.

    Raises:
        OptionError: if there are weights for a source that is not the network.
    """
    if weights is not None and source not in (MotionSource.AUTO, MotionSource.NETWORK):
        raise OptionError(f"weights are for the motion source network: got {source}")
    if source is not MotionSource.AUTO:
        return source
    if weights is not None:
        return MotionSource.NETWORK
    return next(candidate for candidate in AUTO_ORDER if MOTIONS[candidate].answers(asset))


def method_of(source: MotionSource, weights: Path | None) -> MotionMethod:
    """Returns the row of `MOTIONS`; with `weights` the network is that of the file."""
    if weights is None:
        return MOTIONS[source]
    return replace(MOTIONS[source], complete=partial(complete_by_weights, weights=weights))


def require_attached(asset: Asset, source: MotionSource) -> None:
    """Passes an asset that has what the source states.

    Raises:
        OptionError: if motions of a foreign source are asked for, and joints are of another one.
    """
    if source.is_foreign and any(joint.stated_by != source for joint in asset.joints):
        raise OptionError(
            f"motions of {source} must be attached first: {asset.name} has none; give what `read_foreign` returns"
        )
