"""One graph file of a release to one graph with points, and what its JSON states beyond it."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import final

from grafu.asset.options import Limits
from grafu.asset.resources import ModelFiles
from grafu.data.furfun.points import PointFolder
from grafu.dataclass import dataclass
from grafu.errors import GraphError, UnreadableAsset
from grafu.graph.functional_graph import FunctionalGraph, joined_groups
from grafu.graph.json_values import Json
from grafu.graph.official_json import graph_from_official
from grafu.graph.serialize import load_json

# A key that functional graphs of synthetic furniture have; the authors' loader ignores keys that it does not know.
MADE_BY = ("made_by", "grafu")
_LIMITS = Limits()


@final
@dataclass(frozen=True)
class GraphFile:
    """A graph as it was read. `geometry_id` is the id in its JSON, under which its points lie.

    `kinds` are the words for the edges in the file, the functional one where an edge is stated twice.
    """

    graph: FunctionalGraph
    geometry_id: str
    kinds: Mapping[frozenset[str], str]
    notes: tuple[str, ...]


def read_graph_file(path: Path, model_id: str) -> GraphFile:
    """Returns the graph in a file, named `model_id`, without points.

    Raises:
        UnreadableAsset: if the file is missing or not text.
        GraphError: if it is not JSON, a value is missing or wrong, or the graph breaks an invariant.
    """
    data = load_graph_json(path)
    try:
        reading = graph_from_official(data)
    except GraphError as error:
        raise GraphError(f"{path}: {error}") from error
    geometry_id = reading.graph.model_id or model_id
    return GraphFile(replace(reading.graph, model_id=model_id), geometry_id, _kinds(data), reading.notes)


def load_graph_json(path: Path) -> Json:
    """Returns the JSON object in a graph file.

    Raises:
        UnreadableAsset: if the file is missing or not text.
        GraphError: if it is not a JSON object.
    """
    try:
        return load_json(_text(path, ModelFiles(path.parent, _LIMITS)))
    except GraphError as error:
        raise GraphError(f"{path}: {error}") from error


def _text(path: Path, files: ModelFiles) -> str:
    data = files.read(path)
    files.limits.require("values", sum(data.count(sign) for sign in (b",", b"[", b"{")), path)
    try:
        return data.decode()
    except UnicodeDecodeError:
        raise UnreadableAsset(f"{path} is no text: expected a graph as JSON in UTF-8") from None


def with_points(graph: FunctionalGraph, points: PointFolder) -> FunctionalGraph:
    """Returns the graph with the points of each part.

    Raises:
        UnreadableAsset: if a point file is damaged.
    """
    return replace(graph, nodes=tuple(replace(n, points=points.points(n.id, n.box)) for n in graph.nodes))


def why_skipped(data: Json, whole: bool) -> str:
    """Returns why the authors' loader leaves a graph out, in words, or nothing where it does not.

    `whole` states that all parts must hang together over edges of any kind. In synthetic furniture they need not: parts
    float in it as they do in real models, by intent, where in an annotated graph an edge was forgotten.
    """
    listed, edges = data.get("nodes"), data.get("edges", [])
    if listed is None or listed in ({}, []):
        return "it has no nodes"
    whole = whole and (MADE_BY[0], data.get(MADE_BY[0])) != MADE_BY
    if not whole or not isinstance(listed, dict | list) or not isinstance(edges, list):
        return ""  # a reader of a damaged graph reports it
    ids = [str(n.get("id")) if isinstance(n, Mapping) else str(n) for n in listed]
    neighbours: dict[str, list[str]] = {i: [] for i in ids}
    for edge in edges:
        src, dst = (str(edge.get(end)) if isinstance(edge, Mapping) else "" for end in ("src", "dst"))
        if src in neighbours and dst in neighbours:
            neighbours[src].append(dst)
            neighbours[dst].append(src)
    pieces = len(joined_groups(neighbours))
    return f"its functional graph falls into {pieces} pieces" if pieces > 1 else ""


def _kinds(data: Json) -> dict[frozenset[str], str]:
    kinds: dict[frozenset[str], str] = {}
    for edge in data.get("edges", ()):
        ends, kind = frozenset((str(edge.get("src")), str(edge.get("dst")))), str(edge.get("kind"))
        kind = kind if kind in ("hinge", "rail", "attached") else "contact"
        if kinds.get(ends, "contact") == "contact":
            kinds[ends] = kind
    return kinds
