"""How a piece stands: what holds it, why, and what tips it over; for the report. It makes and writes nothing."""

from math import isfinite
from typing import TYPE_CHECKING

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.base import BaseKind
from grafu.articulation.physics import physics_known
from grafu.articulation.stability import Stability, stability_of
from grafu.asset.part import Asset
from grafu.asset.wall_units import hangs_on_wall
from grafu.pipeline.settings import Settings

if TYPE_CHECKING:
    from grafu.pipeline.report_schema import Report
    from grafu.pipeline.report_standing import BaseRecord, StabilityRecord

_DIGITS = 4


def base_of(asset: Asset, settings: Settings) -> BaseKind | None:
    """Returns what holds a piece: as the user states, the wall where it is known to hang or lean there, else None."""
    return settings.base or (BaseKind.WALL if hangs_on_wall(asset) else None)


def base_record(asset: Asset, articulated: ArticulatedObject) -> "BaseRecord":
    """Returns what holds a piece, and why."""
    from grafu.pipeline.report_standing import BaseRecord

    evidence, base = hangs_on_wall(asset), articulated.base
    if base is None:
        return BaseRecord(kind=BaseKind.FIXED, why="by default")
    return BaseRecord(kind=base, why=evidence if base is BaseKind.WALL and evidence else "as asked for")


def with_stability(report: "Report", articulated: ArticulatedObject) -> "Report":
    """Returns the report with what tips the piece over, where masses and shapes were worked out for a format.

    Of a piece that is to stand freely and does not bear the usual pulls a note states it; of one that by default is
    fixed, where as drawn it leans or falls.
    """
    from grafu.pipeline.verdict import with_notes

    physics = physics_known(articulated)
    if physics is None or report.base is None:
        return report
    found = stability_of(articulated, physics.masses, physics.shapes)
    record = report.base.with_changes(stability=None if found is None else _record(found))
    stated = report.with_changes(base=record)
    if report.base.kind is BaseKind.FREE:
        return with_notes(stated, *_notes(record))
    leans = articulated.base is None and found is not None and found.closed_margin < 0
    return with_notes(stated, *_notes(record)) if leans else stated


def _record(found: Stability) -> "StabilityRecord":
    from grafu.pipeline.report_standing import StabilityRecord

    return StabilityRecord(
        mass=round(found.mass, _DIGITS),
        margin=round(found.margin, _DIGITS),
        closed_margin=round(found.closed_margin, _DIGITS),
        tipping_force=round(found.tipping_force, _DIGITS) if isfinite(found.tipping_force) else None,
        tipping_joint=found.tipping_joint,
        weight_needed=round(found.weight_needed, _DIGITS),
        wall_force=round(found.wall_force, _DIGITS),
    )


def _notes(record: "BaseRecord") -> tuple[str, ...]:
    found = record.stability
    if found is None:
        return ("it does not stand by itself: too little of it touches the floor",)
    return () if found.weight_needed == 0 else (stability_words(found),)


def stability_words(found: "StabilityRecord") -> str:
    """Returns in a sentence what tips a piece over, and what it needs."""
    if found.closed_margin is not None and found.closed_margin < 0:
        tips = (
            f"its centre of mass is {-1000 * found.closed_margin:.0f} mm outside of what it stands on, and it tips over"
        )
    elif found.tipping_force == 0 and not found.tipping_joint:
        tips = f"{'' if found.closed_margin is not None else 'closed or '}with everything open it tips over by itself"
    elif found.tipping_force is None:
        return "closed and with everything open no pull at a grip tips it over"
    else:
        tips = f"with everything open a pull of {found.tipping_force:.0f} N at {found.tipping_joint} tips it over"
    if found.weight_needed == 0:
        return tips
    return (
        f"{tips}: it needs {found.weight_needed:.1f} kg more at the far side of its base, or a wall mount at its upper "
        f"edge that bears {found.wall_force:.0f} N"
    )
