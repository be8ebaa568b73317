"""The three ways in which a model is asked about, where a network is judged. They are drawn once and stay the same."""

from collections.abc import Mapping

from grafu.data.corruption.config import PAPER, CorruptionConfig
from grafu.data.corruption.corrupt import fold
from grafu.data.pair import GraphPair
from grafu.graph.edit import as_contacts, relabelled
from grafu.vocabulary import PartLabel

VARIANTS = ("natural", "masked", "lacking")
"""Each model as it was found, that with its labels hidden, and one from which the paper's corruptions took away."""

MASKED = "natural, labels masked"  # named beside the strategies of corruption

LACKING = CorruptionConfig(
    weights=tuple(
        (name, 0.0)
        for name in (
            "fully_anonymized",  # a variant of its own
            "mask_materials_keep_edges",
            "mask_random_edges_keep_types",
            "drop_nodes_keep_edge_types",
            "fully_functional_drop",  # in use, an input never knows the kinds of its edges
            "drop_doors",
            "drop_drawers",
        )
    ),
    mirror_probability=0.0,
    label_masking=PAPER.label_masking,
)


def asked_pairs(natural: GraphPair, number: int) -> Mapping[str, GraphPair]:
    """Returns the pairs of model `number` by variant."""
    return {
        "natural": natural,
        "masked": masked_pair(natural),
        "lacking": fold(natural, number, config=LACKING),
    }


def masked_pair(natural: GraphPair) -> GraphPair:
    """Returns a natural pair with every label of the input hidden."""
    hidden = {node.id: PartLabel.UNKNOWN for node in natural.input.nodes}
    return GraphPair(relabelled(as_contacts(natural.input), hidden), natural.target, MASKED, natural.model_id)
