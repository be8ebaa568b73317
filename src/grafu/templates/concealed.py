"""The concealed cup hinge: a 35 mm cup in the door, an arm on a mounting plate in the case, two links between them.

The links and the bodies between their pivots are a four-bar linkage, so that the door turns and shifts at once, away
from the case first.

Cup frame, closed: the origin lies on the door's inner face at its hinge edge, +X runs across the door, +Y out of the
case, +Z along the edge, about which the door opens. The cup is sunk into the door, where y > 0; the plate stands on the
inner face of the case's side, a plane of constant x. Links and the arm's nose reach into the cup, of which the door's
own mesh has no hollow.
"""

from functools import lru_cache
from math import radians
from typing import final

import numpy as np
from shapely.geometry import LineString, box
from shapely.geometry.base import BaseGeometry

from grafu.dataclass import dataclass
from grafu.errors import TemplateError
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Mat4, Scalars, vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.templates.four_bar import FourBar, Plane, Point
from grafu.templates.solids import BLACK, NICKEL, SCREW, disc, extrude, finished, placed, rectangle

LINKAGE = FourBar(((0.0365, 0.009), (0.0338, 0.0018)), ((0.013, 0.0075), (0.0128, 0.0025)))
RANGE = radians(105)
_STEPS = 43  # values at which the linkage is tabled: one per two and a half degrees
_X, _Y, _Z = vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)


@final
@dataclass(frozen=True, slots=True)
class CupSizes:
    """Metres: what makers of 35 mm hinges have in common."""

    cup: float = 0.0175
    """Radius of the cup."""
    depth: float = 0.0115
    """How deep it is sunk into the door."""
    edge: float = 0.005
    """From the door's edge to the cup."""
    rim: float = 0.0001
    """How far the cup stands out of the door's inner face: hardly, for it reaches behind the case's side."""
    flange: tuple[float, float, float] = (0.0045, 0.0115, 0.029)
    """How far the flange reaches from the cup's middle, outwards and inwards, and half its length along the edge."""
    sheet: float = 0.0012
    """Thickness of the flange, and half that of a link."""
    plate: tuple[float, float, float] = (0.02, 0.056, 0.024)
    """Where the mounting plate begins and ends behind the door, and half its height."""
    plate_sheet: float = 0.002
    """Thickness of the mounting plate."""
    arm: tuple[float, float, float] = (0.006, 0.056, 0.0085)
    """Where the arm begins and ends behind the door, and half its height."""
    arm_end: float = 0.032
    """How far from the door's edge the arm reaches across."""
    nose: float = 0.0024
    """Half the width of the nose and of the links."""
    layers: tuple[float, float, float, float] = (0.0036, 0.0054, 0.0058, 0.0076)
    """Half heights at which the nose, the inner link's cheeks and the outer one's end."""


SIZES = CupSizes()


@final
@dataclass(frozen=True)
class ConcealedArm:
    """A piece that reaches into the cup: its pivot, and by how much it has turned at each angle of the table."""

    name: str
    surfaces: tuple[Surface, ...]
    pivot: Point
    turns: Scalars


@final
@dataclass(frozen=True)
class ConcealedHinge:
    """A cup hinge in its cup frame, closed. `angles` (radians) are those of the table, `shifts` the coupler's there."""

    static: tuple[Surface, ...]
    dynamic: tuple[Surface, ...]
    arms: tuple[ConcealedArm, ...]
    linkage: FourBar
    angles: Scalars

    def slips(self, axis: Point) -> Plane:
        """Returns what is added to a turn about an axis of the cup frame, at each angle of the table."""
        return self.linkage.slips(self.angles, axis)


@final
@dataclass(frozen=True, slots=True)
class ConcealedModel:
    """A concealed hinge at a scale: on its furniture one metre is `metre` metres long."""

    id: str
    title: str
    metre: float = 1.0

    @property
    def range(self) -> float:
        """The widest opening, radians."""
        return RANGE

    def at_scale(self, metre: float) -> "ConcealedModel":
        """Returns the hinge for furniture on which a metre is `metre` metres long."""
        return ConcealedModel(self.id, self.title, self.metre * metre)

    def build(self, side: float, depth: float) -> ConcealedHinge:
        """Returns the hinge for a case whose side has its inner face at x = `side`, its cup `depth` deep, metres.

        Raises:
            TemplateError: if the side stands where the arm is, or the cup has no depth.
        """
        return _built(self.metre, round(side, 6), round(depth, 6))

    @property
    def cup_diameter(self) -> float:
        """The diameter of the cup, metres."""
        return 2.0 * SIZES.cup * self.metre

    @property
    def deepest(self) -> float:
        """How deep the cup is sunk into a door that is thick enough, metres."""
        return SIZES.depth * self.metre

    @property
    def widest_side(self) -> float:
        """The greatest x of the side's inner face that leaves the arm room, metres."""
        return (SIZES.arm_end - 4 * SIZES.plate_sheet) * self.metre

    @property
    def natural(self) -> ConcealedHinge:
        """The hinge as it is for a full overlay on a side of 16 mm."""
        return self.build(0.016 * self.metre, self.deepest)


@lru_cache(maxsize=256)
def _built(metre: float, side: float, depth: float) -> ConcealedHinge:
    if depth <= 0 or side > (SIZES.arm_end - 4 * SIZES.plate_sheet) * metre + 1e-9:
        raise TemplateError(f"a cup hinge needs a cup with a depth and room for its arm: got {depth:g}, {side:g} m")
    S = np.diag([metre, metre, metre, 1.0])
    static = tuple(surface.transformed(S) for surface in _plate_and_arm(side / metre))
    dynamic = tuple(surface.transformed(S) for surface in _cup(depth / metre))
    angles = np.linspace(0.0, RANGE, _STEPS)
    arms = tuple(_scaled(arm, S, metre) for arm in _arms(angles))
    return ConcealedHinge(static, dynamic, arms, LINKAGE.scaled(metre), angles)


def _scaled(arm: ConcealedArm, S: Mat4, metre: float) -> ConcealedArm:
    pivot = metre * arm.pivot[0], metre * arm.pivot[1]
    return ConcealedArm(arm.name, tuple(surface.transformed(S) for surface in arm.surfaces), pivot, arm.turns)


def _cup(depth: float) -> list[Surface]:
    """Returns the cup in the door with its flange, two screws, and the dark mouth that stands for its hollow."""
    middle, (outwards, inwards, along) = SIZES.edge + SIZES.cup, SIZES.flange
    bowl, hollow = (disc((middle, 0.0), ratio * SIZES.cup, 36) for ratio in (1.0, 0.9))
    flange = rectangle((middle - outwards, middle + inwards), (-along, along), outwards).difference(hollow)
    metal = [_upright(bowl, -SIZES.rim, depth), _upright(flange, -SIZES.sheet, SIZES.rim)]
    mouth = _upright(hollow, -2.0 * SIZES.rim, 0.0)
    places = ((middle + (inwards - outwards) / 2, sign * 0.82 * along) for sign in (-1.0, 1.0))
    screws = [_upright(disc(place, 0.0032, 14), -1.7 * SIZES.sheet, 0.0) for place in places]
    return [
        *(finished(solid, NICKEL) for solid in metal),
        finished(mouth, BLACK),
        finished(merge_meshes(screws), SCREW),
    ]


def _upright(shape: BaseGeometry, near: float, far: float) -> TriangleMesh:
    """Returns a plate drawn across and along the door's edge, between two depths of the door."""
    return placed(extrude(shape, near, far), _X, -_Z, _Y)


def _plate_and_arm(side: float) -> list[Surface]:
    """Returns the mounting plate on the side, and the arm from there to where the links are hinged."""
    begin, end, high = SIZES.plate
    front, rear, half = SIZES.arm
    face = side + SIZES.plate_sheet
    plate = _level(box(side, -end, face, -begin), (-high, high))
    post = _level(box(face, -end + 0.004, SIZES.arm_end, -begin - 0.004), (-half / 2, half / 2))
    arm = _level(box(max(face, SIZES.arm_end - 0.012), -rear, SIZES.arm_end, -front), (-half, half))
    heads = [placed(extrude(disc((z, -0.037), 0.0036, 14), 0.0, 0.0008), _Z, _Y, _X) for z in (-0.016, 0.016)]
    shift = np.eye(4)
    shift[0, 3] = face
    screws = merge_meshes(heads).transformed(shift)
    return [*(finished(solid, NICKEL) for solid in (plate, post, arm)), finished(screws, SCREW)]


def _level(shape: BaseGeometry, span: tuple[float, float]) -> TriangleMesh:
    """Returns a plate drawn in the plane of the linkage between two heights."""
    return placed(extrude(shape, *span), _X, _Y, _Z)


def _arms(angles: Scalars) -> list[ConcealedArm]:
    """Returns the arm's nose, which does not move, and the two links, each of two cheeks beside it."""
    (first, second), (one, other) = LINKAGE.fixed, LINKAGE.moving
    start = (SIZES.arm_end - 0.006, -SIZES.arm[0] - 0.002)
    inner, low, middle, high = SIZES.layers
    nose = _level(LineString([start, second, first]).buffer(SIZES.nose, quad_segs=4), (-inner, inner))
    pins = [_level(disc(place, 0.5 * SIZES.nose, 12), (-high, high)) for place in (first, second)]
    still = tuple(finished(solid, NICKEL) for solid in (nose, merge_meshes(pins)))
    turns = LINKAGE.link_turns(angles)
    found = [ConcealedArm("nose", still, first, np.zeros(len(angles)))]
    links = ((first, one, (inner, low)), (second, other, (middle, high)))
    for k, (fixed, moving, (near, far)) in enumerate(links):
        shape = LineString([fixed, moving]).buffer(0.8 * SIZES.nose, quad_segs=4)
        cheeks = merge_meshes([_level(shape, (near, far)), _level(shape, (-far, -near))])
        pin = _level(disc(moving, 0.5 * SIZES.nose, 12), (-far, far))
        found.append(ConcealedArm(f"link_{k}", (finished(cheeks, NICKEL), finished(pin, NICKEL)), fixed, turns[:, k]))
    return found


def axis_at(point: Point, z: float = 0.0) -> Axis:
    """Returns the axis through a point of the cup frame along which the door's edge runs."""
    return Axis(vec3(point[0], point[1], z), _Z)
