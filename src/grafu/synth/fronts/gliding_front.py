"""Doors that slide along the front of a cell, and leaves that fold, with their true motions. Fronts face -Y."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import inf
from typing import Literal

from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.axis import Axis
from grafu.graph.edges import Hinge, Slide
from grafu.synth.fronts.gliding import Folding, Sliding
from grafu.synth.fronts.handles import gripped_side, handle_pieces, held_along, opposite
from grafu.synth.fronts.interior import interior_pieces
from grafu.synth.fronts.layout import Cell, Edge, Rect, Side
from grafu.synth.fronts.leaf_relief import LeafShape
from grafu.synth.fronts.leaves import leaf_surfaces
from grafu.synth.fronts.pocket_front import pocket_pieces
from grafu.synth.fronts.setting import Setting, front_rect
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, plank
from grafu.vocabulary import PartLabel

PANE = 0.006  # metres: how thick a pane without a frame is
BEHIND = 0.01  # metres from the last leaf to what is behind it
LEAST_ROOM = 0.1  # metres behind the leaves: less is no cabinet
LEAST_TRAVEL = 0.5  # of a leaf's width: a door that opens less is no door
STRAP = (0.03, 0.006, 0.08)  # metres: how wide and thick the straps of a barn door are, and how far they reach down
APART = 0.002  # metres between a leaf or a handle and what stops it


def sliding_pieces(cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    """Yields the leaves, their rails, and what is behind them.

    Raises:
        ValueError: if they have no room to slide, or none behind them.
    """
    sliding = cell.leaf
    assert isinstance(sliding, Sliding)
    if sliding.kind == "barn":
        yield from _barn(sliding, cell, setting)
        return
    if sliding.kind != "bypass":
        yield from pocket_pieces(cell, setting)
        return
    thickness = PANE if sliding.pane else setting.thickness
    first, second = _planes(thickness, setting)
    shapes = list(_bypass(sliding, cell.opening, (first, second), thickness, setting))
    drafts = [_leaf(sliding, shape, k == len(shapes) - 1, setting) for k, shape in enumerate(shapes)]
    room = cell.opening.x0 + setting.gap, cell.opening.x1 - setting.gap
    for k, draft in enumerate(drafts):
        sense: Literal[-1, 1] = -1 if k == len(drafts) - 1 else 1
        others = [other for other in drafts if other is not draft]
        rect = shapes[k].rect
        ends = min(room[1] - rect.x1 if sense > 0 else rect.x0 - room[0], rect.width - sliding.lap)
        yield _with_slide(draft, rect, sense, min(ends, _free(draft, others, sense)))
    last = second + thickness
    yield from _tracks(sliding, cell.opening, (setting.plane, last + setting.gap), setting)
    yield from interior_pieces(sliding.shelves, sliding.inside, cell, _behind(setting, last))


def _planes(thickness: float, setting: Setting) -> tuple[float, float]:
    """Returns the y of the outer faces in both planes."""
    first = setting.plane + setting.gap
    return first, first + thickness + setting.gap


def _behind(setting: Setting, last: float) -> Setting:
    """Returns the setting of what stands behind leaves whose last plane ends at the y `last`."""
    plane = last + BEHIND
    if setting.back - plane < LEAST_ROOM:
        raise ValueError(f"sliding doors leave no room behind them: got {setting.back - plane:.3f} m")
    return replace(setting, plane=plane, mount="inset", thickness=0.0, frame=0.0)


def _bypass(
    sliding: Sliding, o: Rect, planes: tuple[float, float], thickness: float, setting: Setting
) -> Iterator[LeafShape]:
    gap, lap, count = setting.gap, sliding.lap, sliding.leaves
    width = (o.width - 2 * gap + (count - 1) * lap) / count
    z0, z1 = o.z0 + sliding.track + gap, o.z1 - sliding.track - gap
    for k in range(count):
        x = o.x0 + gap + k * (width - lap)
        y = planes[(k % 2) != (not sliding.left_first)]
        yield _shape(sliding, Rect(x, x + width, z0, z1), y, thickness, "left" if k == count - 1 else "right")


def _shape(front: Sliding | Folding, rect: Rect, y: float, thickness: float, towards: Side) -> LeafShape:
    """Returns a leaf that is held at the side across from `towards`."""
    side = gripped_side(front.hold, towards)
    return LeafShape(front.leaf, rect, y, thickness, opposite(towards), front.grip, side, held_along(front.hold, side))


def _leaf(front: Sliding, shape: LeafShape, is_last: bool, setting: Setting) -> PieceDraft:
    """Returns a leaf without its motion, with the handle at its outer edge."""
    finish = setting.finish
    seen = replace(finish, front=finish.glass) if front.pane else finish
    handle = handle_pieces(front.handle, front.hold, shape, "left" if is_last else "right", finish.metal)
    return PieceDraft(PartLabel.DOOR, "door", leaf_surfaces(shape, seen), None, handle)


def _with_slide(draft: PieceDraft, rect: Rect, sense: int, travel: float) -> PieceDraft:
    if travel < LEAST_TRAVEL * rect.width:
        raise ValueError(f"a sliding door has no room: got {travel:.3f} m of {rect.width:.3f} m")
    x, z = rect.center
    y = float(draft.surfaces[0].mesh.box.center[1])
    return replace(
        draft, motion=PieceMotion(Slide.joint_type, Axis(vec3(x, y, z), vec3(float(sense), 0.0, 0.0)), travel)
    )


def _free(draft: PieceDraft, others: Sequence[PieceDraft], sense: int) -> float:
    """Returns how far a leaf and its handle slide before they meet other leaves or their handles."""
    free = inf
    boxes = [s.mesh.box for other in others for piece in (other, *other.attached) for s in piece.surfaces]
    for mine in (s.mesh.box for piece in (draft, *draft.attached) for s in piece.surfaces):
        for box in boxes:
            gaps = mine.axis_gaps(box)
            ahead = box.low[0] - mine.high[0] if sense > 0 else mine.low[0] - box.high[0]
            if max(gaps[1], gaps[2]) < 0 and box.center[0] * sense > mine.center[0] * sense:
                free = min(free, float(ahead) - APART)
    return free


def _tracks(sliding: Sliding, o: Rect, depth: tuple[float, float], setting: Setting) -> Iterator[PieceDraft]:
    if sliding.track:
        for z0, z1 in ((o.z0, o.z0 + sliding.track), (o.z1 - sliding.track, o.z1)):
            span = ((o.x0, depth[0], z0), (o.x1, depth[1], z1))
            yield plank(PartLabel.BAR, "door_track", setting.finish.metal, span)


def _barn(sliding: Sliding, cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    """Yields the rail before the case, the door that hangs on it, and the case's inner wall with shelves beside it."""
    whole, o, t = front_rect(cell, replace(setting, mount="overlay", lap=1.0)), cell.opening, setting.thickness
    rail, finish = max(sliding.track, 0.015), setting.finish
    y, top = setting.plane - setting.gap - t, whole.z1 - rail - APART
    shape = _shape(sliding, Rect(whole.x0, o.center[0] + sliding.lap, whole.z0, top), y, t, "left")
    door, (wide, thick, down) = _leaf(sliding, shape, True, setting), STRAP
    middles = [shape.rect.x0 + ratio * shape.rect.width for ratio in (0.15, 0.85)]
    face = float(min(surface.mesh.box.low[1] for surface in door.surfaces))
    straps = [((x - wide / 2, face - thick, top - down), (x + wide / 2, face, whole.z1 - APART)) for x in middles]
    strap = plank(PartLabel.MISC, "hanger", finish.metal, *straps)
    travel = whole.x1 - shape.rect.x1
    yield _with_slide(replace(door, attached=(*door.attached, strap)), shape.rect, 1, travel)
    span = ((whole.x0, setting.plane - t, whole.z1 - rail), (whole.x1, setting.plane, whole.z1))
    yield plank(PartLabel.BAR, "door_track", finish.metal, span)
    inner, half = _behind(setting, setting.plane - BEHIND), setting.panel / 2
    middle = o.center[0]
    wall = ((middle - half, setting.plane, o.z0), (middle + half, setting.back, o.z1))
    yield plank(PartLabel.DIVIDER, "divider", finish.case, wall)
    left = Cell(sliding, replace(o, x1=middle - half), replace(cell.edges, right=Edge.SHARED))
    right = Cell(sliding, replace(o, x0=middle + half), replace(cell.edges, left=Edge.SHARED))
    for side in (left, right):
        yield from interior_pieces(sliding.shelves, sliding.inside, side, replace(inner, wall=0.0))


def folding_pieces(cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    """Yields the outer leaf, with the inner one that hangs on it and follows, and what is behind them."""
    front = cell.leaf
    assert isinstance(front, Folding)
    outer, inner = _halves(front.side, front_rect(cell, setting), setting.gap)
    y, t = setting.front, setting.thickness
    towards: Side = "top" if front.side == "top" else opposite(front.side)
    inner_shape, plain = _shape(front, inner, y, t, towards), replace(front, grip="none")
    handle = handle_pieces(front.handle, front.hold, inner_shape, towards, setting.finish.metal)
    turn = {"left": vec3(0.0, 0.0, -1.0), "right": vec3(0.0, 0.0, 1.0), "top": vec3(-1.0, 0.0, 0.0)}[front.side]
    on_case = PieceMotion(Hinge.joint_type, Axis(_edge(front.side, outer, y), turn), front.opening)
    behind = Axis(_edge(front.side, inner, y + t), -turn)
    follows = PieceMotion(Hinge.joint_type, behind, 2 * front.opening, follows=2.0)
    leaf = PieceDraft(PartLabel.DOOR, "door", leaf_surfaces(inner_shape, setting.finish), follows, handle)
    outer_shape = _shape(plain, outer, y, t, front.side)
    surfaces = leaf_surfaces(outer_shape, setting.finish)
    yield PieceDraft(PartLabel.DOOR, "door", surfaces, on_case, (leaf,))
    yield from interior_pieces(front.shelves, front.inside, cell, setting)


def _halves(side: Side, rect: Rect, gap: float) -> tuple[Rect, Rect]:
    """Returns the leaf that hangs on the case, and the other, with a seam between."""
    x, z = rect.center
    if side == "top":
        return replace(rect, z0=z + gap / 2), replace(rect, z1=z - gap / 2)
    left, right = replace(rect, x1=x - gap / 2), replace(rect, x0=x + gap / 2)
    return (left, right) if side == "left" else (right, left)


def _edge(side: Side, rect: Rect, y: float) -> Vec3:
    """Returns the middle of a leaf's edge on this side, at a depth."""
    x, z = rect.center
    at = {"left": (rect.x0, z), "right": (rect.x1, z), "top": (x, rect.z1)}[side]
    return vec3(at[0], y, at[1])
