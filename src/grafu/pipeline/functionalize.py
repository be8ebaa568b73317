"""The paper's pipeline as one function: graph, completion, plan, what is missing, joints. It touches no files."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, final

from grafu.additions.step import Addition, StepResult
from grafu.articulation.articulated_object import ArticulatedObject
from grafu.asset.part import Asset
from grafu.asset.regrouping import regrouped
from grafu.completion.misnamed_parts import with_corrected_names
from grafu.dataclass import dataclass
from grafu.geometry.budget import UNLIMITED, Budget
from grafu.geometry.config_checks import at_scale
from grafu.graph.completion import GraphCompletion
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.parse import ParsingConfig, parse_graph
from grafu.joints.catches import with_catches
from grafu.joints.folding import as_turning, folds_in
from grafu.joints.plan import RealizationPlan
from grafu.joints.rail_config import DrawerConfig
from grafu.joints.realize import Realized
from grafu.joints.report import RealizationReport
from grafu.pipeline.additions import add_after_joints
from grafu.pipeline.built_graph import as_built, with_joints, without_removed
from grafu.pipeline.finishing import with_lifts_of, with_small_joints_of, with_stays_of
from grafu.pipeline.grasps import with_grasp_frames
from grafu.pipeline.joint_stages import JointStages
from grafu.pipeline.likeliest_front import with_likeliest_front
from grafu.pipeline.motion_choices import corrected, require_fronts, with_motions, with_mounts, with_moving
from grafu.pipeline.motion_methods import MOTIONS, choose_source, method_of, require_attached
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.pipeline.shown_by_shape import additions_wanted, small_parts_wanted, with_labels_by_shape
from grafu.pipeline.stages import (
    Stages,
    by_contacts,
    nothing_after_joints,
    without_network,
)
from grafu.pipeline.standing import base_of
from grafu.processes.cache import NO_CACHE, Cache
from grafu.scene.scale import metre_on
from grafu.scene.scene import Scene
from grafu.templates.template import Gallery
from grafu.vocabulary import PartLabel

if TYPE_CHECKING:
    from grafu.asset.foreign.motions import ForeignMotions


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
    stated, drawers, own = len(asset.stated_joints), joints.drawer, config.own_handles
    asset = regrouped(asset, settings.regrouped)
    folds = folds_in(settings.motions, asset, at_scale(joints.fold, metre_on(asset.extent)))
    motions = as_turning(settings.motions, folds)
    asset, chosen = _with_source(asset, source, replace(settings, motions=motions), drawers, stages)
    motion = method_of(chosen, settings.weights)
    if chosen is MotionSource.NETWORK:
        asked = partial(_completed, motion.complete, config.parsing)
        asset = stages.timed("complete", partial(with_likeliest_front, asset, asked))
    parse = partial(cache.value, "parse", parse_graph, asset)  # contacts only
    graph = stages.timed("parse", partial(parse, config.parsing), lambda _: by_contacts(config.parsing, parse))
    complete = partial(cache.value, f"complete by {chosen} of {settings.weights}", motion.complete, asset, graph)
    completion = stages.timed("complete", complete, partial(without_network, graph))
    asset = with_corrected_names(asset, completion)
    completion = with_mounts(with_motions(completion, motions, asset), settings.joints)
    make = JointStages(asset, chosen, motion, motions, folds, gallery, config, stages, cache)
    completion, plan, turning, body, realized = make.with_second_choices(completion)
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
        replace(with_catches(realized.object, settings.catch), base=base_of(asset, settings)),
        realized.report,
        body,
        fittings,
        before_panels,
        tuple(stages.laps.items()),
        tuple(stages.notes),
        stated,
        frozenset(motions),
    )


def _completed(
    complete: Callable[[Asset, FunctionalGraph], GraphCompletion], parsing: ParsingConfig, asset: Asset
) -> GraphCompletion:
    return complete(asset, parse_graph(asset, parsing))


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
    require_attached(asset, chosen)
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
