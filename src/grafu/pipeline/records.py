"""Values of the stages as records of the JSON forms, for report and inspection alike. It decides nothing."""

from dataclasses import asdict

from grafu.additions.step import Deficiency
from grafu.articulation.articulated_object import Coupling
from grafu.asset.part import Asset, Frame, PartSource
from grafu.geometry.arrays import Vec3
from grafu.geometry.axis import Axis
from grafu.pipeline.report_schema import (
    AxisRecord,
    CouplingRecord,
    DeficiencyRecord,
    FrameRecord,
    InputRecord,
    SourceRecord,
    Vector,
)


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


def input_record(asset: Asset, name: str = "") -> InputRecord:
    """Returns what was read; `name` is the name of the results (empty: the asset's)."""
    return InputRecord(
        name=name or asset.name, path=asset.path, kind=asset.kind, parts=len(asset.parts), notes=asset.notes
    )
