"""Pivots: two discs face to face at an end of a door, one on the door, one on what stands above or below it.

They carry whatever turns about an axis through itself (a tap, a revolving shelf), and doors whose seams leave no room
for leaves. Discs grow from the part that they belong to; where part and body are apart they become posts. Beside the
end of an overlay door, where nothing stands, the static disc sits on a plate that reaches back to the case.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from grafu.articulation.articulated_object import Visual, VisualRole
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster, robust_median
from grafu.joints.config import BlockConfig, RealizationConfig
from grafu.joints.hinge.candidates import PinCandidate
from grafu.joints.hinge.hardware import LOOSE, ONE_END, HingeSite, InstalledHinge
from grafu.joints.hinge_config import PivotConfig
from grafu.joints.support_block import METAL, Footing, block
from grafu.scene.border import BorderFrame
from grafu.vocabulary import PartLabel

PivotEnd = tuple[tuple[Visual, ...], tuple[Visual, ...]]


def pivot_ends(
    frame: BorderFrame, pin: PinCandidate, door: TriangleMesh, static: TriangleMesh, realization: RealizationConfig
) -> list[PivotEnd]:
    """Returns (static, dynamic) discs at each end of the pin where the door and the body near it are met."""
    config = realization.hinge.pivot
    found: list[PivotEnd] = []
    casters, reach = (RayCaster(door), RayCaster(static)), config.reach * frame.length
    for sign in (1.0, -1.0):
        met = met_by_rays(frame, pin, casters, sign, reach, config) or _met_by_corners(
            frame, pin, (door, static), sign, reach, config
        )
        if met is None:
            plated = _plated_end(frame, pin, casters, sign, config, realization.block)
            found += [plated] if plated else []
            continue
        found.append(two_discs(frame, pin, met, sign, config))
    return found


def door_end(frame: BorderFrame, pin: PinCandidate, door: RayCaster, sign: float, config: PivotConfig) -> float:
    """Returns how far from the frame's middle the door ends by the pin, metres; minus infinity where it is not met."""
    outside = frame.length / 2 + config.start
    start = np.array([[x, y, sign * outside] for x, y in _ring(pin, config)])
    met = door.along(frame.to_object(start), frame.direction(0.0, 0.0, -sign))
    return outside - robust_median(met, config.plate_end, config.met)


def two_discs(
    frame: BorderFrame, pin: PinCandidate, met: tuple[float, float, float], sign: float, config: PivotConfig
) -> PivotEnd:
    """Returns the discs on a door's end and on the body beyond it, at the heights and with the radius that are met."""
    on_door, on_body, radius = met
    gap = sign * (on_body - on_door)
    middle = on_door + sign * min(max(gap, 0.0) / 2, config.disc_inset)
    wide = replace(pin, radius=radius)
    on_static = max(sign * on_body, sign * middle) * sign + sign * config.disc_inset
    on_dynamic = min(sign * on_door, sign * middle) * sign - sign * config.disc_inset
    static_disc = disc_at(frame, wide, middle, on_static, config.sides)
    dynamic_disc = disc_at(frame, wide, on_dynamic, middle, config.sides)
    return (pivot_visual("hinge_static", static_disc),), (pivot_visual("hinge_dynamic", dynamic_disc),)


def _plated_end(
    frame: BorderFrame,
    pin: PinCandidate,
    casters: tuple[RayCaster, RayCaster],
    sign: float,
    config: PivotConfig,
    blocks: BlockConfig,
) -> PivotEnd | None:
    """Returns the discs beside an end of a door where the body has nothing, the static one on a plate.

    The plate lies beside the door's end and reaches back along it; a block joins it to what stands behind the door.
    """
    door, static = casters
    on_door = door_end(frame, pin, door, sign, config)
    if not np.isfinite(on_door):
        return None
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
        frame.to_object(vec3(pin.x, back + config.foot * config.plate_reach, sign * inner)[None])[0],
        frame.direction(0.0, 0.0, -sign),
        frame.direction(config.foot_width * pin.radius, 0.0, 0.0),
        frame.direction(0.0, config.foot_depth * config.plate_reach, 0.0),
    )
    gap = foot.gap(static, config.plate_reach, blocks)
    if not np.isfinite(gap):
        return None
    still = (
        pivot_visual("hinge_static", disc_at(frame, pin, middle, sign * outer, config.sides)),
        block("hinge_plate", plate, config.plate, blocks, METAL),
        block("support_hinge", foot, gap, blocks, METAL),
    )
    moving = disc_at(frame, pin, sign * (on_door - config.disc_inset), middle, config.sides)
    return still, (pivot_visual("hinge_dynamic", moving),)


def met_by_rays(
    frame: BorderFrame,
    pin: PinCandidate,
    casters: tuple[RayCaster, RayCaster],
    sign: float,
    reach: float,
    config: PivotConfig,
) -> tuple[float, float, float] | None:
    """Returns the z of the door's end and of the body beyond it on the pin's line, and the pin's radius."""
    door, static = casters
    outside = frame.length / 2 + config.start
    direction = frame.direction(0.0, 0.0, sign)
    ring = np.array(list(_ring(pin, config)))
    start = np.column_stack([ring, np.full(len(ring), sign * outside)])
    to_door = robust_median(door.along(frame.to_object(start), -direction), frame.length, config.met)
    if not np.isfinite(to_door):
        return None
    on_door = sign * (outside - to_door)
    inside = config.inside * frame.length
    start[:, 2] = on_door - sign * inside
    to_body = robust_median(static.along(frame.to_object(start), direction), reach + inside, config.met)
    return (on_door, float(start[0, 2]) + sign * to_body, pin.radius) if np.isfinite(to_body) else None


def _met_by_corners(
    frame: BorderFrame,
    pin: PinCandidate,
    meshes: tuple[TriangleMesh, TriangleMesh],
    sign: float,
    reach: float,
    config: PivotConfig,
) -> tuple[float, float, float] | None:
    """Returns the same for tubes and sockets, which rays along the axis pass through: from corners about the pin."""
    corners = [frame.to_border(mesh.vertices) * _upright(sign) for mesh in meshes]
    for radius in np.array(config.tubes) * pin.radius:
        near = [c[np.hypot(c[:, 0] - pin.x, c[:, 1] - pin.y) <= radius, 2] for c in corners]
        if not all(len(heights) for heights in near):
            continue
        on_door = float(near[0].max())
        beyond = near[1][np.abs(near[1] - on_door) <= max(reach, config.tube_reach * frame.length)]
        if len(beyond):
            rim = corners[0][np.abs(corners[0][:, 2] - on_door) <= config.disc_inset]
            wide = np.hypot(rim[:, 0] - pin.x, rim[:, 1] - pin.y)
            met = sign * float(beyond[np.argmin(np.abs(beyond - on_door))])
            return sign * on_door, met, float(wide[wide <= radius].max(initial=pin.radius))
    return None


def _upright(sign: float) -> np.ndarray:
    """Returns the factors that turn border coordinates so that the end in question points up."""
    return np.array([1.0, 1.0, sign])


def _ring(pin: PinCandidate, config: PivotConfig) -> Iterator[tuple[float, float]]:
    yield pin.x, pin.y
    radius = config.ring * pin.radius
    for angle in 2 * np.pi * np.arange(config.rays) / config.rays:
        yield pin.x + radius * np.cos(angle), pin.y + radius * np.sin(angle)


def disc_at(frame: BorderFrame, pin: PinCandidate, start: float, end: float, sides: int) -> TriangleMesh:
    """Returns the watertight cylinder about a pin between two heights of a border frame, in the object frame."""
    return upright_disc(frame, (pin.x, pin.y), pin.radius, (start, end), sides)


def upright_disc(
    frame: BorderFrame, middle: tuple[float, float], radius: float, ends: tuple[float, float], sides: int
) -> TriangleMesh:
    """Returns the watertight cylinder about (x, y) of a border frame between two heights, in the object frame."""
    (x, y), low, high = middle, min(ends), max(ends)
    angles = np.arange(sides) * 2 * np.pi / sides
    circle = np.column_stack([x + radius * np.cos(angles), y + radius * np.sin(angles)])
    rings = [np.column_stack([circle, np.full(sides, z)]) for z in (low, high)]
    vertices = np.vstack([*rings, vec3(x, y, low), vec3(x, y, high)])
    k, n = np.arange(sides), np.roll(np.arange(sides), -1)
    bottom, top = np.full(sides, 2 * sides), np.full(sides, 2 * sides + 1)
    walls = [np.column_stack(c) for c in ((k, n, n + sides), (k, n + sides, k + sides))]
    caps = [np.column_stack([bottom, n, k]), np.column_stack([top, k + sides, n + sides])]
    return TriangleMesh(frame.to_object(vertices), np.vstack([*walls, *caps]))


def pivot_visual(name: str, mesh: TriangleMesh) -> Visual:
    """Returns a piece of metal hardware."""
    return Visual(name, (Surface(mesh, METAL),), VisualRole.HARDWARE, PartLabel.MISC)


def with_flaw(hinge: InstalledHinge, pin: PinCandidate, site: HingeSite) -> InstalledHinge:
    """Returns a pivot with its flaw, if any: no static part carries it, or it is wide to reach one beside the door."""
    points = site.frame.to_border(hinge.dynamic[0].mesh.vertices)
    is_wide = float(np.ptp(points[:, 0])) > 2 * site.config.pivot.widest * pin.radius
    is_carried = site.scene.is_near_static(merge_meshes(hinge.static_meshes), site.anchor, site.holders)
    return hinge if is_carried and not is_wide else replace(hinge, struck_by=(*hinge.struck_by, LOOSE))


def with_both_ends(hinges: Sequence[InstalledHinge]) -> list[InstalledHinge]:
    """Returns the pivots of a door, the only one with that as its flaw: it leaves the other end without hold."""
    if len(hinges) != 1:
        return [*hinges]
    return [replace(hinges[0], struck_by=(*hinges[0].struck_by, ONE_END))]


def is_on_mount(hinge: InstalledHinge, site: HingeSite) -> bool:
    """Whether the static end sits on what alone may hold it, if that is limited."""
    static = merge_meshes(hinge.static_meshes)
    return not site.holders or site.scene.is_near_static(static, site.anchor, site.holders)
