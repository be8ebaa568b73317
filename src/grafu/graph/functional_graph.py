"""The functional graph: parts as nodes, six kinds of edges, and every invariant checked when it is made.

The paper's three attributes of a node are its label, its box and its points. It holds no meshes.
"""

from collections.abc import Iterable, Mapping, Set
from dataclasses import replace
from functools import cached_property
from typing import assert_never, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.errors import GraphError
from grafu.geometry.box import Box
from grafu.geometry.sampling import PointCloud
from grafu.graph.edges import Attached, Contact, Edge, Hinge, MotionEdge, Rail, Slide, Turn, ends_of, kind_of, motion_of
from grafu.vocabulary import PartLabel


def joined_groups(neighbours: Mapping[str, Iterable[str]]) -> list[frozenset[str]]:
    """Returns the groups of nodes that are connected by a path, in the order of their first nodes.

    `neighbours` names for each node those that it is joined to, in both directions.
    """
    groups: list[frozenset[str]] = []
    seen: set[str] = set()
    for first in neighbours:
        if first in seen:
            continue
        group, queue = {first}, [first]
        while queue:
            reached = set(neighbours[queue.pop()]) - group
            group |= reached
            queue += reached
        seen |= group
        groups.append(frozenset(group))
    return groups


@final
@dataclass(frozen=True, slots=True)
class PartNode:
    """One part: `box` and `points` in the object frame, metres; `source_name` is the input's own word for it.

    `transparent` is the fraction of its surface that is glass; a GraphError is raised if it is not in 0..1.
    """

    id: str
    label: PartLabel
    box: Box
    points: PointCloud | None = None
    source_name: str = ""
    transparent: float = 0.0

    def __post_init__(self) -> None:
        if not 0.0 <= self.transparent <= 1.0:
            raise GraphError(f"the transparent fraction of `{self.id}` must be 0..1: got {self.transparent}")


@final
@dataclass(frozen=True, repr=False)
class FunctionalGraph:
    """Nodes in a fixed order (the network's slots) and edges without doubles.

    An unknown label may stand for any part, so that a graph whose labels are masked keeps its edges. A door or drawer
    may carry a moving part where an edge moves it itself.

    Raises:
        GraphError: if ids repeat or are empty, an edge dangles, joins a part to itself or doubles another, an edge
            breaks the type system, a handle has two parents, two edges of one moving part state
            different motions, moving parts carry one another in a circle, or one follows what is no other part.
    """

    model_id: str
    nodes: tuple[PartNode, ...]
    edges: tuple[Edge, ...] = ()

    def __repr__(self) -> str:
        return f"<FunctionalGraph {self.model_id}: {len(self.nodes)} nodes, {len(self.edges)} edges>"

    def __post_init__(self) -> None:
        _require_unique_ids(self.nodes)
        _require_simple_edges(self.edges, self._by_id)
        for edge in self.edges:
            _require_types(edge, self._by_id, self.moving)
        _require_one_parent(self.edges)
        _require_one_motion(self.edges)
        _require_leaders(self.motions, self._by_id)
        _require_no_circle(self.motions)

    @cached_property
    def _by_id(self) -> dict[str, PartNode]:
        return {node.id: node for node in self.nodes}

    def node(self, node_id: str) -> PartNode:
        """Returns the node with this id.

        Raises:
            GraphError: if there is none.
        """
        if node_id not in self._by_id:
            raise GraphError(f"graph `{self.model_id}` has no node `{node_id}`: its nodes are {list(self._by_id)[:12]}")
        return self._by_id[node_id]

    def __contains__(self, node_id: str) -> bool:
        return node_id in self._by_id

    def labelled(self, *labels: PartLabel) -> tuple[PartNode, ...]:
        """Returns the nodes that carry one of these labels, in order."""
        return tuple(node for node in self.nodes if node.label in labels)

    @cached_property
    def box(self) -> Box:
        """The box around all nodes; a graph without nodes has an empty box at the origin."""
        if not self.nodes:
            return Box(np.zeros(3), np.zeros(3))
        lows, highs = [n.box.low for n in self.nodes], [n.box.high for n in self.nodes]
        return Box(np.min(lows, axis=0), np.max(highs, axis=0))

    @cached_property
    def contacts(self) -> tuple[Contact, ...]:
        """The contact edges, in order."""
        return tuple(e for e in self.edges if isinstance(e, Contact))

    @cached_property
    def attachments(self) -> tuple[Attached, ...]:
        """The attached edges, in order."""
        return tuple(e for e in self.edges if isinstance(e, Attached))

    @cached_property
    def hinges(self) -> tuple[Hinge, ...]:
        """The hinge edges, in order."""
        return tuple(e for e in self.edges if isinstance(e, Hinge))

    @cached_property
    def rails(self) -> tuple[Rail, ...]:
        """The rail edges, in order."""
        return tuple(e for e in self.edges if isinstance(e, Rail))

    @cached_property
    def slides(self) -> tuple[Slide, ...]:
        """The slide edges, in order."""
        return tuple(e for e in self.edges if isinstance(e, Slide))

    @cached_property
    def motions(self) -> tuple[MotionEdge, ...]:
        """The edges that state motions (hinges, rails, slides and turns), in order."""
        return tuple(e for e in self.edges if isinstance(e, MotionEdge))

    @cached_property
    def moving(self) -> frozenset[str]:
        """The ids of the parts that an edge moves."""
        return frozenset(edge.child for edge in self.motions)

    def motions_of(self, part: str) -> tuple[MotionEdge, ...]:
        """Returns the edges that state how a part moves, in order."""
        return tuple(edge for edge in self.motions if edge.child == part)

    def carrier_of(self, part: str) -> str:
        """Returns the moving part that carries a moving part; "" where a static part does."""
        return next((edge.parent for edge in self.motions_of(part) if edge.parent in self.moving), "")

    @cached_property
    def neighbours(self) -> dict[str, tuple[str, ...]]:
        """For each id, the ids that an edge of any kind joins it to, in edge order."""
        found: dict[str, list[str]] = {node.id: [] for node in self.nodes}
        for edge in self.edges:
            a, b = ends_of(edge)
            found[a].append(b)
            found[b].append(a)
        return {node_id: tuple(ids) for node_id, ids in found.items()}


def is_allowed(edge: Edge, parent: PartLabel, child: PartLabel, *, parent_moves: bool = False) -> bool:
    """Whether the type system allows this edge between these labels; for a contact, any two.

    The paper's is that of parents that do not move; a door or drawer that moves may carry what moves on it.
    """
    unknown = PartLabel.UNKNOWN
    carries = parent.is_support or (parent_moves and parent.is_movable)
    match edge:
        case Contact():
            return True
        case Hinge():
            return child in (PartLabel.DOOR, unknown) and carries
        case Rail():
            return child in (PartLabel.DRAWER, unknown) and carries
        case Slide():
            return child is not PartLabel.DRAWER and carries
        case Turn():
            return carries
        case Attached():
            return child in (PartLabel.HANDLE, unknown) and (parent.is_movable or parent is unknown)
        case _:
            assert_never(edge)


def allowed_edges(edges: Iterable[Edge], label_of: Mapping[str, PartLabel]) -> tuple[Edge, ...]:
    """Returns the edges, those as contacts that these labels forbid, or whose parent moves no more because of that."""
    given = tuple(edges)
    moving = {edge.child for edge in given if isinstance(edge, MotionEdge)}
    made = tuple(edge if _fits(edge, label_of, moving) else Contact(*ends_of(edge)) for edge in given)
    return made if made == given else allowed_edges(made, label_of)


def paper_edges(graph: FunctionalGraph) -> tuple[Edge, ...]:
    """Returns the edges as the paper's four kinds can state them.

    Of a slide, a turn, and a motion on a door or drawer they state that the two parts touch; that one follows another
    is left out.
    """
    return tuple(_as_paper(edge, graph.node(ends_of(edge)[0]).label) for edge in graph.edges)


def _as_paper(edge: Edge, parent: PartLabel) -> Edge:
    if not isinstance(edge, MotionEdge):
        return edge
    if isinstance(edge, Slide | Turn) or parent.is_movable:
        return Contact(*ends_of(edge))
    return edge if edge.coupling is None else replace(edge, coupling=None)


def _fits(edge: Edge, label_of: Mapping[str, PartLabel], moving: Set[str]) -> bool:
    parent, child = ends_of(edge)
    return is_allowed(edge, label_of[parent], label_of[child], parent_moves=parent in moving)


def _require_unique_ids(nodes: tuple[PartNode, ...]) -> None:
    seen: set[str] = set()
    for node in nodes:
        if not node.id:
            raise GraphError("node ids must not be empty: give every part a name")
        if node.id in seen:
            raise GraphError(f"node ids must be unique: got `{node.id}` more than once")
        seen.add(node.id)


def _require_simple_edges(edges: Iterable[Edge], known: dict[str, PartNode]) -> None:
    seen: set[frozenset[str]] = set()
    for edge in edges:
        ends = ends_of(edge)
        for end in ends:
            if end not in known:
                raise GraphError(f"both ends of an edge must be nodes: got {edge}, there is no node `{end}`")
        if ends[0] == ends[1]:
            raise GraphError(f"an edge must join two parts: got {edge}")
        if frozenset(ends) in seen:
            raise GraphError(f"two parts must share at most one edge: got a second one, {edge}")
        seen.add(frozenset(ends))


def _require_types(edge: Edge, known: dict[str, PartNode], moving: Set[str]) -> None:
    parent, child = (known[end].label for end in ends_of(edge))
    if not is_allowed(edge, parent, child, parent_moves=ends_of(edge)[0] in moving):
        rules = (
            "a hinge joins a door, a rail a drawer, a slide what is no drawer to a support or to what moves, attached "
            "a door or drawer and its handle"
        )
        raise GraphError(f"{rules}: got {kind_of(edge)} from {parent} to {child}, {edge}")


def _require_one_parent(edges: Iterable[Edge]) -> None:
    seen: set[str] = set()
    for edge in edges:
        if isinstance(edge, Attached):
            if edge.child in seen:
                raise GraphError(f"a handle must be attached to one part: got a second parent in {edge}")
            seen.add(edge.child)


def _require_one_motion(edges: Iterable[Edge]) -> None:
    first: dict[str, MotionEdge] = {}
    for edge in edges:
        if isinstance(edge, MotionEdge) and motion_of(first.setdefault(edge.child, edge)) != motion_of(edge):
            raise GraphError(
                f"all edges of a moving part must state one motion: `{edge.child}` has {first[edge.child]} and {edge}"
            )


def _require_leaders(edges: Iterable[MotionEdge], known: Mapping[str, PartNode]) -> None:
    for edge in edges:
        if edge.coupling is not None and (edge.coupling.leader not in known or edge.coupling.leader == edge.child):
            raise GraphError(f"a moving part must follow another part of the graph: got {edge}")


def _require_no_circle(edges: Iterable[MotionEdge]) -> None:
    """Raises where a part would be carried by what it carries itself."""
    parents: dict[str, set[str]] = {}
    for edge in edges:
        parents.setdefault(edge.child, set()).add(edge.parent)
    for part in parents:
        above, queue = set[str](), [part]
        while queue:
            new = parents.get(queue.pop(), set()) - above
            above |= new
            queue += new
        if part in above:
            raise GraphError(f"moving parts must not carry one another in a circle: `{part}` carries itself")
