"""From what a run made to its report: what was read, assumed, missing, built, added and skipped. It writes no file."""

from collections.abc import Mapping

from grafu.articulation.articulated_object import ArticulatedObject, Joint, VisualRole
from grafu.asset.part import Part
from grafu.pipeline.deficiencies import find_deficiencies, handled_parts
from grafu.pipeline.functionalize import Functionalized
from grafu.pipeline.records import axis_record, deficiency_record, frame_record, input_record, source_record, vector
from grafu.pipeline.report_schema import (
    AddedRecord,
    ClearanceRecord,
    JointRecord,
    MotionRecord,
    PartRecord,
    Report,
    SkippedRecord,
)
from grafu.realization.report import Installed
from grafu.version import __version__
from grafu.vocabulary import PartLabel


def report_of(result: Functionalized, name: str = "", other_timings: Mapping[str, float] | None = None) -> Report:
    """Returns the report of a run.

    `name` is the name of the results (empty: the asset's); `other_timings` are seconds of stages outside the pipeline
    (reading, exporting).
    """
    lacks = find_deficiencies(result.asset, result.completion.completed)
    timings = {**dict(result.timings), **(other_timings or {})}
    return Report(
        version=__version__,
        input=input_record(result.asset, name),
        frame=frame_record(result.asset.frame),
        motion=MotionRecord(source=result.source),
        parts=_part_records(result),
        deficiencies=tuple(deficiency_record(lack) for lack in lacks),
        joints=_joint_records(result),
        added=_added_records(result.object),
        skipped=tuple(
            SkippedRecord(request=s.request, reason=s.reason, detail=s.detail) for s in result.report.skipped
        ),
        timings={stage: round(seconds, 4) for stage, seconds in timings.items()},
    )


def _part_records(result: Functionalized) -> tuple[PartRecord, ...]:
    link_of = {visual.name: link.id for link in result.object.links for visual in link.visuals}
    category_of = {node.id: node.label for node in result.completion.completed.nodes}
    return tuple(
        _part_record(part, category_of[part.id], link_of.get(part.id, result.object.root))
        for part in result.asset.parts
    )


def _part_record(part: Part, category: PartLabel, link: str) -> PartRecord:
    labelled_by = part.labelled_by if category is part.label else "prediction"
    return PartRecord(
        id=part.id, source=source_record(part.source), category=category, labelled_by=labelled_by, link=link
    )


def _joint_records(result: Functionalized) -> tuple[JointRecord, ...]:
    joints = {joint.id: joint for joint in result.object.joints}
    held = handled_parts(result.asset, result.completion.completed)
    return tuple(_joint_record(made, joints[made.joint], made.moving in held) for made in result.report.installed)


def _joint_record(made: Installed, joint: Joint, held: bool) -> JointRecord:
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
        restricted=made.restricted,
        collision_share=made.collision_share,
        largest_gap=made.largest_gap,
        after=joint.after,
        grasp="handle" if held else "none",
        clearances=tuple(
            ClearanceRecord(part=c.part, kind=c.kind, amount=c.amount, share=c.share, why=c.why)
            for c in made.clearances
        ),
        notes=made.notes,
    )


def _added_records(articulated: ArticulatedObject) -> tuple[AddedRecord, ...]:
    added = [v for link in articulated.links for v in link.visuals if v.role is VisualRole.ADDED]
    return tuple(AddedRecord(part=v.name, category=v.label, why="the input had none") for v in added)
