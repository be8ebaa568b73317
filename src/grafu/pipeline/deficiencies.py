"""What an asset lacks before it is worked on: joints, hinges, rails, handles, a top. It mends nothing."""

from dataclasses import dataclass
from enum import StrEnum
from typing import final

from grafu.asset.part import Asset, Part
from grafu.graph.functional_graph import FunctionalGraph
from grafu.vocabulary import PartLabel


class DeficiencyKind(StrEnum):
    """The things that furniture can lack."""

    JOINT = "joint"  # the input does not say how the part moves
    HINGE = "hinge"  # a door without hardware
    RAIL = "rail"  # a drawer without hardware
    HANDLE = "handle"  # nothing to grasp the part by
    TOP = "top panel"  # no part is the top
    LABEL = "label"  # the part's category is not known


@final
@dataclass(frozen=True, slots=True)
class Deficiency:
    """One thing that is missing: at which part (empty: the whole object), and in words what was looked for."""

    kind: DeficiencyKind
    part: str
    detail: str


def find_deficiencies(asset: Asset, graph: FunctionalGraph) -> tuple[Deficiency, ...]:
    """Returns what the asset lacks, judged by the labels of `graph` (completed, or as parsed), part by part."""
    label_of = {node.id: node.label for node in graph.nodes}
    held = handled_parts(asset, graph)
    jointed = {joint.part for joint in asset.joints}
    found = [lack for part in asset.parts for lack in _of_part(part, label_of[part.id], part.id in jointed)]
    found += [
        Deficiency(DeficiencyKind.HANDLE, node.id, "no handle is attached to it")
        for node in graph.nodes
        if node.label.is_movable and node.id not in held
    ]
    if PartLabel.TOP_PANEL not in label_of.values():
        found.append(Deficiency(DeficiencyKind.TOP, "", "no part is labelled so; whether one is needed is not judged"))
    return tuple(found)


def handled_parts(asset: Asset, graph: FunctionalGraph) -> frozenset[str]:
    """Returns the ids of the parts that a handle rides on, by the asset's own word or the graph's."""
    riding = {part.rides_on for part in asset.parts if part.rides_on and part.label is PartLabel.HANDLE}
    return frozenset(riding | {edge.parent for edge in graph.attachments})


def _of_part(part: Part, label: PartLabel, jointed: bool) -> list[Deficiency]:
    found = []
    if part.label is PartLabel.UNKNOWN:
        found.append(Deficiency(DeficiencyKind.LABEL, part.id, f"its name `{part.source.name}` names no category"))
    if label.is_movable or jointed:
        mechanism = DeficiencyKind.RAIL if label is PartLabel.DRAWER else DeficiencyKind.HINGE
        found.append(Deficiency(mechanism, part.id, "the input has no hardware for it"))
    if label.is_movable and not jointed:
        found.append(Deficiency(DeficiencyKind.JOINT, part.id, "the input does not state how it moves"))
    return found
