"""Cabinets whose doors fold: wardrobes with two or four leaves in one opening, and corner units with two hinged leaves.

The corner units are drawn in the family of those; the wardrobes are specimens for tests and samples: families have
folding leaves in their layouts (`fronts.gliding`).
"""

from collections.abc import Iterator
from dataclasses import replace
from math import pi, radians
from typing import Literal, final

from grafu.articulation.articulated_object import Coupling
from grafu.asset.edit import centred
from grafu.asset.part import AnnotatedJoint, Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.transform import from_rotation, rotation_matrix
from grafu.synth.cabinets.cabinet import Cabinet, cabinet_pieces
from grafu.synth.cabinets.corner import InnerCorner, corner_case
from grafu.synth.case.case import Case
from grafu.synth.fronts.front import front_pieces
from grafu.synth.fronts.layout import Cell, Edge, Edges, Pair, Rect
from grafu.synth.fronts.setting import Mount, Setting
from grafu.synth.pieces.assembly import PieceDraft, assemble, plank
from grafu.synth.pieces.finish import Finish
from grafu.vocabulary import JointType, PartLabel

Side = Literal["left", "right"]
WARDROBE = Case(1.0, 2.1, 0.58)
SLIM_POST = InnerCorner(post=0.022)  # the leaves clear one another there
_OPENING = radians(85)  # of the outer leaf; the inner one turns back by twice as much
_SECOND = radians(80)  # of the second leaf in a corner, on the first
_BAR = (0.012, 0.03, 0.16)  # metres: a handle's width, depth and height
_BESIDE = 0.04  # metres from the seam to a handle
_UP = vec3(0.0, 0.0, 1.0)


@final
@dataclass(frozen=True, slots=True)
class FoldingDoors:
    """A cabinet with folding doors, metres: two leaves that fold to a `side`, or four, a pair to either side.

    Raises:
        ValueError: if there are neither two nor four leaves.
    """

    name: str = "folding_doors"
    case: Case = WARDROBE
    leaves: int = 2
    side: Side = "left"
    mount: Mount = "overlay"
    front: float = 0.018
    gap: float = 0.003
    shelves: int = 1

    def __post_init__(self) -> None:
        if self.leaves not in (2, 4):
            raise ValueError(f"`FoldingDoors.leaves` must be 2 or 4: got {self.leaves}")


def make_folding_doors(spec: FoldingDoors) -> Asset:
    """Returns the cabinet with its leaves' true joints; the inner leaves ride on the outer ones and follow them."""
    pair = Cabinet(spec.name, spec.case, Pair(shelves=spec.shelves, handle="none"), spec.mount, spec.front, spec.gap)
    pieces = cabinet_pieces(pair)
    boxes = [piece.surfaces[0].mesh.box for piece in pieces if piece.label is PartLabel.DOOR]
    halves = boxes if spec.leaves == 2 else [half for box in boxes for half in _halves(box, spec.gap)]
    inner = {2: (1,) if spec.side == "left" else (0,), 4: (1, 2)}[spec.leaves]
    leaves = [_leaf(box, pair.finish, k in inner, is_right_of_seam=k % 2 == 1) for k, box in enumerate(halves)]
    plain = assemble(spec.name, [*(piece for piece in pieces if piece.label is not PartLabel.DOOR), *leaves])
    names = [f"door_{k + 1}" for k in range(spec.leaves)]
    if spec.leaves == 2:
        return _folding(plain, [(names if spec.side == "left" else names[::-1], spec.side)])
    return _folding(plain, [(names[:2], "left"), (names[:1:-1], "right")])


def _halves(box: Box, gap: float) -> tuple[Box, Box]:
    """Returns a leaf parted in two equal ones, with a seam between."""
    middle = float(box.center[0])
    left = Box(box.low, vec3(middle - gap / 2, *box.high[1:]))
    return left, Box(vec3(middle + gap / 2, *box.low[1:]), box.high)


def _leaf(box: Box, finish: Finish, is_pulled: bool, is_right_of_seam: bool) -> PieceDraft:
    """Returns a plain leaf; one that is pulled has a bar beside the seam between its pair."""
    low, high = ((float(p[0]), float(p[1]), float(p[2])) for p in (box.low, box.high))
    door = plank(PartLabel.DOOR, "door", finish.front, (low, high))
    if not is_pulled:
        return door
    wide, deep, long = _BAR
    x = low[0] + _BESIDE if is_right_of_seam else high[0] - _BESIDE - wide
    z = float(box.center[2]) - long / 2
    bar = plank(PartLabel.HANDLE, "handle", finish.metal, ((x, low[1] - deep, z), (x + wide, low[1], z + long)))
    return replace(door, attached=(bar,))


def _folding(asset: Asset, pairs: list[tuple[list[str], Side]]) -> Asset:
    joints: list[AnnotatedJoint] = []
    carried: dict[str, str] = {}
    for (outer, inner), side in pairs:
        first, second = asset.part(outer), asset.part(inner)
        sign = -1.0 if side == "left" else 1.0
        joints.append(AnnotatedJoint(outer, JointType.REVOLUTE, _at_front(first, sign), 0.0, _OPENING))
        behind = Axis(_edge(second, sign, float(second.box.high[1])), -sign * _UP)
        follows = Coupling(outer, 2.0)
        joints.append(AnnotatedJoint(inner, JointType.REVOLUTE, behind, 0.0, 2 * _OPENING, coupling=follows))
        carried[inner] = outer
    parts = (replace(p, carried_by=carried.get(p.id, p.carried_by)) for p in asset.parts)
    return replace(asset, parts=tuple(parts), joints=tuple(joints))


def _at_front(leaf: Part, sign: float) -> Axis:
    return Axis(_edge(leaf, sign, float(leaf.box.low[1])), sign * _UP)


def _edge(leaf: Part, sign: float, y: float) -> Vec3:
    """Returns the middle of a leaf's edge at its left (`sign` -1) or its right, at a depth."""
    box = leaf.box
    return vec3(float((box.high if sign > 0 else box.low)[0]), y, float(box.center[2]))


@final
@dataclass(frozen=True, slots=True)
class FoldingCorner:
    """An L-shaped corner unit with two leaves that meet in the inner corner, metres; `side` hangs on the case.

    `case` states its size; its post does not count. Its first door states the leaves' style and the handle of the one
    that is not on the case.
    """

    name: str = "folding_corner"
    case: InnerCorner = SLIM_POST
    side: Side = "right"


def make_folding_corner(spec: FoldingCorner) -> Asset:
    """Returns the corner unit with its leaves' true joints: one on the case, the other on that one."""
    pieces = [*(piece for piece in corner_case(spec.case) if piece.stem != "corner_post"), *_leaves(spec)]
    asset = assemble(spec.name, pieces)
    first, second = ("door_1", "door_2") if spec.side == "right" else ("door_2", "door_1")
    asset = replace(asset, joints=tuple(_in_corner(asset, first, second, spec.side)))
    parts = (replace(part, carried_by=first) if part.id == second else part for part in asset.parts)
    return centred(replace(asset, parts=tuple(parts)))


def _leaves(spec: FoldingCorner) -> Iterator[PieceDraft]:
    """Yields the leaf that faces -Y, then the one that faces +X; the one that is not on the case has a handle."""
    case, t = spec.case, spec.case.panel
    low, high = case.base + t, case.height - (t if case.topped else 0.0)
    setting = Setting(-case.depth, 0.0, thickness=case.front, gap=case.gap, panel=t, finish=case.finish)
    top = Edge.CASE if case.topped else Edge.STOP
    near = Rect(case.depth + case.post, case.along_x - t, low, high)
    far = Rect(t - case.along_y, -case.depth - case.post, low, high)
    pulled = replace(case.door, shelves=0, behind=None)
    plain = replace(pulled, handle="none", grip="none")
    is_right = spec.side == "right"
    door = replace(plain if is_right else pulled, hinge="left")
    yield from front_pieces(Cell(door, near, Edges(left=Edge.STOP, top=top)), setting)
    other = replace(pulled if is_right else plain, hinge="right")
    turn = from_rotation(rotation_matrix(_UP, pi / 2))
    for piece in front_pieces(Cell(other, far, Edges(right=Edge.STOP, top=top)), setting):
        yield piece.transformed(turn)


def _in_corner(asset: Asset, first: str, second: str, side: Side) -> Iterator[AnnotatedJoint]:
    faces_front, faces_right = asset.part("door_1").box, asset.part("door_2").box
    z = float(faces_front.center[2])
    y, x = float(faces_front.low[1]), float(faces_right.high[0])
    if side == "right":
        on_case = Axis(vec3(float(faces_front.high[0]), y, z), _UP)
        on_leaf = Axis(vec3(x, float(faces_right.high[1]), z), _UP)
    else:
        on_case = Axis(vec3(x, float(faces_right.low[1]), z), -_UP)
        on_leaf = Axis(vec3(float(faces_front.low[0]), y, z), -_UP)
    yield AnnotatedJoint(first, JointType.REVOLUTE, on_case, 0.0, pi / 2)
    yield AnnotatedJoint(second, JointType.REVOLUTE, on_leaf, 0.0, _SECOND)
