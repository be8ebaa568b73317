"""One learning example: a graph that lacks something and the whole functional graph. It draws nothing at random."""

from dataclasses import dataclass
from functools import cached_property
from typing import final

from grafu.errors import GraphError
from grafu.graph.edges import ends_of
from grafu.graph.edit import as_contacts
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.synth.specimen import Specimen

NATURAL = "natural"  # the strategy of a pair that nothing was taken from on purpose


@final
@dataclass(frozen=True)
class GraphPair:
    """What a network is given and what it is to answer: the paper's non-functional and functional graph.

    A node of the input is anchored to the node of the target that has its id: the same part in the same place, but
    perhaps with another label, and with edges of its own. `strategy` names how the input came about (`natural`, or one
    of `grafu.data.corruption`), `model_id` the model that both show, the same for all its pairs.

    Raises:
        GraphError: if a node of the input is not one of the target, or its box is another.
    """

    input: FunctionalGraph
    target: FunctionalGraph
    strategy: str
    model_id: str

    def __post_init__(self) -> None:
        for node in self.input.nodes:
            if node.id not in self.target:
                raise GraphError(f"nodes of the input must be in the target: `{self.model_id}` lacks `{node.id}`")
            _require_same_box(node, self.target.node(node.id), self.model_id)

    @property
    def missing(self) -> tuple[str, ...]:
        """The ids of the nodes that the input lacks, in the target's order."""
        return tuple(node.id for node in self.target.nodes if node.id not in self.input)

    @cached_property
    def apart(self) -> frozenset[frozenset[str]]:
        """The pairs of input nodes that an edge of the target joins and none of the input.

        In a natural pair they are parts that do not touch, such as a drawer and the walls beside it.
        """
        joined = {frozenset(ends_of(e)) for e in self.input.edges}
        wanted = (ends_of(e) for e in self.target.edges)
        return frozenset(frozenset(e) for e in wanted if e[0] in self.input and e[1] in self.input) - joined


def specimen_pair(specimen: Specimen) -> GraphPair:
    """Returns the natural pair of made furniture: as it was modelled, and its true graph."""
    return GraphPair(specimen.given, specimen.truth, NATURAL, specimen.id)


def natural_pair(target: FunctionalGraph) -> GraphPair:
    """Returns the pair of a functional graph and the same parts at rest, whose edges are all contacts."""
    return GraphPair(as_contacts(target), target, NATURAL, target.model_id)


def _require_same_box(given: PartNode, wanted: PartNode, model_id: str) -> None:
    if given.box is not wanted.box and given.box != wanted.box:
        raise GraphError(
            f"a node must have one box in input and target: `{given.id}` of `{model_id}` has {given.box}, {wanted.box}"
        )
