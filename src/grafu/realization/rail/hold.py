"""What holds one rail of a pair: what it touches, or a support that bridges the way to the case and to the drawer.

A support is a block to whatever is nearest, a slab to the wall beside the rail, or an upright board along it, as was
chosen. It judges no motion.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Visual, VisualRole
from grafu.geometry.arrays import Mat4
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.raycast import RayCaster
from grafu.realization.placement import CHOSEN_REACH
from grafu.realization.plan import Supports
from grafu.realization.rail.search import DrawerSearch
from grafu.realization.support_block import Footing, block, shortest_bridge
from grafu.templates.template import RailTemplate, TemplateEnd
from grafu.vocabulary import PartLabel

_BOARD = 0.016  # thickness of a divider where there is room for it, metres
_THINNEST = 0.003  # a divider thinner than this carries nothing
_AIR = 0.001  # kept between a divider and what stands behind it


@final
@dataclass(frozen=True)
class HeldRail:
    """One rail's static and dynamic end with their supports; `is_on_mount`: whether the chosen mount carries it."""

    static: tuple[Visual, ...]
    dynamic: tuple[Visual, ...]
    is_on_mount: bool


def held_rail(template: RailTemplate, T: Mat4, side: str, search: DrawerSearch) -> HeldRail | None:
    """Returns one rail at a pose with what holds it; None where nothing that may hold it is in reach."""
    name = f"{search.request.moving}_{side}"
    static, dynamic = template.static.transformed(T), template.dynamic.transformed(T)
    carried = _carried(f"{name}_dynamic", dynamic, T, search)
    if carried is None:
        return None
    mount = search.request.choice.mount
    on_mount = _fixed(f"{name}_static", static, T, search, mount) if mount else None
    fixed = on_mount or _fixed(f"{name}_static", static, T, search, "")
    return None if fixed is None else HeldRail(fixed, carried, on_mount is not None)


def _fixed(name: str, end: TemplateEnd, T: Mat4, search: DrawerSearch, mount: str) -> tuple[Visual, ...] | None:
    """Returns a rail's static end fixed to the case, or to one part of it; None where it is out of reach."""
    rail = _visual(f"rail_{name}", end)
    if search.scene.is_near_static(end.mesh, search.config.anchor * search.scene.unit, mount):
        return (rail,)
    if search.request.choice.supports is Supports.NONE:
        return None
    if not mount and _meets_divider(end, search):
        return (rail,)
    walls = search.walls_of(mount) if mount else search.static_rays
    reach = (CHOSEN_REACH if mount else search.config.bridge) * search.scene.unit
    if search.request.choice.supports is Supports.DIVIDER:
        found = _divider(end, T, walls, reach)
    else:
        footings = _footings(end, T)
        found = shortest_bridge([next(footings)] if _is_slab(search) else footings, walls, reach)
    return None if found is None else (rail, block(f"support_{name}", *found))


def _meets_divider(end: TemplateEnd, search: DrawerSearch) -> bool:
    """Whether dividers were chosen and one that was built for another drawer stands right behind a rail."""
    if search.request.choice.supports is not Supports.DIVIDER:
        return False
    near = search.config.anchor * search.scene.unit
    boards = (o for o in search.scene.static_hardware if o.id.startswith("support_"))
    rail = MeshCollider(end.mesh)
    return any(
        board.collider.box.grown(near).contains(end.snap.center[None]).all() and rail.is_within(near, board.collider)
        for board in boards
    )


def _carried(name: str, end: TemplateEnd, T: Mat4, search: DrawerSearch) -> tuple[Visual, ...] | None:
    """Returns a rail's dynamic end fixed to the drawer; None where it is out of reach."""
    rail = _visual(f"rail_{name}", end)
    gap = MeshCollider(end.mesh).distance(MeshCollider(search.mesh))
    if gap <= search.config.anchor * search.scene.unit:
        return (rail,)
    if search.request.choice.supports is Supports.NONE:
        return None
    bridge = shortest_bridge(_dynamic_footings(end, T), RayCaster(search.mesh), 0.2 * search.frame.width)
    return None if bridge is None else (rail, block(f"support_{name}", *bridge))


def _is_slab(search: DrawerSearch) -> bool:
    return search.request.choice.supports is Supports.SLAB


def _visual(name: str, end: TemplateEnd) -> Visual:
    return Visual(name, end.surfaces, VisualRole.HARDWARE, PartLabel.MISC)


def _divider(end: TemplateEnd, T: Mat4, walls: RayCaster, reach: float) -> tuple[Footing, float] | None:
    """Returns the foot of an upright board behind a rail and its height: from what is below to what is above.

    Where one of the two is out of reach it ends with the rail there; None where both are, or a wall leaves no room.
    """
    snap = end.snap
    room = Footing(snap.center, snap.normal, 0.98 * snap.u, 0.98 * snap.v).gap(walls, reach)
    thickness = min(_BOARD, room - _AIR)
    if thickness < _THINNEST:
        return None
    up, back = T[:3, 2], T[:3, 1]
    outward = np.asarray(snap.normal)
    heights, lengths = end.mesh.vertices @ up, end.mesh.vertices @ back
    half = float(np.ptp(heights)) / 2
    v = 0.98 * back * float(np.ptp(lengths)) / 2
    middle = snap.center + outward * thickness / 2
    middle = middle + up * (float(heights.min() + half) - float(middle @ up))
    middle = middle + back * (float(lengths.min() + np.ptp(lengths) / 2) - float(middle @ back))
    ways = [Footing(middle, sign * up, outward * thickness / 2, v).gap(walls, reach) for sign in (-1.0, 1.0)]
    if not np.isfinite(ways).any():
        return None
    below, above = (way if np.isfinite(way) else half for way in ways)
    return Footing(middle - below * up, up, outward * thickness / 2, v), below + above


def _footings(end: TemplateEnd, T: Mat4) -> Iterator[Footing]:
    """Yields the static snap plane looking at the wall, then the rail looking up, down and to the back."""
    snap = end.snap
    yield Footing(snap.center, snap.normal, 0.98 * snap.u, 0.98 * snap.v)
    yield from _looking(end, T, (("up", 1.0, "back", "outward"), ("up", -1.0, "back", "outward")))
    yield from _looking(end, T, (("back", 1.0, "up", "outward"),))


def _dynamic_footings(end: TemplateEnd, T: Mat4) -> Iterator[Footing]:
    """Yields the dynamic snap plane looking at the drawer, then the rail's front end looking at the front's back."""
    snap = end.snap
    yield Footing(snap.center, snap.normal, 0.9 * snap.u, 0.9 * snap.v)
    yield from _looking(end, T, (("back", -1.0, "up", "outward"),))


def _looking(end: TemplateEnd, T: Mat4, looks: tuple[tuple[str, float, str, str], ...]) -> Iterator[Footing]:
    """Yields rectangles on a rail's sides, measured along its own axes: direction, its sense, and their two sides."""
    middle, reach = np.zeros(3), {}
    for name, axis in (("outward", end.snap.normal), ("back", T[:3, 1]), ("up", T[:3, 2])):
        along = end.mesh.vertices @ axis
        middle = middle + axis * (along.min() + along.max()) / 2
        reach[name] = axis * (along.max() - along.min()) / 2
    for name, sign, first, second in looks:
        towards = sign * reach[name]
        direction = towards / np.linalg.norm(towards)
        yield Footing(middle + towards, direction, 0.9 * reach[first], 0.9 * reach[second])
