"""What the generator returns: furniture as an artist models it, and its ground truth. It draws nothing at random."""

from functools import cached_property
from typing import Literal, final

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.errors import GraphError
from grafu.graph.edit import as_contacts, relabelled, without_contacts, without_nodes
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.piece_facts import STATIC, PieceFacts
from grafu.synth.pieces.riding import bodies_of
from grafu.vocabulary import PieceKind

DefectKind = Literal[
    "missing",  # a part that the repaired version holds is not there
    "interpenetrating",  # a part was shifted or grown into a neighbour
    "floating",  # a part was shifted away from what carries it
    "ajar",  # a moving part was modelled a little open
    "mislabelled",  # a part carries the label of something else
]


@final
@dataclass(frozen=True, slots=True)
class Defect:
    """A flaw that was put in on purpose, and the parts that it concerns."""

    kind: DefectKind
    parts: tuple[str, ...]


@final
@dataclass(frozen=True)
class Specimen:
    """One made piece of furniture.

    `asset` is what a reader would load: parts may be missing, labels unknown, meshes noisy; it states no joints.
    `whole` is its repaired version: the same parts in the same places and those that were missing, all with true
    labels, with the true joints (`AnnotatedJoint`, lower 0) and attached parts. `truth` is the functional graph of
    `whole`: one node per part in the same order, with boxes, points, contacts, hinges, rails and attachments.
    `removable` are the parts that a completion may be asked to restore when they are missing: no moving part, none that
    carries one. `apart` are the pairs that a functional edge of `truth` joins though they do not touch: a drawer and
    the walls that carry its rails, a centimetre beside it. `kind` is what the whole is.

    Raises:
        GraphError: if the three disagree about their parts.
    """

    id: str
    family: str
    asset: Asset
    whole: Asset
    truth: FunctionalGraph
    removable: frozenset[str]
    defects: tuple[Defect, ...] = ()
    apart: frozenset[frozenset[str]] = frozenset()
    kind: PieceKind | None = None

    def __post_init__(self) -> None:
        given, whole = [p.id for p in self.asset.parts], [p.id for p in self.whole.parts]
        if [n.id for n in self.truth.nodes] != whole:
            raise GraphError(f"the truth of `{self.id}` must have one node per part of the whole, in order")
        if not set(given) <= set(whole):
            raise GraphError(f"the whole of `{self.id}` lacks parts of its asset: {sorted(set(given) - set(whole))}")
        if not self.removable <= set(whole):
            raise GraphError(f"`removable` of `{self.id}` names no parts: {sorted(self.removable - set(whole))}")

    @cached_property
    def facts(self) -> PieceFacts:
        """What the piece is, which parts are drawn ajar, and which move as one."""
        moving = {joint.part for joint in self.whole.joints}
        bodies = {part: body if body in moving else STATIC for part, body in bodies_of(self.whole).items()}
        ajar = {part for defect in self.defects if defect.kind == "ajar" for part in defect.parts}
        return PieceFacts(self.kind, frozenset(ajar), bodies)

    @property
    def missing(self) -> tuple[str, ...]:
        """The ids of the parts that the asset lacks, in the order of the whole."""
        given = {part.id for part in self.asset.parts}
        return tuple(part.id for part in self.whole.parts if part.id not in given)

    @cached_property
    def given(self) -> FunctionalGraph:
        """The graph of the asset as it was modelled: contacts only, labels as given, nodes in the truth's order."""
        graph = without_contacts(as_contacts(without_nodes(self.truth, self.missing)), self.apart)
        return relabelled(graph, {part.id: part.label for part in self.asset.parts})
