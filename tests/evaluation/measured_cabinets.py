"""A small cabinet of boxes whose figures follow from its construction: 1 m wide and high, one door, one drawer."""

from dataclasses import replace
from math import radians

from grafu.asset.part import AnnotatedJoint, Asset
from grafu.evaluation.methods import Method, made_by
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.vocabulary import JointType, PartLabel
from sketches import Sketched, board, door, drawer, handle, sketch

DOOR, DRAWER = "door", "drawer"


def carcass() -> tuple[Sketched, ...]:
    """Returns two sides, a top, a bottom, a shelf and a back; 1 m wide and high, 0.5 deep, open to -Y."""
    return (
        board("left", PartLabel.SIDE_PANEL, (-0.5, -0.25, 0.0), (-0.48, 0.25, 1.0)),
        board("right", PartLabel.SIDE_PANEL, (0.48, -0.25, 0.0), (0.5, 0.25, 1.0)),
        board("top", PartLabel.TOP_PANEL, (-0.48, -0.25, 0.98), (0.48, 0.25, 1.0)),
        board("bottom", PartLabel.BOTTOM_PANEL, (-0.48, -0.25, 0.0), (0.48, 0.25, 0.02)),
        board("shelf", PartLabel.SHELF, (-0.48, -0.25, 0.60), (0.48, 0.23, 0.62)),
        board("back", PartLabel.BACK_PANEL, (-0.48, 0.23, 0.02), (0.48, 0.25, 0.98)),
    )


def cabinet(hinge: str = "left", name: str = "cabinet", handle_at: float = 0.42) -> Asset:
    """Returns the cabinet; its door lies before the carcass with a seam of 1 mm, pinned at its front edge."""
    pieces = (
        door(DOOR, (-0.5, -0.271, 0.0), (0.5, -0.251, 0.6), hinge),
        handle("handle", DOOR, (handle_at, -0.291, 0.3)),
        drawer(DRAWER, (-0.478, -0.25, 0.63), (0.478, 0.15, 0.97)),
    )
    return replace(sketch(*carcass(), *pieces), name=name)


def turning(x: float, y: float, sense: float, part: str = DOOR, reference: float = radians(90)) -> RealizationPlan:
    """Returns a plan that turns a part about an upright line at (x, y); `sense` 1 turns it counter-clockwise."""
    axis = Axis(vec3(x, y, 0.3), vec3(0.0, 0.0, sense))
    return RealizationPlan((JointRequest(part, JointType.REVOLUTE, axis, "test", reference, (), ("handle",)),))


def sliding(direction: tuple[float, float, float], part: str = DRAWER, reference: float = 0.3) -> RealizationPlan:
    """Returns a plan that slides a part."""
    axis = Axis(vec3(0.0, 0.0, 0.8), vec3(*direction))
    return RealizationPlan((JointRequest(part, JointType.PRISMATIC, axis, "test", reference),))


def restated(asset: Asset, part: str, **changes: object) -> Asset:
    """Returns the asset with one joint stated otherwise."""
    joints: tuple[AnnotatedJoint, ...] = tuple(replace(j, **changes) if j.part == part else j for j in asset.joints)
    return replace(asset, joints=joints)


def made(asset: Asset, method: str = "annotation"):
    """Returns what the pipeline makes of the asset, joints alone."""
    return made_by(Method(method), asset, asset.name, joints_alone=True)
