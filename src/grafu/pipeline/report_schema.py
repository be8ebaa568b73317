"""The form of `report.json`, version `grafu.report/1`, as checked values. docs/report.md is drawn from this file.

Lengths are metres, angles radians, points and directions in the output's frame (Z up, front -Y) unless said otherwise.
"""

from typing import Final, Literal

from grafu.additions.step import DeficiencyKind
from grafu.graph.completion import Question
from grafu.joints.report import LIFT_ARMS
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.report_changes import AddedRecord, CarvedRecord
from grafu.pipeline.report_record import Count, FiniteFloat, Ratio, ReportRecord, stated
from grafu.pipeline.report_standing import BaseRecord, CaughtRecord
from grafu.pipeline.words import Colour, FaultKind, Grasp
from grafu.refusal import Asked, Reason
from grafu.vocabulary import JointType, MechanismClass, PartLabel, PieceKind

Vector = tuple[FiniteFloat, FiniteFloat, FiniteFloat]
Row = tuple[FiniteFloat, FiniteFloat, FiniteFloat, FiniteFloat]
NOT_ADDED: Final = "not added"


class InputRecord(ReportRecord):
    """What was read."""

    name: str = stated(description="the name of the results: the file's stem, or the folder's name")
    path: str = stated(description="the input as it was given")
    kind: str = stated(
        description="how it was read: partnet-mobility, hssd, urdf, sdf, mjcf, glb, mesh folder, mesh file"
    )
    parts: int = stated(description="the number of parts")
    notes: tuple[str, ...] = stated(description="what the reader left out or mended")


class FrameRecord(ReportRecord):
    """How the input's coordinates became the output's."""

    input_to_output: tuple[Row, Row, Row, Row] = stated(
        description="4x4, row-major; from the mesh files' coordinates (for a URDF: its static root link's)"
    )
    up: str = stated(description="the input's axis that points up")
    front: str = stated(description="the input's axis that points out of the front")
    scale: float = stated(description="metres per unit of the input")
    assumed: tuple[str, ...] = stated(description="what was decided, and why")


class SourceRecord(ReportRecord):
    """Where a part came from."""

    name: str = stated(description="its name in the input")
    file: str = stated(description="the mesh file, or empty")
    link: str = stated(description="the link, or empty")


class PartRecord(ReportRecord):
    """One part of the input."""

    id: str = stated(description="its id: the visual's name in model.urdf, the node's in model.glb and graph.json")
    source: SourceRecord = stated(description="where it came from")
    category: PartLabel = stated(description="its category, as completed")
    labelled_by: str = stated(
        description="what the category rests on: name, shape, joint, annotation, user, prediction, added, hidden, none"
    )
    link: str = stated(description="the link of model.urdf that holds it; empty: it was replaced")


class DeficiencyRecord(ReportRecord):
    """One thing that the input lacked."""

    kind: DeficiencyKind = stated(description="what was missing")
    part: str = stated(description="at which part; empty: the object as a whole")
    detail: str = stated(description="what was looked for")


class AxisRecord(ReportRecord):
    """A line in space."""

    origin: Vector = stated(description="a point on it")
    direction: Vector = stated(description="its unit direction; positive motion opens, by the right-hand rule")


class CouplingRecord(ReportRecord):
    """A joint follows another, its leader: value = multiplier x the leader's value + offset."""

    leader: str = stated(description="the joint that it follows; for a stated joint, the part that its leader moves")
    multiplier: float = stated(description="how far it moves for each unit of the leader's value")
    offset: float = stated(description="its value where the leader's is 0, radians or metres")


class ClearanceRecord(ReportRecord):
    """Material that was taken away so that a part can move."""

    part: str = stated(description="what was cut")
    kind: str = stated(
        description="joined, separated (shells of the case), closed, trimmed (the moving part), eased (shrunk), "
        "carved (a static part)"
    )
    amount: float = stated(
        description="how deep or how far, metres or radians; carved, separated: the root of the removed area"
    )
    share: Ratio = stated(
        description="fraction removed; carved: the larger of the next two; eased: of the volume; trimmed: of a side; "
        "separated: of the moving body's surface"
    )
    surface_share: Ratio = stated(default=0.0, description="of the part's outer surface, which is what is seen of it")
    volume_share: Ratio = stated(default=0.0, description="of the volume of the convex hulls of its pieces")
    why: str = stated(description="what it blocked")


class GraspFrameRecord(ReportRecord):
    """Where a gripper with two fingers takes hold of the moving link, at rest."""

    name: str = stated(description="the name of its frame in model.xml, model.sdf and model.usdc")
    part: str = stated(description="the visual that is held")
    kind: Grasp = stated(description="what is held, as in `grasp`")
    position: Vector = stated(description="a point on the surface of what is held")
    approach: Vector = stated(description="unit vector from the hand into the piece: z of the frame")
    closing: Vector = stated(description="unit vector along which the fingers close: y of the frame")
    width: float = stated(description="what lies between the fingers; 0: they hook in closed, and pull at +`closing`")
    depth: float = stated(
        description="how far past `position` both fingers have room, at most 20 mm; 0: they have none"
    )


class JointRecord(ReportRecord):
    """One joint that was built, with what was measured on it."""

    id: str = stated(description="the joint's name in model.urdf")
    part: str = stated(description="the moving part, which is also the link's name")
    type: JointType = stated(description="revolute or prismatic")
    axis: Vector = stated(description="the rectified axis: unit direction, positive opens")
    origin: Vector = stated(description="a point on the rectified axis")
    lower: float = stated(description="the lower limit; 0 is closed")
    upper: float = stated(description="the upper limit, rectified")
    mount: str = stated(description="the part that carries it: a static one, or one of the link `parent`")
    mechanism: MechanismClass = stated(description="the class of mechanism")
    template: str = stated(description="the template that was installed")
    count: int = stated(description="how many hinges or rails")
    motion_source: str = stated(description="what stated the motion")
    initial_axis: AxisRecord = stated(description="the axis as it was stated")
    rectified_axis: AxisRecord = stated(description="the axis as it was built")
    opening: float = stated(description="the range of the joint")
    reference: float | None = stated(description="the opening that was asked for; null: as far as it goes")
    wanted: float | None = stated(
        default=None,
        description="the opening it should have: as asked for, else as usual, at most what its kind allows",
    )
    restricted: bool = stated(description="whether the opening is under 70 % of the reference")
    collision_share: Ratio = stated(description="fraction of poses in which it still cuts into something")
    stays: int = stated(default=0, description="how many stays it has besides its hinges: a lid or a flap")
    largest_gap: float = stated(description="the widest gap between the link and what carries it, over the motion")
    after: tuple[str, ...] = stated(description="joints that must be open before this one can move")
    parent: str = stated(default="", description="the link of model.urdf that carries it; empty: not stated")
    follows: CouplingRecord | None = stated(default=None, description="the joint that it follows; null: none")
    grasp: Grasp = stated(
        description="how it can be grasped (`itself`: a knob or button is held, `driven`: a drive, or the whole piece, "
        "moves it); a follower without a grasp: how its leader can be"
    )
    grasp_frames: tuple[GraspFrameRecord, ...] = stated(default=(), description="its grips: handles, else one or none")
    small: bool = stated(default=False, description="whether it is a knob, a button, a wheel or a caster")
    clearances: tuple[ClearanceRecord, ...] = stated(description="what was cut for it")
    notes: tuple[str, ...] = stated(description="what the user should check")
    left_out: tuple[str, ...] = stated(
        default=(), description="which other hinges were tried and left out, and why; no fault of those that were built"
    )

    @property
    def is_front(self) -> bool:
        """Whether a door, a drawer or the like moves on it: neither a small part nor arms alone that lift a flap."""
        return not self.small and (self.template != LIFT_ARMS or self.follows is not None)


class SkippedRecord(ReportRecord):
    """A request that was not built."""

    request: str = stated(description="the part that was to move, or what was to be added")
    reason: Reason | Literal["not added"] = stated(
        description="for a joint, its cause; for an addition `not added`, unless it was too complex"
    )
    detail: str = stated(description="what was found, in words")
    what: Asked | None = stated(
        default=None,
        description="what was asked for: joint, top, carcass board, drawer box, grasp, interior, additions (several)",
    )
    cause: Reason | None = stated(
        default=None, description="why, from the [list of reasons](errors.md#reasons-not-errors)"
    )

    @property
    def sentence(self) -> str:
        """The cause in one plain sentence; empty in reports that state none."""
        return "" if self.cause is None else self.cause.sentence


class MotionRecord(ReportRecord):
    """Where the motions came from."""

    source: MotionSource = stated(description="annotation, network, rule, particulate, singapo, grafu-pred or urdf")
    stated_joints: Count = stated(default=0, description="how many joints the input itself states")
    unused_joints: Count = stated(
        default=0, description="how many of these were not read: another source stated the motions"
    )


class GuessRecord(ReportRecord):
    """A decision of the motion source that a motion rests on; what the user stated is no guess."""

    part: str = stated(description="the part")
    question: Question = stated(
        description="label: its category; border: the side it turns about; sign, slide: that it opens to"
    )
    choice: str = stated(description="the answer: a category, or a side of the piece")
    score: Ratio = stated(description="the confidence, 0..1")
    runner_up: str = stated(description="what would have come next, or empty")
    runner_up_score: Ratio = stated(description="the confidence of the runner-up")


class PieceRecord(ReportRecord):
    """What the whole piece is, as the network predicts it."""

    kind: PieceKind = stated(description=", ".join(PieceKind))
    score: Ratio = stated(description="the confidence, 0..1")
    runner_up: PieceKind = stated(description="what would have come next")
    runner_up_score: Ratio = stated(description="the confidence of the runner-up")


class FaultRecord(ReportRecord):
    """One fault."""

    part: str = stated(description="the part, or what was asked for; empty: the object as a whole")
    kind: FaultKind = stated(description=", ".join(FaultKind))
    colour: Colour = stated(description="red: it does not work; yellow: it works, with something to look at")
    why: str = stated(description="why, in words, with its figure")
    option: str = stated(description="what may correct it, for the same command with --overwrite; or empty")


class VerdictRecord(ReportRecord):
    """The verdict on the result: green if all doors and drawers work and nothing was guessed."""

    colour: Colour = stated(description="red, yellow or green: that of the worst line; green: there is none")
    sentence: str = stated(description="the same in one sentence")
    lines: tuple[FaultRecord, ...] = stated(description="all faults, red lines first")
    least_confidence: Ratio = stated(description="a decision with a lower score is a guess")
    least_opening: Ratio = stated(
        description="a joint that opens by a smaller fraction of what it should is restricted"
    )
    most_carved: Ratio = stated(description="a part of which a larger fraction was cut away is carved too much")


class Report(ReportRecord):
    """The whole report."""

    schema: Literal["grafu.report/1"] = stated(default="grafu.report/1", description="the form's name")
    version: str = stated(description="the version of grafu")
    input: InputRecord = stated(description="what was read")
    frame: FrameRecord = stated(description="how coordinates were mapped")
    motion: MotionRecord = stated(description="where the motions came from")
    verdict: VerdictRecord | None = stated(
        default=None, description="the verdict on the result; null: written by an earlier version"
    )
    size: Vector | None = stated(
        default=None, description="the size of the input, metres; null: written by an earlier version"
    )
    base: BaseRecord | None = stated(
        default=None, description="what holds it, and what tips it over; null: written by an earlier version"
    )
    caught: CaughtRecord | None = stated(default=None, description="catches of doors and drawers; null: there are none")
    piece: PieceRecord | None = stated(
        default=None, description="what the whole piece is; null: not known, or another motion source was used"
    )
    parts: tuple[PartRecord, ...] = stated(description="every part of the input")
    deficiencies: tuple[DeficiencyRecord, ...] = stated(description="what the input lacked")
    joints: tuple[JointRecord, ...] = stated(description="what moves now")
    added: tuple[AddedRecord, ...] = stated(description="parts that were added")
    carved: tuple[CarvedRecord, ...] = stated(default=(), description="grips and compartments cut into parts")
    skipped: tuple[SkippedRecord, ...] = stated(description="what was asked for and not built")
    notes: tuple[str, ...] = stated(
        default=(),
        description="what was simplified or left out: the budget was too small, or collision shapes are too many",
    )
    guesses: tuple[GuessRecord, ...] = stated(default=(), description="decisions that motions rest on")
    moves: dict[str, tuple[str, ...]] = stated(
        default_factory=dict, description="by part, the options that say how else it moves, the likeliest first"
    )
    timings: dict[str, float] = stated(description="seconds per stage")

    @property
    def additions(self) -> tuple[AddedRecord | CarvedRecord, ...]:
        """The parts that were added, then what was cut into parts."""
        return (*self.added, *self.carved)
