"""What an asset lacks before it is worked on: joints, hinges, rails, handles, a top, boards. It mends nothing."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import final

from grafu.additions.carcass.missing_panels import MissingPanel
from grafu.additions.drawer_box.verdict import BoxVerdict
from grafu.additions.handle.grasp import Grasp
from grafu.additions.top.complete import TopVerdict, missing_top
from grafu.asset.part import Asset, Part
from grafu.graph.functional_graph import FunctionalGraph
from grafu.vocabulary import PartLabel


class DeficiencyKind(StrEnum):
    """The things that furniture can lack."""

    JOINT = "joint"  # the input does not say how the part moves
    HINGE = "hinge"  # a door without hardware
    RAIL = "rail"  # a drawer without hardware
    HANDLE = "handle"  # nothing to grasp the part by
    TOP = "top panel"  # nothing closes it from above
    BACK = "back panel"  # the back of a carcass is open
    BOTTOM = "bottom panel"  # its bottom is open
    DRAWER_BOX = "drawer box"  # a drawer is only a front, or its box lacks boards
    LABEL = "label"  # the part's category is not known


@final
@dataclass(frozen=True, slots=True)
class Deficiency:
    """One thing that is missing: at which part (empty: the whole object), and in words what was looked for."""

    kind: DeficiencyKind
    part: str
    detail: str


@final
@dataclass(frozen=True)
class Findings:
    """What a run found missing by geometry, once it knew what moves: see `body_additions` and `fittings`."""

    top: TopVerdict
    carcass: Sequence[MissingPanel]
    drawers: Sequence[BoxVerdict]
    grasps: Mapping[str, Grasp]


def find_deficiencies(asset: Asset, graph: FunctionalGraph, findings: Findings | None = None) -> tuple[Deficiency, ...]:
    """Returns what the asset lacks, judged by the labels of `graph` (completed, or as parsed), part by part.

    Without `findings`, of what moves only labels are known: a part without a handle may still offer an edge to grasp.
    """
    label_of = {node.id: node.label for node in graph.nodes}
    jointed = {joint.part for joint in asset.joints}
    found = [one for part in asset.parts for one in _of_part(part, label_of[part.id], part.id in jointed)]
    found += _without_handle(asset, graph, findings.grasps if findings else {})
    top = findings.top if findings else missing_top(asset.parts)
    if top.missing:
        found.append(Deficiency(DeficiencyKind.TOP, "", top.why))
    found += [Deficiency(DeficiencyKind.TOP, "", further.why) for further in top.others]
    return (*found, *(_of_boards(findings) if findings else ()))


def _without_handle(asset: Asset, graph: FunctionalGraph, grasps: Mapping[str, Grasp]) -> list[Deficiency]:
    held = handled_parts(asset, graph)
    found = []
    for part in asset.parts:
        grasp = grasps.get(part.id)
        if grasp is not None and grasp.kind == "none":
            found.append(Deficiency(DeficiencyKind.HANDLE, part.id, grasp.why))
        elif grasp is None and graph.node(part.id).label.is_movable and part.id not in held:
            found.append(Deficiency(DeficiencyKind.HANDLE, part.id, "no handle is attached to it"))
    return found


def _of_boards(findings: Findings) -> list[Deficiency]:
    found = [Deficiency(DeficiencyKind(one.what.value), "", one.why) for one in findings.carcass]
    open_boxes = (verdict for verdict in findings.drawers if verdict.missing)
    found += [Deficiency(DeficiencyKind.DRAWER_BOX, v.drawer, f"{v.kind}: {v.why}") for v in open_boxes]
    return found


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
