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
from grafu.graph.edges import Hinge
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, Span, plank, solid
from grafu.synth.pieces.finish import surface_of
from grafu.synth.pieces.shapes import framed_opening, prism
from grafu.vocabulary import PartLabel

WIRE = 0.004  # metres
FRAME = 0.22  # of the shorter side of a door: its frame around a window; handles stand on it
_SIDES = 24  # of what is round
_BAR = (0.03, 0.012)  # metres: how far a handle stands out, and how thick it is


def hollow(material: Material, span: Span, wall: float) -> PieceDraft:
    """Returns a body that is open in front: five walls of a thickness, metres."""
    (x0, y0, z0), (x1, y1, z1) = span
    boards = [
        ((x0, y0, z0), (x0 + wall, y1, z1)),
        ((x1 - wall, y0, z0), (x1, y1, z1)),
        ((x0 + wall, y0, z0), (x1 - wall, y1, z0 + wall)),
        ((x0 + wall, y0, z1 - wall), (x1 - wall, y1, z1)),
        ((x0 + wall, y1 - wall, z0 + wall), (x1 - wall, y1, z1 - wall)),
    ]
    return plank(PartLabel.MISC, "body", material, *boards)


def door(
    material: Material,
    metal: Material,
    span: Span,
    edge: Literal["bottom", "left", "right"],
    window: Material | None = None,
) -> PieceDraft:
    """Returns a door that turns about an edge of its front side's box, with a bar along the opposite edge.

    With a `window` of some material, it is a frame around that.
    """
    (x0, y0, z0), (x1, y1, z1) = span
    out, thick = _BAR
    if edge == "bottom":
        axis = Axis(vec3((x0 + x1) / 2, y1, z0), vec3(1.0, 0.0, 0.0))
        bar = ((x0 + 0.06, y0 - out, z1 - 0.06), (x1 - 0.06, y0 - out + thick, z1 - 0.06 + thick))
        posts = [((x, y0 - out, z1 - 0.06), (x + thick, y0, z1 - 0.06 + thick)) for x in (x0 + 0.06, x1 - 0.06 - thick)]
    else:
        sign = -1.0 if edge == "left" else 1.0
        axis = Axis(vec3(x0 if edge == "left" else x1, y0, (z0 + z1) / 2), vec3(0.0, 0.0, sign))
        x = x1 - 0.05 if edge == "left" else x0 + 0.05 - thick
        low, high = z0 + 0.25 * (z1 - z0), z1 - 0.25 * (z1 - z0)
        bar = ((x, y0 - out, low), (x + thick, y0 - out + thick, high))
        posts = [((x, y0 - out, z), (x + thick, y0, z + thick)) for z in (low, high - thick)]
    handle = plank(PartLabel.HANDLE, "handle", metal, bar, *posts)
    surfaces = plank(PartLabel.DOOR, "door", material, span).surfaces
    if window is not None:
        box = Box(vec3(*span[0]), vec3(*span[1]))
        bars = framed_opening(box, FRAME * min(x1 - x0, z1 - z0))
        pane = Box.from_center(box.center, box.half - vec3(1.0, 0.0, 1.0) * FRAME * min(x1 - x0, z1 - z0))
        panes = surface_of(TriangleMesh.box_mesh(pane), window)
        surfaces = (*(surface_of(bar, material) for bar in bars), panes)
    return PieceDraft(PartLabel.DOOR, "door", surfaces, PieceMotion(Hinge.joint_type, axis, pi / 2), (handle,))


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
