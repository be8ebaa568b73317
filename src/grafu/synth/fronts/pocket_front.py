"""Doors that slide behind a board that stays: to the side into a pocket, or up as a shutter, with true motions.

A shutter is one stiff panel, as of a tambour that does not bend. Fronts face -Y.
"""

from collections.abc import Iterator
from dataclasses import replace

from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.graph.edges import Slide
from grafu.synth.fronts.gliding import Sliding
from grafu.synth.fronts.handles import gripped_side, handle_pieces, held_along, opposite
from grafu.synth.fronts.interior import interior_pieces
from grafu.synth.fronts.layout import Cell, Rect, Side
from grafu.synth.fronts.leaf_relief import LeafShape
from grafu.synth.fronts.leaves import leaf_surfaces
from grafu.synth.fronts.setting import Setting
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, plank
from grafu.vocabulary import PartLabel

WALL = 0.006  # metres: how thick the board behind a leaf in its pocket is
GUIDE = 0.012  # metres: how wide the guides beside a shutter are
APART = 0.002  # metres between a leaf or its handle and what stops it
BEHIND = 0.01  # metres from the pocket to what is behind it
LEAST_ROOM = 0.1  # metres behind the leaf: less is no cabinet
LEAST_TRAVEL = 0.5  # of a leaf's size along its way


def pocket_pieces(cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    """Yields the leaf, the board before its pocket and the one behind it, guides, and what is behind them.

    Raises:
        ValueError: if the leaf has no room to slide, or there is none behind it.
    """
    front, o = cell.leaf, cell.opening
    assert isinstance(front, Sliding)
    outer = setting.plane + setting.gap
    y = outer + setting.thickness + setting.gap
    wall = y + setting.thickness + setting.gap
    inner = wall + WALL + BEHIND
    if setting.back - inner < LEAST_ROOM:
        raise ValueError(f"a pocket leaves no room behind it: got {setting.back - inner:.3f} m")
    rises = front.kind == "shutter"
    leaf, covered, towards = _places(front, o, setting)
    finish = setting.finish
    board = ((covered.x0, outer, covered.z0), (covered.x1, outer + setting.thickness, covered.z1))
    cover = plank(PartLabel.FACE_FRAME, "shutter_cover" if rises else "pocket_front", finish.front, board)
    back = ((covered.x0, wall, covered.z0), (covered.x1, wall + WALL, covered.z1))
    yield _sliding(front, leaf, y, towards, cover.surfaces[0].mesh.box, setting)
    yield cover
    yield plank(PartLabel.DIVIDER, "pocket_back", finish.inside, back)
    yield from _guides(front, o, (setting.plane, wall), setting)
    behind = replace(setting, plane=inner, mount="inset", thickness=0.0, frame=0.0)
    yield from interior_pieces(front.shelves, front.inside, cell, behind)


def _places(front: Sliding, o: Rect, setting: Setting) -> tuple[Rect, Rect, Side]:
    """Returns the leaf, the board that it slides behind, and the side that it slides to."""
    (x, z), gap, lap = o.center, setting.gap, front.lap
    if front.kind == "shutter":
        side = GUIDE + gap
        return Rect(o.x0 + side, o.x1 - side, o.z0 + gap, z + lap), replace(o, z0=z), "top"
    low, high = o.z0 + front.track + gap, o.z1 - front.track - gap
    if front.left_first:
        return Rect(o.x0 + gap, x + lap, low, high), replace(o, x0=x), "right"
    return Rect(x - lap, o.x1 - gap, low, high), replace(o, x1=x), "left"


def _sliding(front: Sliding, leaf: Rect, y: float, towards: Side, cover: Box, setting: Setting) -> PieceDraft:
    """Returns the leaf with its handle at the edge that stays visible, and its motion."""
    side = gripped_side(front.hold, towards)
    grip = front.grip, side, held_along(front.hold, side)
    shape = LeafShape(front.leaf, leaf, y, setting.thickness, opposite(towards), *grip)
    handle = handle_pieces(front.handle, front.hold, shape, towards, setting.finish.metal)
    axis, sense = (2, 1.0) if towards == "top" else (0, 1.0 if towards == "right" else -1.0)
    size = leaf.height if axis == 2 else leaf.width
    travel = min([size - 2 * front.lap, *(_free(piece, cover, axis, sense) for piece in handle)])
    if travel < LEAST_TRAVEL * size:
        raise ValueError(f"a door has no room in its pocket: got {travel:.3f} m of {size:.3f} m")
    direction = vec3(sense, 0.0, 0.0) if axis == 0 else vec3(0.0, 0.0, 1.0)
    slide = Axis(vec3(leaf.center[0], y, leaf.center[1]), direction)
    motion = PieceMotion(Slide.joint_type, slide, travel)
    return PieceDraft(PartLabel.DOOR, "door", leaf_surfaces(shape, setting.finish), motion, handle)


def _free(handle: PieceDraft, cover: Box, axis: int, sense: float) -> float:
    """Returns how far a handle slides before it meets the board that the leaf slides behind."""
    boxes = [surface.mesh.box for surface in handle.surfaces]
    ends = [cover.low[axis] - box.high[axis] if sense > 0 else box.low[axis] - cover.high[axis] for box in boxes]
    return float(min(ends)) - APART


def _guides(front: Sliding, o: Rect, depth: tuple[float, float], setting: Setting) -> Iterator[PieceDraft]:
    """Yields the guides beside a shutter, or the tracks below and above a door where they are drawn."""
    y0, y1 = depth
    if front.kind == "shutter":
        for x in (o.x0, o.x1 - GUIDE):
            span = ((x, y0 + 2 * setting.gap + setting.thickness, o.z0), (x + GUIDE, y1, o.z1))
            yield plank(PartLabel.BAR, "shutter_guide", setting.finish.metal, span)
    elif front.track:
        for z in (o.z0, o.z1 - front.track):
            low = y0 + 2 * setting.gap + setting.thickness
            span = ((o.x0, low, z), (o.x1, y1, z + front.track))
            yield plank(PartLabel.BAR, "door_track", setting.finish.metal, span)
