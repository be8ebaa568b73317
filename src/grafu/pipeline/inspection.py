"""What was read from an input, before anything is done to it: `grafu.inspection/1`. It builds nothing."""

from typing import Literal

from grafu.asset.part import AnnotatedJoint, Asset, Part
from grafu.graph.functional_graph import FunctionalGraph
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.records import (
    axis_record,
    coupling_record,
    deficiency_record,
    find_deficiencies,
    frame_record,
    input_record,
    source_record,
    vector,
)
from grafu.pipeline.report_record import FiniteFloat, Ratio, ReportRecord, stated
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
from grafu.vocabulary import JointType, PartLabel


class InspectedPart(ReportRecord):
    """One part as it was read."""

    id: str = stated(description="its id")
    source: SourceRecord = stated(description="where it came from")
    category: PartLabel = stated(description="its category")
    labelled_by: str = stated(description="what the category rests on")
    rides_on: str | None = stated(description="the moving part that carries it, where the input states it")
    low: Vector = stated(description="the low corner of its box, metres")
    high: Vector = stated(description="the high corner of its box, metres")
    faces: int = stated(description="the number of triangles")
    closed: bool = stated(description="whether its mesh encloses a volume")


class StatedJoint(ReportRecord):
    """A joint that the input itself states; it is read by `--motion annotation` alone."""

    part: str = stated(description="the moving part: its id with `--motion annotation`, where its pieces are one part")
    type: JointType = stated(description="revolute or prismatic")
    axis: AxisRecord = stated(description="the axis as stated, in the output's frame")
    lower: FiniteFloat | None = stated(description="the lower limit as stated, radians or metres; null: none stated")
    upper: FiniteFloat | None = stated(description="the upper limit as stated; null: none stated")
    follows: CouplingRecord | None = stated(default=None, description="the joint that it follows; null: none")


class ExpectedMotion(ReportRecord):
    """A part that a run by default would make move; whether there is room for it, the run finds."""

    part: str = stated(description="the moving part")
    type: JointType = stated(description="how it moves: revolute, prismatic, continuous")
    confidence: Ratio | None = stated(
        description="the least confidence of the decisions that it rests on; null: its shape or name shows it"
    )
    decided: tuple[str, ...] = stated(
        description="these decisions in words, each with its confidence and the runner-up"
    )


class StaticPart(ReportRecord):
    """A part that might move and would not."""

    part: str = stated(description="the part")
    reason: str = stated(description="the reason, from the [list of reasons](errors.md#reasons-not-errors)")
    why: str = stated(description="what was found, in words")


class Forecast(ReportRecord):
    """What a run by default would make of it."""

    source: MotionSource = stated(description="what states the motions: network, or rule without weights")
    piece: PieceRecord | None = stated(default=None, description="what the whole piece is; null: not known")
    motions: tuple[ExpectedMotion, ...] = stated(description="the parts that would move")
    static: tuple[StaticPart, ...] = stated(description="the parts that might move and would not")


class Inspection(ReportRecord):
    """The whole inspection."""

    schema: Literal["grafu.inspection/1"] = stated(default="grafu.inspection/1", description="the form's name")
    input: InputRecord = stated(description="what was read")
    frame: FrameRecord = stated(description="how coordinates were mapped")
    size: Vector = stated(description="the size of the whole, metres")
    parts: tuple[InspectedPart, ...] = stated(description="every part")
    contacts: tuple[tuple[str, str], ...] = stated(description="pairs of parts that touch")
    joints: tuple[StatedJoint, ...] = stated(description="the joints that the input states")
    deficiencies: tuple[DeficiencyRecord, ...] = stated(description="what it lacks")
    forecast: Forecast | None = stated(default=None, description="what a run would make of it; null: not asked for")


def inspect(asset: Asset, graph: FunctionalGraph) -> Inspection:
    """Returns what was read into `asset`, with the contacts of `graph`, which was parsed from it."""
    return Inspection(
        input=input_record(asset),
        frame=frame_record(asset.frame),
        size=vector(asset.box.size),
        parts=tuple(_part(part) for part in asset.parts),
        contacts=tuple((contact.a, contact.b) for contact in graph.contacts),
        joints=tuple(_joint(joint) for joint in asset.stated_joints),
        deficiencies=tuple(deficiency_record(one) for one in find_deficiencies(asset, graph)),
    )


def _part(part: Part) -> InspectedPart:
    return InspectedPart(
        id=part.id,
        source=source_record(part.source),
        category=part.label,
        labelled_by=part.labelled_by,
        rides_on=part.carried_by,
        low=vector(part.box.low),
        high=vector(part.box.high),
        faces=len(part.mesh.faces),
        closed=part.mesh.is_watertight,
    )


def _joint(joint: AnnotatedJoint) -> StatedJoint:
    return StatedJoint(
        part=joint.part,
        type=joint.type,
        axis=axis_record(joint.axis),
        lower=joint.lower if joint.limited else None,
        upper=joint.upper if joint.limited else None,
        follows=coupling_record(joint.coupling),
    )
