"""The authors' predicted graphs as foreign motions: slots are parts, hinge and rail edges joints.

Boxes are regressed, so a motion stays the code that was predicted, to be decoded on the true box. Where the graph that
was predicted from lies beside the file, its boxes are taken. It matches nothing with an asset.
"""

from pathlib import Path
from typing import Any, final

from grafu.asset.foreign.motions import ForeignJoint, ForeignMotions, ForeignPart
from grafu.asset.json_files import read_json
from grafu.asset.options import Limits, LoadOptions
from grafu.asset.resources import ModelFiles
from grafu.dataclass import dataclass
from grafu.errors import AssetError, GraphError, UnreadableAsset
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.graph.edges import AxisSign, HingeBorder, SignedAxis
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.json_values import Json
from grafu.graph.motion import hinge_to_axis, rail_to_axis
from grafu.graph.official_json import graph_from_official

SUFFIX = "_pred.json"
_EXPECTED = "the authors' <model>_pred.json, whose nodes have a `slot` and an `obb`"


@final
@dataclass(frozen=True, slots=True)
class BorderPin:
    """A hinge as the authors say it: the border of the door that carries the pin, and its sign."""

    border: HingeBorder
    sign: AxisSign

    def axis_on(self, box: Box) -> Axis:
        """Returns the pin on a door's box."""
        return hinge_to_axis(box, self.border, self.sign)


@final
@dataclass(frozen=True, slots=True)
class OfficialRail:
    """A rail as the authors say it: the signed axis along which it opens."""

    axis: SignedAxis

    def axis_on(self, box: Box) -> Axis:
        """Returns the slide through the middle of a drawer's box."""
        return rail_to_axis(box, self.axis)


def is_prediction(data: Any) -> bool:
    """Whether decoded JSON is a predicted graph: nodes with slots, and edges."""
    nodes = data.get("nodes") if isinstance(data, dict) else None
    return (
        isinstance(nodes, dict) and "edges" in data and any(isinstance(n, dict) and "slot" in n for n in nodes.values())
    )


def read_prediction(path: Path, options: LoadOptions = LoadOptions()) -> ForeignMotions:
    """Returns the prediction of a `_pred.json`.

    Raises:
        UnreadableAsset: if the file is missing, damaged, or of another form.
    """
    data = _json(path, options.limits)
    if not is_prediction(data):
        raise UnreadableAsset(f"{path} holds no predicted nodes: expected {_EXPECTED}")
    given = _given_boxes(path, data, options.limits)
    try:
        slots = {str(key): _slot(key, node) for key, node in data["nodes"].items()}
        known = {key: node for key, node in data["nodes"].items() if given is None or slots[key] < len(given)}
        nodes = {key: node if given is None else node | {"obb": given[slots[key]]} for key, node in known.items()}
        reading = graph_from_official(data | {"nodes": nodes})
        parts = _parts(reading.graph, slots)
        return ForeignMotions("grafu-pred", str(path), parts, _joints(reading.graph), notes=reading.notes)
    except (AssetError, GraphError) as error:
        raise UnreadableAsset(f"{path} is damaged ({error}): expected {_EXPECTED}") from None


def _json(path: Path, limits: Limits) -> Any:
    return read_json(path, ModelFiles(path.parent, limits), _EXPECTED)


def _given_boxes(path: Path, data: Json, limits: Limits) -> list[Any] | None:
    """Returns the boxes of the graph that was predicted from, in slot order, where it lies beside the prediction."""
    name = path.name.removesuffix(SUFFIX)
    for beside in (path.with_name(f"{name}_input.json"), path.with_name(f"{name}.json")):
        if beside.is_file() and beside != path:
            nodes = _json(beside, limits)
            nodes = nodes.get("nodes") if isinstance(nodes, dict) else None
            boxes = (
                [node.get("obb") for node in nodes.values() if isinstance(node, dict)]
                if isinstance(nodes, dict)
                else []
            )
            if boxes and len(boxes) <= len(data["nodes"]):
                return boxes
    return None


def _slot(key: str, node: Any) -> int:
    slot = node.get("slot") if isinstance(node, dict) else None
    if isinstance(slot, bool) or not isinstance(slot, int) or slot < 0:
        raise GraphError(f"`slot` of node `{key}` must be an integer from 0: got {slot!r}")
    return slot


def _parts(graph: FunctionalGraph, slots: dict[str, int]) -> tuple[ForeignPart, ...]:
    carried = {edge.child: edge.parent for edge in graph.attachments}
    if len({slots[node.id] for node in graph.nodes}) < len(graph.nodes):
        raise GraphError("each slot must be used once: two nodes share one")
    return tuple(
        ForeignPart(n.id, TriangleMesh.box_mesh(n.box), True, n.label, carried.get(n.id), slots[n.id])
        for n in sorted(graph.nodes, key=lambda node: slots[node.id])
    )


def _joints(graph: FunctionalGraph) -> tuple[ForeignJoint, ...]:
    found = {}
    for hinge in graph.hinges:
        pin = BorderPin(hinge.border, hinge.sign)
        axis = pin.axis_on(graph.node(hinge.child).box)
        found[hinge.child] = ForeignJoint(hinge.child, hinge.joint_type, axis, limited=False, code=pin)
    for rail in graph.rails:
        slide = OfficialRail(rail.axis)
        axis = slide.axis_on(graph.node(rail.child).box)
        found.setdefault(rail.child, ForeignJoint(rail.child, rail.joint_type, axis, limited=False, code=slide))
    return tuple(found.values())
