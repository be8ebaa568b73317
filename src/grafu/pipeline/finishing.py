"""What joints are built on, and what is done to the object last: small parts, lift arms, stays."""

from dataclasses import replace
from functools import partial

from grafu.additions.interior.carousel import CAROUSEL
from grafu.additions.step import StepResult
from grafu.asset.part import Asset
from grafu.joints.config import RealizationConfig
from grafu.joints.plan import MotionRole, RealizationPlan
from grafu.joints.realize import Realized
from grafu.pipeline.additions import fitted_object
from grafu.pipeline.shown_by_shape import WantedSmallParts
from grafu.pipeline.stages import Stages
from grafu.processes.cache import NO_CACHE, Cache


def to_build(asset: Asset, body: StepResult, plan: RealizationPlan) -> Asset:
    """Returns the asset with what was added before joints, without the drawn arms and stays that a plan leaves out."""
    parts, gone = tuple(body.scene.parts.values()), plan.left_out
    if not gone:  # as in most runs
        return replace(asset, parts=parts)
    loose = (replace(p, carried_by=None) if p.carried_by in gone else p for p in parts if p.id not in gone)
    return replace(asset, parts=tuple(loose), joints=(), small_joints=())


def with_small_joints_of(
    realized: Realized,
    fittings: StepResult,
    asset: Asset,
    joints: RealizationConfig,
    stages: Stages,
    small: WantedSmallParts,
    cache: Cache = NO_CACHE,
) -> Realized:
    """Returns what was realized with all that was added on its links, and `small` parts moving by themselves.

    Added carousels are among these, but where the user wants none.
    """
    realized = replace(realized, object=fitted_object(realized.object, fittings))
    added = frozenset(addition.part.id for addition in fittings.additions if addition.style == CAROUSEL)
    if added and small.chosen is not None:
        small = WantedSmallParts(True, small.chosen | added)
    if not small.any:  # as in most runs
        return realized
    from grafu.joints.small_joints import with_small_parts

    add = partial(cache.value, "small parts", with_small_parts, realized, asset, joints, small.chosen)
    return stages.timed("small parts", add, lambda _: realized)


def with_lifts_of(
    realized: Realized, plan: RealizationPlan, asset: Asset, joints: RealizationConfig, stages: Stages
) -> Realized:
    """Returns what was realized with arms on the flaps of a plan that they lift upright, where there is room."""
    flaps = [request.moving for request in plan.joints if request.role is MotionRole.LIFTED]
    if not flaps:  # as in most runs
        return realized
    from grafu.joints.drawn_lifts import drawn_lifts
    from grafu.joints.parallel_lifts import with_parallel_lifts

    build = partial(with_parallel_lifts, realized, flaps, joints, drawn=drawn_lifts(plan, asset))
    return stages.timed("lift arms", build, lambda _: realized)


def with_stays_of(
    realized: Realized,
    fittings: StepResult,
    plan: RealizationPlan,
    asset: Asset,
    joints: RealizationConfig,
    stages: Stages,
    wanted: bool,
) -> tuple[Realized, StepResult]:
    """Returns what was realized with stays, if they are wanted, and with the drawn arms and stays that stay in place.

    Those that do not are among what the fittings removed.
    """
    realized = _with_stays(realized, joints, stages) if wanted else realized
    if not plan.arms:  # as in most runs
        return realized, fittings
    from grafu.joints.drawn_lifts import with_drawn_left

    realized, gone = with_drawn_left(realized, plan, asset, joints)
    changes = replace(fittings.changes, removed=fittings.changes.removed | gone)
    return realized, replace(fittings, changes=changes)


def _with_stays(realized: Realized, joints: RealizationConfig, stages: Stages) -> Realized:
    """Returns what was realized with stays on the lids and flaps that have room for them."""
    upright = (abs(float(joint.axis.direction[2])) for joint in realized.object.joints if joint.kind.turns)
    if min(upright, default=1.0) > joints.stay.level:
        return realized
    from grafu.joints.stays import with_stays

    return stages.timed("stays", partial(with_stays, realized, joints), lambda _: realized)
