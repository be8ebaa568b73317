"""One learning example: a graph that lacks something and the whole functional graph.

What one model of a data set is, as a network is taught with it: two graphs and a few words.
"""

from dataclasses import replace
from functools import cached_property
from typing import final

from grafu.dataclass import dataclass
from grafu.errors import GraphError
from grafu.graph.edges import ends_of
from grafu.graph.edit import as_contacts
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.piece_facts import NOT_KNOWN, PieceFacts
from grafu.synth.specimen import Defect, Specimen

NATURAL = "natural"  # the strategy of a pair that nothing was taken from on purpose


@final
@dataclass(frozen=True)
class GraphPair:
    """What a network is given and what it is to answer: the paper's non-functional and functional graph.

    A node of the input is anchored to the node of the target that has its id: the same part in the same place, but
    perhaps with another label, and with edges of its own. `strategy` names how the input was made (`natural`, or one
    of `grafu.data.corruption`), `model_id` the model that both show, the same for all its pairs. `facts` are what is
    known of the piece beside its graph.

    Raises:
        GraphError: if a node of the input is not one of the target, or its box is another.
    """

    input: FunctionalGraph
    target: FunctionalGraph
    strategy: str
    model_id: str
    facts: PieceFacts = NOT_KNOWN

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
    """Returns the natural pair of synthetic furniture: as it was modelled, and its true graph."""
    return GraphPair(specimen.given, specimen.truth, NATURAL, specimen.id, specimen.facts)


def natural_pair(target: FunctionalGraph) -> GraphPair:
    """Returns the pair of a functional graph and the same parts at rest, whose edges are all contacts."""
    return GraphPair(as_contacts(target), target, NATURAL, target.model_id)


def _require_same_box(given: PartNode, wanted: PartNode, model_id: str) -> None:
    if given.box is not wanted.box and given.box != wanted.box:
        raise GraphError(
            f"a node must have one box in input and target: `{given.id}` of `{model_id}` has {given.box}, {wanted.box}"
        )


@final
@dataclass(frozen=True)
class Record:
    """One model of a data set: `given` is what a network sees, `truth` what it is to say.

    The nodes of `given` are nodes of `truth` in the same order, with the same boxes and points; their labels may
    differ. `removable`, `defects` and `facts` are as in `Specimen`.

    Raises:
        GraphError: if the graphs carry another name than the model, or `given` holds what `truth` does not.
    """

    model_id: str
    family: str
    given: FunctionalGraph
    truth: FunctionalGraph
    removable: frozenset[str] = frozenset()
    defects: tuple[Defect, ...] = ()
    facts: PieceFacts = NOT_KNOWN

    def __post_init__(self) -> None:
        if not self.given.model_id == self.truth.model_id == self.model_id:
            names = f"`{self.given.model_id}` and `{self.truth.model_id}`"
            raise GraphError(f"both graphs of a record must be named `{self.model_id}` as it is: got {names}")
        _require_same_nodes(self)
        if not all(part in self.truth for part in self.removable):
            raise GraphError(f"`removable` of `{self.model_id}` must name nodes: got {sorted(self.removable)}")

    @property
    def missing(self) -> tuple[str, ...]:
        """The ids of the nodes that `given` lacks, in the order of `truth`."""
        return tuple(node.id for node in self.truth.nodes if node.id not in self.given)


def record_of(specimen: Specimen) -> Record:
    """Returns the specimen without its meshes; both graphs take its id."""
    return Record(
        specimen.id,
        specimen.family,
        _named(specimen.given, specimen.id),
        _named(specimen.truth, specimen.id),
        specimen.removable,
        specimen.defects,
        specimen.facts,
    )


def record_pair(record: Record) -> GraphPair:
    """Returns the natural pair of a record, from which `fold` makes corrupted ones."""
    return GraphPair(record.given, record.truth, NATURAL, record.model_id, record.facts)


def _named(graph: FunctionalGraph, name: str) -> FunctionalGraph:
    return graph if graph.model_id == name else replace(graph, model_id=name)


def _require_same_nodes(record: Record) -> None:
    known = {node.id: (place, node) for place, node in enumerate(record.truth.nodes)}
    last = -1
    for node in record.given.nodes:
        place, true_node = known.get(node.id, (-1, None))
        if true_node is None or place <= last or not _is_same(node, true_node):
            raise GraphError(
                f"`given` of `{record.model_id}` must hold nodes of `truth` in its order, with their boxes, points and "
                f"source names: got `{node.id}`"
            )
        last = place


def _is_same(a: PartNode, b: PartNode) -> bool:
    """Whether two nodes differ in nothing but their label; shared arrays, the usual case, are not compared."""
    same_box = a.box is b.box or a.box == b.box
    same_points = a.points is b.points or a.points == b.points
    return same_box and same_points and a.source_name == b.source_name and a.transparent == b.transparent
