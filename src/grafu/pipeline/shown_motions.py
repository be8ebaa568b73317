"""What shapes and names alone show of how parts move, whatever predicted the plan. Annotated plans do without."""

from collections.abc import Collection

from grafu.asset.part import Asset
from grafu.geometry.config_checks import at_scale
from grafu.graph.completion import GraphCompletion
from grafu.joints.config import RealizationConfig
from grafu.joints.drawn_hinges import with_drawn_hinges
from grafu.joints.folding import with_folds
from grafu.joints.lifts import with_lifts
from grafu.joints.plan import RealizationPlan
from grafu.joints.shown_folds import shown_folds
from grafu.joints.sliding_doors import with_sliding_doors
from grafu.scene.scene import metre_on


def with_shown_motions(
    plan: RealizationPlan,
    asset: Asset,
    completion: GraphCompletion,
    joints: RealizationConfig,
    with_small: bool,
    settled: Collection[str] = (),
) -> RealizationPlan:
    """Returns a predicted plan with what shape and names alone show of how parts move; `settled` are the user's."""
    plan = with_sliding_doors(with_drawn_hinges(plan, asset, joints), asset)
    plan = with_folds(plan, shown_folds(plan, asset, joints, settled), joints.fold)
    plan = with_lifts(plan, completion.completed, at_scale(joints.lift, metre_on(asset.extent)))
    if not with_small:
        return plan
    from grafu.joints.small_parts import without_turntables

    return without_turntables(plan, asset)
