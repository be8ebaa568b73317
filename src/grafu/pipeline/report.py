"""From what a run made to its report: what was read, assumed, missing, built, added and skipped. It writes no file."""

from collections.abc import Mapping
from dataclasses import asdict, replace

import numpy as np

from grafu.additions.step import DeficiencyKind
from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.asset.part import Part
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.joints.report import Installed
from grafu.joints.sliding_doors import SOURCE as RULE
from grafu.pipeline.certainty import guesses_of
from grafu.pipeline.functionalize import Functionalized
from grafu.pipeline.grasps import grasp_kinds, small_parts
from grafu.pipeline.move_options import move_options
from grafu.pipeline.records import (
    axis_record,
    coupling_record,
    deficiency_record,
    find_deficiencies,
    frame_record,
    input_record,
    piece_record,
    source_record,
    vector,
)
from grafu.pipeline.report_changes import AddedRecord, CarvedRecord
from grafu.pipeline.report_schema import (
    NOT_ADDED,
    ClearanceRecord,
    GraspFrameRecord,
    JointRecord,
    MotionRecord,
    PartRecord,
    Report,
    SkippedRecord,
)
from grafu.pipeline.standing import base_record
from grafu.pipeline.verdict import verdict_of
from grafu.pipeline.words import Grasp
from grafu.refusal import Asked, Reason, Refusal
from grafu.version import __version__
from grafu.vocabulary import PartLabel


def report_of(result: Functionalized, name: str = "", other_timings: Mapping[str, float] | None = None) -> Report:
    """Returns the report of a run.

    `name` is the name of the results (empty: the asset's); `other_timings` are seconds of stages outside the pipeline
    (reading, exporting).
    """
    missing = find_deficiencies(result.asset, _with_removed(result), (result.body, result.fittings))
    timings = {**dict(result.timings), **(other_timings or {})}
    report = Report(
        version=__version__,
        input=input_record(result.asset, name),
        frame=frame_record(result.asset.frame),
        motion=MotionRecord(
            source=result.source, stated_joints=result.stated_joints, unused_joints=result.unused_joints
        ),
        size=vector(result.asset.box.size),
        base=base_record(result.asset, result.object),
        piece=piece_record(result.completion),
        parts=_part_records(result),
        deficiencies=tuple(deficiency_record(one) for one in missing),
        joints=_joint_records(result),
        added=_added_records(result),
        carved=_carved_records(result),
        skipped=tuple(
            skipped_record(refusal)
            for refusal in (*result.report.skipped, *result.body.refusals, *result.fittings.refusals)
        ),
        notes=result.notes,
        guesses=guesses_of(result.completion, result.decided | _shown_by_shape(result)),
        moves=move_options(result),
        timings={stage: round(seconds, 4) for stage, seconds in timings.items()},
    )
    return report.with_changes(verdict=verdict_of(report))


def _shown_by_shape(result: Functionalized) -> frozenset[str]:
    """Returns the parts whose motion shape or name shows, whatever the source stated: it is no guess of the source."""
    stated = result.completion.source
    shown = {r.moving for r in result.plan.joints if r.source == RULE != stated}
    return small_parts(result.report, result.plan) | shown


def skipped_record(refusal: Refusal) -> SkippedRecord:
    """Returns the record of a refusal."""
    told = refusal.what is Asked.JOINT or refusal.reason is Reason.TOO_COMPLEX
    return SkippedRecord(
        request=refusal.part,
        reason=refusal.reason if told else NOT_ADDED,
        detail=refusal.why,
        what=refusal.what,
        cause=refusal.reason,
    )


def _with_removed(result: Functionalized) -> FunctionalGraph:
    """Returns the completed graph, with the nodes of parts that were replaced: what was lacking was so before."""
    graph = result.completion.completed
    gone = tuple(PartNode(p.id, p.label, p.box) for p in result.asset.parts if p.id in result.removed)
    return replace(graph, nodes=(*graph.nodes, *gone)) if gone else graph


def _part_records(result: Functionalized) -> tuple[PartRecord, ...]:
    link_of = {visual.name: link.id for link in result.object.links for visual in link.visuals}
    category_of = {node.id: node.label for node in result.completion.completed.nodes}
    link_of |= dict.fromkeys(result.removed, "")
    return tuple(
        _part_record(part, category_of.get(part.id, part.label), link_of.get(part.id, result.object.root))
        for part in result.asset.parts
    )


def _part_record(part: Part, category: PartLabel, link: str) -> PartRecord:
    labelled_by = part.labelled_by if category is part.label else "prediction"
    return PartRecord(
        id=part.id, source=source_record(part.source), category=category, labelled_by=labelled_by, link=link
    )


def _joint_records(result: Functionalized) -> tuple[JointRecord, ...]:
    joints = {joint.id: joint for joint in result.object.joints}
    grasps = grasp_kinds(result.object, result.fittings, result.report, result.plan)
    pulled = {name: result.object.leader_of(joint).child for name, joint in joints.items()}
    small = small_parts(result.report, result.plan)
    records = (
        _joint_record(made, joints[made.joint], grasps.get(made.moving, grasps.get(pulled[made.joint], "none")))
        for made in result.report.installed
    )
    return tuple(
        record.with_changes(
            small=record.part in small, grasp_frames=_grasp_records(result.object, joints[record.id].child)
        )
        for record in records
    )


def _grasp_records(made: ArticulatedObject, link: str) -> tuple[GraspFrameRecord, ...]:
    return tuple(
        GraspFrameRecord(
            name=grasp.name,
            part=grasp.part,
            kind=grasp.kind,
            position=vector(np.asarray(grasp.position)),
            approach=vector(np.asarray(grasp.approach)),
            closing=vector(np.asarray(grasp.closing)),
            width=round(grasp.width, 6),
            depth=round(grasp.depth, 6),
        )
        for grasp in made.grasps
        if grasp.link == link
    )


def _joint_record(made: Installed, joint: Joint, grasp: Grasp) -> JointRecord:
    return JointRecord(
        id=joint.id,
        part=made.moving,
        type=made.type,
        axis=vector(joint.axis.direction),
        origin=vector(joint.axis.point),
        lower=joint.limits.lower,
        upper=joint.limits.upper,
        mount=made.mount,
        mechanism=made.mechanism,
        template=made.template,
        count=made.count,
        motion_source=made.source,
        initial_axis=axis_record(made.initial_axis),
        rectified_axis=axis_record(made.axis),
        opening=made.opening,
        reference=made.reference,
        wanted=made.wanted,
        restricted=made.restricted,
        collision_share=made.collision_share,
        stays=made.stays,
        largest_gap=made.largest_gap,
        after=joint.after,
        parent=joint.parent,
        follows=coupling_record(joint.coupling),
        grasp=grasp,
        clearances=tuple(ClearanceRecord(**asdict(clearance)) for clearance in made.clearances),
        notes=made.notes,
        left_out=made.left_out,
    )


def _added_records(result: Functionalized) -> tuple[AddedRecord, ...]:
    link_of = {visual.name: link.id for link in result.object.links for visual in link.visuals}
    return tuple(
        AddedRecord(part=a.part.id, category=a.part.label, why=a.why, style=a.style, link=link_of[a.part.id])
        for a in result.additions
    )


def _carved_records(result: Functionalized) -> tuple[CarvedRecord, ...]:
    link_of = {visual.name: link.id for link in result.object.links for visual in link.visuals}
    grips = [
        CarvedRecord(
            part=c.part.id,
            category=PartLabel.HANDLE,
            why="it could not be grasped, and was carved",
            style=f"{c.kind}, {c.profile}",
            link=link_of[c.part.id],
        )
        for c in result.fittings.changes.carved
    ]
    compartments = [
        CarvedRecord(
            part=c.part.id,
            category=c.part.label,
            why=f"it was drawn solid behind {', '.join(fronts)}",
            style=DeficiencyKind.COMPARTMENT,
            link=link_of[c.part.id],
        )
        for c in result.body.changes.compartments
        for fronts in c.fronts
    ]
    return (*grips, *compartments)
