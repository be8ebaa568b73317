"""What was read from an input, before anything is done to it: `grafu.inspection/1`. It builds nothing."""

from typing import Literal

from pydantic import Field, FiniteFloat

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
from grafu.pipeline.report_record import ReportRecord, schema_field
from grafu.pipeline.report_schema import (
    AxisRecord,
    CouplingRecord,
    DeficiencyRecord,
    FrameRecord,
    InputRecord,
    PieceRecord,
    Ratio,
    SourceRecord,
    Vector,
)
from grafu.vocabulary import JointType, PartLabel


class InspectedPart(ReportRecord):
    """One part as it was read."""

    id: str = Field(description="its id")
    source: SourceRecord = Field(description="where it came from")
    category: PartLabel = Field(description="its category")
    labelled_by: str = Field(description="what the category rests on")
    rides_on: str | None = Field(description="the moving part that carries it, where the input states it")
    low: Vector = Field(description="the low corner of its box, metres")
    high: Vector = Field(description="the high corner of its box, metres")
    faces: int = Field(description="the number of triangles")
    closed: bool = Field(description="whether its mesh encloses a volume")


class StatedJoint(ReportRecord):
    """A joint that the input itself states; it is read by `--motion annotation` alone."""

    part: str = Field(description="the moving part: its id with `--motion annotation`, where its pieces are one part")
    type: JointType = Field(description="revolute or prismatic")
    axis: AxisRecord = Field(description="the axis as stated, in the output's frame")
    lower: FiniteFloat | None = Field(description="the lower limit as stated, radians or metres; null: none stated")
    upper: FiniteFloat | None = Field(description="the upper limit as stated; null: none stated")
    follows: CouplingRecord | None = Field(default=None, description="the joint that it follows; null: none")


class ExpectedMotion(ReportRecord):
    """A part that a run by default would make move; whether there is room for it, the run finds."""

    part: str = Field(description="the moving part")
    type: JointType = Field(description="how it moves: revolute, prismatic, continuous")
    confidence: Ratio | None = Field(
        description="the least confidence of the decisions that it rests on; null: its shape or name shows it"
    )
    decided: tuple[str, ...] = Field(description="these decisions in words, each with its confidence and the runner-up")


class StaticPart(ReportRecord):
    """A part that might move and would not."""

    part: str = Field(description="the part")
    reason: str = Field(description="the reason, from the [list of reasons](errors.md#reasons-not-errors)")
    why: str = Field(description="what was found, in words")


class Forecast(ReportRecord):
    """What a run by default would make of it."""

    source: MotionSource = Field(description="what states the motions: network, or rule without weights")
    piece: PieceRecord | None = Field(default=None, description="what the whole piece is; null: not known")
    motions: tuple[ExpectedMotion, ...] = Field(description="the parts that would move")
    static: tuple[StaticPart, ...] = Field(description="the parts that might move and would not")


class Inspection(ReportRecord):
    """The whole inspection."""

    schema_: Literal["grafu.inspection/1"] = schema_field("grafu.inspection/1")
    input: InputRecord = Field(description="what was read")
    frame: FrameRecord = Field(description="how coordinates were mapped")
    size: Vector = Field(description="the size of the whole, metres")
    parts: tuple[InspectedPart, ...] = Field(description="every part")
    contacts: tuple[tuple[str, str], ...] = Field(description="pairs of parts that touch")
    joints: tuple[StatedJoint, ...] = Field(description="the joints that the input states")
    deficiencies: tuple[DeficiencyRecord, ...] = Field(description="what it lacks")
    forecast: Forecast | None = Field(default=None, description="what a run would make of it; null: not asked for")


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
