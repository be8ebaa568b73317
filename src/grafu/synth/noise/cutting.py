"""Which parts a modeller joins to one and which are in several pieces: the drawing of cuts, with their rates."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.synth.noise.modelling_noise import Joined, PartCut
from grafu.synth.noise.segmentation import is_board
from grafu.synth.pieces.riding import busy_in
from grafu.synth.sampling.chance import between, chance, count, pick
from grafu.vocabulary import PartLabel

Masking = tuple[float, float, float, float]  # none, a few, many, all labels lost
_CASE = (PartLabel.SIDE_PANEL, PartLabel.BACK_PANEL, PartLabel.BOTTOM_PANEL, PartLabel.TOP_PANEL, PartLabel.DIVIDER)
# What is joined, by weight. 32052 has each pedestal's whole case as one back panel, and 22692 and 49182 have panels
# with their mouldings in one.
GROUPS: Final[dict[str, tuple[float, tuple[PartLabel, ...]]]] = {
    "case": (0.22, (*_CASE, PartLabel.SHELF)),
    "case without shelves": (0.13, _CASE),
    "sides": (0.15, (PartLabel.SIDE_PANEL,)),
    "sides and back": (0.1, (PartLabel.SIDE_PANEL, PartLabel.BACK_PANEL)),
    "shelves": (0.12, (PartLabel.SHELF,)),
    "legs": (0.1, (PartLabel.LEG,)),
    "bars": (0.08, (PartLabel.BAR,)),
    "front frame": (0.1, (PartLabel.FACE_FRAME, PartLabel.BAR)),
}
# What is joined of several kinds is called after its largest wall; now and then it is an odd part, or has no label.
ODD, NAMELESS = 0.15, 0.12
LEVEL: Final = (PartLabel.TOP_PANEL, PartLabel.BOTTOM_PANEL, PartLabel.SHELF)  # no case is named after these

# A whole case in one part, legs, frame, top and all, before which only the fronts are apart: in the development models
# the greatest difference from synthetic furniture was that bulky parts, which hold others within their box, were rare.
BODY = 0.12  # of models with fronts
BODY_NAMELESS = 0.6  # of those: the name of the whole piece is no label of the part
BODY_HANDLES = 0.4  # of those: handles are within their fronts, as where the parts were cut out of one mesh
LEAST_OF_BODY = 3  # still parts: fewer are in one part already, or nearly
FRONTS_ALONE = 0.6  # of those: drawers are a front and nothing behind it
BODY_MASKING: Final[Masking] = (0.2, 0.1, 0.1, 0.6)  # of those: what is cut out of a mesh has no name

# A face frame as bars: 6 of 7 frames in the development models. Otherwise a cut is seldom.
HANDLES_IN_PIECES = 0.2  # of models: posts and plates of handles, where these have some, are parts as in CAD files
FRAME_IN_BARS = 0.6
STRIP = 0.15  # of cut models: solid-edge strips along panels
# How much likelier the walls of a case are in planks than its levels: 32052 has its back in three.
WALLS: Final = {PartLabel.SIDE_PANEL: 5.0, PartLabel.BACK_PANEL: 9.0}
ALIKE, SAME = 0.8, 0.001  # of boards in planks, their twins too; metres within which two boards are of one size
BOX_APART = 0.12  # of cut models: fronts moved by the artist, their boxes left as boards


def draw_joined(
    rng: np.random.Generator, asset: Asset, parts: Sequence[Part], ratio: float, handles: float, tops: float = 1.0
) -> tuple[Joined, ...]:
    """Returns which of the parts are joined: with chance `ratio` a group, with chance `handles` handles with fronts.

    Where a case is joined, its top is one of what is joined with chance `tops`.
    """
    found = []
    busy = busy_in(asset)
    still = [p for p in parts if p.id not in busy and p.carried_by is None]
    if not chance(rng, tops):
        still = [p for p in still if p.label is not PartLabel.TOP_PANEL]
    if chance(rng, ratio):
        able = {
            name: weight
            for name, (weight, labels) in GROUPS.items()
            if sum(p.label in labels for p in still) > 1
            and len({p.label for p in still} & set(labels)) > (len(labels) > 1)
        }
        if able:
            _, labels = GROUPS[pick(rng, able)]
            found.append(_joined(rng, [p for p in still if p.label in labels]))
    attached = tuple(p.id for p in parts if p.label is PartLabel.HANDLE and p.carried_by)
    if attached and chance(rng, handles):
        found.append(Joined(attached, None))
    return tuple(found)


def draw_body(rng: np.random.Generator, asset: Asset, parts: Sequence[Part]) -> tuple[Joined, ...]:
    """Returns all still parts as one, for `BODY` of the models that open, and the handles of some in their fronts."""
    busy = busy_in(asset)
    still = [p for p in parts if p.id not in busy and p.carried_by is None]
    if len(still) < LEAST_OF_BODY or not asset.joints or not chance(rng, BODY):
        return ()
    named = _joined(rng, still)
    body = replace(named, named=named.named and not chance(rng, BODY_NAMELESS))
    attached = tuple(p.id for p in parts if p.label is PartLabel.HANDLE and p.carried_by)
    return (body, Joined(attached, None)) if attached and chance(rng, BODY_HANDLES) else (body,)


def draw_bare_drawers(rng: np.random.Generator, asset: Asset, is_body: bool) -> tuple[PartCut, ...]:
    """Returns the drawers that are a front alone, before a case in one part: all of them or none."""
    if not is_body or not chance(rng, FRONTS_ALONE):
        return ()
    carrying = {p.carried_by for p in asset.parts if p.label is not PartLabel.HANDLE}
    drawers = (j.part for j in asset.joints if asset.part(j.part).label is PartLabel.DRAWER)
    return tuple(PartCut(part, "front alone") for part in drawers if part not in carrying)


def _joined(rng: np.random.Generator, parts: Sequence[Part]) -> Joined:
    walls = [p for p in parts if p.label not in LEVEL] or parts
    largest = max(walls, key=lambda p: float(p.box.volume)).label
    alike = all(p.label is largest for p in parts)
    odd, nameless = chance(rng, ODD), chance(rng, NAMELESS)
    label = PartLabel.MISC if odd and not alike else largest
    return Joined(tuple(p.id for p in parts), label, named=alike or not nameless)


def draw_cuts(rng: np.random.Generator, asset: Asset, parts: Sequence[Part], ratio: float) -> tuple[PartCut, ...]:
    """Returns which of the parts are in several pieces: frames often, panels with chance `ratio`."""
    found = []
    label = PartLabel.BAR if chance(rng, 0.7) else PartLabel.FACE_FRAME
    if chance(rng, FRAME_IN_BARS):
        frames = (p for p in parts if p.label is PartLabel.FACE_FRAME and len(p.surfaces) > 1)
        found += [PartCut(p.id, "pieces", label) for p in frames]
    if not chance(rng, ratio):
        return tuple(found)
    boards = [p for p in parts if p.label in (*_CASE, PartLabel.SHELF) and is_board(p) and p.box.size.min() > 0.002]
    if boards and chance(rng, STRIP):
        width = between(rng, (0.01, 0.04))
        return (*found, *(PartCut(p.id, "edge strip", width=width) for p in boards if p.box.thin_axis != 1))
    if chance(rng, BOX_APART):
        return (*found, *(PartCut(j.part, "box apart") for j in asset.joints))
    weights = np.array([WALLS.get(board.label, 1.0) for board in boards])
    number = min(count(rng, 1, 2), len(boards))
    for k in rng.choice(len(boards), number, replace=False, p=weights / weights.sum()) if number else ():
        found.append(_planks(rng, boards[k]))
    return (*found, *_twins(rng, boards, found))


def _twins(rng: np.random.Generator, boards: Sequence[Part], cuts: Sequence[PartCut]) -> Iterator[PartCut]:
    """Yields the cuts of boards whose twins, of the same label and size, are cut: one side as the other."""
    whole = {board.id: board for board in boards}
    done = {cut.part for cut in cuts}
    for cut in cuts:
        if cut.part not in whole or not chance(rng, ALIKE):
            continue
        board = whole[cut.part]
        twins = [b for b in boards if b.label is board.label and np.allclose(b.box.size, board.box.size, atol=SAME)]
        yield from (replace(cut, part=twin.id) for twin in twins if twin.id not in done)
        done |= {twin.id for twin in twins}


def _planks(rng: np.random.Generator, board: Part) -> PartCut:
    """Returns a board in two to five, square to its longer or (seldom) shorter side."""
    order = np.argsort(board.box.size)
    axis = int(order[1] if chance(rng, 0.6) else order[2])
    return PartCut(board.id, "planks", count=count(rng, 2, 5), axis=axis)
