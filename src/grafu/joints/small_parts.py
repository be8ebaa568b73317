"""Small parts that move by themselves: knobs, wheels and turntables turn, buttons are pressed, casters swivel.

They are found by their shape, and by what they touch, on an object whose doors and drawers work already; only buttons
go by their names. Knobs are in `small_knobs.py`.
"""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from math import pi

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Visual, VisualRole
from grafu.asset.names import words
from grafu.asset.part import Asset
from grafu.geometry.arrays import Points, Vec3, vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.joints.config import SmallPartConfig
from grafu.joints.make_plan import request_of_joint
from grafu.joints.plan import JointRequest, PlanConfig
from grafu.joints.small_knobs import SOURCE, Piece, Round, knobs, largest_side, round_about, standing, turning
from grafu.scene.border import part_axes
from grafu.vocabulary import JointType, PartLabel

_BUTTONS = frozenset({"button", "buttons", "pushbutton"})
_CAROUSELS = frozenset({"carousel", "susan"})
_TURNTABLES = _CAROUSELS | {"turntable"}
_UP = vec3(0.0, 0.0, 1.0)


def stated_small_parts(asset: Asset, config: PlanConfig = PlanConfig()) -> tuple[JointRequest, ...]:
    """Returns the small parts that the input states joints for; what turns without limits is continuous."""
    found = []
    for joint in asset.small_joints:
        request = replace(request_of_joint(joint, asset, config), drawn_at=0.0, attached=joint.members)
        if request.kind.turns and not joint.limited:
            request = replace(request, type=JointType.CONTINUOUS, reference=2 * pi)
        elif joint.limited and request.kind.slides:  # a button goes as far as its range spans, wherever it begins
            request = replace(request, reference=abs(joint.upper - joint.lower))
        found.append(request)
    return tuple(found)


def are_links(asset: Asset, names: Sequence[str]) -> bool:
    """Whether parts are whole links of a robot description, which are rigid bodies."""
    links = {part.source.link for part in asset.parts if part.id in names}
    return "" not in links and links.isdisjoint(p.source.link for p in asset.parts if p.id not in names)


def round_trays(asset: Asset, names: Collection[str], config: SmallPartConfig = SmallPartConfig()) -> frozenset[str]:
    """Returns which of some parts are trays that are round: these turn and do not slide (`small_parts`)."""
    parts = [asset.part(name) for name in names]
    pieces = [Piece("", Visual(part.id, part.surfaces, label=part.label)) for part in parts]
    return frozenset(piece.name for piece in pieces if _turntable(piece, config) is not None)


def carousels(asset: Asset) -> frozenset[str]:
    """Returns the static parts of an asset that are called carousels: they turn whatever else of it does."""
    return frozenset(p.id for p in asset.parts if p.carried_by is None and _CAROUSELS & set(words(p.source.name)))


def small_parts(made: ArticulatedObject, config: SmallPartConfig = SmallPartConfig()) -> tuple[JointRequest, ...]:
    """Returns what turns or is pressed by itself on an object; lengths of `config` are in its scale (`at_scale`).

    What a request's part takes along is `attached` to it: other pieces of a knob, the wheels of a caster.
    """
    pieces = [Piece(link.id, visual) for link in made.links for visual in link.visuals]
    wheels = _wheels([p for p in pieces if p.link == made.root], config)
    rolling = {id(wheel.piece) for wheel in wheels}
    others = [piece for piece in pieces if id(piece) not in rolling]
    casters = list(_casters(wheels, [p for p in others if p.link == made.root], config))
    taken = {name for request in casters for name in (request.moving, *request.attached)}
    rest = [piece for piece in others if piece.name not in taken]
    tables = list(_turntables([piece for piece in rest if piece.link == made.root], config))
    taken = {name for request in tables for name in (request.moving, *request.attached)}
    rest = [piece for piece in rest if piece.name not in taken]
    turning = list(knobs(rest, pieces, made.joint_of, config))
    taken = {name for request in turning for name in (request.moving, *request.attached)}
    buttons = _buttons([piece for piece in rest if piece.name not in taken], pieces, config)
    return (*casters, *(_wheel(wheel) for wheel in wheels), *tables, *turning, *buttons)


def _wheels(pieces: Sequence[Piece], config: SmallPartConfig) -> list[Round]:
    """Returns the pieces that stand on the floor and are round about a level axis, and about no upright one."""
    floor = min((float(piece.mesh.box.low[2]) for piece in pieces), default=0.0)
    found = []
    for piece in pieces:
        low = float(piece.mesh.box.low[2])
        if not piece.is_part or low > floor + config.off_floor:
            continue
        if not config.wheel[0] <= piece.largest <= config.wheel[1] or round_about(piece, 2, config):
            continue
        level = [round_about(piece, k, config) for k in (0, 1)]
        found += [one for one in level if one is not None and one.length <= one.diameter][:1]
    return found


def _wheel(wheel: Round) -> JointRequest:
    return turning(wheel.piece.name, wheel.axis)


def _casters(wheels: Sequence[Round], still: Sequence[Piece], config: SmallPartConfig) -> Iterator[JointRequest]:
    """Yields the forks of wheels, which swivel about their stem and take the wheels along."""
    forks: dict[tuple[str, ...], list[Round]] = {}
    by_name = {piece.name: piece for piece in still}
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
        attached = (*(name for name in names if name != largest), *(wheel.piece.name for wheel in turned))
        axis = Axis(stem.center, _UP)
        yield turning(largest, axis, attached)


def _fork(wheel: Round, still: Sequence[Piece], config: SmallPartConfig) -> list[str]:
    """Returns the pieces that hold a wheel and are of its size, with what of that size these hold."""
    reach = config.fork * wheel.diameter
    middle = wheel.axis.point
    around = Box(middle - reach, middle + reach)
    near = [p for p in still if p.largest <= reach and p.is_part and _is_in(p.mesh.box, around)]
    found: list[Piece] = []
    queue = [wheel.piece.mesh.box.grown(config.beside * wheel.diameter)]
    while queue:
        box = queue.pop()
        new = [piece for piece in near if piece not in found and piece.mesh.box.overlaps(box)]
        found += new
        queue += [piece.mesh.box.grown(config.touching) for piece in new]
    return sorted(piece.name for piece in found)


def _is_in(inner: Box, outer: Box) -> bool:
    return bool(np.all(inner.low >= outer.low) and np.all(inner.high <= outer.high))


def _turntables(still: Sequence[Piece], config: SmallPartConfig) -> Iterator[JointRequest]:
    """Yields the round trays, which turn with what lies beneath them and within their outline.

    What is called a carousel turns as one with all of it about the same axis: its trays and its pole.
    """
    taken: set[str] = set()
    tables = [(piece, table) for piece in still if (table := _turntable(piece, config)) is not None]
    for piece, table in sorted(tables, key=lambda found: -found[1].diameter):
        if piece.name in taken:
            continue
        box = piece.mesh.box
        below = Box(box.low - config.stout * np.array([0.0, 0.0, table.diameter]), box.high).grown(config.touching)
        reach = table.diameter / 2 + config.touching
        inside = (p for p in still if p is not piece and p.is_part and _is_in(p.mesh.box, below))
        ring = tuple(p.name for p in inside if _farthest(p.mesh.vertices, table.axis.point) <= reach)
        ring += tuple(
            p.name for p, other in tables if p is not piece and _is_one_carousel(piece, table, p, other, config)
        )
        ring = tuple(name for name in dict.fromkeys(ring) if name not in taken)
        taken |= {piece.name, *ring}
        yield turning(piece.name, Axis(table.axis.point, _UP), ring)


def _is_one_carousel(piece: Piece, table: Round, other: Piece, its: Round, config: SmallPartConfig) -> bool:
    """Whether two pieces that are called carousels turn about one axis."""
    are_called = all(_CAROUSELS & set(words(one.name)) for one in (piece, other))
    apart = float(np.linalg.norm((table.axis.point - its.axis.point)[:2]))
    return are_called and apart <= config.touching


def _farthest(points: Points, middle: Vec3) -> float:
    """Returns how far points are at most from an upright line through a point."""
    return float(np.linalg.norm(points[:, :2] - middle[:2], axis=1).max(initial=0.0))


def _turntable(piece: Piece, config: SmallPartConfig) -> Round | None:
    """Returns a piece that is called a tray or a turntable, round about the upright axis; else None.

    It is flat, unless it is called a carousel: that may have trays above each other, and may have been added.
    """
    names = set(words(piece.name))
    called = piece.visual.label is PartLabel.DRAWER or _TURNTABLES & names
    may_turn = piece.is_part or (piece.visual.role is VisualRole.ADDED and _CAROUSELS & names)
    table = round_about(piece, 2, config) if called and may_turn else None
    is_flat = table is not None and table.length <= config.stout * table.diameter
    return table if is_flat or _CAROUSELS & names else None


def _buttons(pieces: Sequence[Piece], every: Sequence[Piece], config: SmallPartConfig) -> Iterator[JointRequest]:
    """Yields what is called a button: it is pressed towards what it stands on."""
    largest = largest_side(config.of_piece[1], every, config)
    for piece in pieces:
        is_button = piece.is_part and _BUTTONS & set(words(piece.name))
        if not is_button or piece.largest > largest:
            continue
        box, names = piece.mesh.box, (piece.name,)
        for direction in sorted(part_axes(piece.mesh).T, key=lambda d: float(np.ptp(piece.mesh.vertices @ d))):
            along = piece.mesh.vertices @ direction
            ends, width = (float(along.min()), float(along.max())), 0.5 * float(box.size.min())
            stand = standing(Axis(box.center, direction), ends, width, names, every, config)
            if stand is not None:
                travel = min(config.press, 0.5 * (ends[1] - ends[0]))
                yield JointRequest(piece.name, JointType.PRISMATIC, Axis(box.center, -stand[0]), SOURCE, travel)
                break
