"""Faults of how moving bodies can be grasped, in words, for `judge_additions.py`."""

from collections.abc import Iterator

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, Visual, VisualRole
from grafu.evaluation.completeness import SKIN
from grafu.geometry.mesh import merge_meshes
from grafu.judging.handles import handle_faults
from grafu.metrics.bodies import largest_side
from grafu.metrics.judged import judged_piece
from grafu.pipeline.functionalize import Functionalized
from grafu.pipeline.report import report_of
from grafu.scene.scale import metre_on
from grafu.vocabulary import PartLabel

WIDE = 0.9  # metres: from here on two handles are no waste


def grasp_faults(result: Functionalized) -> Iterator[str]:
    """Yields moving bodies that nothing can be grasped of, and those with more handles than they need."""
    grasps = {joint.part: joint.grasp for joint in report_of(result).joints}
    factor = metre_on(largest_side(result.object))
    for joint in result.object.joints:
        visuals, added = result.object.link(joint.child).visuals, new_handles(result.object, joint)
        carved = [c for c in result.fittings.changes.carved if c.part.id in {v.name for v in visuals}]
        before = result.fittings.grasps[joint.child]
        if grasps[joint.child] == "none":
            yield f"`{joint.child}` cannot be grasped"
        width = float(np.max(merge_meshes([v.mesh for v in visuals]).box.size[:2])) / factor
        if len(added) + len(carved) > (2 if width >= WIDE else 1):
            yield f"`{joint.child}` has {len(added)} handles and {len(carved)} grips"
        if (added or carved) and before.kind in ("handle", "recess"):
            yield f"`{joint.child}` had a {before.kind} and got another"


def worded_handle_faults(result: Functionalized) -> Iterator[str]:
    """Yields added handles that cut into anything along their path, or that other moving bodies run into on theirs."""
    piece = judged_piece(result.object)
    yield from (f"`{a}` {what} `{b}`" for a, what, b in handle_faults(piece, SKIN * piece.largest_side))


def new_handles(articulated: ArticulatedObject, joint: Joint) -> list[Visual]:
    """Returns the handles that the moving part of a joint was given."""
    visuals = articulated.link(joint.child).visuals
    return [v for v in visuals if v.role is VisualRole.ADDED and v.label is PartLabel.HANDLE]
