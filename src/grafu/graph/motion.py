"""The only bridge between motion codes and lines in space, both ways.

A face code, like a signed axis, is 2 * axis + (1 for the positive side). A hinge border counts within the door's own
plane: the thin axis of its box is left out, and of the two others, in ascending order, the border's slot (border // 2)
names the axis along which the pin lies off-centre, its last bit on which side. The rotation axis runs along the other.
"""

from typing import Literal, cast

import numpy as np

from grafu.errors import GraphError
from grafu.geometry.arrays import Vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.graph.edges import AxisSign, HingeBorder, SignedAxis

PinDepth = Literal["outward", "official"]
AXIS_NAMES = ("-X", "+X", "-Y", "+Y", "-Z", "+Z")


def code_to_direction(code: SignedAxis) -> Vec3:
    """Returns the unit vector of a signed axis, or the outward normal of a face."""
    direction = np.zeros(3)
    direction[code // 2] = 1.0 if code % 2 else -1.0
    return direction


def direction_to_code(direction: Vec3) -> SignedAxis:
    """Returns the signed axis nearest to a direction (the first of equals)."""
    axis = int(np.argmax(np.abs(direction)))
    return signed_axis(axis, bool(direction[axis] > 0))


def signed_axis(axis: int, positive: bool) -> SignedAxis:
    """Returns the code of an axis (0..2) and a side."""
    return cast(SignedAxis, 2 * axis + int(positive))


def opposite(code: SignedAxis) -> SignedAxis:
    """Returns the code of the opposite face or sense."""
    return cast(SignedAxis, code ^ 1)


def plane_axes(thin: int) -> tuple[int, int]:
    """Returns the two axes of a door's plane in ascending order, given its thin axis."""
    first, second = (axis for axis in range(3) if axis != thin)
    return first, second


def level_axis(thin: int) -> int:
    """Returns the first level axis of a door's plane, given its thin axis; Z is up. An upright door has only one."""
    return 1 if thin == 0 else 0


def border_to_face(thin: int, border: HingeBorder) -> SignedAxis:
    """Returns the face of the door's box that carries the pin (the authors' six-way `hinge_border`)."""
    return signed_axis(plane_axes(thin)[border // 2], border % 2 == 1)


def border_to_signed_axis(thin: int, border: HingeBorder, sign: AxisSign) -> SignedAxis:
    """Returns the signed rotation axis (the authors' `hinge_axis_signed`)."""
    return signed_axis(plane_axes(thin)[1 - border // 2], sign == 1)


def face_to_border(thin: int, face: SignedAxis) -> HingeBorder:
    """Returns the border of a door whose pin lies on this face.

    Raises:
        GraphError: if the face is one of the door's two broad ones.
    """
    if face // 2 == thin:
        raise GraphError(f"a hinge border must be an edge of the door: got its broad face {AXIS_NAMES[face]}")
    slot = plane_axes(thin).index(face // 2)
    return cast(HingeBorder, 2 * slot + face % 2)


def opening_face(thin: int, border: HingeBorder, sign: AxisSign) -> SignedAxis:
    """Returns the broad face that leads when the door opens: its free edge sets off this way."""
    axis = code_to_direction(border_to_signed_axis(thin, border, sign))
    to_free_edge = -code_to_direction(border_to_face(thin, border))
    return direction_to_code(np.cross(axis, to_free_edge))


def sign_for_opening(thin: int, border: HingeBorder, front: SignedAxis) -> AxisSign:
    """Returns the sign with which a door pinned at `border` opens towards its broad face `front`.

    Raises:
        GraphError: if `front` is not a broad face.
    """
    if front // 2 != thin:
        raise GraphError(f"a door must open across its thin axis {'XYZ'[thin]}: got {AXIS_NAMES[front]}")
    return 1 if opening_face(thin, border, 1) == front else 0


def hinge_to_axis(box: Box, border: HingeBorder, sign: AxisSign, depth: PinDepth = "outward") -> Axis:
    """Returns the pin of a door: right-hand rule, positive angles open.

    The point is the middle of the border. Across the thin axis it lies on the side that the door opens to, where a pin
    is freest; `official` is the authors' choice, always the negative side.
    """
    thin = box.thin_axis
    point = box.face_center(border_to_face(thin, border))
    side = opening_face(thin, border, sign) if depth == "outward" else signed_axis(thin, False)
    point[thin] = box.face_center(side)[thin]
    return Axis(point, code_to_direction(border_to_signed_axis(thin, border, sign)))


def axis_to_hinge(box: Box, axis: Axis) -> tuple[HingeBorder, AxisSign]:
    """Returns the border and sign that are nearest to a line in space.

    Raises:
        GraphError: if the axis runs mostly across the door's thin side: no border lies along it.
    """
    thin = box.thin_axis
    along = direction_to_code(axis.direction)
    if along // 2 == thin:
        raise GraphError(f"a hinge axis must lie in the door's plane: it runs along the thin axis {'XYZ'[thin]}")
    across = next(a for a in plane_axes(thin) if a != along // 2)
    offset = float(axis.closest_point(box.center)[across] - box.center[across])
    border = face_to_border(thin, signed_axis(across, offset > 0))
    return border, cast(AxisSign, along % 2)


def rail_to_axis(box: Box, axis: SignedAxis) -> Axis:
    """Returns the slide of a drawer through the middle of its box; positive distances open."""
    return Axis(box.center, code_to_direction(axis))


def axis_to_rail(axis: Axis) -> SignedAxis:
    """Returns the signed axis nearest to a slide."""
    return direction_to_code(axis.direction)


def mirror_face(code: SignedAxis, across: int) -> SignedAxis:
    """Returns a face or translation code in the mirror image across an axis."""
    return opposite(code) if code // 2 == across else code


def mirror_rotation(code: SignedAxis, across: int) -> SignedAxis:
    """Returns a rotation axis in the mirror image: a pseudovector, reversed unless it is parallel to `across`."""
    return code if code // 2 == across else opposite(code)


def mirror_hinge(thin: int, border: HingeBorder, sign: AxisSign, across: int) -> tuple[HingeBorder, AxisSign]:
    """Returns border and sign in the mirror image across an axis."""
    face = mirror_face(border_to_face(thin, border), across)
    rotation = mirror_rotation(border_to_signed_axis(thin, border, sign), across)
    return face_to_border(thin, face), cast(AxisSign, rotation % 2)
