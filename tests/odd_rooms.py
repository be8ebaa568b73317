"""Furniture whose rooms are no boxes: under a sloping top, with a curved wall, L-shaped without doors."""

from math import cos, pi, sin

from grafu.asset.part import AnnotatedJoint, Asset, Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.pieces.shapes import board, prism, prism_along_x
from grafu.vocabulary import JointType, PartLabel

BOARD = 0.018  # metres: the thickness of all boards
LOW, HIGH = 0.8, 2.0  # metres: how high a piece under a roof is at its ends


def piece(name: str, label: PartLabel, *meshes: TriangleMesh) -> Part:
    return Part(name, label, tuple(Surface(mesh) for mesh in meshes), PartSource(name))


def made(name: str, parts: tuple[Part, ...], joints: tuple[AnnotatedJoint, ...] = ()) -> Asset:
    return Asset(name, "", "made", parts, joints=joints)


def under_a_slope_to_the_side(width: float = 1.4, depth: float = 0.6, door: bool = False) -> Asset:
    """A wardrobe under a roof, 0.8 m high at its left, 2 m at its right, with a door as high or open in front."""
    t, x, y = BOARD, width / 2, depth / 2
    slope = (HIGH - LOW) / width
    thick = t * (1 + slope * slope) ** 0.5  # of the sloping board, upright
    top = _turned(prism(((-x, LOW - thick), (x, HIGH - thick), (x, HIGH), (-x, LOW)), -y, y))
    back = _turned(prism(((-x, 0.0), (x, 0.0), (x, HIGH - thick), (-x, LOW - thick)), y - t, y))
    parts = (
        piece("left", PartLabel.SIDE_PANEL, board((-x, -y, 0.0), (t - x, y - t, LOW - thick))),
        piece("right", PartLabel.SIDE_PANEL, board((x - t, -y, 0.0), (x, y - t, HIGH - thick - slope * t))),
        piece("bottom", PartLabel.BOTTOM_PANEL, board((t - x, -y, 0.0), (x - t, y - t, t))),
        piece("top", PartLabel.TOP_PANEL, top),
        piece("back", PartLabel.BACK_PANEL, back),
    )
    if not door:
        return made("wardrobe", parts)
    plane = ((-x, 0.0), (x, 0.0), (x, HIGH - thick), (-x, LOW - thick))
    leaf = piece("door", PartLabel.DOOR, _turned(prism(plane, -y - t - 0.001, -y - 0.001)))
    return made("wardrobe", (*parts, leaf), (hinged(x, -y - t - 0.001, 1.0),))


def hinged(x: float, y: float, turn: float) -> AnnotatedJoint:
    return AnnotatedJoint("door", JointType.REVOLUTE, Axis(vec3(x, y, 0.0), vec3(0.0, 0.0, turn)), 0.0, 1.7)


def _turned(mesh: TriangleMesh) -> TriangleMesh:
    """A prism over (x, z) that runs along y, of one over (x, y) that runs along z."""
    return TriangleMesh(mesh.vertices[:, [0, 2, 1]], mesh.faces[:, ::-1])


def under_a_slope_to_the_back(width: float = 1.0, depth: float = 0.9, door: bool = True) -> Asset:
    """A cabinet under a roof: 1.4 m high in front, 0.5 m at its back, with a door in front."""
    t, x, y, front, back = BOARD, width / 2, depth / 2, 1.4, 0.5
    slope = (front - back) / depth
    thick = t * (1 + slope * slope) ** 0.5
    side = ((-y, 0.0), (y, 0.0), (y, back), (-y, front))
    top = ((-y, front - thick), (y - t, back - thick + slope * t), (y - t, back + slope * t), (-y, front))
    parts = [
        piece("left", PartLabel.SIDE_PANEL, prism_along_x(side, -x, t - x)),
        piece("right", PartLabel.SIDE_PANEL, prism_along_x(side, x - t, x)),
        piece("bottom", PartLabel.BOTTOM_PANEL, board((t - x, -y, 0.0), (x - t, y - t, t))),
        piece("back", PartLabel.BACK_PANEL, board((t - x, y - t, 0.0), (x - t, y, back))),
        piece("top", PartLabel.TOP_PANEL, prism_along_x(top, t - x, x - t)),
    ]
    if not door:
        return made("cabinet", tuple(parts))
    parts.append(piece("door", PartLabel.DOOR, board((-x, -y - t - 0.001, 0.0), (x, -y - 0.001, front))))
    return made("cabinet", tuple(parts), (hinged(-x, -y - t - 0.001, -1.0),))


def open_corner(along: float = 1.0, depth: float = 0.35, height: float = 1.2) -> Asset:
    """An L-shaped corner bookcase without doors: its wings stand at the walls y = 0 and x = 0."""
    t = BOARD
    ell = ((0.0, -along), (depth, -along), (depth, -depth), (along, -depth), (along, 0.0), (0.0, 0.0))
    return made(
        "corner",
        (
            piece("left", PartLabel.SIDE_PANEL, board((t, -along, t), (depth, t - along, height - t))),
            piece("right", PartLabel.SIDE_PANEL, board((along - t, -depth, t), (along, -t, height - t))),
            piece("back_left", PartLabel.BACK_PANEL, board((0.0, -along, t), (t, -t, height - t))),
            piece("back_right", PartLabel.BACK_PANEL, board((0.0, -t, t), (along, 0.0, height - t))),
            piece("bottom", PartLabel.BOTTOM_PANEL, prism(ell, 0.0, t)),
            piece("top", PartLabel.TOP_PANEL, prism(ell, height - t, height)),
        ),
    )


def round_corner(radius: float = 0.6, height: float = 1.0, edges: int = 24) -> Asset:
    """A quarter-round corner cabinet, open in front: a curved back, a straight front."""
    t = BOARD
    outer = [(radius * cos(a), radius * sin(a)) for a in (pi * k / edges for k in range(edges + 1))]
    inner = [((radius - t) * x / radius, (radius - t) * y / radius) for x, y in outer]
    wall = [prism((outer[k], outer[k + 1], inner[k + 1], inner[k]), t, height - t) for k in range(edges)]
    return made(
        "round",
        (
            piece("wall", PartLabel.SIDE_PANEL, *wall),
            piece("bottom", PartLabel.BOTTOM_PANEL, prism(outer, 0.0, t)),
            piece("top", PartLabel.TOP_PANEL, prism(outer, height - t, height)),
        ),
    )
