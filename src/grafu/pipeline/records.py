"""Values of the stages as records of the JSON forms, for report and inspection alike, and what an asset lacks.

What an asset lacks before it is worked on: joints, hinges, rails, handles, a top, boards. It mends nothing.
"""

from collections.abc import Mapping, Sequence
from dataclasses import asdict

from grafu.additions.step import Deficiency, DeficiencyKind, Grasp, StepResult
from grafu.additions.top.complete import missing_top
from grafu.articulation.articulated_object import Coupling
from grafu.asset.part import Asset, Frame, Part, PartSource
from grafu.geometry.arrays import Vec3
from grafu.geometry.axis import Axis
from grafu.graph.completion import GraphCompletion
from grafu.graph.functional_graph import FunctionalGraph
from grafu.pipeline.report_schema import (
    AxisRecord,
    CouplingRecord,
    DeficiencyRecord,
    FrameRecord,
    InputRecord,
    PieceRecord,
    SourceRecord,
    Vector,
)
from grafu.vocabulary import PartLabel


def frame_record(frame: Frame) -> FrameRecord:
    """Returns how coordinates were mapped, and what was assumed."""
    a, b, c, d = (tuple(row) for row in frame.input_to_output.tolist())
    return FrameRecord(
        input_to_output=(a, b, c, d), up=frame.up, front=frame.front, scale=frame.scale, assumed=frame.assumed
    )


def deficiency_record(deficiency: Deficiency) -> DeficiencyRecord:
    """Returns one thing that was lacking."""
    return DeficiencyRecord(kind=deficiency.kind, part=deficiency.part, detail=deficiency.detail)


def source_record(source: PartSource) -> SourceRecord:
    """Returns where a part came from."""
    return SourceRecord(name=source.name, file=source.file, link=source.link)


def axis_record(axis: Axis) -> AxisRecord:
    """Returns a line in space."""
    return AxisRecord(origin=vector(axis.point), direction=vector(axis.direction))


def coupling_record(coupling: Coupling | None) -> CouplingRecord | None:
    """Returns how a joint follows another; None where it follows none."""
    return None if coupling is None else CouplingRecord(**asdict(coupling))


def vector(values: Vec3) -> Vector:
    """Returns three plain numbers."""
    x, y, z = values.tolist()
    return x, y, z


def piece_record(completion: GraphCompletion) -> PieceRecord | None:
    """Returns what the whole piece is, where the completion states it."""
    return None if completion.piece is None else PieceRecord(**asdict(completion.piece))


def input_record(asset: Asset, name: str = "") -> InputRecord:
    """Returns what was read; `name` is the name of the results (empty: the asset's)."""
    return InputRecord(
        name=name or asset.name, path=asset.path, kind=asset.kind, parts=len(asset.parts), notes=asset.notes
    )


def find_deficiencies(asset: Asset, graph: FunctionalGraph, made: Sequence[StepResult] = ()) -> tuple[Deficiency, ...]:
    """Returns what the asset lacks, judged by the labels of `graph` (completed, or as parsed), part by part.

    `made` holds what a run's steps found missing, once it was known what moves. Without it, of what moves only labels
    are known: a part without a handle may still offer an edge to grasp.
    """
    label_of = {node.id: node.label for node in graph.nodes}
    jointed = {joint.part for joint in asset.joints}
    found = [one for part in asset.parts for one in _of_part(part, label_of[part.id], part.id in jointed)]
    found += _without_handle(asset, graph, {name: grasp for one in made for name, grasp in one.grasps.items()})
    if made:
        seen = [one for result in made for one in result.deficiencies]
        return (*found, *sorted(seen, key=lambda one: one.kind is DeficiencyKind.DRAWER_BOX))  # these come last
    top = missing_top(asset.parts)
    return (*found, Deficiency(DeficiencyKind.TOP, "", top.why)) if top.missing else tuple(found)


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


def handled_parts(asset: Asset, graph: FunctionalGraph) -> frozenset[str]:
    """Returns the ids of the parts that a handle rides on, by the asset's own word or the graph's."""
    riding = {part.carried_by for part in asset.parts if part.carried_by and part.label is PartLabel.HANDLE}
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
