"""What appliances are made of: a hollow body with a panel, a door, wire racks, dials, and the true motion of a door."""

from collections.abc import Iterator
from math import pi
from typing import Literal

import numpy as np

from grafu.geometry.appearance import Material
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.graph.edges import Hinge, Rail
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, Span, plank, solid
from grafu.synth.pieces.finish import surface_of
from grafu.synth.pieces.shapes import framed_opening, prism
from grafu.vocabulary import PartLabel

Edge = Literal["bottom", "left", "right"]
Pull = Literal["bar", "long", "none"]
WIRE = 0.004  # metres
REACH = {"bar": 0.25, "long": 0.08}  # of the length of a front, at each end: where an upright bar ends
LEVEL_REACH = {"bar": 0.22, "long": 0.1}  # the same of a level bar
FRAME = 0.22  # of the shorter side of a door: its frame around a window; handles stand on it
_SIDES = 24  # of what is round
_BAR = (0.03, 0.012)  # metres: how far a handle stands out, and how thick it is


def hollow(material: Material, span: Span, wall: float, drawer: float = 0.0) -> PieceDraft:
    """Returns a body that is open in front: five walls, and one above a drawer of that height, metres."""
    (x0, y0, z0), (x1, y1, z1) = span
    boards = [
        ((x0, y0, z0), (x0 + wall, y1, z1)),
        ((x1 - wall, y0, z0), (x1, y1, z1)),
        ((x0 + wall, y0, z0), (x1 - wall, y1, z0 + wall)),
        ((x0 + wall, y0, z1 - wall), (x1 - wall, y1, z1)),
        ((x0 + wall, y1 - wall, z0 + wall), (x1 - wall, y1, z1 - wall)),
    ]
    if drawer:
        boards.append(((x0 + wall, y0, z0 + drawer), (x1 - wall, y1 - wall, z0 + drawer + wall)))
    return plank(PartLabel.MISC, "body", material, *boards)


def door(
    material: Material,
    metal: Material,
    span: Span,
    edge: Edge,
    window: Material | None = None,
    pull: Pull = "bar",
    pin: Literal["back", "front"] = "back",
) -> PieceDraft:
    """Returns a door that turns about an edge of its front side's box, with a bar along the opposite edge.

    With a `window` of some material, it is a frame around that. A `long` bar is nearly as long as the edge. The `pin`
    of one that drops down lies at its back, where it needs room below, or at its front, where it needs none.
    """
    (x0, y0, z0), (x1, y1, z1) = span
    handle: tuple[PieceDraft, ...] = ()
    if edge == "bottom":
        axis = Axis(vec3((x0 + x1) / 2, y1 if pin == "back" else y0, z0), vec3(1.0, 0.0, 0.0))
        handle = _level_bar(metal, span, z1 - 0.06, pull)
    else:
        sign = -1.0 if edge == "left" else 1.0
        axis = Axis(vec3(x0 if edge == "left" else x1, y0, (z0 + z1) / 2), vec3(0.0, 0.0, sign))
        handle = _upright_bar(metal, span, x1 - 0.05 if edge == "left" else x0 + 0.05 - _BAR[1], pull)
    surfaces = plank(PartLabel.DOOR, "door", material, span).surfaces
    if window is not None:
        box = Box(vec3(*span[0]), vec3(*span[1]))
        bars = framed_opening(box, FRAME * min(x1 - x0, z1 - z0))
        pane = Box.from_center(box.center, box.half - vec3(1.0, 0.0, 1.0) * FRAME * min(x1 - x0, z1 - z0))
        panes = surface_of(TriangleMesh.box_mesh(pane), window)
        surfaces = (*(surface_of(bar, material) for bar in bars), panes)
    return PieceDraft(PartLabel.DOOR, "door", surfaces, PieceMotion(Hinge.joint_type, axis, pi / 2), handle)


def pulled_drawer(material: Material, metal: Material, front: Span, room: Span, pull: Pull) -> PieceDraft:
    """Returns a drawer with this front, whose box fills a room behind it, 8 mm of air around; it comes out by 70 %."""
    (x0, y0, z0), (x1, y1, z1) = room
    x0, x1, z0, z1, thick = x0 + 0.008, x1 - 0.008, z0 + 0.008, z1 - 0.008, 0.012
    box = [
        ((x0, y0, z0), (x1, y1, z0 + thick)),
        ((x0, y0, z0 + thick), (x0 + thick, y1, z1)),
        ((x1 - thick, y0, z0 + thick), (x1, y1, z1)),
        ((x0 + thick, y1 - thick, z0 + thick), (x1 - thick, y1, z1)),
    ]
    handle = _level_bar(metal, front, (front[0][2] + front[1][2]) / 2, pull)
    out = Axis(vec3((x0 + x1) / 2, y0, (z0 + z1) / 2), vec3(0.0, -1.0, 0.0))
    made = plank(PartLabel.DRAWER, "drawer", material, front, *box)
    return PieceDraft(made.label, made.stem, made.surfaces, PieceMotion(Rail.joint_type, out, 0.7 * (y1 - y0)), handle)


def _level_bar(metal: Material, span: Span, z: float, pull: Pull) -> tuple[PieceDraft, ...]:
    """Returns a level bar on two posts before a front, its lower edge at a height, metres."""
    if pull == "none":
        return ()
    (x0, y0, _), (x1, _, _) = span
    out, thick = _BAR
    low, high = x0 + LEVEL_REACH[pull] * (x1 - x0), x1 - LEVEL_REACH[pull] * (x1 - x0)
    bar = ((low, y0 - out, z), (high, y0 - out + thick, z + thick))
    posts = [((x, y0 - out, z), (x + thick, y0, z + thick)) for x in (low, high - thick)]
    return (plank(PartLabel.HANDLE, "handle", metal, bar, *posts),)


def _upright_bar(metal: Material, span: Span, x: float, pull: Pull) -> tuple[PieceDraft, ...]:
    """Returns an upright bar on two posts before a front, its left edge at x, metres."""
    if pull == "none":
        return ()
    (_, y0, z0), (_, _, z1) = span
    out, thick = _BAR
    low, high = z0 + REACH[pull] * (z1 - z0), z1 - REACH[pull] * (z1 - z0)
    bar = ((x, y0 - out, low), (x + thick, y0 - out + thick, high))
    posts = [((x, y0 - out, z), (x + thick, y0, z + thick)) for z in (low, high - thick)]
    return (plank(PartLabel.HANDLE, "handle", metal, bar, *posts),)


def rack(material: Material, span: Span, mesh: float, is_basket: bool) -> PieceDraft:
    """Returns a grid of wires `mesh` apart, metres; a basket has a rim as high as the span, and wires up to it."""
    (x0, y0, z0), (x1, y1, _) = span
    wires: list[Span] = [((x, y0, z0), (x + WIRE, y1, z0 + WIRE)) for x in _steps(x0, x1 - WIRE, mesh)]
    wires += [((x0, y, z0), (x1, y + WIRE, z0 + WIRE)) for y in _steps(y0, y1 - WIRE, mesh)]
    wires += list(_rim(span, mesh)) if is_basket else []
    return plank(PartLabel.SHELF, "basket" if is_basket else "rack", material, *wires)


def _rim(span: Span, mesh: float) -> Iterator[Span]:
    (x0, y0, z0), (x1, y1, z1) = span
    for x in (x0, x1 - WIRE):
        yield (x, y0, z1 - WIRE), (x + WIRE, y1, z1)
        for y in _steps(y0, y1 - WIRE, 2 * mesh):
            yield (x, y, z0), (x + WIRE, y + WIRE, z1)
    for y in (y0, y1 - WIRE):
        yield (x0, y, z1 - WIRE), (x1, y + WIRE, z1)
        for x in _steps(x0, x1 - WIRE, 2 * mesh):
            yield (x, y, z0), (x + WIRE, y + WIRE, z1)


def _steps(low: float, high: float, step: float) -> list[float]:
    return np.linspace(low, high, max(2, round((high - low) / step) + 1)).tolist()


def disc(material: Material, stem: str, center: tuple[float, float, float], radius: float, height: float) -> PieceDraft:
    """Returns a flat round tray that stands on the height of its centre, metres."""
    x, y, z = center
    mesh = prism(_circle(x, y, radius), z, z + height)
    return solid(PartLabel.MISC, stem, material, [mesh])


def dial(material: Material, x: float, y: float, z: float, radius: float, long: float) -> PieceDraft:
    """Returns a knob on a front at depth y, about a level axis, with a pointer on it, metres."""
    upright = prism(_circle(0.0, 0.0, radius), 0.0, long)
    vertices = np.stack([x + upright.vertices[:, 0], y - upright.vertices[:, 2], z + upright.vertices[:, 1]], axis=1)
    knob = TriangleMesh(vertices, upright.faces)
    width = 0.15 * radius
    mark = TriangleMesh.box_mesh(
        Box(vec3(x - width, y - long - 0.003, z - 0.2 * radius), vec3(x + width, y - long + 0.001, z + 0.9 * radius))
    )
    return solid(PartLabel.MISC, "knob", material, [knob, mark])


def _circle(x: float, y: float, radius: float) -> list[tuple[float, float]]:
    angles = np.linspace(0.0, 2 * pi, _SIDES, endpoint=False)
    return list(zip((x + radius * np.cos(angles)).tolist(), (y + radius * np.sin(angles)).tolist(), strict=True))
