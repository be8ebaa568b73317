"""The whole loss: match slots to nodes, lay the answers out by slot, take every term, weigh and add.

Terms before weights: of single slots attributes, existence, anchors (supplement, Per-slot Loss), of pairs of slots
kinds of edges and exclusive choices (Per-pair Loss), of true hinges and rails their motions (Motion Loss). Means are
over marked entries, so that padding and what is unknown never count.
"""

from typing import NamedTuple, final

import torch
from torch import Tensor
from torch.nn import functional

from grafu.dataclass import dataclass
from grafu.graph.arrays import ALONG, ATTACHED, DOOR, DRAWER, HANDLE, HINGE, NONE, NULL, UNKNOWN
from grafu.network.batch import Predictions
from grafu.shapes import Bool, Float, Int64
from grafu.training.loss_config import BoxError, LossConfig
from grafu.training.matcher import SlotTruth, match_slots, slot_truth
from grafu.training.targets import TargetBatch


@final
@dataclass(frozen=True)
class MotionLosses:
    """Three numbers: two over hinges, one over rails, slides and turns."""

    border: Float[Tensor, ""]
    sign: Float[Tensor, ""]
    slide: Float[Tensor, ""]


def motion_losses(predictions: Predictions, truth: SlotTruth) -> MotionLosses:
    """Returns the cross-entropies of border, sign and slide, read at (moving part, what carries it)."""
    hinges = truth.child & (truth.edges == HINGE)
    along = truth.child & torch.isin(truth.edges, torch.tensor(ALONG, device=truth.edges.device))
    return MotionLosses(
        border=code_loss(predictions.border.float(), truth.border, hinges),
        sign=code_loss(predictions.sign.float(), truth.sign, hinges),
        slide=code_loss(predictions.slide.float(), truth.slide, along),
    )


def code_loss(
    logits: Float[Tensor, "b s s c"], codes: Int64[Tensor, "b s"], edges: Bool[Tensor, "b s s"]
) -> Float[Tensor, ""]:
    """Returns the mean cross-entropy over the edges of parts whose code is known."""
    graph, child, carrier = (edges & (codes != NONE)[:, :, None]).nonzero(as_tuple=True)  # few of all pairs
    wrong = functional.cross_entropy(logits[graph, child, carrier], codes[graph, child], reduction="sum")
    return wrong / max(len(graph), 1)


def mean_where(values: Float[Tensor, "*shape"], where: Bool[Tensor, "*shape"]) -> Float[Tensor, ""]:
    """Returns the mean of the marked values, 0 where none is marked."""
    return weighted_mean(values, where.to(values.dtype))


def weighted_mean(values: Float[Tensor, "*shape"], weights: Float[Tensor, "*shape"]) -> Float[Tensor, ""]:
    """Returns the mean of the values by weight; values without weight take no part, even if infinite."""
    used = torch.where(weights > 0, values, 0.0)
    total = weights.sum()
    return (used * weights).sum() / torch.where(total > 0, total, 1.0)


@final
@dataclass(frozen=True)
class SlotLosses:
    """Each number is a mean over the slots (the count: over the graphs) that it speaks of, before its weight."""

    category: Float[Tensor, ""]
    centre: Float[Tensor, ""]
    half: Float[Tensor, ""]
    exists: Float[Tensor, ""]
    free_exists: Float[Tensor, ""]
    count: Float[Tensor, ""]
    anchor_centre: Float[Tensor, ""]
    anchor_half: Float[Tensor, ""]
    free_category: Float[Tensor, ""]
    free_centre: Float[Tensor, ""]
    free_half: Float[Tensor, ""]


def slot_losses(predictions: Predictions, truth: SlotTruth, config: LossConfig) -> SlotLosses:
    """Returns the per-slot losses; nodes without a known label take no part in the category's."""
    centre, half, error = predictions.centre.float(), predictions.half.float(), config.box_error
    exists, categories = predictions.exists.float(), predictions.category.float()
    added = truth.matched & truth.free
    off_centre = box_errors(centre, truth.boxes[..., :3], error)
    off_size = box_errors(half, truth.boxes[..., 3:], error)
    return SlotLosses(
        category=category_loss(categories, truth, truth.matched),
        centre=mean_where(off_centre, truth.matched),
        half=mean_where(off_size, truth.matched),
        exists=exists_loss(exists, truth, config.exists_balanced),
        free_exists=free_exists_loss(exists, truth, config.free_positive),
        count=count_loss(exists, truth, config.count_smoothing, config.count_capped),
        anchor_centre=mean_where(box_errors(centre, truth.given[..., :3], error), truth.anchored),
        anchor_half=mean_where(box_errors(half, truth.given[..., 3:], error), truth.anchored),
        free_category=category_loss(categories, truth, added),
        free_centre=mean_where(off_centre, added),
        free_half=mean_where(off_size, added),
    )


def category_loss(logits: Float[Tensor, "b s c"], truth: SlotTruth, slots: Bool[Tensor, "b s"]) -> Float[Tensor, ""]:
    """Returns the cross-entropy of the categories of these slots, where the node has a label."""
    wrong = functional.cross_entropy(logits.transpose(1, 2), truth.labels, reduction="none")
    return mean_where(wrong, slots & (truth.labels != UNKNOWN))


def box_errors(found: Float[Tensor, "b s 3"], wanted: Float[Tensor, "b s 3"], error: BoxError) -> Float[Tensor, "b s"]:
    """Returns the squared distance, or the sum of the absolute differences, of each slot."""
    apart = found - wanted
    return (apart.square() if error == "squared" else apart.abs()).sum(dim=-1)


def exists_loss(exists: Float[Tensor, "b s"], truth: SlotTruth, balanced: bool) -> Float[Tensor, ""]:
    """Returns the cross-entropy of existence over all slots: those anchored or matched should exist."""
    should, slots = truth.anchored | truth.matched, truth.anchored | truth.free | truth.padding
    ratio = slots.sum() / should.sum().clamp(min=1)
    return mean_where(_existence(exists, should, ratio if balanced else torch.ones_like(ratio)), slots)


def free_exists_loss(exists: Float[Tensor, "b s"], truth: SlotTruth, positive: float) -> Float[Tensor, ""]:
    """Returns the cross-entropy of existence over the slots of no input node, padding slots too (supplement, L_free).

    Those that should exist weigh `positive`.
    """
    weight = torch.full((), positive, device=exists.device)
    return mean_where(_existence(exists, truth.matched, weight), truth.free | truth.padding)


def count_loss(
    exists: Float[Tensor, "b s"], truth: SlotTruth, smoothing: float, capped: bool = True
) -> Float[Tensor, ""]:
    """Returns the square root of how far the expected number of added nodes is from the number of missing ones.

    With `capped`, from what free slots can add of them. It is the mean over the graphs that have a free slot.
    """
    expected = torch.where(truth.free, exists.sigmoid(), 0.0).sum(dim=1)
    wanted = torch.minimum(truth.missing, truth.free.sum(dim=1)) if capped else truth.missing
    roots = ((expected - wanted).abs() + smoothing).sqrt() - smoothing**0.5
    return weighted_mean(roots, truth.free.any(dim=1).float())


def _existence(
    exists: Float[Tensor, "b s"], should: Bool[Tensor, "b s"], positive: Float[Tensor, ""]
) -> Float[Tensor, "b s"]:
    return functional.binary_cross_entropy_with_logits(exists, should.float(), pos_weight=positive, reduction="none")


@final
@dataclass(frozen=True)
class PairLosses:
    """Three numbers: over real pairs, over handles, over doors."""

    edge: Float[Tensor, ""]
    parent: Float[Tensor, ""]
    hinge_target: Float[Tensor, ""]


def pair_losses(predictions: Predictions, truth: SlotTruth, edge_kinds: tuple[float, ...]) -> PairLosses:
    """Returns the per-pair losses, the kinds of edges weighted by `edge_kinds`."""
    return PairLosses(
        edge=edge_loss(predictions.edge.float(), truth, edge_kinds),
        parent=choice_loss(predictions.parent.float(), predictions.parent_abstain.float(), parents(truth)),
        hinge_target=choice_loss(
            predictions.hinge_target.float(),
            predictions.hinge_abstain.float(),
            hinge_targets(truth, nests(predictions)),
        ),
    )


def edge_loss(logits: Float[Tensor, "b s s k"], truth: SlotTruth, edge_kinds: tuple[float, ...]) -> Float[Tensor, ""]:
    """Returns the cross-entropy of the kinds of edges over real pairs, a mean by the weight of the true kinds."""
    weights = torch.tensor(edge_kinds, device=logits.device)[truth.edges] * truth.real_pairs
    right = logits.log_softmax(dim=-1).gather(-1, truth.edges[..., None])[..., 0]
    return weighted_mean(-right, weights)


class Choices(NamedTuple):
    """Which slots choose one other slot each, among which, and which of them are right."""

    chooses: Bool[Tensor, "b s"]
    among: Bool[Tensor, "b s s"]
    right: Bool[Tensor, "b s s"]


def parents(truth: SlotTruth) -> Choices:
    """Returns how handles choose their one door or drawer."""
    movable = (truth.labels == DOOR) | (truth.labels == DRAWER)
    among = movable[:, None, :] & truth.real_pairs
    return Choices(truth.labels == HANDLE, among, truth.child & (truth.edges == ATTACHED))


def hinge_targets(truth: SlotTruth, nested: bool) -> Choices:
    """Returns how doors choose what they hang on, among all that is neither drawer nor handle.

    Without `nested`, as with the paper's kinds of edges, no door is asked, either.
    """
    others = [DRAWER, HANDLE] if nested else [DOOR, DRAWER, HANDLE]
    support = ~torch.isin(truth.labels, torch.tensor(others, device=truth.labels.device))
    among = support[:, None, :] & truth.real_pairs
    return Choices(truth.labels == DOOR, among, truth.child & (truth.edges == HINGE))


def nests(predictions: Predictions) -> bool:
    """Whether a network's kinds of edges are all kinds, so that doors may hang on doors."""
    return predictions.edge.shape[-1] > NULL + 1


def choice_loss(scores: Float[Tensor, "b s s"], abstain: Float[Tensor, ""], choices: Choices) -> Float[Tensor, ""]:
    """Returns minus the log of the fraction that right candidates, or else abstaining, have in the softmax over all.

    Of several right ones any may be chosen; a slot for which none is right should abstain.
    It is the mean over the slots that choose.
    """
    graph, slot = choices.chooses.nonzero(as_tuple=True)
    scores, among, right = scores[graph, slot], choices.among[graph, slot], choices.right[graph, slot]
    nowhere = torch.full_like(scores[:, :1], -torch.inf)
    abstains = abstain.expand(nowhere.shape)
    others = scores.masked_fill(~(among | right), -torch.inf)
    right_abstains = torch.where(right.any(dim=-1, keepdim=True), nowhere, abstains)
    right_scores = torch.cat([scores.masked_fill(~right, -torch.inf), right_abstains], dim=-1)
    all_scores = torch.cat([others, abstains], dim=-1)
    return (all_scores.logsumexp(dim=-1) - right_scores.logsumexp(dim=-1)).sum() / max(len(slot), 1)


@final
@dataclass(frozen=True)
class FactLosses:
    """Three numbers: over pairs of which one moves, over input parts, over graphs."""

    body: Float[Tensor, ""]
    ajar: Float[Tensor, ""]
    piece: Float[Tensor, ""]


def of_moving(truth: SlotTruth) -> Bool[Tensor, "b s s"]:
    """Returns the pairs that are asked whether they move as one: those of which at least one moves."""
    known, moves = truth.bodies != NONE, truth.bodies > 0
    return truth.real_pairs & known[:, :, None] & known[:, None, :] & (moves[:, :, None] | moves[:, None, :])


def fact_losses(predictions: Predictions, truth: SlotTruth, ajar_positive: float = 1.0) -> FactLosses:
    """Returns the cross-entropies of what moves as one, what is drawn ajar, and what the whole is.

    What is drawn ajar weighs `ajar_positive` times what is not.
    """
    same = truth.bodies[:, :, None] == truth.bodies[:, None, :]
    pairs = functional.binary_cross_entropy_with_logits(predictions.body.float(), same.float(), reduction="none")
    weight = torch.full((), ajar_positive, device=predictions.ajar.device)
    slots = _existence(predictions.ajar.float(), truth.ajar == 1, weight)
    kinds = functional.cross_entropy(predictions.piece.float(), truth.piece.clamp(min=0), reduction="none")
    return FactLosses(
        body=mean_where(pairs, of_moving(truth)),
        ajar=mean_where(slots, truth.anchored & (truth.ajar != NONE)),
        piece=mean_where(kinds, truth.piece != NONE),
    )


@final
@dataclass(frozen=True)
class LossTerms:
    """The weighted sum, which is what is minimised, and each term before its weight."""

    total: Float[Tensor, ""]
    slots: SlotLosses
    pairs: PairLosses
    motions: MotionLosses
    facts: FactLosses

    def by_name(self) -> dict[str, Tensor]:
        """Returns every number without gradients, by name, the total first; the names are `LossConfig`'s weights."""
        terms = {"total": self.total} | vars(self.slots) | vars(self.pairs) | vars(self.motions)
        terms |= vars(self.facts)
        return {name: value.detach() for name, value in terms.items()}


def criterion(predictions: Predictions, targets: TargetBatch, config: LossConfig) -> LossTerms:
    """Returns the loss of a batch of predictions (supplement, Loss Function); losses are computed in float32."""
    matching = match_slots(predictions, targets, config)
    truth = slot_truth(predictions, targets, matching)
    slots = slot_losses(predictions, truth, config)
    pairs = pair_losses(predictions, truth, config.edge_kinds)
    motions = motion_losses(predictions, truth)
    facts = fact_losses(predictions, truth, config.ajar_positive)
    terms = vars(slots) | vars(pairs) | vars(motions) | vars(facts)
    total = torch.stack([getattr(config, name) * term for name, term in terms.items()]).sum()
    return LossTerms(total, slots, pairs, motions, facts)
