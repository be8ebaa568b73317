"""How many motions of annotated models weights state right: the paper's GT-aligned, of what is predicted alone."""

from pathlib import Path
from statistics import fmean

from grafu.evaluation.dataset import ModelRef, load_model
from grafu.evaluation.moving_parts import counted_parts
from grafu.graph.parse import parse_graph
from grafu.joints.make_plan import plan_from_completion
from grafu.metrics.motion import Motion, compare_motions
from grafu.pipeline.complete import complete_by_weights


def aligned_ratio(ref: ModelRef, weights: Path) -> float | None:
    """Returns the fraction of a model's parts that count to which weights give the annotated motion.

    It is None where no part counts. The network sees the parts as annotated, with names and labels, and no joints.
    Rules on shapes have no say.

    Raises:
        AssetError: if the model cannot be read.
        WeightsError: if the weights cannot.
    """
    asset = load_model(ref)
    true = {part.id: part.motion for part in counted_parts(asset)}
    if not true:
        return None
    bare = asset.without_annotation()
    plan = plan_from_completion(complete_by_weights(bare, parse_graph(bare), weights), bare)
    found = {r.moving: Motion(r.type, r.axis, true[r.moving].center) for r in plan.joints if r.moving in true}
    return fmean(float(agreement.whole) for agreement in compare_motions(found, true))
