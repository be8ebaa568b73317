"""Simple handles on fronts that face -Y: bars on two posts, and knobs. It knows no doors but their outline."""

from grafu.geometry.appearance import Material
from grafu.geometry.arrays import vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.assembly import Piece
from grafu.synth.finish import surface_of
from grafu.synth.layout import HandleKind, Rect, Side
from grafu.synth.shapes import rod, turned
from grafu.vocabulary import PartLabel

STANDOFF = 0.028  # metres from the front to a bar's middle: room for fingers
FREE_EDGE = 0.045  # metres from a door's free edge to its handle
KNOB = ((0.0, 0.006), (0.45, 0.006), (0.6, 0.014), (0.85, 0.015), (1.0, 0.010))


def door_handle(kind: HandleKind, rect: Rect, y: float, hinge: Side, metal: Material) -> tuple[Piece, ...]:
    """Returns the handle of a door at its free edge, opposite the hinge; doors carry it above their middle."""
    inset = min(FREE_EDGE, rect.width / 5, rect.height / 5)
    x, z = rect.center
    upright = hinge in ("left", "right")
    if upright:
        x, z = (rect.x1 - inset if hinge == "left" else rect.x0 + inset), rect.z0 + 0.65 * rect.height
    else:
        z = rect.z0 + inset if hinge == "top" else rect.z1 - inset
    length = min(0.16, 0.4 * (rect.height if upright else rect.width))
    return _handle(kind, (x, y, z), length, upright, metal)


def drawer_handle(kind: HandleKind, rect: Rect, y: float, metal: Material) -> tuple[Piece, ...]:
    """Returns the handle in the middle of a drawer's front, lengthwise."""
    x, z = rect.center
    return _handle(kind, (x, y, z), min(0.16, 0.4 * rect.width), False, metal)


def _handle(
    kind: HandleKind, at: tuple[float, float, float], length: float, upright: bool, metal: Material
) -> tuple[Piece, ...]:
    if kind == "none":
        return ()
    meshes = _knob(at) if kind == "knob" else _bar(at, length, upright)
    return (Piece(PartLabel.HANDLE, "handle", tuple(surface_of(mesh, metal) for mesh in meshes)),)


def _knob(at: tuple[float, float, float]) -> list[TriangleMesh]:
    foot = vec3(*at)
    return [turned(foot, foot - vec3(0.0, 0.026, 0.0), KNOB)]


def _bar(at: tuple[float, float, float], length: float, upright: bool) -> list[TriangleMesh]:
    along = vec3(0.0, 0.0, length / 2) if upright else vec3(length / 2, 0.0, 0.0)
    foot, out = vec3(*at), vec3(0.0, -STANDOFF, 0.0)
    posts = [rod(foot + side * 0.8 * along, foot + side * 0.8 * along + out, 0.004, 8) for side in (-1.0, 1.0)]
    return [*posts, rod(foot + out - along, foot + out + along, 0.006)]
