"""Predictions that say exactly what is wanted, to spoil one answer at a time, and wanted answers to start from."""

from collections.abc import Sequence

import numpy as np
import torch
from torch import Tensor
from torch.nn.functional import one_hot

from grafu.graph.edit import without_nodes
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.piece_facts import PieceFacts
from grafu.network.batch import Predictions
from grafu.training.loss_config import LossConfig
from grafu.training.matcher import SlotTruth, match_slots, slot_truth
from grafu.training.targets import NONE, GraphTargets, TargetBatch, graph_targets, stack_targets
from grafu.vocabulary import PieceKind
from small_graphs import cabinet

SURE = 30.0
ORDER = [node.id for node in cabinet().nodes]
place = ORDER.index


def targets_of(graph: FunctionalGraph, missing: Sequence[str] = ()) -> GraphTargets:
    given = [node.id for node in graph.nodes if node.id not in missing]
    bodies = {node.id: "" for node in graph.nodes} | {part: part for part in graph.moving}
    bodies |= {edge.child: edge.parent for edge in graph.attachments}
    facts = PieceFacts(PieceKind.CABINET, frozenset({"door_1"}), bodies)
    return graph_targets(graph, given, np.zeros(3), 1.0, facts=facts)


def two_cabinets() -> TargetBatch:
    """A whole cabinet that lacks two knobs, and a smaller one that lacks a shelf."""
    small = without_nodes(cabinet(), ["knob_3", "knob_4", "drawer_1", "drawer_2", "back"])
    return stack_targets([targets_of(cabinet(), ["knob_2", "knob_4"]), targets_of(small, ["shelf_1"])])


def perfect(targets: TargetBatch, free: int = 4) -> Predictions:
    """Sure and right answers; missing nodes are answered by the last of the free slots, in reverse order."""
    matching = torch.cat([targets.anchors, torch.full((len(targets.labels), free), NONE)], dim=1)
    mask = matching != NONE
    mask[:, targets.anchors.shape[1] :] = True
    for graph, row in enumerate(matching):
        wanted = targets.mask[graph].nonzero()[:, 0].tolist()
        missing = [node for node in wanted if node not in targets.anchors[graph].tolist()][:free]
        row[len(row) - len(missing) :] = torch.tensor(missing[::-1], dtype=torch.int64)
    blank = _blank(mask)
    truth = slot_truth(blank, targets, matching)
    return _answers(truth, mask)


def truth_of(predictions: Predictions, targets: TargetBatch, config: LossConfig = LossConfig()) -> SlotTruth:  # noqa: B008
    return slot_truth(predictions, targets, match_slots(predictions, targets, config))


def _blank(mask: Tensor) -> Predictions:
    b, s = mask.shape
    pairs = torch.zeros(b, s, s)
    return Predictions(
        exists=torch.zeros(b, s),
        category=torch.zeros(b, s, 14),
        centre=torch.zeros(b, s, 3),
        half=torch.zeros(b, s, 3),
        edge=torch.zeros(b, s, s, 5),
        parent=pairs,
        parent_abstain=torch.zeros(()),
        hinge_target=pairs,
        hinge_abstain=torch.zeros(()),
        border=torch.zeros(b, s, s, 4),
        sign=torch.zeros(b, s, s, 2),
        slide=torch.zeros(b, s, s, 6),
        body=pairs,
        ajar=torch.zeros(b, s),
        piece=torch.zeros(b, len(PieceKind)),
        mask=mask,
        padding=torch.zeros_like(mask),
    )


def _answers(truth: SlotTruth, mask: Tensor) -> Predictions:
    s = mask.shape[1]

    def code(values: Tensor, count: int) -> Tensor:
        return SURE * one_hot(values.clamp(min=0), count).float()

    def motion(values: Tensor, count: int) -> Tensor:
        return code(values, count)[:, :, None].expand(-1, -1, s, -1)

    return Predictions(
        exists=torch.where(truth.matched, SURE, -SURE),
        category=code(truth.labels, 14),
        centre=truth.boxes[..., :3],
        half=truth.boxes[..., 3:],
        edge=code(truth.edges, 5),
        parent=SURE * (truth.child & (truth.edges == 3)).float() - SURE / 2,
        parent_abstain=torch.zeros(()),
        hinge_target=SURE * (truth.child & (truth.edges == 1)).float() - SURE / 2,
        hinge_abstain=torch.zeros(()),
        border=motion(truth.border, 4),
        sign=motion(truth.sign, 2),
        slide=motion(truth.slide, 6),
        body=2 * SURE * (truth.bodies[:, :, None] == truth.bodies[:, None, :]).float() - SURE,
        ajar=2 * SURE * truth.ajar.clamp(min=0).float() - SURE,
        piece=code(truth.piece, len(PieceKind)),
        mask=mask,
        padding=torch.zeros_like(mask),
    )
