"""What all records of a report have in common, those of how the piece stands, and of catches."""

from typing import Any

from pydantic import AliasChoices, BaseModel, ConfigDict, Field

from grafu.articulation.base import BaseKind
from grafu.articulation.catch_kind import CatchKind
from grafu.visible import short_repr


class ReportRecord(BaseModel):
    """Abstract base: frozen, and strict about unknown fields."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    def __repr__(self) -> str:
        return short_repr(type(self).__name__, ((name, getattr(self, name)) for name in type(self).model_fields))

    __str__ = __repr__


def schema_field(name: str) -> Any:
    """Returns the field `schema_`, whose value is `name`; it is called `schema` in JSON, a word that pydantic keeps."""
    alias = AliasChoices("schema", "schema_")
    return Field(default=name, validation_alias=alias, serialization_alias="schema", description="the form's name")


class StabilityRecord(ReportRecord):
    """How safely the piece stands on its own with everything open."""

    mass: float = Field(description="of the whole, kg")
    margin: float = Field(
        description="the least that the centre of mass is inside the polygon on which it stands, closed or open, metres"
    )
    closed_margin: float | None = Field(
        default=None, description="the same with every joint closed; null: written by an earlier version"
    )
    tipping_force: float | None = Field(
        description="the least pull at a grip that tips it, newtons; 0: it tips by itself; null: none does"
    )
    tipping_joint: str = Field(description="the joint of that grip, or empty")
    weight_needed: float = Field(
        description="kg at the far side of its base with which it bears 20 N at doors, 30 N at drawers; 0: none"
    )
    wall_force: float = Field(description="what a wall mount at its upper edge must bear instead, newtons")


class BaseRecord(ReportRecord):
    """What holds the piece in a simulator."""

    kind: BaseKind = Field(description="free: nothing, fixed: to the world, wall: it hangs or leans on one")
    why: str = Field(description="as asked for, by default, or the evidence that it hangs or leans on a wall")
    stability: StabilityRecord | None = Field(
        default=None, description="null: no format with masses was written, or it has no base to stand on"
    )


class CaughtJointRecord(ReportRecord):
    """A joint with a catch."""

    joint: str = Field(description="the joint's id")
    kind: CatchKind = Field(description="detent: held where it is closed; self-closing: pulled closed, and held there")
    effort: float | None = Field(
        description="the force towards closed, newtons; of a hinge newton metres; null: none, or no format with masses "
        "was written"
    )
    reach: float | None = Field(description="the value of the joint, metres or radians, from which on there is none")


class CaughtRecord(ReportRecord):
    """The catches of doors and drawers."""

    joints: tuple[CaughtJointRecord, ...] = Field(description="the joints that have one")
    files: tuple[str, ...] = Field(description="the files that were written in which simulators find their forces")
    files_without: tuple[str, ...] = Field(description="those that were written and whose formats cannot hold them")
