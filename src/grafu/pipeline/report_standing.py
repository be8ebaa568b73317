"""The records of how the piece stands, and of catches."""

from grafu.articulation.base import BaseKind
from grafu.articulation.catch_kind import CatchKind
from grafu.pipeline.report_record import ReportRecord, stated


class StabilityRecord(ReportRecord):
    """How safely the piece stands on its own with everything open."""

    mass: float = stated(description="of the whole, kg")
    margin: float = stated(
        description="the least that the centre of mass is inside the polygon on which it stands, closed or open, metres"
    )
    closed_margin: float | None = stated(
        default=None, description="the same with every joint closed; null: written by an earlier version"
    )
    tipping_force: float | None = stated(
        description="the least pull at a grip that tips it, newtons; 0: it tips by itself; null: none does"
    )
    tipping_joint: str = stated(description="the joint of that grip, or empty")
    weight_needed: float = stated(
        description="kg at the far side of its base with which it bears 20 N at doors, 30 N at drawers; 0: none"
    )
    wall_force: float = stated(description="what a wall mount at its upper edge must bear instead, newtons")


class BaseRecord(ReportRecord):
    """What holds the piece in a simulator."""

    kind: BaseKind = stated(description="free: nothing, fixed: to the world, wall: it hangs or leans on one")
    why: str = stated(description="as asked for, by default, or the evidence that it hangs or leans on a wall")
    stability: StabilityRecord | None = stated(
        default=None, description="null: no format with masses was written, or it has no base to stand on"
    )


class CaughtJointRecord(ReportRecord):
    """A joint with a catch."""

    joint: str = stated(description="the joint's id")
    kind: CatchKind = stated(description="detent: held where it is closed; self-closing: pulled closed, and held there")
    effort: float | None = stated(
        description="the force towards closed, newtons; of a hinge newton metres; null: none, or no format with masses "
        "was written"
    )
    reach: float | None = stated(description="the value of the joint, metres or radians, from which on there is none")


class CaughtRecord(ReportRecord):
    """The catches of doors and drawers."""

    joints: tuple[CaughtJointRecord, ...] = stated(description="the joints that have one")
    files: tuple[str, ...] = stated(description="the files that were written in which simulators find their forces")
    files_without: tuple[str, ...] = stated(description="those that were written and whose formats cannot hold them")
