"""What the user states of how parts move, and what their mechanisms need, as one plan."""

from collections.abc import Mapping, Sequence

from grafu.asset.part import Asset
from grafu.graph.completion import GraphCompletion
from grafu.joints.config import RealizationConfig
from grafu.joints.drawn_arms import with_drawn_arms
from grafu.joints.drop_supports import with_stated_supports
from grafu.joints.extension_leaves import with_extension_leaves
from grafu.joints.folding import Fold, with_folds
from grafu.joints.motion_choice import MotionChoice, Moves
from grafu.joints.parallel_lifts import with_lifted
from grafu.joints.plan import RealizationPlan
from grafu.joints.swivel_mirrors import with_stated_mirrors
from grafu.joints.tilting_fronts import with_tilts
from grafu.pipeline.motion_choices import plan_with_motions


def with_mechanisms(
    plan: RealizationPlan,
    motions: Mapping[str, MotionChoice],
    folds: Sequence[Fold],
    completion: GraphCompletion,
    asset: Asset,
    joints: RealizationConfig,
) -> RealizationPlan:
    """Returns the plan with the motions that are stated, and with what their mechanisms need; `folds` are among them.

    Raises:
        OptionError: if a part is to move in a way that it cannot.
    """
    plan = with_folds(plan_with_motions(plan, motions, completion, asset), folds, joints.fold)
    plan = with_tilts(plan, asset, completion.completed, _stated(motions, Moves.TILTS))
    plan = with_stated_supports(with_extension_leaves(plan, asset), asset)
    plan = with_stated_mirrors(with_lifted(plan, _stated(motions, Moves.LIFTS)), asset)
    return with_drawn_arms(plan, asset)


def _stated(motions: Mapping[str, MotionChoice], moves: Moves) -> frozenset[str]:
    """Returns the ids of the parts that are stated to move in one way."""
    return frozenset(part for part, choice in motions.items() if choice.moves is moves)
