"""Which joints have a catch, and which of the files that were written have it, for the report. It makes nothing."""

from collections.abc import Collection
from typing import Final

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.catch_kind import CatchKind
from grafu.articulation.physics import physics_known
from grafu.pipeline.report_schema import Report
from grafu.pipeline.report_standing import CaughtJointRecord, CaughtRecord
from grafu.pipeline.verdict import with_notes

HOLDS: Final = ("model.xml",)
"""The files in which a simulator finds the force of a catch."""
CANNOT_HOLD: Final = ("model.urdf", "model.sdf", "model.usdc", "model.usdz")
"""The files whose formats know no force that ends: their springs pull harder the further a joint is open."""
_DIGITS = 4


def with_caught(report: Report, articulated: ArticulatedObject, files: Collection[str]) -> Report:
    """Returns the report with the catches of the object's joints, and which of these files have them.

    Where there are joints with a catch and no file that has it, a note states it.
    """
    joints = [joint for joint in articulated.moving_joints if joint.catch is not CatchKind.NONE]
    if not joints:
        return report
    physics = physics_known(articulated)
    forces = {joint.id: physics.dynamics[joint.id].catch for joint in joints} if physics else {}
    records = tuple(
        CaughtJointRecord(
            joint=joint.id,
            kind=joint.catch,
            effort=None if (found := forces.get(joint.id)) is None else round(found.effort, _DIGITS),
            reach=None if found is None else round(found.reach, _DIGITS),
        )
        for joint in joints
    )
    held, lost = (tuple(name for name in names if name in files) for names in (HOLDS, CANNOT_HOLD))
    stated = report.with_changes(caught=CaughtRecord(joints=records, files=held, files_without=lost))
    if held:
        return stated
    return with_notes(stated, "no file that was written has the catches of doors and drawers: add mjcf to --formats")
