"""One front at a time in the style of its piece: leaf, handle, hold, grip, shelves.

Rates: handles that say nothing about the hinge (centred on an edge) sit on about one door in ten, mostly of pairs, none
at all on one in fourteen, one on the hinge side on fewer than one in 200.
"""

from dataclasses import replace

import numpy as np

from grafu.synth.fronts.hold import Grip, HandleStyle, Hold, Inside
from grafu.synth.fronts.layout import CURVED, Blank, Door, Drawer, LeafStyle, OpenCell, Pair, Rect, Side, Tilt
from grafu.synth.sampling.chance import between, chance, pick
from grafu.synth.sampling.style import MakerStyle

# Single doors on a piece whose pairs carry handles in the middle of an edge, with theirs at the free edge all the same:
# in the middle it has half the leverage. Real pairs have it there (6 of 20 doors), real single doors not (0 of 5).
FREED = 0.65
HINGE_EDGE = 0.003  # doors whose handle sits on the hinge side: modellers' errors
SMALL_FRONT = 0.15  # metres: a framed leaf of this height would be all frame, so small fronts are mostly plain
MOST_SHELVES = 7  # in one opening: more would be racks of trays
NO_SHELVES, BARE_INSIDE = (
    0.07,
    0.26,
)  # openings left empty: modellers often stop at what is seen, of bare pieces more so
MORE_SHELVES = {0: 0.44, 1: 0.46, -1: 0.1}  # than the pitch states
INSIDES = {
    Inside(): 0.83,
    Inside(shelf="short"): 0.07,
    Inside(dividers=1): 0.03,
    Inside(rails=2): 0.03,
    Inside(basket="wire"): 0.015,
    Inside(basket="rack"): 0.01,
    Inside(runners=2): 0.015,
    Inside(cleats=True): 0.13,
    Inside(blocks=True): 0.09,
    Inside(lip=0.02): 0.05,
}
FLUSH_BAYS = 0.6  # open shelves mostly end with the case's front


def fit_door(rng: np.random.Generator, door: Door, side: Side, room: Rect, style: MakerStyle, hand: float) -> Door:
    """Returns the door hung on this side, with its leaf, handle, grip and shelves."""
    flap = side in ("top", "bottom")
    leaf = leaf_of(rng, door.leaf, style.leaf, room, flap)
    grip = style.grip if leaf == "slab" else "none"
    handle = handle_of(door.handle, style.handle, grip)
    freed = style.carry in ("top line", "middle line") and chance(rng, FREED)
    alone = replace(style, carry="reach") if freed else style
    hold = plain_hold(style, handle) if flap else _door_hold(rng, alone, handle, room, hand)
    return replace(
        door,
        hinge=side,
        leaf=leaf,
        handle=handle,
        hold=hold,
        grip=grip,
        opening=min(style.opening, 1.75) if flap else style.opening,
        shelves=draw_shelves(rng, door.shelves, room, door.behind is not None, style),
        inside=draw_inside(rng, door.inside, leaf, style),
    )


def fit_pair(rng: np.random.Generator, pair: Pair, room: Rect, style: MakerStyle, hand: float) -> Pair:
    """Returns the pair with leaves, handles, grips, muntin and shelves."""
    half = replace(room, x1=room.center[0])
    leaf = leaf_of(rng, pair.leaf, style.leaf, half, False)
    grip = style.grip if leaf == "slab" else "none"
    handle = handle_of(pair.handle, style.handle, grip)
    return replace(
        pair,
        leaf=leaf,
        handle=handle,
        hold=_door_hold(rng, style, handle, half, hand),
        grip=grip,
        opening=style.opening,
        muntin=0.0 if pair.behind else pair.muntin or style.muntin,  # what stands behind must come out
        shelves=draw_shelves(rng, pair.shelves, room, pair.behind is not None, style),
        inside=draw_inside(rng, pair.inside, leaf, style),
    )


def fit_drawer(rng: np.random.Generator, drawer: Drawer, room: Rect, style: MakerStyle) -> Drawer:
    """Returns the drawer with its box, leaf, handle and grip."""
    leaf = leaf_of(rng, drawer.leaf, style.drawer_leaf, room, True)
    if style.drawer_leaf == "bowed" and drawer.leaf == "slab" and room.height > SMALL_FRONT:
        leaf = "bowed"
    grip = style.grip if leaf == "slab" else "none"
    handle = handle_of(drawer.handle, style.drawer_handle, grip)
    return replace(
        drawer,
        box=style.box if drawer.box == "whole" else drawer.box,
        leaf=leaf,
        handle=handle,
        hold=_drawer_hold(style, handle, room),
        grip=grip,
        travel=style.travel,
        runners=style.runners,
        depth=1.0 if chance(rng, 0.7) else between(rng, (0.6, 0.95)),
    )


def fit_tilt(tilt: Tilt, style: MakerStyle) -> Tilt:
    """Returns the tilting front with its leaf and handle."""
    leaf = style.leaf if style.leaf in ("slab", "chamfered", "shaker", "louvred", "planks") else "slab"
    grip = style.grip if leaf == "slab" else "none"
    handle = handle_of(tilt.handle, style.drawer_handle, grip)
    short = replace(style, full=False, length=None if style.length is None else min(style.length, 0.2))
    return replace(tilt, leaf=leaf, handle=handle, grip=grip, hold=plain_hold(short, handle))


def fit_blank(blank: Blank, room: Rect, style: MakerStyle) -> Blank:
    """Returns the still board: a false drawer front looks like the drawers, fillers and panels stay plain."""
    if blank.name != "false_front":
        return blank
    return replace(blank, leaf="slab" if room.height < SMALL_FRONT else style.drawer_leaf)


def fit_bay(rng: np.random.Generator, bay: OpenCell, room: Rect, style: MakerStyle) -> OpenCell:
    """Returns the open bay with its shelves."""
    inside = replace(bay.inside, setback=0.0 if chance(rng, FLUSH_BAYS) else style.setback, band=style.banded)
    return replace(bay, shelves=draw_shelves(rng, bay.shelves, room, False, style), inside=inside)


def leaf_of(rng: np.random.Generator, asked: LeafStyle, usual: LeafStyle, room: Rect, level: bool) -> LeafStyle:
    """Returns the leaf: what is asked for unless that is the default; plain where it is small or bends wrongly."""
    leaf = usual if asked == "slab" else asked
    if leaf in CURVED and level:
        return "slab"
    if leaf in ("arched", "half arched", "arched rail") and (level or room.height < room.width):
        return "shaker"
    small = min(room.width, room.height) < SMALL_FRONT
    return "slab" if small and leaf != "rounded" and chance(rng, 0.75) else leaf


def handle_of(asked: HandleStyle, usual: HandleStyle, grip: Grip) -> HandleStyle:
    """Returns the handle: the one asked for unless that is the default, none beside a grip."""
    if asked != "bar-round":  # a family's own choice
        return asked
    return "none" if grip != "none" else usual


def _door_hold(rng: np.random.Generator, style: MakerStyle, handle: HandleStyle, room: Rect, hand: float) -> Hold:
    """Returns how a side-hung door is held."""
    plain = plain_hold(style, handle)
    if chance(rng, HINGE_EDGE):
        return replace(plain, place="hinge edge", along=0.5)
    reach = (hand - room.z0) / room.height
    if style.carry == "top line":
        return replace(plain, place="top edge" if reach > 0.5 else "bottom edge", inset=min(style.inset, 0.05))
    if style.carry == "middle line":
        return replace(plain, place="middle line", along=0.5)
    if style.carry == "corner":
        return replace(plain, place="free edge", along=0.98 if reach > 0.5 else 0.02)
    if style.carry == "middle":
        return replace(plain, place="free edge", along=0.5)
    return replace(plain, place="free edge", along=float(np.clip(reach, 0.14, 0.86)))


def _drawer_hold(style: MakerStyle, handle: HandleStyle, room: Rect) -> Hold:
    high = style.drawer_high and room.height > 0.12
    two = room.width > 0.65 and not style.full and (style.length is None or style.length < 0.15)
    hold = replace(plain_hold(style, handle), count=2 if two and style.inset > 0.035 else 1)
    return replace(hold, place="top edge") if high else hold


def plain_hold(style: MakerStyle, handle: HandleStyle) -> Hold:
    """Returns how large a handle of this kind is on the piece, at its usual place; a small knob protrudes less."""
    family = handle.partition("-")[0]
    if family == "knob":
        return Hold(length=style.knob, inset=style.inset)
    bar = family == "bar" and handle != "bar-profile"
    ratio, length = (0.94, 3.0) if style.full else (0.8 if style.length else 0.4, style.length)
    return Hold(length=length, ratio=ratio, inset=style.inset, protrusion=style.protrusion if bar else None)


def draw_shelves(rng: np.random.Generator, asked: int, room: Rect, filled: bool, style: MakerStyle) -> int:
    """Returns the shelves of an opening, by its height; none where something stands behind the door."""
    least = min(0.3, 2 * style.pitch)
    empty = 0.0 if style.banded else BARE_INSIDE if style.bare else NO_SHELVES
    if asked or filled or room.height < least or chance(rng, empty):
        return asked
    usual = round(room.height / style.pitch) - 1 + pick(rng, MORE_SHELVES)
    return max(1 if room.height > 0.3 else 0, min(usual, MOST_SHELVES))


def draw_inside(rng: np.random.Generator, asked: Inside, leaf: LeafStyle, style: MakerStyle) -> Inside:
    """Returns the fittings behind a front: what is asked for, or some of the usual ones."""
    plain = Inside(setback=style.setback, band=style.banded)
    asked = replace(asked, setback=plain.setback, band=plain.band)
    if asked != plain or style.bare:
        return asked
    if leaf in ("glass", "muntins") and chance(rng, 0.4):
        return replace(asked, shelf="glass")
    return replace(pick(rng, INSIDES), setback=plain.setback, band=plain.band)
