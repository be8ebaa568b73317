"""A release on disk as pairs, read one model at a time: FurFun-233, PN-M, HSSD, or one written by `write`.

The two graphs of one model become one pair: they say which nodes are the same part.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import final

import numpy as np

from grafu.data.furfun.graph_files import GraphFile, load_graph_json, read_graph_file, why_skipped, with_points
from grafu.data.furfun.layout import FurFunLayout, find_layout
from grafu.data.furfun.points import PointFolder
from grafu.data.furfun.split import Split, read_split, split_models
from grafu.data.pair import NATURAL, GraphPair
from grafu.dataclass import dataclass
from grafu.errors import AssetError, GraphError
from grafu.graph.edges import Contact, Edge, ends_of, kind_of
from grafu.graph.functional_graph import FunctionalGraph, is_allowed

SAME_PLACE = 0.05  # the authors': centres of one part in both graphs are nearer, in the file's unit
_NOTED = 1e-3  # boxes that differ by more are worth a word; a millimetre where the unit is a metre

EdgeKinds = Mapping[frozenset[str], str]


def paired(
    given: FunctionalGraph, target: FunctionalGraph, kinds: EdgeKinds, model_id: str
) -> tuple[GraphPair, tuple[str, ...]]:
    """Returns the pair of a model's input and functional graph, and what was changed to make it one, in words.

    A node of the input is the node of the target with its name, if their centres are near; another is left out. Box
    and points are the target's then, in which its motion codes are stated. `kinds` are the kinds of the input's edges
    as its file states them: a functional one holds if the target has it too, and takes the target's motion.

    Raises:
        GraphError: if the two share no node.
    """
    anchored = {n.id for n in given.nodes if n.id in target and _distance(given, target, n.id) < SAME_PLACE}
    if not anchored:
        raise GraphError(f"input and functional graph of `{model_id}` must share parts: they have none in common")
    notes = [f"left out a part of the input that the target lacks: {n.id}" for n in given.nodes if n.id not in anchored]
    nodes = tuple(
        replace(n, box=target.node(n.id).box, points=target.node(n.id).points) for n in given.nodes if n.id in anchored
    )
    shift = max(
        float(np.abs(n.box.center - target.node(n.id).box.center).max()) for n in given.nodes if n.id in anchored
    )
    if shift > _NOTED:
        notes.append(f"took the boxes of the functional graph: those of the input lie up to {shift:.3f} beside them")
    bare = FunctionalGraph(target.model_id, nodes)
    true = {frozenset(ends_of(e)): e for e in target.edges}
    edges = tuple(_edge(e, bare, true, kinds) for e in given.edges if anchored.issuperset(ends_of(e)))
    return GraphPair(replace(bare, edges=edges), target, NATURAL, model_id), tuple(notes)


def _distance(given: FunctionalGraph, target: FunctionalGraph, node_id: str) -> float:
    return float(np.linalg.norm(given.node(node_id).box.center - target.node(node_id).box.center))


def _edge(edge: Edge, given: FunctionalGraph, true: Mapping[frozenset[str], Edge], kinds: EdgeKinds) -> Edge:
    ends = ends_of(edge)
    found = true.get(frozenset(ends))
    if found is None or kind_of(found).value != kinds.get(frozenset(ends)):
        return Contact(*ends)
    parent, child = (given.node(end).label for end in ends_of(found))
    return found if is_allowed(found, parent, child) else Contact(*ends)


@final
@dataclass(frozen=True)
class FurFunModel:
    """One model of a release: its input graph, the whole one where the release has it, and notes on the reading."""

    id: str
    input: FunctionalGraph
    pair: GraphPair | None
    notes: tuple[str, ...]


@final
@dataclass(frozen=True)
class FurFunFolder:
    """The folder of a release; it is asked for models by id and keeps none of them.

    Units are the files'. `points` is the number of points on each part (0: none), drawn with `seed` where a file has
    more. Graphs without nodes are left out, and so are annotated functional graphs that fall apart (the authors' loader
    does the same; `keep_disconnected` keeps them; ours are kept). No graph is too large.

    Raises:
        UnreadableAsset: if the folder is not laid out like a release.
    """

    path: Path
    points: int = 512  # the authors'
    seed: int = 0
    keep_disconnected: bool = False

    def __post_init__(self) -> None:
        if self.points < 0 or self.seed < 0:
            raise ValueError(f"`points` and `seed` must not be negative: got {self.points}, {self.seed}")
        self.layout  # noqa: B018  # a folder of another kind is refused now

    def __reduce__(self) -> tuple[type["FurFunFolder"], tuple[Path, int, int, bool]]:
        """What another process needs to look into the folder itself."""
        return FurFunFolder, (self.path, self.points, self.seed, self.keep_disconnected)

    @cached_property
    def layout(self) -> FurFunLayout:
        """Where everything lies."""
        return find_layout(self.path)

    @cached_property
    def skipped(self) -> Mapping[str, str]:
        """The ids of the models that are left out, and why."""
        return MappingProxyType({i: why for i in self.layout.inputs if (why := self._why_skipped(i))})

    @cached_property
    def models(self) -> tuple[str, ...]:
        """The ids of all models that can be read, sorted.

        Raises:
            UnreadableAsset: if a graph file is damaged.
            GraphError: if a graph file is not JSON.
        """
        return tuple(i for i in self.layout.inputs if i not in self.skipped)

    @property
    def paired(self) -> tuple[str, ...]:
        """The ids of the models that have a functional graph, sorted."""
        return tuple(i for i in self.models if i in self.layout.functional)

    @property
    def notes(self) -> tuple[str, ...]:
        """What was left out, in words."""
        lonely = sorted(set(self.layout.functional) - set(self.layout.inputs))
        return tuple(f"skipped {i}: {why}" for i, why in self.skipped.items()) + tuple(
            f"skipped {i}: it has no input graph" for i in lonely
        )

    def model(self, model_id: str) -> FurFunModel:
        """Returns a model.

        Raises:
            AssetError: if there is no such model, it is left out, or a file of it is damaged.
            GraphError: if a graph of it is.
        """
        self._require_known(model_id)
        given = read_graph_file(self.layout.inputs[model_id], model_id)
        if model_id not in self.layout.functional:
            points = self._point_folder(given, model_id)
            graph = with_points(given.graph, points) if self.points else given.graph
            return FurFunModel(model_id, graph, None, given.notes + _boxed(points, graph))
        target = read_graph_file(self.layout.functional[model_id], model_id)
        points = self._point_folder(target, model_id)
        whole = with_points(target.graph, points) if self.points else target.graph
        pair, notes = paired(given.graph, whole, given.kinds, model_id)
        return FurFunModel(model_id, pair.input, pair, target.notes + notes + _boxed(points, whole))

    def pair(self, model_id: str) -> GraphPair:
        """Returns the natural pair of a model.

        Raises:
            AssetError: if there is no such model, it is left out, or a file of it is damaged.
            GraphError: if a graph of it is, or it has no functional graph.
        """
        pair = self.model(model_id).pair
        if pair is None:
            raise GraphError(f"`{model_id}` of {self.path} has no functional graph: ask for its model instead")
        return pair

    def split(self, name: str = "full_split") -> Split:
        """Returns a split of the release, without models that are not there; 80/10/10 where there is no split file.

        Raises:
            AssetError: if there are split files but none of this name, or it is damaged.
        """
        if not self.layout.splits.is_dir():
            return split_models(self.paired or self.models)
        return read_split(self.layout.splits, name).only(self.models)

    def _point_folder(self, file: GraphFile, model_id: str) -> PointFolder:
        return PointFolder(self.layout.geometry_of(file.geometry_id, model_id), self.points, self.seed)

    def _why_skipped(self, model_id: str) -> str:
        reason = why_skipped(load_graph_json(self.layout.inputs[model_id]), whole=False)
        if reason or model_id not in self.layout.functional:
            return reason
        return why_skipped(load_graph_json(self.layout.functional[model_id]), whole=not self.keep_disconnected)

    def _require_known(self, model_id: str) -> None:
        if model_id not in self.layout.inputs:
            raise AssetError(f"{self.path} holds no model `{model_id}`: it has {len(self.layout.inputs)} others")
        if model_id in self.skipped:
            raise AssetError(f"`{model_id}` of {self.path} is left out: {self.skipped[model_id]}")


def _boxed(points: PointFolder, graph: FunctionalGraph) -> tuple[str, ...]:
    count = len(points.boxed)
    if not count:
        return ()
    return (f"drew points on the boxes of {count} of {len(graph.nodes)} parts: they have no .npy and no .ply",)
