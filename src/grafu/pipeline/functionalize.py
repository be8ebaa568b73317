"""The paper's pipeline as one function: graph, completion, plan, what is missing, joints. It touches no files."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, final

from grafu.additions.step import Addition, StepResult
from grafu.articulation.articulated_object import ArticulatedObject
from grafu.asset.part import Asset
from grafu.asset.regrouping import regrouped
from grafu.completion.session import has_shipped_weights
from grafu.errors import OptionError
from grafu.geometry.budget import UNLIMITED, Budget
from grafu.geometry.config_checks import at_scale
from grafu.graph.completion import GraphCompletion
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.parse import ParsingConfig, parse_graph
from grafu.joints.closing import closed_plan
from grafu.joints.config import RealizationConfig
from grafu.joints.folding import as_turning, folds_in
from grafu.joints.joint_choice import with_choices
from grafu.joints.make_plan import plan_from_annotation, plan_from_completion
from grafu.joints.plan import PlanConfig, RealizationPlan
from grafu.joints.rail_config import DrawerConfig
from grafu.joints.realize import Realized, realize
from grafu.joints.report import RealizationReport
from grafu.joints.waste_bins import with_stated_bins
from grafu.pipeline.additions import add_after_joints, add_before_joints, without_idle
from grafu.pipeline.built_graph import as_built, with_joints, without_removed
from grafu.pipeline.complete import complete_by_annotation, complete_by_shape, complete_by_weights
from grafu.pipeline.finishing import to_build, with_lifts_of, with_small_joints_of, with_stays_of
from grafu.pipeline.grasps import with_grasp_frames
from grafu.pipeline.mechanisms import with_mechanisms
from grafu.pipeline.motion_choices import corrected, require_fronts, with_motions, with_mounts, with_moving
from grafu.pipeline.motion_source import AUTO_ORDER, FOREIGN, MotionSource
from grafu.pipeline.settings import Settings
from grafu.pipeline.shown_by_shape import additions_wanted, shown_by_shape, small_parts_wanted, with_labels_by_shape
from grafu.pipeline.stages import (
    Stages,
    by_contacts,
    nothing_after_joints,
    nothing_before_joints,
    without_joints,
    without_network,
)
from grafu.pipeline.standing import base_of
from grafu.processes.cache import NO_CACHE, Cache
from grafu.scene.scale import metre_on
from grafu.scene.scene import Scene
from grafu.templates.template import Gallery, HandleTemplate
from grafu.visible import ShortRepr
from grafu.vocabulary import PartLabel

if TYPE_CHECKING:
    from grafu.asset.foreign.motions import ForeignMotions


@final
@dataclass(frozen=True)
class PipelineConfig(ShortRepr):
    """What the user chose, and the configurations of the stages that no setting reaches."""

    settings: Settings = Settings()
    """The user's choices; the motion source and how the input is read are passed on their own."""
    own_handles: Mapping[str, HandleTemplate] = field(default_factory=dict)
    """The user's handle templates by id."""
    parsing: ParsingConfig = ParsingConfig()
    realization: RealizationConfig = RealizationConfig()

    @property
    def joints(self) -> RealizationConfig:
        """The configuration of joints, as far as the settings allow."""
        hinge = replace(self.realization.hinge, preferred=self.settings.hinge or self.realization.hinge.preferred)
        return replace(self.realization, trim=self.realization.trim and self.settings.trim, hinge=hinge)


@final
@dataclass(frozen=True, repr=False)
class Functionalized:
    """Everything that was made of one asset.

    `asset` is the input as the motion source saw it, `source` that source (never `auto`). `completion` is the graph as
    it was built, additions included. `body` and `fittings` say what was missing and what was added, before joints were
    built and after; `before_panels` is the scene before shelves and dividers. `timings` are seconds per stage, in
    order. `notes` state what was done in a simpler way, or left out, because the budget did not hold it.
    `stated_joints` counts the joints that the input states, whether they were read or not. `decided` are the parts
    whose motion the user stated or rejected.
    """

    asset: Asset
    source: MotionSource
    completion: GraphCompletion
    plan: RealizationPlan
    object: ArticulatedObject
    report: RealizationReport
    body: StepResult
    fittings: StepResult
    before_panels: Scene
    timings: tuple[tuple[str, float], ...] = ()
    notes: tuple[str, ...] = ()
    stated_joints: int = 0
    decided: frozenset[str] = frozenset()

    @property
    def unused_joints(self) -> int:
        """How many of the joints that the input states were not read, because another source stated the motions."""
        return 0 if self.source is MotionSource.ANNOTATION else self.stated_joints

    def __repr__(self) -> str:
        return f"<Functionalized {self.asset.name}: {len(self.object.joints)} joints, {len(self.additions)} added>"

    @property
    def additions(self) -> tuple[Addition, ...]:
        """All parts that the input did not have."""
        return (*self.body.additions, *self.fittings.additions)

    @property
    def removed(self) -> frozenset[str]:
        """The ids of the input's parts that were replaced."""
        return self.body.changes.removed | self.fittings.changes.removed


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


def _say_nothing(_: str) -> None:
    """Hears of a stage and does nothing."""


def functionalize(
    asset: Asset,
    source: "MotionSource | ForeignMotions",
    gallery: Gallery,
    config: PipelineConfig = PipelineConfig(),
    on_stage: Callable[[str], None] = _say_nothing,
    cache: Cache = NO_CACHE,
    budget: Budget = UNLIMITED,
) -> Functionalized:
    """Returns the asset as an articulated object, and how it was made.

    `source` is also what another system predicted, as `grafu.pipeline.foreign.read_foreign` reads it. A door or drawer
    that cannot be made to move is no error: the report states which, and why. `on_stage` is called with each stage as
    it begins. What the `cache` holds of earlier runs is not computed again; the result is the same. What `budget` does
    not hold is left out: joints are skipped as too complex, `notes` state what was done in a simpler way. Where it
    holds all, nothing changes.

    Raises:
        OptionError: if what is chosen for a part or joint does not exist.
        WeightsError: if the network is asked for and its weights are not there.
        AssetError: if a prediction is of another object.
        OptionError: if a foreign source is named, but no motions of its are attached to the asset.
        TooComplex: if the budget does not even hold what cannot be left out.
    """
    stages, settings, joints = Stages(on_stage, budget), config.settings, config.joints
    stated, drawers, knobs, own = len(asset.stated_joints), joints.drawer, settings.small_parts, config.own_handles
    asset = regrouped(asset, settings.regrouped)
    folds = folds_in(settings.motions, asset, at_scale(joints.fold, metre_on(asset.extent)))
    motions = as_turning(settings.motions, folds)
    asset, chosen = _with_source(asset, source, replace(settings, motions=motions), drawers, stages)
    motion = _motion(chosen, settings.weights)
    parse = partial(cache.value, "parse", parse_graph, asset)  # contacts only
    graph = stages.timed("parse", partial(parse, config.parsing), lambda _: by_contacts(config.parsing, parse))
    complete = partial(cache.value, f"complete by {chosen} of {settings.weights}", motion.complete, asset, graph)
    completion = stages.timed("complete", complete, partial(without_network, graph))
    completion = with_mounts(with_motions(completion, motions, asset), settings.joints)
    plan = stages.timed("plan", partial(cache.value, f"plan by {chosen}", motion.plan, asset, completion, joints.plan))
    turning: frozenset[str] = frozenset()
    if not motion.reads_annotation:
        plan, turning = cache.value("shape", shown_by_shape, plan, asset, completion.completed, joints, motions, knobs)
    plan = with_stated_bins(plan, asset) if motion.reads_annotation else plan
    plan = with_mechanisms(plan, motions, folds, completion, asset, joints)
    plan = with_choices(plan, settings.joints, asset, gallery, joints.plan)
    close = partial(cache.value, "close", closed_plan, plan, asset, joints)  # drawers drawn open
    plan = stages.timed("close", close, lambda _: plan)
    add = partial(cache.value, "body", add_before_joints, asset, completion, plan, settings.additions.of_body, drawers)
    body = stages.timed("body", add, partial(nothing_before_joints, asset, plan))  # top, drawer boxes
    plan, grown = plan.with_attached(body.attached), to_build(asset, body, plan)
    build = partial(realize, plan, grown, gallery.preferring(settings.hinge), joints, cache)
    body, realized = without_idle(body, stages.timed("realize", build, partial(without_joints, plan, grown)))
    wanted = additions_wanted(asset, settings.additions)
    fit = partial(cache.value, "fittings", add_after_joints, realized.scene, completion, plan, wanted, own)
    fittings, before_panels = stages.timed("fittings", fit, partial(nothing_after_joints, realized.scene))
    small = small_parts_wanted(asset, motion.reads_annotation, settings.small_parts, turning)
    realized = with_small_joints_of(realized, fittings, asset, joints, stages, small, cache)
    realized = with_lifts_of(realized, plan, asset, joints, stages)
    realized, fittings = with_stays_of(realized, fittings, plan, asset, joints, stages, settings.stays)
    realized = with_grasp_frames(realized, fittings, plan, stages, cache)
    with budget.in_force():
        graph_built = by_contacts(config.parsing, partial(_as_built, completion, asset, realized, body.then(fittings)))
    return Functionalized(
        asset,
        MotionSource(completion.source) if stages.gave_up("complete") else chosen,
        graph_built,
        plan,
        replace(realized.object, base=base_of(asset, settings)),
        realized.report,
        body,
        fittings,
        before_panels,
        tuple(stages.laps),
        tuple(stages.notes),
        stated,
        frozenset(motions),
    )


def _with_source(
    asset: Asset, source: "MotionSource | ForeignMotions", settings: Settings, drawers: DrawerConfig, stages: Stages
) -> tuple[Asset, MotionSource]:
    """Returns the asset as the motion source is to see it, corrected by the user, and the source to use."""
    asset = asset.as_annotated() if source is MotionSource.ANNOTATION else asset
    require_fronts(asset, settings.additions.fronts)
    asset = with_moving(corrected(asset, settings.labels), settings.motions, settings.labels, drawers)
    if not isinstance(source, MotionSource):
        from grafu.asset.foreign.attach import attach_motions  # local: most runs do without

        return stages.timed("match", lambda: attach_motions(asset, source)), MotionSource(source.source)
    chosen = choose_source(asset, source, settings.weights)
    _require_attached(asset, chosen)
    if MOTIONS[chosen].reads_annotation:
        return asset, chosen
    return with_labels_by_shape(asset.without_annotation()), chosen


def _as_built(
    completion: GraphCompletion, asset: Asset, realized: Realized, made: StepResult, parsing: ParsingConfig
) -> GraphCompletion:
    """Returns the completed graph with what was added, without what was replaced, with an edge for each joint."""
    tops = [addition.part.id for addition in made.additions if addition.part.label is PartLabel.TOP_PANEL]
    built = without_removed(as_built(completion, asset, made.additions, parsing), made.changes.removed, tops)
    return with_joints(built, realized.object, {done.moving: done.mount for done in realized.report.installed})


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


def _motion(source: MotionSource, weights: Path | None) -> MotionMethod:
    """Returns the row of `MOTIONS`; with `weights` the network is that of the file."""
    if weights is None:
        return MOTIONS[source]
    return replace(MOTIONS[source], complete=partial(complete_by_weights, weights=weights))


def _require_attached(asset: Asset, source: MotionSource) -> None:
    if source.is_foreign and any(joint.stated_by != source for joint in asset.joints):
        raise OptionError(
            f"motions of {source} must be attached first: {asset.name} has none; give what `read_foreign` returns"
        )
