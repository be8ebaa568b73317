"""The stages from a completed graph to joints: plan, what is closed, what is missing in the body, the joints.

Where a part is blocked in the direction that was decided, they run once more with the next likely one; what opens more
parts stands.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple, final

from grafu.additions.step import StepResult
from grafu.asset.part import Asset
from grafu.completion.static_guesses import with_static
from grafu.dataclass import dataclass
from grafu.graph.completion import GraphCompletion
from grafu.joints.closing import closed_plan
from grafu.joints.folding import Fold
from grafu.joints.joint_choice import with_choices
from grafu.joints.motion_choice import MotionChoice
from grafu.joints.plan import RealizationPlan
from grafu.joints.realize import Realized, realize
from grafu.joints.waste_bins import with_stated_bins
from grafu.pipeline.additions import add_before_joints, without_idle
from grafu.pipeline.colliding_guesses import blocked_guesses, colliding_guesses
from grafu.pipeline.finishing import to_build
from grafu.pipeline.mechanisms import with_mechanisms
from grafu.pipeline.motion_methods import MotionMethod
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.second_choices import noted, other_faces, second_choices
from grafu.pipeline.shown_by_shape import shown_by_shape
from grafu.pipeline.stages import Stages, nothing_before_joints, without_joints
from grafu.pipeline.turned_doors import turned_doors
from grafu.processes.cache import Cache
from grafu.refusal import Reason, Refusal
from grafu.templates.template import Gallery


class BuiltJoints(NamedTuple):
    """The graph that joints were planned from, the plan, what turns by shape alone, and what was built."""

    completion: GraphCompletion
    plan: RealizationPlan
    turning: frozenset[str]
    body: StepResult
    realized: Realized


@final
@dataclass(frozen=True, slots=True)
class JointStages:
    """The stages of one asset; `motions` and `folds` are what the user states about how parts move."""

    asset: Asset
    source: MotionSource
    method: MotionMethod
    motions: Mapping[str, MotionChoice]
    folds: Sequence[Fold]
    gallery: Gallery
    config: PipelineConfig
    stages: Stages
    cache: Cache

    def with_second_choices(self, completion: GraphCompletion) -> BuiltJoints:
        """Returns the joints of a completion, with another direction where the likeliest one is blocked.

        A door that cannot open to the face that was decided opens to the other, and one that cannot slide turns. What
        was stated is not chosen again. What was only guessed to move stays where it cuts into other parts.
        """
        first = best = self.built(completion)
        config = self.config.joints.plan
        for turn in range(0 if self.method.reads_annotation else config.other_directions):
            skipped = best.realized.report.skipped
            other = second_choices(best.completion, skipped, turn, config)
            if other is None:
                break
            best = self._better(best, other)
        faced = (
            None if self.method.reads_annotation else other_faces(best.completion, best.realized.report.skipped, config)
        )
        best = best if faced is None else self._better(best, faced)
        turned = None if self.method.reads_annotation else turned_doors(best.completion, best.realized.report.skipped)
        best = self._without_colliding(best if turned is None else self._better(best, turned))
        if best is first:
            return first
        report = noted(best.realized.report, completion, best.completion, first.realized.report.skipped)
        return best._replace(realized=replace(best.realized, report=report))

    def _better(self, best: BuiltJoints, other: GraphCompletion) -> BuiltJoints:
        """Returns the joints of another completion where more of them could be built, else the best so far."""
        if self.stages.gave_up("realize"):
            return best
        before, tried = self.stages.given_up(), self.built(other)
        if len(tried.realized.report.installed) > len(best.realized.report.installed):
            return tried
        self.stages.take_back(before)
        return best

    def _without_colliding(self, made: BuiltJoints) -> BuiltJoints:
        """Returns the joints in which what was only guessed to move stays where it cuts into other parts.

        What no joint could be built for stays as well, and is stated as a guess.
        """
        if self.method.reads_annotation or self.stages.gave_up("realize"):
            return made
        settled = {*self.motions, *(name for fold in self.folds for name in fold.leaves)}
        doubtful = tuple(colliding_guesses(made.completion, made.realized.report.installed, settled))
        made = self._still(made, with_static(made.completion, doubtful)) if doubtful else made
        report = made.realized.report
        blocked = {refusal.part: refusal for refusal in blocked_guesses(made.completion, report.skipped, settled)}
        if not blocked:
            return made
        outcomes = (blocked.get(o.part, o) if isinstance(o, Refusal) else o for o in report.outcomes)
        realized = replace(made.realized, report=replace(report, outcomes=tuple(outcomes)))
        return made._replace(completion=with_static(made.completion, tuple(blocked.values())), realized=realized)

    def _still(self, made: BuiltJoints, completion: GraphCompletion) -> BuiltJoints:
        """Returns the joints of a completion in which less moves; those that were made where time ends meanwhile."""
        before, tried = self.stages.given_up(), self.built(completion)
        lost = _too_complex(tried) - _too_complex(made)
        if not lost:
            return tried
        self.stages.take_back(before)
        self.stages.left_out(f"guesses that cut into other parts still move: no time was left for {len(lost)} joints")
        return made

    def built(self, completion: GraphCompletion) -> BuiltJoints:
        """Returns the joints of a completion."""
        asset, settings, joints = self.asset, self.config.settings, self.config.joints
        stages, value = self.stages, self.cache.value
        planned = partial(value, f"plan by {self.source}", self.method.plan, asset, completion, joints.plan)
        plan, turning = stages.timed("plan", planned), frozenset[str]()
        if self.method.reads_annotation:
            plan = with_stated_bins(plan, asset)
        else:
            graph, knobs = completion.completed, settings.small_parts
            plan, turning = value("shape", shown_by_shape, plan, asset, graph, joints, self.motions, knobs)
        plan = with_mechanisms(plan, self.motions, self.folds, completion, asset, joints)
        plan = with_choices(plan, settings.joints, asset, self.gallery, joints.plan)
        close = partial(value, "close", closed_plan, plan, asset, joints)  # drawers drawn open
        plan = stages.timed("close", close, lambda _: plan)
        wanted = settings.additions.of_body  # top, drawer boxes
        add = partial(value, "body", add_before_joints, asset, completion, plan, wanted, joints.drawer)
        body = stages.timed("body", add, partial(nothing_before_joints, asset, plan))
        plan, grown = plan.with_attached(body.attached), to_build(asset, body, plan)
        build = partial(realize, plan, grown, self.gallery.preferring(settings.hinge), joints, self.cache)
        body, realized = without_idle(body, stages.timed("realize", build, partial(without_joints, plan, grown)))
        return BuiltJoints(completion, plan, turning, body, realized)


def _too_complex(made: BuiltJoints) -> set[str]:
    """Returns the parts whose joints there was no time for."""
    return {refusal.part for refusal in made.realized.report.skipped if refusal.reason is Reason.TOO_COMPLEX}
