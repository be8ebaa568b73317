"""A cabinet with every kind of motion, and predictions about it in any frame, for tests of what other systems say."""

from dataclasses import replace

import numpy as np

from grafu.asset.foreign.motions import ForeignJoint, ForeignMotions, ForeignPart
from grafu.asset.part import AnnotatedJoint, Asset
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import from_rotation, scale_of
from grafu.vocabulary import JointType, PartLabel
from sketches import board, door, drawer, handle, sketch


def cabinet() -> Asset:
    """Returns a cabinet with a door hinged left, one hinged right, a drawer, handles, and no symmetry."""
    L = PartLabel
    return sketch(
        board("side_left", L.SIDE_PANEL, (-0.5, -0.2, 0.0), (-0.48, 0.2, 1.0)),
        board("side_right", L.SIDE_PANEL, (0.48, -0.2, 0.0), (0.5, 0.2, 1.0)),
        board("bottom", L.BOTTOM_PANEL, (-0.48, -0.2, 0.0), (0.48, 0.2, 0.02)),
        board("top", L.TOP_PANEL, (-0.5, -0.2, 1.0), (0.5, 0.2, 1.03)),
        board("back", L.BACK_PANEL, (-0.48, 0.19, 0.02), (0.48, 0.2, 1.0)),
        board("shelf", L.SHELF, (-0.48, -0.18, 0.7), (0.48, 0.19, 0.72)),
        door("door_left", (-0.5, -0.22, 0.0), (-0.1, -0.2, 0.7), "left"),
        door("door_right", (-0.1, -0.22, 0.0), (0.5, -0.2, 0.7), "right"),
        drawer("drawer", (-0.46, -0.22, 0.74), (0.46, 0.15, 0.98)),
        handle("handle_left", "door_left", (-0.13, -0.24, 0.35)),
        handle("handle_right", "door_right", (-0.06, -0.24, 0.35)),
        handle("handle_drawer", "drawer", (0.0, -0.24, 0.86)),
    )


def predicted(asset: Asset, T_file_object: np.ndarray, boxes: bool = False, source: str = "urdf") -> ForeignMotions:
    """Returns the asset's own joints as a prediction in another frame, handles fixed to what they ride on."""
    labels = source == "singapo"
    parts = []
    for part in asset.parts:
        mesh = part.mesh.transformed(T_file_object)
        shape = TriangleMesh.box_mesh(mesh.box) if boxes else mesh
        label = part.label if labels else PartLabel.UNKNOWN
        parts.append(
            ForeignPart(f"their_{part.id}", shape, boxes, label, part.carried_by and f"their_{part.carried_by}")
        )
    scale = scale_of(T_file_object)
    joints = []
    for joint in asset.joints:
        turns = joint.type is JointType.REVOLUTE
        length = 1.0 if turns else scale
        axis = joint.axis.transformed(T_file_object, rotational=turns)
        lower, upper = joint.lower * length, joint.upper * length
        joints.append(ForeignJoint(f"their_{joint.part}", joint.type, axis, lower, upper))
    return ForeignMotions(source, "their.file", tuple(parts), tuple(joints))  # type: ignore[arg-type]


def way(rotation: np.ndarray, scale: float = 1.0, offset: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> np.ndarray:
    """Returns a similarity."""
    return from_rotation(scale * rotation, np.array(offset))


def unlabelled(asset: Asset) -> Asset:
    """Returns the asset with no label at all, nor a joint nor an attached part."""
    parts = tuple(replace(p, label=PartLabel.UNKNOWN, labelled_by="none", carried_by=None) for p in asset.parts)
    return replace(asset, parts=parts, joints=())


def reversed_joints(foreign: ForeignMotions) -> ForeignMotions:
    """Returns the same motions said backwards: axes reversed, ranges from below 0 to 0."""
    joints = tuple(replace(j, axis=j.axis.reversed(), lower=-j.upper, upper=-j.lower) for j in foreign.joints)
    return replace(foreign, joints=joints)


def require_same_joints(found: Asset, truth: Asset, sense: float = 1.0, tolerance: float = 1e-6) -> None:
    """Fails unless the joints are the true ones: type, signed axis, place and range, as a fraction of the size."""
    mine = {joint.part: joint for joint in found.joints}
    assert set(mine) == {joint.part for joint in truth.joints}
    for joint in truth.joints:
        require_same_joint(mine[joint.part], joint, truth.box, sense, tolerance)


def require_same_joint(found: AnnotatedJoint, true: AnnotatedJoint, whole: Box, sense: float, tolerance: float) -> None:
    size = float(whole.size.max())
    assert found.type is true.type
    np.testing.assert_allclose(found.axis.direction, sense * true.axis.direction, atol=tolerance)
    if true.type is JointType.REVOLUTE:
        assert true.axis.distance_to(found.axis.point) <= tolerance * size
    ends = sorted((sense * true.lower, sense * true.upper))
    np.testing.assert_allclose([found.lower, found.upper], ends, atol=tolerance * max(size, 1.0))
