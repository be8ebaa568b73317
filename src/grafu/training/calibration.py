"""Calibrated probabilities: one temperature for each head, fitted on validation data and folded into its last layer.

A head's logits are divided by its temperature before the softmax; what is likeliest stays so, and the probability comes
close to how often it is right (Guo et al., On Calibration of Modern Neural Networks, 2017).
"""

from collections.abc import Iterable, Mapping, Sequence
from copy import deepcopy
from typing import NamedTuple

import torch
from torch import Tensor, nn
from torch.nn import functional

from grafu.graph.arrays import ALONG, HINGE, NONE, UNKNOWN
from grafu.network.batch import Predictions
from grafu.network.grafu import GraFu
from grafu.shapes import Bool, Float, Int64
from grafu.training.batching import TrainingBatch
from grafu.training.criterion import Choices, hinge_targets, nests, of_moving, parents
from grafu.training.loss_config import LossConfig
from grafu.training.matcher import SlotTruth, match_slots, slot_truth

HEADS = ("category", "edge", "parent", "hinge_target", "border", "sign", "slide", "body", "ajar", "piece")
_FACTS = ("body", "ajar", "piece")
"""The heads whose answers are classes; whether a slot exists is no choice that a report states."""
_RANGE = (0.25, 8.0)  # of temperatures: beyond it there are too few answers to fit one
_LEAST = 50  # answers that a temperature is fitted on
_STEPS = 40  # of a search by thirds: the range shrinks to a millionth


class Answers(NamedTuple):
    """The logits of k questions with c choices, and which choice is right."""

    logits: Float[Tensor, "k c"]
    right: Int64[Tensor, " k"]


@torch.inference_mode()
def temperatures(network: nn.Module, batches: Iterable[TrainingBatch], loss: LossConfig) -> dict[str, float]:
    """Returns the temperature of each head that makes the right answers of the batches likeliest; 1 where few ask."""
    found: dict[str, list[Answers]] = {name: [] for name in HEADS}
    device = next(network.parameters()).device
    was_training = network.training
    network.eval()
    for batch in batches:
        moved = batch.to(device)
        predictions = network(moved.graphs)
        truth = slot_truth(predictions, moved.targets, match_slots(predictions, moved.targets, loss))
        for name, answers in head_answers(predictions, truth, moved.graphs.labels).items():
            found[name].append(answers)
    network.train(was_training)
    return {name: fitted(answers) for name, answers in found.items()}


def calibrated(network: GraFu, by_head: Mapping[str, float]) -> GraFu:
    """Returns a copy of the network whose logits are divided by the temperature of each head."""
    made = deepcopy(network)
    with torch.no_grad():
        for name, temperature in by_head.items():
            if name in _FACTS and made.fact_heads is None:
                continue
            for weight in _last_weights(made, name):
                weight /= temperature
    return made


def head_answers(predictions: Predictions, truth: SlotTruth, given: Int64[Tensor, "b n"]) -> dict[str, Answers]:
    """Returns what each head is asked about input nodes, `given` being their labels, and what is right."""
    seen = truth.anchored[:, :, None] & truth.anchored[:, None, :] & truth.real_pairs
    hidden = functional.pad(given, (0, truth.labels.shape[1] - given.shape[1]), value=0) == UNKNOWN
    asked = truth.anchored & hidden & (truth.labels != UNKNOWN)
    hinges = truth.child & (truth.edges == HINGE) & seen
    along = truth.child & torch.isin(truth.edges, torch.tensor(ALONG, device=truth.edges.device)) & seen
    hung = hinge_targets(truth, nests(predictions))
    same, known = truth.bodies[:, :, None] == truth.bodies[:, None, :], truth.piece != NONE
    return {
        "category": Answers(predictions.category[asked], truth.labels[asked]),
        "edge": Answers(predictions.edge[seen], truth.edges[seen]),
        "parent": _choices(predictions.parent, predictions.parent_abstain, parents(truth), seen),
        "hinge_target": _choices(predictions.hinge_target, predictions.hinge_abstain, hung, seen),
        "border": _codes(predictions.border, truth.border, hinges),
        "sign": _codes(predictions.sign, truth.sign, hinges),
        "slide": _codes(predictions.slide, truth.slide, along),
        "body": _yes_or_no(predictions.body, same, of_moving(truth) & seen),
        "ajar": _yes_or_no(predictions.ajar, truth.ajar == 1, truth.anchored & (truth.ajar != NONE)),
        "piece": Answers(predictions.piece[known], truth.piece[known]),
    }


def _yes_or_no(logits: Tensor, right: Tensor, asked: Tensor) -> Answers:
    """Returns a logit as the choice between no, whose logit is 0, and yes."""
    found = logits[asked]
    return Answers(torch.stack([torch.zeros_like(found), found], dim=-1), right[asked].long())


def _choices(
    scores: Float[Tensor, "b s s"], abstain: Float[Tensor, ""], choices: Choices, seen: Bool[Tensor, "b s s"]
) -> Answers:
    """Returns the choice of one slot among those seen, or of none; of several right ones the likeliest counts."""
    among, right = choices.among & seen, choices.right & seen
    graph, slot = (choices.chooses & among.any(dim=2)).nonzero(as_tuple=True)
    among, right, scores = among[graph, slot], right[graph, slot], scores[graph, slot]
    logits = torch.cat([scores.masked_fill(~(among | right), -torch.inf), abstain.expand(len(scores), 1)], dim=1)
    best = scores.masked_fill(~right, -torch.inf).argmax(dim=1)
    return Answers(logits, torch.where(right.any(dim=1), best, logits.shape[1] - 1))


def _codes(logits: Float[Tensor, "b s s c"], codes: Int64[Tensor, "b s"], edges: Tensor) -> Answers:
    graph, child, carrier = (edges & (codes != NONE)[:, :, None]).nonzero(as_tuple=True)
    return Answers(logits[graph, child, carrier], codes[graph, child])


def fitted(answers: Sequence[Answers]) -> float:
    """Returns the temperature at which the cross-entropy of all answers is least; 1 where they are few."""
    if sum(len(one.right) for one in answers) < _LEAST:
        return 1.0
    wide = max(one.logits.shape[1] for one in answers)
    # Choices among slots: abstaining is last, whatever the number of slots.
    logits = torch.cat(
        [functional.pad(one.logits, (wide - one.logits.shape[1], 0), value=-torch.inf) for one in answers]
    )
    right = torch.cat([one.right + wide - one.logits.shape[1] for one in answers])
    return _least(logits.double(), right)


def _least(logits: Tensor, right: Tensor) -> float:
    """Returns the temperature of the least cross-entropy: it is convex in the inverse temperature."""
    low, high = 1.0 / _RANGE[1], 1.0 / _RANGE[0]
    for _ in range(_STEPS):
        third = (high - low) / 3
        a, b = (float(functional.cross_entropy(logits * x, right)) for x in (low + third, high - third))
        low, high = (low, high - third) if a <= b else (low + third, high)
    return 2.0 / (low + high)


def _last_weights(network: GraFu, head: str) -> list[Tensor]:
    """Returns what a head's logits are proportional to: the weights and biases of its last layer, and of abstaining."""
    if head == "category":
        return list(_last_linear(network.slot_heads.category).parameters())
    if head in _FACTS:
        return list(_last_linear(getattr(network.fact_heads, head)).parameters())
    owner = network.pair_heads if head in ("edge", "parent", "hinge_target") else network.motion_heads
    weights: list[Tensor] = list(_last_linear(getattr(owner, head)).parameters())
    abstain = {"parent": network.pair_heads.parent_abstain, "hinge_target": network.pair_heads.hinge_abstain}
    return [*weights, abstain[head]] if head in abstain else weights


def _last_linear(head: nn.Module) -> nn.Linear:
    *_, last = (module for module in head.modules() if isinstance(module, nn.Linear))
    return last
