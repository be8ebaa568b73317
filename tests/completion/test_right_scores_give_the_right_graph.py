"""A network that knows the truth about synthetic furniture: the decode loses nothing that matters of it."""

import numpy as np
import pytest

from grafu.completion.decode_config import ADDABLE, DecodeConfig
from grafu.completion.features import FeatureConfig, GraphFeatures, Scores
from grafu.completion.network import complete_by_network
from grafu.completion.session import GraphNetwork
from grafu.graph.arrays import EDGE_CODES, graph_arrays
from grafu.graph.edit import relabelled
from grafu.graph.functional_graph import FunctionalGraph
from grafu.metrics.graph_accuracy import Ratio, graph_accuracy, total_accuracy
from grafu.synth.generate import make_specimen
from grafu.vocabulary import PartLabel, PieceKind

FEW = FeatureConfig(points=16, anchors=2, neighbours=2)
FREE, SURE = 4, np.float32(6.0)
AS_SEEN = DecodeConfig(mirror=False)  # the oracle answers as the piece was made, not as its mirror image


def oracle(truth: FunctionalGraph) -> GraphNetwork:
    """Returns the network that knows the whole graph; it tells parts by their boxes, and adds what it does not see."""
    known = graph_arrays(truth)

    def one_hot(codes: np.ndarray, count: int) -> np.ndarray:
        return SURE * (np.maximum(codes, 0)[..., None] == np.arange(count)).astype(np.float32)

    def by_child(codes: np.ndarray, count: int) -> np.ndarray:
        return np.repeat(one_hot(codes, count)[:, None], len(codes), axis=1)

    def answer(features: GraphFeatures) -> Scores:
        boxes = features.boxes * features.scale
        boxes[:, :3] += features.origin.astype(np.float32)
        seen = np.abs(boxes[:, None] - known.boxes[None]).max(axis=2).argmin(axis=1)
        unseen = [k for k in range(len(known.labels)) if k not in seen and truth.nodes[k].label in ADDABLE][:FREE]
        exists = np.arange(len(seen) + FREE) < len(seen) + len(unseen)
        of = np.concatenate([seen, unseen, np.zeros(FREE - len(unseen))]).astype(np.int64)
        chosen = SURE * known.child[np.ix_(of, of)].astype(np.float32)
        return Scores(
            exists=np.where(exists, SURE, -SURE),
            category=one_hot(known.labels[of], len(PartLabel)),
            centre=((known.boxes[of, :3] - features.origin) / features.scale).astype(np.float32),
            half=(known.boxes[of, 3:] / features.scale).astype(np.float32),
            edge=one_hot(known.edges[np.ix_(of, of)], EDGE_CODES["all"]) * 2,
            parent=chosen,
            parent_abstain=-2.0,
            hinge_target=chosen,
            hinge_abstain=-2.0,
            border=by_child(known.border[of], 4),
            sign=by_child(known.sign[of], 2),
            slide=by_child(known.slide[of], 6),
            body=np.zeros((len(of), len(of)), np.float32),
            ajar=np.full(len(of), -SURE, np.float32),
            piece=np.zeros(len(PieceKind), np.float32),
        )

    return answer


@pytest.mark.parametrize("masked", [False, True])
def test_what_is_known_is_found(masked: bool) -> None:
    figures = []
    for index in range(20):
        made = make_specimen(18, index, 0)
        if made.family == "drop-leaf table" or any(defect.kind == "mislabelled" for defect in made.defects):
            continue  # what shape decides, and labels that are kept though they are wrong
        if any(defect.kind == "floating" and any("track" in part for part in defect.parts) for defect in made.defects):
            continue  # a track that touches no door: shape decides what carries a sliding one
        masks = {node.id: PartLabel.UNKNOWN for node in made.given.nodes} if masked else {}
        given = relabelled(made.given, masks)
        completion = complete_by_network(given, oracle(made.truth), FEW, AS_SEEN)
        figures.append(graph_accuracy(completion, made.truth))
    total = total_accuracy(figures)

    assert total.joint.whole > 0
    assert total.slide.whole > 0
    for found in (total.slides, total.turns):
        assert found == Ratio(found.whole, found.whole)
        assert found.whole > 0
    for name in ("category", "hinge", "rail", "joint", "slide", "mount"):
        assert getattr(total, name).value == 1.0
    assert min(total.existence.value, total.parent.value, total.attached.value, total.contact.value) > 0.97
