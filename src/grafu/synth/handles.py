"""Handles on fronts that face -Y: where each goes and how large it is. Their shapes are templates."""

from grafu.geometry.appearance import Material
from grafu.geometry.arrays import vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.assembly import Piece
from grafu.synth.finish import surface_of
from grafu.synth.hold import HandleStyle, Hold
from grafu.synth.layout import Side
from grafu.synth.leaves import LeafShape
from grafu.synth.shapes import rod, turned
from grafu.vocabulary import PartLabel

STANDOFF = 0.028  # metres from the front to a bar's middle: room for fingers
KNOB = ((0.0, 0.006), (0.45, 0.006), (0.6, 0.014), (0.85, 0.015), (1.0, 0.010))
HIGH = 0.65  # of a door's height: where its handle is if nothing else is said
_OPPOSITE: dict[Side, Side] = {"left": "right", "right": "left", "top": "bottom", "bottom": "top"}


def opposite(side: Side) -> Side:
    """Returns the side across."""
    return _OPPOSITE[side]


def held_side(hold: Hold, hinge: Side | None) -> Side | None:
    """Returns the edge that a front is held at; None: its upright middle line. `hinge` None: a drawer."""
    sides: dict[str, Side | None] = {"middle line": None, "top edge": "top", "bottom edge": "bottom"}
    if hold.place in sides or hinge is None:
        return sides.get(hold.place)
    return hinge if hold.place == "hinge edge" else opposite(hinge)


def handle_pieces(
    style: HandleStyle, hold: Hold, leaf: LeafShape, hinge: Side | None, material: Material
) -> tuple[Piece, ...]:
    """Returns the handles of a front, none for the style "none"; `hinge` None: a drawer."""
    if style == "none":
        return ()
    rect, side = leaf.rect, held_side(hold, hinge)
    inset = min(hold.inset, rect.width / 5, rect.height / 5)
    x, z = rect.center
    along = hold.along if hold.along is not None else (HIGH if side in ("left", "right") else 0.5)
    if side in ("left", "right"):
        x, z = (rect.x1 - inset if side == "right" else rect.x0 + inset), rect.z0 + along * rect.height
    elif side is not None:
        x, z = rect.x0 + along * rect.width, (rect.z0 + inset if side == "bottom" else rect.z1 - inset)
    upright = side in ("left", "right")
    length = min(0.16, hold.share * (rect.height if upright else rect.width))
    at = (x, leaf.front, z)
    meshes = _knob(at) if style.startswith("knob") else _bar(at, length, upright)
    return (Piece(PartLabel.HANDLE, "handle", tuple(surface_of(mesh, material) for mesh in meshes)),)


def _knob(at: tuple[float, float, float]) -> list[TriangleMesh]:
    foot = vec3(*at)
    return [turned(foot, foot - vec3(0.0, 0.026, 0.0), KNOB)]


def _bar(at: tuple[float, float, float], length: float, upright: bool) -> list[TriangleMesh]:
    along = vec3(0.0, 0.0, length / 2) if upright else vec3(length / 2, 0.0, 0.0)
    foot, out = vec3(*at), vec3(0.0, -STANDOFF, 0.0)
    posts = [rod(foot + side * 0.8 * along, foot + side * 0.8 * along + out, 0.004, 8) for side in (-1.0, 1.0)]
    return [*posts, rod(foot + out - along, foot + out + along, 0.006)]
