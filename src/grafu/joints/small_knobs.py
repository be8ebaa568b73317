"""Knobs that turn: dials on a body, and knobs of doors on which a mark shows how far they are turned.

A knob has a round outline, stands on something with one end, and has nothing before the other; pieces that touch one
another are one knob, and so are the shells of a piece. What nothing shows to turn is a pull: the plain knob of a door,
and every knob of a drawer.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from math import pi
from typing import final

import numpy as np
import shapely

from grafu.articulation.articulated_object import Joint, Visual, VisualRole
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.shells import shell_numbers
from grafu.geometry.touching import near_pairs
from grafu.graph.functional_graph import joined_groups
from grafu.joints.config import SmallPartConfig
from grafu.joints.plan import JointRequest
from grafu.scene.border import part_axes
from grafu.vocabulary import JointType, PartLabel

SOURCE = "rule"
"""`JointRequest.source` of a small part that is found by its shape."""
_KNOBS = (PartLabel.HANDLE, PartLabel.MISC, PartLabel.UNKNOWN)


@final
@dataclass(frozen=True, eq=False)
class Piece:
    """A visual of a link, with its colliding shape."""

    link: str
    visual: Visual

    @cached_property
    def collider(self) -> MeshCollider:
        """Its mesh as an obstacle."""
        return MeshCollider(self.visual.mesh)

    @cached_property
    def shells(self) -> "tuple[Piece, ...]":
        """Its connected shells, each as a piece of the same name."""
        number = shell_numbers(self.mesh)
        if not len(number) or not number.any():
            return (self,)
        meshes = (self.mesh.with_faces(number == k) for k in range(int(number.max()) + 1))
        return tuple(Piece(self.link, replace(self.visual, surfaces=(Surface(mesh),))) for mesh in meshes)

    @property
    def name(self) -> str:
        """The visual's name, which no other has."""
        return self.visual.name

    @property
    def mesh(self) -> TriangleMesh:
        """The visual's mesh, in the object frame."""
        return self.visual.mesh

    @property
    def largest(self) -> float:
        """Its largest side, metres."""
        return float(self.mesh.box.size.max())

    @property
    def is_part(self) -> bool:
        """Whether it came with the input."""
        return self.visual.role is VisualRole.PART

    def meets(self, box: Box) -> bool:
        """Whether its surface passes through a box."""
        return self.mesh.box.overlaps(box) and self.collider.intersects(MeshCollider(TriangleMesh.box_mesh(box)))


@final
@dataclass(frozen=True, eq=False)
class Round:
    """A piece whose outline along `axis` is a circle; what lies along the axis is from `low` to `high`, metres."""

    piece: Piece
    axis: Axis
    diameter: float
    low: float
    high: float

    @property
    def length(self) -> float:
        """Its extent along the axis, metres."""
        return self.high - self.low


def turning(moving: str, axis: Axis, attached: tuple[str, ...] = ()) -> JointRequest:
    """Returns the request of a part that turns without end about an axis, and takes others along."""
    return JointRequest(moving, JointType.CONTINUOUS, axis, SOURCE, 2 * pi, attached=attached)


def round_about(piece: Piece, k: int, config: SmallPartConfig) -> Round | None:
    """Returns a piece as a round one about its own axis `k`; None where its outline along it is no circle."""
    axes = part_axes(piece.mesh)
    local = piece.mesh.vertices @ axes
    box, flat = Box.around(local), np.delete(local, k, axis=1)
    radius = float(np.linalg.norm(flat - np.delete(box.center, k), axis=1).max())
    least = config.round * pi * radius**2
    if float(np.delete(box.size, k).prod()) < least:  # nor is any outline in this rectangle a circle
        return None
    area = shapely.convex_hull(shapely.multipoints(flat)).area
    if area <= 0 or area < least:
        return None
    return Round(piece, Axis(axes @ box.center, axes[:, k]), 2 * radius, float(box.low[k]), float(box.high[k]))


def knobs(
    pieces: Sequence[Piece], every: Sequence[Piece], joint_of: Mapping[str, Joint], config: SmallPartConfig
) -> Iterator[JointRequest]:
    """Yields the knobs among some pieces of an object.

    Args:
        pieces: what may be a knob or a piece of one.
        every: all pieces of the object.
        joint_of: the joint of each link that moves.
        config: what counts as a knob; lengths in the scale of the object.
    """
    largest = largest_side(config.of_piece[0], every, config)
    small = [p for p in pieces if p.is_part and p.visual.label in _KNOBS and p.largest <= largest]
    for cluster in _clusters(small, config):
        turned = _turned(cluster, largest, config)
        if turned is None and (plates := _plates(cluster, config)):
            cluster = [piece for piece in cluster if piece.name not in plates]
            turned = _turned(cluster, largest, config)
        if turned is None:
            continue
        (widest, ends), names = turned, [piece.name for piece in cluster]
        stand = standing(widest.axis, ends, widest.diameter, names, every, config)
        if stand is not None and _turns(cluster, widest.axis, stand[1], joint_of, config):
            attached = tuple(name for name in names if name != widest.piece.name)
            axis = Axis(widest.axis.point, stand[0])
            yield turning(widest.piece.name, axis, attached)


def are_shaped_as_knobs(parts: Iterable[Part], whole: Box, config: SmallPartConfig) -> frozenset[str]:
    """Returns the ids of the parts with the size and the shape of a knob; `whole` is the box of their object."""
    largest = _largest(config.of_piece[0], whole, config)
    small = (Piece("", Visual(p.id, p.surfaces, label=p.label)) for p in parts if p.box.size.max() <= largest)
    return frozenset(piece.name for piece in small if _turned([piece], largest, config) is not None)


def largest_side(ratio: float, every: Sequence[Piece], config: SmallPartConfig) -> float:
    """Returns the largest side of a knob or button, metres: `ratio` of the object's, as scales are estimates."""
    return _largest(ratio, Box.enclosing(piece.mesh.box for piece in every), config)


def _largest(ratio: float, whole: Box, config: SmallPartConfig) -> float:
    return max(config.knob[1], ratio * float(whole.size.max()))


def _clusters(pieces: Sequence[Piece], config: SmallPartConfig) -> list[list[Piece]]:
    """Returns the pieces in groups that touch one another and belong to one link."""
    by_name = {piece.name: piece for piece in pieces}
    touched: dict[str, list[str]] = {name: [] for name in by_name}
    for i, j in near_pairs([piece.mesh.box for piece in pieces], config.touching) if pieces else ():
        a, b = pieces[i], pieces[j]
        if a.link == b.link and a.collider.is_within(config.touching, b.collider):
            touched[a.name].append(b.name)
            touched[b.name].append(a.name)
    return [[by_name[name] for name in sorted(group)] for group in joined_groups(touched)]


def _turned(
    cluster: Sequence[Piece], largest: float, config: SmallPartConfig
) -> tuple[Round, tuple[float, float]] | None:
    """Returns the widest round piece of a knob, about the knob's axis, and where the knob begins and ends along it.

    A ball is round about any axis, so it states none. None where nothing does, or the shape is no knob's.
    """
    shells = [shell for piece in cluster for shell in piece.shells]
    levels = [level for shell in shells if (level := _only_level(shell, config)) is not None]
    if not levels:
        return None
    axis = max(levels, key=lambda one: one.diameter).axis
    on_axis = [one for shell in shells for one in _rounds(shell, config) if _lies_on(one, axis, config)]
    widest = max(on_axis, key=lambda one: one.diameter)
    vertices = np.vstack([piece.mesh.vertices for piece in cluster])
    along = vertices @ axis.direction
    ends = (float(along.min()), float(along.max()))
    aside = np.linalg.norm(
        vertices - axis.point - np.outer(along - axis.point @ axis.direction, axis.direction), axis=1
    )
    fits = 2 * float(aside.max()) <= config.pointer * widest.diameter
    stout = config.stout <= (ends[1] - ends[0]) / widest.diameter <= 1 / config.stout
    if not (fits and stout and config.knob[0] <= widest.diameter <= largest):
        return None
    return Round(widest.piece, axis, widest.diameter, *ends), ends


def _plates(cluster: Sequence[Piece], config: SmallPartConfig) -> frozenset[str]:
    """Returns the flat pieces of a cluster that are no disc, and wider than all that are round: a knob stands on them.

    None of a cluster that is flat itself.
    """
    rounds = [one.diameter for piece in cluster for one in _rounds(piece, config)]
    if not rounds:
        return frozenset()
    sides = {p.name: np.sort(Box.around(p.mesh.vertices @ part_axes(p.mesh)).size) for p in cluster}
    return frozenset(
        piece.name
        for piece in cluster
        if sides[piece.name][0] < config.stout * sides[piece.name][1]
        and sides[piece.name][2] > max(rounds)
        and not _rounds(piece, config)
    )


def _rounds(piece: Piece, config: SmallPartConfig) -> list[Round]:
    return [one for k in range(3) if (one := round_about(piece, k, config)) is not None]


def _only_level(piece: Piece, config: SmallPartConfig) -> Round | None:
    """Returns a piece that is round about one level axis and no other."""
    level = [one for k in (0, 1) if (one := round_about(piece, k, config)) is not None]
    return level[0] if len(level) == 1 and round_about(piece, 2, config) is None else None


def _lies_on(one: Round, axis: Axis, config: SmallPartConfig) -> bool:
    """Whether a round piece lies on an axis: its own middle does, and it is round about it or a ball."""
    parallel = abs(float(one.axis.direction @ axis.direction)) > config.parallel
    ball = len(_rounds(one.piece, config)) > 1
    offset = float(np.linalg.norm(axis.closest_point(one.axis.point) - one.axis.point))
    return (parallel or ball) and offset <= config.touching


def _turns(
    cluster: Sequence[Piece],
    axis: Axis,
    stand: Sequence[Piece],
    joint_of: Mapping[str, Joint],
    config: SmallPartConfig,
) -> bool:
    """Whether a knob turns: on what is static it does, unless that is a front; on a door only if it has a mark."""
    joint = joint_of.get(cluster[0].link)
    if joint is None:
        return not any(piece.visual.label.is_movable for piece in stand)
    shells = [shell for piece in cluster for shell in piece.shells]
    marked = any(not any(_lies_on(one, axis, config) for one in _rounds(shell, config)) for shell in shells)
    return joint.kind.turns and marked


def standing(
    axis: Axis,
    ends: tuple[float, float],
    width: float,
    names: Collection[str],
    every: Sequence[Piece],
    config: SmallPartConfig,
) -> tuple[Vec3, list[Piece]] | None:
    """Returns the direction of the end that nothing stands on or before, and what holds the other end.

    None unless one end is held and the other is free.

    Args:
        axis: what lies along it.
        ends: where it begins and ends along the axis, metres.
        width: its width across the axis, metres.
        names: its own pieces.
        every: all pieces of the object.
        config: how near is on, and how far before.
    """
    others = [piece for piece in every if piece.name not in names]
    d, middle = axis.direction, 0.5 * (ends[0] + ends[1])
    half = 0.5 * config.middle * width
    for sign, end in ((1.0, ends[1]), (-1.0, ends[0])):
        held = _along(axis, (middle, ends[0] + ends[1] - end - sign * config.touching), half)
        free = _along(axis, (middle, end + sign * config.room), half)
        holding = [piece for piece in others if piece.meets(held)]
        if holding and not any(piece.meets(free) for piece in others):
            return np.asarray(sign * d), holding
    return None


def _along(axis: Axis, span: tuple[float, float], half: float) -> Box:
    """Returns the box around an axis between two places along it, metres, so wide to each side."""
    at = [axis.point + (place - float(axis.point @ axis.direction)) * axis.direction for place in span]
    box, aside = Box.around(np.array(at)), half * (1.0 - np.abs(axis.direction))
    return Box(box.low - aside, box.high + aside)
