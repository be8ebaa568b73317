"""Handles on fronts that face -Y: where each goes, how it is turned and how large it is. Their shapes are templates."""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import Mat4, vec3
from grafu.geometry.box import Box
from grafu.geometry.transform import from_rotation
from grafu.synth.fronts.hold import HandleStyle, Hold
from grafu.synth.fronts.layout import Side
from grafu.synth.fronts.leaf_relief import LeafShape
from grafu.synth.fronts.leaves import face_at, filled_rect
from grafu.synth.pieces.assembly import PieceDraft
from grafu.synth.pieces.finish import surface_of
from grafu.templates.handles import handle_template
from grafu.templates.template import HandleTemplate
from grafu.vocabulary import PartLabel

HIGH = 0.65  # of a door's height: where its handle is if nothing else is said
CLEAR = 0.002  # metres that every handle stays inside its leaf's border
END_OFF = 0.4  # of the inset: what is left between the edge and the end of a handle that lies across it
FEET = 0.4  # of a bar's length: how far from its middle it stands on the leaf
_AT_EDGE = ("bar-profile",)  # handles that belong on the very edge, whatever the inset
_OPPOSITE: dict[Side, Side] = {"left": "right", "right": "left", "top": "bottom", "bottom": "top"}
_TURNS: dict[Side, Mat4] = {  # about Y: where a handle's upper side comes to lie
    "left": from_rotation(np.array([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]])),
    "right": from_rotation(np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])),
    "bottom": from_rotation(np.diag([-1.0, 1.0, -1.0])),
}


def opposite(side: Side) -> Side:
    """Returns the side across."""
    return _OPPOSITE[side]


def held_side(hold: Hold, hinge: Side | None) -> Side | None:
    """Returns the edge that a front is held at; None: its upright middle line. `hinge` None: a drawer."""
    sides: dict[str, Side | None] = {"middle line": None, "top edge": "top", "bottom edge": "bottom"}
    if hold.place in sides or hinge is None:
        return sides.get(hold.place)
    return hinge if hold.place == "hinge edge" else opposite(hinge)


def gripped_side(hold: Hold, hinge: Side | None) -> Side:
    """Returns the edge that a front's grip is cut into: where it is held, but never at its hinge or in its middle."""
    side, free = held_side(hold, hinge), opposite(hinge) if hinge else "top"
    return free if side in (None, hinge) else side


def held_along(hold: Hold, side: Side | None) -> float:
    """Returns how far along its edge a front is held, as a fraction upwards or to the right."""
    if hold.along is not None:
        return hold.along
    return HIGH if side in ("left", "right") else 0.5


def handle_pieces(
    style: HandleStyle, hold: Hold, leaf: LeafShape, hinge: Side | None, material: Material
) -> tuple[PieceDraft, ...]:
    """Returns the handles of a front, none for the style "none"; `hinge` None: a drawer.

    They stay inside the leaf's border. A bar stands on the lower of the faces under its two ends.
    """
    if style == "none":
        return ()
    template = handle_template(style)
    upright = _is_upright(template, hold, hinge)
    above = _upper_side(style, held_side(hold, hinge), upright)
    surfaces = _surfaces(style, _size(template, hold, leaf, upright), above, material)
    box = _box(surfaces)
    centers = _centers(hold, leaf, hinge, box, style in _AT_EDGE)
    return tuple(_piece(leaf, x, z, surfaces, box) for x, z in centers)


def _is_upright(template: HandleTemplate, hold: Hold, hinge: Side | None) -> bool:
    if hold.orientation != "usual":
        return hold.orientation == "upright"
    along_level = hinge in (None, "top", "bottom") or hold.place in ("top edge", "bottom edge")
    return template.turns and not along_level


def _upper_side(style: HandleStyle, side: Side | None, upright: bool) -> Side:
    """Returns where a handle's upper side comes to lie: an edge profile juts out at the edge that it is on."""
    if upright:
        return "right" if side == "right" else "left"
    return "bottom" if side == "bottom" and style in _AT_EDGE else "top"


def _size(template: HandleTemplate, hold: Hold, leaf: LeafShape, upright: bool) -> tuple[float, float]:
    """Returns a handle's length and protrusion; a smaller knob also stands out less."""
    rect, natural, wanted = filled_rect(leaf), template.natural, hold.length
    side = rect.height if upright else rect.width
    if wanted is None or (template.family == "knob" and wanted > template.longest):
        wanted = natural.length
    most = hold.ratio * side / (1 if upright else hold.count)
    length = min(wanted, template.longest, most, side - 2 * CLEAR)
    scale = length / natural.length if template.family == "knob" else 1.0
    return length, natural.protrusion * scale if hold.protrusion is None else hold.protrusion


@lru_cache(256)
def _surfaces(style: HandleStyle, size: tuple[float, float], above: Side, material: Material) -> tuple[Surface, ...]:
    """Returns a handle at the origin: a piece of furniture repeats a few."""
    meshes = handle_template(style).build(*size)
    turn = _TURNS.get(above)
    return tuple(surface_of(mesh if turn is None else mesh.transformed(turn), material) for mesh in meshes)


def _box(surfaces: Sequence[Surface]) -> Box:
    boxes = [surface.mesh.box for surface in surfaces]
    return Box(np.min([b.low for b in boxes], axis=0), np.max([b.high for b in boxes], axis=0))


def _centers(hold: Hold, leaf: LeafShape, hinge: Side | None, box: Box, at_edge: bool) -> list[tuple[float, float]]:
    """Returns where on the front the handles' middles go, (x, z)."""
    rect, side = filled_rect(leaf), held_side(hold, hinge)
    inset = 0.0 if at_edge else min(hold.inset, rect.width / 5, rect.height / 5)
    if side in ("left", "right") and box.size[0] > box.size[2]:  # what lies there keeps off the edge with its end
        inset = float(box.size[0]) / 2 + END_OFF * inset
    level = side in ("top", "bottom") or (side is None and hold.count == 2)  # two go side by side
    ratios = (0.25, 0.75) if hold.count == 2 else (held_along(hold, side),)
    height = held_along(hold, None)
    centers = []
    for ratio in ratios:
        x = rect.x0 + (ratio if level else 0.5) * rect.width
        z = rect.z0 + (ratio if side in ("left", "right", None) and not level else height) * rect.height
        x = {"left": rect.x0 + inset, "right": rect.x1 - inset}.get(side or "", x)
        z = {"bottom": rect.z0 + inset, "top": rect.z1 - inset}.get(side or "", z)
        centers.append((_within(x, rect.x0, rect.x1, box, 0), _within(z, rect.z0, rect.z1, box, 2)))
    return centers


def _within(middle: float, low: float, high: float, box: Box, axis: int) -> float:
    """Returns the place nearest to `middle` where the handle is clear of both borders (halfway, if too big)."""
    first, last = low + CLEAR - float(box.low[axis]), high - CLEAR - float(box.high[axis])
    return (first + last) / 2 if first > last else min(max(middle, first), last)


def _piece(leaf: LeafShape, x: float, z: float, surfaces: Sequence[Surface], box: Box) -> PieceDraft:
    dx, _, dz = (FEET * box.size).tolist()
    dx, dz = (dx if dx > 1.2 * dz else 0.0), (dz if dz > 1.2 * dx else 0.0)  # a knob stands on one foot
    y = max(face_at(leaf, x + sign * dx, z + sign * dz) for sign in (-1.0, 1.0))
    offset = vec3(x, y, z)
    moved = tuple(Surface(s.mesh.translated(offset), s.material, s.uv) for s in surfaces)
    return PieceDraft(PartLabel.HANDLE, "handle", moved)
