"""Fronts that come out with racks or bins behind them, and bins that slide out of an opening, with true motions."""

from collections.abc import Iterator

from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.graph.edges import Slide
from grafu.synth.fronts.gliding import PullOut, WasteBins
from grafu.synth.fronts.handles import gripped_side, handle_pieces, held_along
from grafu.synth.fronts.interior import RUNNER
from grafu.synth.fronts.layout import Cell, Rect
from grafu.synth.fronts.leaf_relief import LeafShape
from grafu.synth.fronts.leaves import leaf_surfaces
from grafu.synth.fronts.setting import Setting, front_rect
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, Span, plank
from grafu.vocabulary import PartLabel

WIRE = 0.006  # metres: how thick what a rack is made of is
RIM = 0.05  # metres: how high a tray's sides are
FOOT = 0.04  # metres between an opening's floor and a rack
BIN_WALL = 0.004  # metres
BESIDE = {"overlay": 0.014, "inset": 0.037}  # metres between a bin and a wall: an open inset door stands there
AHEAD = 0.02  # metres between a door and the bins behind it
PLAY = 0.002  # metres between a bin and what is beside or below it
LEAST = 0.06  # metres: a narrower rack or bin holds nothing


def pull_out_pieces(cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    """Yields the front with what comes out with it, and the runner below.

    Raises:
        ValueError: if there is no room for what is behind it.
    """
    front, o, rect = cell.leaf, cell.opening, front_rect(cell, setting)
    assert isinstance(front, PullOut)
    side = gripped_side(front.hold, None)
    grip = front.grip, side, held_along(front.hold, side)
    shape = LeafShape(front.leaf, rect, setting.front, setting.thickness, "top", *grip)
    handle = handle_pieces(front.handle, front.hold, shape, None, setting.finish.metal)
    depth = setting.back - 0.02 - setting.behind
    inner = Rect(o.x0 + setting.slide_gap, o.x1 - setting.slide_gap, o.z0 + FOOT, o.z1 - FOOT)
    if inner.width < LEAST:
        raise ValueError(f"a pull-out leaves its rack no room: got {inner.width:.3f} m")
    ends = setting.behind, setting.behind + 0.95 * depth
    load = _rack(front, inner, ends, setting) if front.load == "trays" else _bins_behind(front, inner, ends, setting)
    x, z = rect.center
    out = PieceMotion(Slide.joint_type, Axis(vec3(x, setting.front, z), vec3(0.0, -1.0, 0.0)), front.travel * depth)
    surfaces = leaf_surfaces(shape, setting.finish)
    yield PieceDraft(PartLabel.DOOR, "door", surfaces, out, (*handle, *load))
    if front.runner:
        half, low = min(0.03, inner.width / 4), setting.inner + 0.01
        span = ((x - half, low, o.z0), (x + half, setting.back - 0.01, o.z0 + 0.5 * FOOT))
        yield plank(PartLabel.MISC, "pull_out_runner", setting.finish.metal, span)


def _rack(front: PullOut, r: Rect, ends: tuple[float, float], setting: Setting) -> Iterator[PieceDraft]:
    """Yields two uprights, behind the front and at the far end, and the trays between them."""
    (near, far), steel = ends, setting.finish.metal
    for at in (near, far - 2 * WIRE):
        yield plank(PartLabel.MISC, "upright", steel, ((r.x0, at, r.z0), (r.x1, at + 2 * WIRE, r.z1)))
    low, high = near + 2 * WIRE, far - 2 * WIRE
    rim = min(RIM, 0.3 * r.height / front.number)
    for k in range(front.number):
        z = r.z0 + k * r.height / front.number
        spans: list[Span] = [((r.x0, low, z), (r.x1, high, z + WIRE))]
        spans += [((x, low, z + WIRE), (x + WIRE, high, z + rim)) for x in (r.x0, r.x1 - WIRE)]
        yield plank(PartLabel.MISC, "tray", steel, *spans)


def _bins_behind(front: PullOut, r: Rect, ends: tuple[float, float], setting: Setting) -> Iterator[PieceDraft]:
    """Yields a frame behind the front, and bins in it behind one another."""
    (near, far), steel = ends, setting.finish.metal
    level, beam = r.z0 + 0.6 * r.height, 2 * WIRE
    bars: list[Span] = [((x, near, level), (x + beam, far, level + beam)) for x in (r.x0, r.x1 - beam)]
    bars += [((r.x0 + beam, y, level), (r.x1 - beam, y + beam, level + beam)) for y in (near, far - beam)]
    yield plank(PartLabel.MISC, "bin_frame", steel, *bars)
    pitch = (far - near - 2 * beam) / front.number
    for k in range(front.number):
        y = near + beam + k * pitch
        low = (r.x0 + beam + PLAY, y + PLAY, r.z0)
        yield plank(PartLabel.MISC, "bin", steel, *_bin(low, (r.x1 - beam - PLAY, y + pitch - PLAY, level + beam)))


def _bin(low: tuple[float, float, float], high: tuple[float, float, float]) -> list[Span]:
    """Returns the boards of a bin that is open above."""
    (x0, y0, z0), (x1, y1, z1), w = low, high, BIN_WALL
    return [
        ((x0, y0, z0), (x1, y1, z0 + w)),
        ((x0, y0, z0 + w), (x0 + w, y1, z1)),
        ((x1 - w, y0, z0 + w), (x1, y1, z1)),
        ((x0 + w, y0, z0 + w), (x1 - w, y0 + w, z1)),
        ((x0 + w, y1 - w, z0 + w), (x1 - w, y1, z1)),
    ]


def bin_pieces(cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    """Yields bins beside each other that slide out, and runners on both walls.

    Raises:
        ValueError: if they have no room.
    """
    bins, o, beside = cell.leaf, cell.opening, BESIDE[setting.mount]
    assert isinstance(bins, WasteBins)
    near = setting.inner + AHEAD
    far, low = near + bins.deep * (setting.back - near), o.z0 + PLAY
    x0, x1 = o.x0 + beside, o.x1 - beside
    pitch, high = (x1 - x0) / bins.number, low + bins.tall * (o.z1 - low)
    if pitch < LEAST or far - near < LEAST:
        raise ValueError(f"bins find no room: got {pitch:.3f} x {far - near:.3f} m")
    for k in range(bins.number):
        at = x0 + k * pitch
        boards = _bin((at + PLAY, near, low), (at + pitch - PLAY, far, high))
        axis = Axis(vec3(at + pitch / 2, near, low), vec3(0.0, -1.0, 0.0))
        motion = PieceMotion(Slide.joint_type, axis, bins.travel * (far - near))
        piece = plank(PartLabel.MISC, "bin", setting.finish.metal, *boards)
        yield PieceDraft(piece.label, piece.stem, piece.surfaces, motion)
    if bins.runners:
        z, half = (low + high) / 2, min(RUNNER[1], 0.3 * o.height) / 2
        for low_x, high_x in ((o.x0, x0), (x1, o.x1)):
            span = ((low_x, near, z - half), (high_x, setting.back, z + half))
            yield plank(PartLabel.MISC, "bin_runner", setting.finish.metal, span)
