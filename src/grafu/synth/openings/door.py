"""Doors of buildings: one or two leaves in a frame that is open below, with levers and, if so drawn, a latch's bolt."""

from dataclasses import replace
from typing import Literal, final

import numpy as np

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.synth.fronts.layout import LeafStyle, Rect
from grafu.synth.fronts.leaf_relief import LeafShape
from grafu.synth.fronts.leaves import leaf_surfaces
from grafu.synth.openings.parts import Edge, lever, ring, sliding, turning
from grafu.synth.pieces.assembly import PieceDraft, Span, assemble, plank
from grafu.synth.pieces.finish import PLAIN, Finish
from grafu.synth.sampling.chance import between, chance
from grafu.vocabulary import PartLabel

Grip = Literal["lever", "none"]


@final
@dataclass(frozen=True, slots=True)
class DoorSpec:
    """A door of a building, metres: its frame, and how its leaves are drawn in it; of two the left one has the bolt.

    `lap` is how far the leaf's edges are drawn into the frame at both sides and above (below 0: a gap). `set_back` is
    how far its front lies behind the frame's front; it opens to the face of the frame that it is nearer to.

    Raises:
        ValueError: if there are neither one nor two leaves, or a leaf would stand out of its frame.
    """

    name: str = "building_door"
    width: float = 0.95
    height: float = 2.1
    depth: float = 0.12
    jamb: float = 0.05
    leaf: float = 0.04
    leaves: int = 1
    hinge: Literal["left", "right"] = "left"
    set_back: float = 0.0
    lap: float = -0.003
    grip: Grip = "lever"
    bolt: bool = False
    style: LeafStyle = "slab"
    finish: Finish = PLAIN

    def __post_init__(self) -> None:
        if self.leaves not in (1, 2):
            raise ValueError(f"`DoorSpec.leaves` must be 1 or 2: got {self.leaves}")
        if not 0 <= self.set_back <= self.depth - self.leaf:
            raise ValueError(f"`DoorSpec.set_back` must keep the leaf in the frame: got {self.set_back}")


def drawn_door(rng: np.random.Generator, name: str) -> DoorSpec:
    """Returns a door of random size; one in five is drawn with its edges in the frame.

    A single leaf without a lever hangs on the left: nothing shows its side.
    """
    depth, leaf = between(rng, (0.08, 0.16)), between(rng, (0.03, 0.05))
    leaves = 2 if chance(rng, 0.3) else 1
    grip: Grip = "lever" if chance(rng, 0.8) else "none"
    return DoorSpec(
        name,
        width=between(rng, (0.75, 1.05)) * (1.7 if leaves == 2 else 1.0),
        height=between(rng, (1.95, 2.4)),
        depth=depth,
        jamb=between(rng, (0.03, 0.08)),
        leaf=leaf,
        leaves=leaves,
        hinge="left" if grip == "none" or chance(rng, 0.5) else "right",
        set_back=0.0 if chance(rng, 0.5) else depth - leaf,
        lap=between(rng, (0.008, 0.016)) if chance(rng, 0.2) else -between(rng, (0.002, 0.005)),
        grip=grip,
        bolt=grip == "lever" and chance(rng, 0.3),
    )


def make_building_door(spec: DoorSpec) -> Asset:
    """Returns the door with the true joints of its leaves; those of levers and bolts are small joints."""
    half, front = spec.width / 2, -spec.depth / 2
    outer = ((-half, front, 0.0), (half, -front, spec.height))
    frame = ring(PartLabel.FACE_FRAME, "door_frame", spec.finish.case, outer, spec.jamb, sill=False)
    inner = half - spec.jamb + spec.lap
    top = spec.height - spec.jamb + spec.lap
    y = front + spec.set_back
    spans: list[tuple[Span, Edge]] = [(((-inner, y, 0.004), (inner, y + spec.leaf, top)), spec.hinge)]
    if spec.leaves == 2:
        gap = 0.0015
        spans = [
            (((-inner, y, 0.004), (-gap, y + spec.leaf, top)), "left"),
            (((gap, y, 0.004), (inner, y + spec.leaf, top)), "right"),
        ]
    return assemble(spec.name, [frame, *(_leaf(span, edge, spec) for span, edge in spans)])


def _leaf(span: Span, edge: Edge, spec: DoorSpec) -> PieceDraft:
    (x0, y0, _), (x1, y1, _) = span
    backwards = spec.set_back > (spec.depth - spec.leaf) / 2
    (_, _, z0), (_, _, z1) = span
    shape = LeafShape(spec.style, Rect(x0, x1, z0, z1), y0, y1 - y0)
    board = PieceDraft(PartLabel.DOOR, "leaf", leaf_surfaces(shape, spec.finish))
    free, towards = (x1 - max(spec.lap, 0.0), -1.0) if edge == "left" else (x0 + max(spec.lap, 0.0), 1.0)
    on_it: list[PieceDraft] = []
    if spec.grip == "lever":
        on_it.append(lever(spec.finish.metal, free + 0.06 * towards, 1.02, towards, ((y0, -1.0), (y1, 1.0)), 0.13))
    if spec.bolt and spec.lap < 0 and (spec.leaves == 1 or edge == "left"):
        middle, out = (y0 + y1) / 2, -0.7 * spec.lap
        low, high = sorted((free - out * towards, free + 0.03 * towards))
        bolt = ((low, middle - 0.006, 1.01), (high, middle + 0.006, 1.03))
        drawn_in = sliding(bolt, vec3(towards, 0.0, 0.0), out, small=True)
        on_it.append(replace(plank(PartLabel.MISC, "latch_bolt", spec.finish.metal, bolt), motion=drawn_in))
    return replace(board, motion=turning(span, edge, backwards), attached=tuple(on_it))
