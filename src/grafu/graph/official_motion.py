"""The authors' words for parts and motions: `material` and motion keys, and our labels and codes, both ways.

The codes are those of the releases' JSON files. It reads no files.
"""

import re
from typing import Any, cast, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.graph.edges import AxisSign, Edge, Hinge, HingeBorder, Rail, SignedAxis
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.json_values import Json, read_code
from grafu.graph.motion import border_to_face, border_to_signed_axis, face_to_border, opposite, signed_axis
from grafu.vocabulary import PartLabel

# The authors list a countertop apart; to the paper's thirteen categories it is a top panel.
_COUNTERTOP = "countertop"


def normalized_material(word: str) -> str:
    """Returns the word as the authors' loader reads it: no Blender suffix, spaces for underscores, lower case."""
    return re.sub(r"\.\d+$", "", word).replace("_", " ").strip().lower()


def material_to_label(word: str) -> PartLabel:
    """Returns the label of an authors' word; `rail`, `hinge` and any other word are unknown."""
    known = normalized_material(word)
    if known == _COUNTERTOP:
        return PartLabel.TOP_PANEL
    return PartLabel(known) if known in tuple(PartLabel) else PartLabel.UNKNOWN


def node_to_material(node: PartNode) -> str:
    """Returns the authors' word for a node; a top panel that was read as a countertop is one again."""
    was_countertop = normalized_material(node.source_name) == _COUNTERTOP
    return _COUNTERTOP if was_countertop and node.label is PartLabel.TOP_PANEL else node.label.value


@final
@dataclass(frozen=True, slots=True)
class HingeCodes:
    """Border and sign of a hinge."""

    border: HingeBorder
    sign: AxisSign


def motion_fields(edge: Edge, graph: FunctionalGraph) -> dict[str, int]:
    """Returns the authors' motion keys of an edge: none for contact and attached."""
    if isinstance(edge, Rail):
        return {"rail_axis_signed": edge.axis}
    if not isinstance(edge, Hinge):
        return {}
    thin = graph.node(edge.child).box.thin_axis
    return {
        "hinge_border_4": edge.border,
        "hinge_axis_sign": edge.sign,
        "hinge_border": border_to_face(thin, edge.border),
        "hinge_axis_signed": border_to_signed_axis(thin, edge.border, edge.sign),
    }


def older_motion_fields(edge: Edge, graph: FunctionalGraph, src: str) -> dict[str, int]:
    """Returns the motion keys of the authors' second label version: unsigned axes, and the faces that touch.

    `src` is the end of the edge that is written first. The face of a part that touches another is the one towards it
    along the axis on which the two boxes are farthest apart.
    """
    if isinstance(edge, Rail):
        return {"rail_axis": edge.axis // 2}
    if not isinstance(edge, Hinge):
        return {}
    signed = border_to_signed_axis(graph.node(edge.child).box.thin_axis, edge.border, edge.sign)
    first, second = (edge.parent, edge.child) if src == edge.parent else (edge.child, edge.parent)
    face = _face_towards(graph.node(first).box, graph.node(second).box)
    return {
        "hinge_axis": signed // 2,
        "hinge_direction": 1 - signed % 2,
        "hinge_face_src": face,
        "hinge_face_dst": opposite(face),
    }


def read_hinge(data: Json, door: Box, door_end: str) -> HingeCodes | None:
    """Returns the hinge that an edge states, in the newest of the three label versions that it has, or None.

    `door_end` is `src` or `dst`: the end of the edge that the door is.
    """
    border, sign = read_code(data, "hinge_border_4", 4), read_code(data, "hinge_axis_sign", 2)
    if border is not None and sign is not None:
        return HingeCodes(cast(HingeBorder, border), cast(AxisSign, sign))
    face, axis = read_code(data, "hinge_border", 6), read_code(data, "hinge_axis_signed", 6)
    if face is None or axis is None:
        face, axis = read_code(data, f"hinge_face_{door_end}", 6), _second_version_axis(data)
    return _codes_of(face, axis, door.thin_axis)


def read_rail(data: Json) -> SignedAxis | None:
    """Returns the slide that an edge states, or None; the older unsigned `rail_axis` does not say which way opens."""
    return cast(SignedAxis | None, read_code(data, "rail_axis_signed", 6))


def _second_version_axis(data: Json) -> int | None:
    axis, direction = read_code(data, "hinge_axis", 3), read_code(data, "hinge_direction", 2)
    return None if axis is None or direction is None else 2 * axis + (1 - direction)


def _face_towards(box: Box, other: Box) -> SignedAxis:
    axis = int(np.argmax(box.axis_gaps(other)))
    return signed_axis(axis, bool(other.center[axis] >= box.center[axis]))


def _codes_of(face: Any, axis: int | None, thin: int) -> HingeCodes | None:
    if face is None or axis is None or face // 2 == thin or axis // 2 in (thin, face // 2):
        return None
    return HingeCodes(face_to_border(thin, face), cast(AxisSign, axis % 2))
