"""Pivots: two discs face to face at an end of a door, one on the door, one on what stands above or below it.

They carry whatever turns about an axis through itself (a tap, a revolving shelf), and doors whose seams leave no room
for leaves. Discs grow from the part that they belong to; where part and body are apart they become posts. Beside the
end of an overlay door, where nothing stands, the static disc sits on a plate that reaches back to the case.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from grafu.articulation.articulated_object import Visual, VisualRole
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster, robust_median
from grafu.joints.config import HingeConfig
from grafu.joints.hinge.candidates import PinCandidate
from grafu.joints.support_block import METAL, Footing, block
from grafu.scene.border import BorderFrame
from grafu.vocabulary import PartLabel

_SEGMENTS = 24  # sides of a disc


PivotEnd = tuple[tuple[Visual, ...], tuple[Visual, ...]]


def pivot_ends(
    frame: BorderFrame, pin: PinCandidate, door: TriangleMesh, static: TriangleMesh, reach: float, config: HingeConfig
) -> list[PivotEnd]:
    """Returns (static, dynamic) discs at each end of the pin where the door and, within `reach`, the body are met."""
    found: list[PivotEnd] = []
    casters = RayCaster(door), RayCaster(static)
    for sign in (1.0, -1.0):
        met = _met_by_rays(frame, pin, casters, sign, reach) or _met_by_corners(
            frame, pin, (door, static), sign, reach, config
        )
        if met is None:
            plated = _plated_end(frame, pin, casters, sign, config)
            found += [plated] if plated else []
            continue
        on_door, on_body, radius = met
        gap = sign * (on_body - on_door)
        middle = on_door + sign * min(max(gap, 0.0) / 2, config.disc_inset)
        wide = replace(pin, radius=radius)
        static_disc = _disc(frame, wide, middle, max(sign * on_body, sign * middle) * sign + sign * config.disc_inset)
        dynamic_disc = _disc(frame, wide, min(sign * on_door, sign * middle) * sign - sign * config.disc_inset, middle)
        found.append(((_visual("hinge_static", static_disc),), (_visual("hinge_dynamic", dynamic_disc),)))
    return found


def _plated_end(
    frame: BorderFrame, pin: PinCandidate, casters: tuple[RayCaster, RayCaster], sign: float, config: HingeConfig
) -> PivotEnd | None:
    """Returns the discs beside an end of a door where the body has nothing, the static one on a plate.

    The plate lies beside the door's end and reaches back along it; a block joins it to what stands behind the door.
    """
    door, static = casters
    start = np.array([[x, y, sign * (frame.length / 2 + 0.01)] for x, y in _ring(pin)])
    to_door = robust_median(door.along(frame.to_object(start), frame.direction(0.0, 0.0, -sign)), 0.02, 0.6)
    if not np.isfinite(to_door):
        return None
    on_door = frame.length / 2 + 0.01 - to_door
    inner, outer = on_door + config.plate_play, on_door + config.plate_play + config.plate
    back = -frame.thickness - config.plate_reach
    middle = sign * (on_door + config.plate_play / 2)
    plate = Footing(
        frame.to_object(vec3(pin.x, (pin.y + pin.radius + back) / 2, sign * inner)[None])[0],
        frame.direction(0.0, 0.0, sign),
        frame.direction(pin.radius, 0.0, 0.0),
        frame.direction(0.0, (pin.y + pin.radius - back) / 2, 0.0),
    )
    foot = Footing(
        frame.to_object(vec3(pin.x, back + 0.4 * config.plate_reach, sign * inner)[None])[0],
        frame.direction(0.0, 0.0, -sign),
        frame.direction(0.9 * pin.radius, 0.0, 0.0),
        frame.direction(0.0, 0.36 * config.plate_reach, 0.0),
    )
    gap = foot.gap(static, config.plate_reach)
    if not np.isfinite(gap):
        return None
    still = (
        _visual("hinge_static", _disc(frame, pin, middle, sign * outer)),
        block("hinge_plate", plate, config.plate, METAL),
        block("support_hinge", foot, gap, METAL),
    )
    return still, (_visual("hinge_dynamic", _disc(frame, pin, sign * (on_door - config.disc_inset), middle)),)


def _met_by_rays(
    frame: BorderFrame, pin: PinCandidate, casters: tuple[RayCaster, RayCaster], sign: float, reach: float
) -> tuple[float, float, float] | None:
    """Returns the z of the door's end and of the body beyond it on the pin's line, and the pin's radius."""
    door, static = casters
    outside = frame.length / 2 + 0.01
    direction = frame.direction(0.0, 0.0, sign)
    ring = np.array(list(_ring(pin)))
    start = np.column_stack([ring, np.full(len(ring), sign * outside)])
    to_door = robust_median(door.along(frame.to_object(start), -direction), frame.length, 0.6)
    if not np.isfinite(to_door):
        return None
    on_door = sign * (outside - to_door)
    start[:, 2] = on_door - sign * 0.4 * frame.length
    to_body = robust_median(static.along(frame.to_object(start), direction), reach + 0.4 * frame.length, 0.6)
    return (on_door, float(start[0, 2]) + sign * to_body, pin.radius) if np.isfinite(to_body) else None


def _met_by_corners(
    frame: BorderFrame,
    pin: PinCandidate,
    meshes: tuple[TriangleMesh, TriangleMesh],
    sign: float,
    reach: float,
    config: HingeConfig,
) -> tuple[float, float, float] | None:
    """Returns the same for tubes and sockets, which rays along the axis pass through: from corners about the pin."""
    corners = [frame.to_border(mesh.vertices) * _upright(sign) for mesh in meshes]
    for radius in np.array([1.5, 3.0, 5.0, 8.0]) * pin.radius:
        near = [c[np.hypot(c[:, 0] - pin.x, c[:, 1] - pin.y) <= radius, 2] for c in corners]
        if not all(len(heights) for heights in near):
            continue
        on_door = float(near[0].max())
        beyond = near[1][np.abs(near[1] - on_door) <= max(reach, 0.25 * frame.length)]
        if len(beyond):
            rim = corners[0][np.abs(corners[0][:, 2] - on_door) <= config.disc_inset]
            wide = np.hypot(rim[:, 0] - pin.x, rim[:, 1] - pin.y)
            met = sign * float(beyond[np.argmin(np.abs(beyond - on_door))])
            return sign * on_door, met, float(wide[wide <= radius].max(initial=pin.radius))
    return None


def _upright(sign: float) -> np.ndarray:
    """Returns the factors that turn border coordinates so that the end in question points up."""
    return np.array([1.0, 1.0, sign])


def _ring(pin: PinCandidate) -> Iterator[tuple[float, float]]:
    yield pin.x, pin.y
    for k in range(6):
        yield pin.x + 0.7 * pin.radius * np.cos(k * np.pi / 3), pin.y + 0.7 * pin.radius * np.sin(k * np.pi / 3)


def _disc(frame: BorderFrame, pin: PinCandidate, start: float, end: float) -> TriangleMesh:
    """Returns the watertight cylinder about the pin between two heights, in the object frame."""
    low, high = min(start, end), max(start, end)
    angles = np.arange(_SEGMENTS) * 2 * np.pi / _SEGMENTS
    circle = np.column_stack([pin.x + pin.radius * np.cos(angles), pin.y + pin.radius * np.sin(angles)])
    rings = [np.column_stack([circle, np.full(_SEGMENTS, z)]) for z in (low, high)]
    vertices = np.vstack([*rings, vec3(pin.x, pin.y, low), vec3(pin.x, pin.y, high)])
    k, n = np.arange(_SEGMENTS), np.roll(np.arange(_SEGMENTS), -1)
    bottom, top = np.full(_SEGMENTS, 2 * _SEGMENTS), np.full(_SEGMENTS, 2 * _SEGMENTS + 1)
    walls = [np.column_stack(c) for c in ((k, n, n + _SEGMENTS), (k, n + _SEGMENTS, k + _SEGMENTS))]
    caps = [np.column_stack([bottom, n, k]), np.column_stack([top, k + _SEGMENTS, n + _SEGMENTS])]
    return TriangleMesh(frame.to_object(vertices), np.vstack([*walls, *caps]))


def _visual(name: str, mesh: TriangleMesh) -> Visual:
    return Visual(name, (Surface(mesh, METAL),), VisualRole.HARDWARE, PartLabel.MISC)
