"""Parametric hinges: two leaves, alternating knuckles on a pin, screws.

How a pose stays clean and connected, by construction (R is the barrel's radius; frames: `template.py`):

* The pin and half of the knuckles are static. The other knuckles are tubes that turn about the pin with
  `PIN_CLEARANCE` between, so both ends stay that near in every pose. Neighbouring knuckles leave `KNUCKLE_GAP`.
* A leaf keeps clear of the whole barrel, but for tongues that reach into its own knuckles. Leaves of contact hinges are
  apart by twice `SEAM_GAP`; those of flush and perpendicular ones lie in different sectors around the pin for every
  angle within the range.
* Everything stays within the hinge's length along the pin, pin heads and finials included.
"""

from functools import lru_cache
from itertools import pairwise
from typing import final

import numpy as np
from shapely.geometry import Polygon, box
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from grafu.dataclass import dataclass
from grafu.errors import TemplateError
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.templates.leaves import LeafArea, LeafShape, PinStyle, ScrewPattern, pin_solid
from grafu.templates.solids import SCREW, disc, extrude, finished, placed, tube
from grafu.templates.template import HingeModel, HingeSize, HingeTemplate, SnapPlane, TemplateEnd
from grafu.vocabulary import MechanismClass

PIN_CLEARANCE = 5e-5  # metres between pin and moving knuckle; less on a barrel under 1.25 mm
KNUCKLE_GAP = 2e-4  # metres between neighbouring knuckles
SEAM_GAP = 1e-4  # metres from the seam's middle to a leaf of a contact hinge
_PIN = 0.5  # radius of the pin in radii of the barrel
_TONGUE = 0.66  # how far from the axis a tongue ends, in radii of the barrel: inside the knuckle's wall, off the pin


@final
@dataclass(frozen=True, slots=True)
class HingeStyle:
    """What tells one hinge from another, apart from its size.

    `opening` is the widest angle in radians. `barrel` is the barrel's fraction of the length; `pitch` the length of a
    knuckle in metres that sets how many there are (odd, 3 to 41), `knuckles` a fixed count instead.
    """

    mechanism: MechanismClass
    opening: float
    material: Material
    static_leaf: LeafShape
    dynamic_leaf: LeafShape
    screws: ScrewPattern
    pin: PinStyle
    barrel: float = 1.0
    knuckles: int = 5
    pitch: float | None = None
    segments: int = 12


@final
@dataclass(frozen=True, slots=True)
class _Side:
    """In which direction one end's leaf runs (`s`) and its part lies (`d`), and at what d the leaf begins and ends."""

    s: Vec3
    d: Vec3
    near: float
    far: float


def hinge_model(id: str, title: str, style: HingeStyle, natural: HingeSize) -> HingeModel:  # noqa: A002
    """Returns a model that builds this style at any size and remembers what it built."""

    @lru_cache(maxsize=256)
    def build(size: HingeSize) -> HingeTemplate:
        return build_hinge(id, style, size)

    return HingeModel(id, title, style.mechanism, natural, build)


def build_hinge(id: str, style: HingeStyle, size: HingeSize) -> HingeTemplate:  # noqa: A002
    """Returns a hinge of a style and size in its own frame, closed.

    Raises:
        TemplateError: if a length is not positive, the leaf does not reach beyond the barrel, or the leaf is thicker
            than the barrel's radius.
    """
    _require_buildable(id, size)
    static_side, dynamic_side = _sides(style.mechanism, size)
    spans = _knuckle_spans(style, size)
    ends = []
    for moving, side in ((False, static_side), (True, dynamic_side)):
        surfaces = (*_leaf_surfaces(style, size, side, spans, moving), *_barrel_surfaces(style, size, spans, moving))
        ends.append(TemplateEnd(surfaces, _snap(side, size)))
    return HingeTemplate(id, style.mechanism, ends[0], ends[1], widest_opening(style, size), size)


def widest_opening(style: HingeStyle, size: HingeSize) -> float:
    """Returns the widest opening in radians: the style's, or less where the leaves of class P would meet."""
    if style.mechanism is not MechanismClass.P:
        return style.opening
    inner = size.radius - size.thickness  # from the pin to the leaf's free face
    meeting = np.pi / 2 + 2 * np.arcsin(np.clip(inner / size.leaf, 0.0, 1.0))
    return float(min(style.opening, meeting - np.radians(0.25)))


def _require_buildable(id: str, size: HingeSize) -> None:  # noqa: A002
    if min(size.length, size.leaf, size.thickness, size.radius) <= 0:
        raise TemplateError(f"hinge `{id}` needs positive sizes: got {size}")
    if size.thickness > size.radius or size.leaf < 1.15 * size.radius + KNUCKLE_GAP:
        raise TemplateError(f"hinge `{id}` needs thickness <= radius and leaf > 1.15 radius: got {size}")


def _sides(mechanism: MechanismClass, size: HingeSize) -> tuple[_Side, _Side]:
    x, y = vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0)
    seam = min(SEAM_GAP, 0.05 * size.thickness)
    inner = size.radius - size.thickness
    if mechanism is MechanismClass.C:
        return _Side(-y, -x, seam, size.thickness), _Side(-y, x, seam, size.thickness)
    if mechanism is MechanismClass.F:
        return _Side(-x, -y, inner, size.radius), _Side(x, -y, inner, size.radius)
    if mechanism is MechanismClass.P:
        return _Side(y, -x, inner, size.radius), _Side(x, -y, inner, size.radius)
    raise TemplateError(f"a hinge must be of class contact, flush or perpendicular: got {mechanism.in_words}")


def _snap(side: _Side, size: HingeSize) -> SnapPlane:
    middle = side.d * side.far + side.s * (size.leaf / 2)
    return SnapPlane(middle, side.d, side.s * (size.leaf / 2), vec3(0.0, 0.0, size.length / 2.0))


def _knuckle_spans(style: HingeStyle, size: HingeSize) -> list[tuple[float, float]]:
    """Returns the knuckles' extents along the pin, bottom first; even ones are static."""
    count = style.knuckles
    if style.pitch is not None:
        count = 2 * int(np.clip(round(size.length / style.pitch / 2), 1, 20)) + 1
    head = style.pin.head * size.radius
    half = min(style.barrel * size.length / 2, max(size.length / 2 - head, 0.3 * size.length))
    gap = min(KNUCKLE_GAP, 0.05 * half / count)
    edges = np.linspace(-half, half, count + 1)
    return [(float(a) + gap / 2, float(b) - gap / 2) for a, b in pairwise(edges)]


def _clearance(size: HingeSize) -> float:
    return min(PIN_CLEARANCE, 0.04 * size.radius)


def _leaf_plan(
    style: HingeStyle, size: HingeSize, side: _Side, own: list[tuple[float, float]], moving: bool
) -> BaseGeometry:
    """Returns a leaf's flat shape: its outline clear of the barrel, and a tongue into each of its own knuckles."""
    area = LeafArea(size.radius + min(KNUCKLE_GAP, 0.05 * size.radius), size.leaf, size.length / 2)
    outline = (style.dynamic_leaf if moving else style.static_leaf)(area)
    tip = float(np.sqrt(max(0.0, (_TONGUE * size.radius) ** 2 - side.near**2)))
    lap = min(0.1 * area.width, 0.2 * size.radius)
    return unary_union([outline, *(box(tip, low, area.start + lap, high) for low, high in own)])


def _leaf_surfaces(
    style: HingeStyle, size: HingeSize, side: _Side, spans: list[tuple[float, float]], moving: bool
) -> list[Surface]:
    own = spans[1::2] if moving else spans[::2]
    area = LeafArea(size.radius, size.leaf, size.length / 2)
    radius, holes = area.screw_radius(), style.screws(area)
    plan = _leaf_plan(style, size, side, own, moving)
    drilled = plan.difference(unary_union([disc(c, radius) for c in holes]))
    z = vec3(0.0, 0.0, 1.0)
    leaf = placed(extrude(drilled, side.near, side.far), side.s, z, side.d)
    heads = placed(_screw_heads(holes, radius, (side.near, side.far), slotted=style.pitch is None), side.s, z, side.d)
    return [finished(leaf, style.material), finished(heads, SCREW)]


def _screw_heads(
    holes: list[tuple[float, float]], radius: float, span: tuple[float, float], slotted: bool
) -> TriangleMesh:
    """Returns screw heads that sit a little below the leaf's free face."""
    near, depth = span[0], span[1] - span[0]
    solids = []
    for k, center in enumerate(holes):
        head = disc(center, 1.04 * radius)
        if slotted:  # screws never stop at the same angle
            cut = head.difference(_slot(center, radius, 0.7 + 1.1 * k))
            solids.append(extrude(cut, near + 0.1 * depth, near + 0.36 * depth))
        solids.append(extrude(head, near + (0.35 if slotted else 0.1) * depth, near + 0.8 * depth))
    return merge_meshes(solids)


def _slot(center: tuple[float, float], radius: float, angle: float) -> Polygon:
    along = np.array([np.cos(angle), np.sin(angle)]) * 2 * radius
    across = np.array([-np.sin(angle), np.cos(angle)]) * 0.14 * radius
    corners = np.array([along - across, along + across, -along + across, -along - across])
    return Polygon(corners + center)


def _barrel_surfaces(
    style: HingeStyle, size: HingeSize, spans: list[tuple[float, float]], moving: bool
) -> list[Surface]:
    pin = _PIN * size.radius
    if moving:
        bore = (pin + _clearance(size)) / np.cos(np.pi / style.segments)  # a polygon's flats, too, clear the pin
        knuckles = _knuckles(style, size, float(bore), spans[1::2])
        return [finished(knuckles, style.material)]
    knuckles = _knuckles(style, size, 0.0, spans[::2])
    off = 0.0 if len(spans) % 2 else min(KNUCKLE_GAP, 0.05 * size.radius)  # a moving top knuckle turns under the head
    solid = pin_solid(style.pin, size, (spans[0][0], spans[-1][1] + off), style.segments)
    return [finished(knuckles, style.material), finished(solid, style.material)]


def _knuckles(style: HingeStyle, size: HingeSize, bore: float, spans: list[tuple[float, float]]) -> TriangleMesh:
    chamfer = 0.0 if style.pitch else 0.1 * size.radius  # a continuous hinge has many knuckles and keeps them plain
    return merge_meshes([tube(bore, size.radius, span, style.segments, chamfer) for span in spans])
