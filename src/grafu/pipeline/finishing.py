"""What is done to the built object last: joints of small parts, lift arms, stays. It decides nothing else."""

from dataclasses import replace
from functools import partial

from grafu.additions.step import StepResult
from grafu.asset.part import Asset
from grafu.joints.config import RealizationConfig
from grafu.joints.plan import MotionRole, RealizationPlan
from grafu.joints.realize import Realized
from grafu.pipeline.additions import fitted_object
from grafu.pipeline.shown_by_shape import WantedSmallParts
from grafu.pipeline.stages import Stages


def with_small_joints_of(
    realized: Realized,
    fittings: StepResult,
    asset: Asset,
    joints: RealizationConfig,
    stages: Stages,
    small: WantedSmallParts,
) -> Realized:
    """Returns what was realized with all that was added on its links, and `small` parts moving by themselves."""
    realized = replace(realized, object=fitted_object(realized.object, fittings))
    if not small.any:  # as in most runs
        return realized
    from grafu.joints.small_joints import with_small_parts

    return stages.timed(
        "small parts", partial(with_small_parts, realized, asset, joints, small.chosen), lambda _: realized
    )


def with_lifts_of(realized: Realized, plan: RealizationPlan, joints: RealizationConfig, stages: Stages) -> Realized:
    """Returns what was realized with arms on the flaps of a plan that they lift upright, where there is room."""
    flaps = [request.moving for request in plan.joints if request.role is MotionRole.LIFTED]
    if not flaps:  # as in most runs
        return realized
    from grafu.joints.parallel_lifts import with_parallel_lifts

    return stages.timed("lift arms", partial(with_parallel_lifts, realized, flaps, joints), lambda _: realized)


def with_stays_of(realized: Realized, joints: RealizationConfig, stages: Stages) -> Realized:
    """Returns what was realized with stays on the lids and flaps that have room for them."""
    upright = (abs(float(joint.axis.direction[2])) for joint in realized.object.joints if joint.kind.turns)
    if min(upright, default=1.0) > joints.stay.level:
        return realized
    from grafu.joints.stays import with_stays

    return stages.timed("stays", partial(with_stays, realized, joints), lambda _: realized)
