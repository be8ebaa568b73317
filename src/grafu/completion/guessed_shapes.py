"""Whether a part that is only guessed to be a door or drawer has the shape of one.

A front is flat or nearly so, and thin. A drawer holds things: it is open from above, has a bottom, and is in a case.
Rays are cast on the meshes.
"""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple, final

import numpy as np

from grafu.asset.part import Asset
from grafu.completion.cushions import closes_nothing, is_cushion_sized
from grafu.completion.drawer_case import is_front_only, is_without_case
from grafu.completion.ways_out import rest_of
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat3, Scalars, Vec3
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster, open_ratios
from grafu.graph.edges import SignedAxis
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.motion import code_to_direction, signed_axis
from grafu.shapes import Bool
from grafu.vocabulary import PartLabel

_UP: SignedAxis = 5
_FRONT: SignedAxis = 2


@final
@dataclass(frozen=True, slots=True)
class GuessedShapeConfig:
    """Which shapes no door and no drawer has.

    Raises:
        ValueError: if a fraction is not between 0 and 1, or another number not above 0.
    """

    straight: float = 0.9
    """A surface runs along the axes of its part where its normals are this near to one (cosine: 25 degrees) ..."""
    rounded: float = 0.85
    """... and what has less of its area so is no front (fraction). Of 178 real doors and drawers whose names were
    hidden the least has 0.94 ..."""
    moulded: float = 0.05
    """... but of a plate, what slopes towards one of its sides alone is a bevel or a moulding (cosine between a normal
    and the other side at most: 3 degrees)."""
    low: float = 0.04
    """A mere front that is no higher than this (fraction of the object's largest side) ..."""
    strip: float = 0.12
    """... and than this (fraction of its width) is a grip or a trim: of 69 real drawers the few that are as low all
    have a box."""
    thick: float = 0.36
    """A door is thinner than this (fraction of the shorter of its other sides). Of 69 real ones the most is 0.22."""
    shallow: float = 0.35
    """A door with a handle may be thicker, as with the bins of a refrigerator behind it, and takes no more than this of
    the object's depth there (fraction): drawers and cases reach farther back."""
    grip: float = 0.08
    """What stands out of a front and is drawn in one with it, as a knob is, has less of its surface (fraction)."""
    seen: float = 0.35
    """A side of a drawer is open where more of it is seen from outside (fraction) ..."""
    aside: float = 0.4
    """... and its left and right where this much is."""
    sunk: float = 0.15
    """A wall may be drawn into a drawer by this (fraction of its size): parts that were made apart overlap."""
    deep: float = 0.3
    """Inside a drawer is what is deeper than this below its top (fraction of its height) ..."""
    inside: float = 0.3
    """... and a block has less of that (fraction, seen from above). Of 108 real drawers the least has 0.60 ..."""
    bottom: float = 0.4
    """... and the least has 0.78 of its area closed below (fraction): what has less than this is a frame."""
    front: float = 0.6
    """A drawer that is only a front is closed, seen from where it slides to, on more than this (fraction) ..."""
    leaf: float = 0.12
    """... and a door on more than this. Of 69 real doors, some of them frames of glass, the least has 0.22."""
    post: float = 0.16
    """A post is no wider and no deeper than this (metres), with all that stands beside it for ..."""
    beside: float = 0.5
    """... as much of its height (fraction): a board of it is no door."""
    longest: float = 1.2
    """No drawer is longer than this in the direction in which it slides (metres): a mattress under its blanket is."""
    book: float = 0.09
    """What is no wider than this (metres) ..."""
    upright: float = 1.5
    """... and as high as this over its width at least (ratio) is a book or a file: such pull-outs have handles."""
    board: float = 0.1
    """A drawer may be a mere board that is at most so thick (fraction of the shorter of its level sides)."""

    def __post_init__(self) -> None:
        lengths = ("longest", "book", "upright")
        require_positive(self, *lengths)
        require_ratios(self, *(name for name in self.__dataclass_fields__ if name not in lengths))


def shape_against(
    node: PartNode,
    asset: Asset,
    graph: FunctionalGraph,
    is_held: bool = False,
    config: GuessedShapeConfig = GuessedShapeConfig(),
) -> str:
    """Returns in words why a part has not the shape of the door or drawer that it is taken for; empty where it may.

    With a handle on it a front may be round, and a drawer drawn as a block.
    """
    mesh, box = asset.part(node.id).mesh, node.box
    is_shallow = is_held and float(box.size[box.thin_axis]) <= config.shallow * float(asset.box.size[box.thin_axis])
    if node.label is PartLabel.DOOR and not is_shallow and is_thick(mesh, config):
        return "it is too thick for a door"
    if node.label is PartLabel.DOOR and not is_held and _is_of_post(node, graph, config):
        return "it is a board of a post, which holds nothing"
    if not is_held and _straight(mesh, config) < config.rounded:
        return "it is round, which fronts are not"
    rest = partial(rest_of, asset, node.id, graph)  # of a large model it takes long, and most doors need none
    rail = next((rail for rail in graph.rails if rail.child == node.id), None)
    may_be_cushion = node.label is PartLabel.DOOR and not is_held and is_cushion_sized(box)
    if may_be_cushion and (why := closes_nothing(box, rest())):
        return why
    if rail is None and node.label is PartLabel.DOOR:
        is_open = _is_open(mesh, rest, box, signed_axis(box.thin_axis, positive=False), config.leaf)
        return "hardly anything is within its outline" if is_open else ""
    slide = _FRONT if rail is None else rail.axis
    return "" if slide // 2 == 2 else _no_drawer(box, slide, mesh, rest(), asset.box, is_held, config)


def is_thick(mesh: TriangleMesh, config: GuessedShapeConfig = GuessedShapeConfig()) -> bool:
    """Whether no door is as thick, along the axes or along its own main directions."""
    sides = (np.sort(_extents(mesh, frame, config.grip)) for frame in _frames(mesh))
    return min(float(least / max(middle, 1e-9)) for least, middle, _ in sides) >= config.thick


def _extents(mesh: TriangleMesh, frame: Mat3, grip: float) -> Vec3:
    """Returns the extents of a surface along the columns of a frame, without what little of it stands out of the rest.

    At each end of the direction in which it is thinnest, faces with the fraction `grip` of the area do not count: of a
    knob that was drawn in one with its front.
    """
    corners = mesh.triangles @ frame
    low, high = corners.min(axis=1), corners.max(axis=1)
    size = high.max(axis=0) - low.min(axis=0)
    thin, area = int(np.argmin(size)), mesh.face_areas
    ends = [
        values[order][np.searchsorted(np.cumsum(area[order]), grip * area.sum())]
        for values, order in ((low[:, thin], np.argsort(low[:, thin])), (-high[:, thin], np.argsort(-high[:, thin])))
    ]
    size[thin] = -ends[1] - ends[0]
    return np.asarray(size)


def _is_of_post(door: PartNode, graph: FunctionalGraph, config: GuessedShapeConfig) -> bool:
    """Whether an upright board and what stands beside it are no wider and no deeper than a post, and higher."""
    height = float(door.box.size[2])
    touched = (graph.node(name).box for name in graph.neighbours[door.id])
    beside = [box for box in touched if _shared_height(box, door.box) >= config.beside * height]
    section = Box.enclosing([door.box, *beside]).size[:2].max()
    return bool(beside and section <= min(config.post, height / 2))


def _shared_height(one: Box, other: Box) -> float:
    return float(min(one.high[2], other.high[2]) - max(one.low[2], other.low[2]))


def _no_drawer(
    box: Box,
    slide: SignedAxis,
    mesh: TriangleMesh,
    rest: RayCaster,
    whole: Box,
    is_held: bool,
    config: GuessedShapeConfig,
) -> str:
    """Returns in words why a part that slides level is no drawer; empty where it may be one."""
    if not is_held and float(box.size[slide // 2]) > config.longest:
        return "it is longer than drawers are"
    width = float(box.size[1 - slide // 2])
    if not is_held and width <= config.book and float(box.size[2]) >= config.upright * width:
        return "it is as narrow and high as a book"
    if not is_held and is_without_case(box, slide, rest, whole):
        return "nothing that could hold it is beside it, or above and below"
    if is_front_only(box, slide // 2):
        if not is_held and _is_strip(box, slide // 2, whole, config):
            return "it is a strip, lower than fronts of drawers are"
        is_open = _is_open(mesh, lambda: rest, box, slide, config.front)
        return "it is open, and a front is closed" if is_open else ""
    seen = _Seen.of(rest, box, slide, config.sunk)
    if min(seen.back, seen.above) > config.seen and seen.aside >= config.aside:
        return "it is seen from behind, from above and from both sides: it is in no case"
    if _is_open(mesh, lambda: rest, box, _UP, config.bottom):
        return "it has no bottom"
    is_block = not is_held and _is_open_block(box, mesh, seen, config)
    return "it is a solid block, and open to see: nothing could be put into it" if is_block else ""


def _is_strip(front: Box, axis: int, whole: Box, config: GuessedShapeConfig) -> bool:
    width, height = float(front.size[1 - axis]), float(front.size[_UP // 2])
    return height <= config.low * float(whole.size.max()) and height <= config.strip * width


def _frames(mesh: TriangleMesh) -> tuple[Mat3, Mat3]:
    """Returns the axes, and a part's own main directions: those of a door that is drawn open, or of an inclined lid.

    Each is a matrix with a direction in each column.
    """
    normals = mesh.face_normals
    return np.eye(3), np.linalg.eigh(np.einsum("f,fi,fj->ij", mesh.face_areas, normals, normals))[1]


def _straight(mesh: TriangleMesh, config: GuessedShapeConfig) -> float:
    """Returns how much of a surface lies across one of the axes, or of its own main directions (fraction of area).

    So do the bevels and mouldings of a plate.
    """
    total = float(mesh.face_areas.sum())
    if not total > 0:
        return 1.0
    return max(float(mesh.face_areas[_lies_along(mesh, frame, config)].sum()) / total for frame in _frames(mesh))


def _lies_along(mesh: TriangleMesh, frame: Mat3, config: GuessedShapeConfig) -> Bool[np.ndarray, " faces"]:
    """Whether each face lies across one of the directions of a frame, or is a bevel or a moulding of a plate."""
    facing, sides = np.abs(mesh.face_normals @ frame), np.ptp(mesh.vertices @ frame, axis=0)
    thin, *long = np.argsort(sides)
    along = facing.max(axis=1) >= config.straight
    if sides[thin] < config.thick * sides[long[0]]:
        along |= facing[:, long].min(axis=1) <= config.moulded
    return np.asarray(along)


class _Seen(NamedTuple):
    """How much of the sides of a drawer is seen from outside (fractions); aside: of its left or right, the lesser."""

    back: float
    aside: float
    below: float
    above: float

    @classmethod
    def of(cls, rest: RayCaster, box: Box, slide: SignedAxis, sunk: float) -> "_Seen":
        """Returns what is seen of a drawer that slides level, past the `rest` of the object."""
        axis = slide // 2
        back = _open_ratios(rest, box, axis, sunk)[1 - slide % 2]
        return cls(back, min(_open_ratios(rest, box, 1 - axis, sunk)), *_open_ratios(rest, box, 2, sunk))


def _open_ratios(rest: RayCaster, box: Box, axis: int, sunk: float) -> tuple[float, float]:
    """Returns how open two sides are, from just before them or from a little within: walls may be drawn into it."""
    size = box.size * (np.arange(3) == axis)
    before, within = (open_ratios(rest, Box(box.low + i * size, box.high - i * size), axis) for i in (0.0, sunk))
    return min(before[0], within[0]), min(before[1], within[1])


def _is_open_block(box: Box, mesh: TriangleMesh, seen: _Seen, config: GuessedShapeConfig) -> bool:
    """Whether nothing could be put into a drawer from above, and no case covers it: it was not drawn simply."""
    is_board = box.size[2] <= config.board * box.size[:2].min()
    is_open = seen.above > config.seen or (max(seen.back, seen.below) > config.seen and not is_board)
    deep = _depths(RayCaster(mesh), box, _UP, outside=True) > config.deep * box.size[2]
    return bool(is_open and deep.mean() < config.inside)


# Where rays go through a box, from side to side: unevenly, as planks and slats have even seams between them.
_STEPS = np.array([0.1, 0.213, 0.288, 0.411, 0.517, 0.587, 0.712, 0.789, 0.9])
_OFF = 0.01  # of a box's largest side: from where rays start outside it, or within it ...
_INTO = 0.25  # ... no farther than this (fraction of its depth there)


def _is_open(mesh: TriangleMesh, rest: Callable[[], RayCaster], box: Box, face: SignedAxis, least: float) -> bool:
    """Whether less than a fraction of a part is closed, seen from one side: by itself, or by what is in its box."""
    within = float(box.size[face // 2]) + _OFF * float(box.size.max())  # a bottom may be just below
    own = _depths(RayCaster(mesh), box, face, outside=True)
    if np.mean(own <= within) >= least:
        return False
    others = _depths(rest(), box, face, outside=False)
    return bool(np.mean(np.minimum(own, others) <= within) < least)


def _depths(caster: RayCaster, box: Box, face: SignedAxis, outside: bool) -> Scalars:
    """Returns how deep in a box rays from one of its faces first meet something, metres.

    They start just `outside` that face, or just inside, past what only touches it, and before the middle of a thin box:
    a pane is there in its leaf.
    """
    axis, step = face // 2, _OFF * float(box.size.max())
    off = step if outside else -min(step, _INTO * float(box.size[axis]))
    others = [k for k in range(3) if k != axis]
    spots = np.meshgrid(*(box.low[k] + _STEPS * box.size[k] for k in others), indexing="ij")
    starts, out = np.empty((len(_STEPS) ** 2, 3)), code_to_direction(face)
    starts[:, others] = np.stack(spots, axis=-1).reshape(-1, 2)
    starts[:, axis] = (box.high[axis] if face % 2 else box.low[axis]) + off * out[axis]
    return caster.along(starts, -out) - off
