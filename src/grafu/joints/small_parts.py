"""Small parts that move by themselves: knobs and wheels turn without limits, buttons are pressed, casters swivel.

They are found by their shape, and by what they touch, on an object whose doors and drawers work already; only buttons
go by their names. A knob has a round outline, stands on something with one end, and has nothing before the other.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import pi
from typing import final

import numpy as np
import shapely

from grafu.articulation.articulated_object import ArticulatedObject, Visual, VisualRole
from grafu.asset.names import words
from grafu.asset.part import Asset
from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.config import SmallPartConfig
from grafu.joints.make_plan import request_of_joint
from grafu.joints.plan import JointRequest, PlanConfig
from grafu.scene.border import part_axes
from grafu.vocabulary import JointType, PartLabel

SOURCE = "rule"
"""`JointRequest.source` of a small part that is found by its shape."""
_KNOBS = (PartLabel.HANDLE, PartLabel.MISC, PartLabel.UNKNOWN)
_BUTTONS = frozenset({"button", "buttons", "pushbutton"})
_UP = vec3(0.0, 0.0, 1.0)


@final
@dataclass(frozen=True, eq=False)
class _Piece:
    """A visual of a link, with its colliding shape."""

    link: str
    visual: Visual

    @cached_property
    def collider(self) -> MeshCollider:
        return MeshCollider(self.visual.mesh)

    @property
    def mesh(self) -> TriangleMesh:
        return self.visual.mesh

    @property
    def largest(self) -> float:
        return float(self.mesh.box.size.max())

    def meets(self, box: Box) -> bool:
        """Whether its surface passes through a box."""
        return self.mesh.box.overlaps(box) and self.collider.intersects(MeshCollider(TriangleMesh.box_mesh(box)))


@final
@dataclass(frozen=True, eq=False)
class _Round:
    """A piece whose outline along `axis` is a circle; what lies along the axis is from `low` to `high`."""

    piece: _Piece
    axis: Axis
    diameter: float
    low: float
    high: float

    @property
    def length(self) -> float:
        return self.high - self.low


def stated_small_parts(asset: Asset, config: PlanConfig = PlanConfig()) -> tuple[JointRequest, ...]:
    """Returns the small parts that the input states joints for; what turns without limits is continuous."""
    found = []
    for joint in asset.small_joints:
        request = replace(request_of_joint(joint, asset, config), drawn_at=0.0, attached=joint.members)
        if request.kind.turns and not joint.limited:
            request = replace(request, type=JointType.CONTINUOUS, reference=2 * pi)
        found.append(request)
    return tuple(found)


def small_parts(made: ArticulatedObject, config: SmallPartConfig = SmallPartConfig()) -> tuple[JointRequest, ...]:
    """Returns what turns or is pressed by itself on an object; lengths of `config` are in its scale (`at_scale`).

    What a request's part takes along is `attached` to it: other pieces of a knob, the wheels of a caster.
    """
    pieces = [_Piece(link.id, visual) for link in made.links for visual in link.visuals]
    wheels = _wheels([p for p in pieces if p.link == made.root], config)
    rolling = {id(wheel.piece) for wheel in wheels}
    others = [piece for piece in pieces if id(piece) not in rolling]
    casters = list(_casters(wheels, [p for p in others if p.link == made.root], config))
    taken = {name for request in casters for name in (request.moving, *request.attached)}
    rest = [piece for piece in others if piece.visual.name not in taken]
    knobs = list(_knobs(rest, pieces, config))
    taken = {name for request in knobs for name in (request.moving, *request.attached)}
    buttons = _buttons([piece for piece in rest if piece.visual.name not in taken], pieces, config)
    return (*casters, *(_wheel(wheel) for wheel in wheels), *knobs, *buttons)


def _round_about(piece: _Piece, k: int, config: SmallPartConfig) -> _Round | None:
    """Returns a piece as a round one about its own axis `k`; None where its outline along it is no circle."""
    axes = part_axes(piece.mesh)
    local = piece.mesh.vertices @ axes
    box, flat = Box.around(local), np.delete(local, k, axis=1)
    radius = float(np.linalg.norm(flat - np.delete(box.center, k), axis=1).max())
    area = shapely.convex_hull(shapely.multipoints(flat)).area
    if area <= 0 or area < config.round * pi * radius**2:
        return None
    return _Round(piece, Axis(axes @ box.center, axes[:, k]), 2 * radius, float(box.low[k]), float(box.high[k]))


def _wheels(pieces: Sequence[_Piece], config: SmallPartConfig) -> list[_Round]:
    """Returns the pieces that stand on the floor and are round about a level axis, and about no upright one."""
    floor = min((float(piece.mesh.box.low[2]) for piece in pieces), default=0.0)
    found = []
    for piece in pieces:
        low = float(piece.mesh.box.low[2])
        if piece.visual.role is not VisualRole.PART or low > floor + config.off_floor:
            continue
        if not config.wheel[0] <= piece.largest <= config.wheel[1] or _round_about(piece, 2, config):
            continue
        level = [_round_about(piece, k, config) for k in (0, 1)]
        found += [one for one in level if one is not None and one.length <= one.diameter][:1]
    return found


def _wheel(wheel: _Round) -> JointRequest:
    return JointRequest(wheel.piece.visual.name, JointType.CONTINUOUS, wheel.axis, SOURCE, 2 * pi)


def _casters(wheels: Sequence[_Round], still: Sequence[_Piece], config: SmallPartConfig) -> Iterator[JointRequest]:
    """Yields the forks of wheels, which swivel about their stem and take the wheels along."""
    forks: dict[tuple[str, ...], list[_Round]] = {}
    by_name = {piece.visual.name: piece for piece in still}
    for wheel in wheels:
        forks.setdefault(tuple(_fork(wheel, still, config)), []).append(wheel)
    for names, turned in forks.items():
        if not names:
            continue
        parts = [by_name[name] for name in names]
        vertices = np.vstack([piece.mesh.vertices for piece in parts])
        high = float(vertices[:, 2].max())
        stem = Box.around(vertices[vertices[:, 2] >= high - config.stem * float(np.ptp(vertices[:, 2]))])
        largest = max(parts, key=lambda piece: piece.largest).visual.name
        attached = (*(name for name in names if name != largest), *(wheel.piece.visual.name for wheel in turned))
        axis = Axis(stem.center, _UP)
        yield JointRequest(largest, JointType.CONTINUOUS, axis, SOURCE, 2 * pi, attached=attached)


def _fork(wheel: _Round, still: Sequence[_Piece], config: SmallPartConfig) -> list[str]:
    """Returns the pieces that hold a wheel and are of its size, with what of that size these hold."""
    reach = config.fork * wheel.diameter
    middle = wheel.axis.point
    around = Box(middle - reach, middle + reach)
    near = [p for p in still if p.largest <= reach and p.visual.role is VisualRole.PART and _is_in(p.mesh.box, around)]
    found: list[_Piece] = []
    queue = [wheel.piece.mesh.box.grown(config.beside * wheel.diameter)]
    while queue:
        box = queue.pop()
        new = [piece for piece in near if piece not in found and piece.mesh.box.overlaps(box)]
        found += new
        queue += [piece.mesh.box.grown(config.touching) for piece in new]
    return sorted(piece.visual.name for piece in found)


def _is_in(inner: Box, outer: Box) -> bool:
    return bool(np.all(inner.low >= outer.low) and np.all(inner.high <= outer.high))


def _knobs(pieces: Sequence[_Piece], every: Sequence[_Piece], config: SmallPartConfig) -> Iterator[JointRequest]:
    """Yields the knobs: one or more round pieces on one level axis, on something, with nothing before them."""
    fits = [p for p in pieces if p.visual.role is VisualRole.PART and p.visual.label in _KNOBS]
    small = [p for p in fits if p.largest <= config.knob[1]]
    rounds = [r for p in small for k in (0, 1) if (r := _round_about(p, k, config)) is not None]
    taken: set[str] = set()
    for group in _coaxial(rounds, config):
        names = sorted({one.piece.visual.name for one in group})
        widest = max(group, key=lambda one: one.diameter)
        low, high = min(one.low for one in group), max(one.high for one in group)
        is_knob = (
            config.knob[0] <= widest.diameter and config.stout <= (high - low) / widest.diameter <= 1 / config.stout
        )
        outwards = _outwards(widest.axis, (low, high), widest.diameter, names, every, config) if is_knob else None
        if outwards is None or taken & set(names):
            continue
        taken |= set(names)
        moving = widest.piece.visual.name
        axis = Axis(widest.axis.point, outwards)
        attached = tuple(name for name in names if name != moving)
        yield JointRequest(moving, JointType.CONTINUOUS, axis, SOURCE, 2 * pi, attached=attached)


def _coaxial(rounds: Sequence[_Round], config: SmallPartConfig) -> list[list[_Round]]:
    """Returns the round pieces in groups that lie end to end on one axis and belong to one link."""
    groups: list[list[_Round]] = []
    for one in sorted(rounds, key=lambda r: r.low):
        group = next((g for g in groups if any(_continues(other, one, config) for other in g)), None)
        if group is None:
            groups.append([one])
        else:
            group.append(one)
    return groups


def _continues(a: _Round, b: _Round, config: SmallPartConfig) -> bool:
    same = a.piece is not b.piece and a.piece.link == b.piece.link
    parallel = abs(float(a.axis.direction @ b.axis.direction)) > config.parallel
    if not (same and parallel):
        return False
    offset = np.linalg.norm(a.axis.closest_point(b.axis.point) - b.axis.point)
    return bool(offset <= config.touching and b.low <= a.high + config.touching and a.low <= b.high + config.touching)


def _outwards(
    axis: Axis,
    ends: tuple[float, float],
    width: float,
    names: Iterable[str],
    every: Sequence[_Piece],
    config: SmallPartConfig,
) -> Vec3 | None:
    """Returns the direction of the end that nothing stands on or before; None unless the other end alone is held.

    Args:
        axis: what lies along it.
        ends: where it begins and ends along the axis, metres.
        width: its width across the axis, metres.
        names: its own pieces.
        every: all pieces of the object.
        config: how near is on, and how far before.
    """
    others = [piece for piece in every if piece.visual.name not in set(names)]
    d, middle = axis.direction, 0.5 * (ends[0] + ends[1])
    half = 0.5 * config.middle * width
    for sign, end in ((1.0, ends[1]), (-1.0, ends[0])):
        held = _along(axis, (middle, ends[0] + ends[1] - end - sign * config.touching), half)
        free = _along(axis, (middle, end + sign * config.room), half)
        if any(piece.meets(held) for piece in others) and not any(piece.meets(free) for piece in others):
            return np.asarray(sign * d)
    return None


def _along(axis: Axis, span: tuple[float, float], half: float) -> Box:
    """Returns the box around an axis between two places along it, metres, so wide to each side."""
    at = [axis.point + (place - float(axis.point @ axis.direction)) * axis.direction for place in span]
    box, aside = Box.around(np.array(at)), half * (1.0 - np.abs(axis.direction))
    return Box(box.low - aside, box.high + aside)


def _buttons(pieces: Sequence[_Piece], every: Sequence[_Piece], config: SmallPartConfig) -> Iterator[JointRequest]:
    """Yields what is called a button: it is pressed towards what it stands on."""
    for piece in pieces:
        is_button = piece.visual.role is VisualRole.PART and _BUTTONS & set(words(piece.visual.name))
        if not is_button or piece.largest > config.knob[1]:
            continue
        box, names = piece.mesh.box, (piece.visual.name,)
        for direction in sorted(part_axes(piece.mesh).T, key=lambda d: float(np.ptp(piece.mesh.vertices @ d))):
            along = piece.mesh.vertices @ direction
            ends, width = (float(along.min()), float(along.max())), 0.5 * float(box.size.min())
            outwards = _outwards(Axis(box.center, direction), ends, width, names, every, config)
            if outwards is not None:
                travel = min(config.press, 0.5 * (ends[1] - ends[0]))
                yield JointRequest(piece.visual.name, JointType.PRISMATIC, Axis(box.center, -outwards), SOURCE, travel)
                break
