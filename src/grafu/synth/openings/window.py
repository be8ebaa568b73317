"""Windows: side-hung, top-hung and bottom-hung leaves, two-leaf windows and sashes, in a frame closed all around."""

from dataclasses import replace
from typing import Literal, final

import numpy as np

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.synth.openings.parts import Edge, ring, sliding, turning
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, Span, assemble, plank
from grafu.synth.pieces.finish import PLAIN, Finish
from grafu.synth.sampling.chance import between, chance
from grafu.vocabulary import PartLabel

Kind = Literal["casement", "awning", "hopper", "pair", "sash"]
KINDS: tuple[Kind, ...] = ("casement", "awning", "hopper", "pair", "sash")


@final
@dataclass(frozen=True, slots=True)
class WindowSpec:
    """A window, metres. It opens to its back if it lies there in its frame (`at_back`), with its handle on that side.

    `sill` is how far a board below stands out in front; 0 leaves it out.

    Raises:
        ValueError: if its bars and those of its leaves leave no opening.
    """

    name: str = "window"
    kind: Kind = "casement"
    width: float = 0.7
    height: float = 1.1
    depth: float = 0.08
    bar: float = 0.05
    stile: float = 0.06
    leaf: float = 0.045
    gap: float = 0.003
    hinge: Literal["left", "right"] = "left"
    at_back: bool = False
    handle: bool = True
    sill: float = 0.0
    finish: Finish = PLAIN

    def __post_init__(self) -> None:
        if min(self.width, self.height) <= 2 * (self.bar + 2 * self.stile):
            raise ValueError("`WindowSpec.bar` and `stile` must leave an opening")


def drawn_window(rng: np.random.Generator, name: str, kind: Kind) -> WindowSpec:
    """Returns a window of one kind and of random size; a single leaf has a handle, which tells where it is hinged."""
    leaf = between(rng, (0.035, 0.055))
    wide, high = {"casement": ((0.45, 0.8), (0.7, 1.5)), "pair": ((0.9, 1.6), (0.8, 1.5))}.get(
        kind, ((0.7, 1.3), (0.5, 0.9)) if kind != "sash" else ((0.5, 1.0), (1.0, 1.8))
    )
    return WindowSpec(
        name,
        kind,
        width=between(rng, wide),
        height=between(rng, high),
        depth=between(rng, (0.06, 0.1)) + (leaf if kind == "sash" else 0.0) + leaf,
        bar=between(rng, (0.035, 0.065)),
        stile=between(rng, (0.04, 0.07)),
        leaf=leaf,
        gap=between(rng, (0.002, 0.005)),
        hinge="left" if chance(rng, 0.5) else "right",
        at_back=chance(rng, 0.5),
        handle=kind != "pair" or chance(rng, 0.7),
        sill=between(rng, (0.03, 0.08)) if chance(rng, 0.3) else 0.0,
    )


def make_window(spec: WindowSpec) -> Asset:
    """Returns the window with its leaves' true joints; panes and handles are pieces on the leaves."""
    half, front = spec.width / 2, -spec.depth / 2
    outer = ((-half, front, 0.0), (half, -front, spec.height))
    pieces = [ring(PartLabel.FACE_FRAME, "window_frame", spec.finish.case, outer, spec.bar)]
    if spec.sill:
        low, high = (-half - 0.03, front - spec.sill, -0.03), (half + 0.03, -front, 0.0)
        pieces.append(plank(PartLabel.MISC, "sill", spec.finish.case, (low, high)))
    x, z = half - spec.bar - spec.gap, (spec.bar + spec.gap, spec.height - spec.bar - spec.gap)
    if spec.kind == "sash":
        return assemble(spec.name, [*pieces, *_sashes(spec, x, z)])
    y = -front - spec.leaf - 0.002 if spec.at_back else front + 0.002
    whole = ((-x, y, z[0]), (x, y + spec.leaf, z[1]))
    edges: dict[Kind, Edge] = {"casement": spec.hinge, "awning": "top", "hopper": "bottom"}
    if spec.kind != "pair":
        return assemble(spec.name, [*pieces, _hung(whole, edges[spec.kind], spec)])
    middle = spec.gap / 2
    left, right = ((-x, y, z[0]), (-middle, y + spec.leaf, z[1])), ((middle, y, z[0]), (x, y + spec.leaf, z[1]))
    return assemble(spec.name, [*pieces, _hung(left, "left", spec), _hung(right, "right", spec)])


def make_window_with_labels(spec: WindowSpec) -> Asset:
    """Returns the window with a still sash labelled as part of the frame, which it is where labels are true."""
    made = make_window(spec)
    moving = {joint.part for joint in made.joints}
    still = {p.id for p in made.parts if p.label is PartLabel.DOOR and p.id not in moving}
    labelled = made.with_labels(dict.fromkeys(still, PartLabel.FACE_FRAME))
    parts = (replace(p, carried_by=None) if p.carried_by in still else p for p in labelled.parts)
    return replace(labelled, parts=tuple(parts))


def _sashes(spec: WindowSpec, x: float, z: tuple[float, float]) -> list[PieceDraft]:
    """Returns the lower sash, which slides up before the other, and the upper one, which stays."""
    meeting = (z[0] + z[1]) / 2
    lap = spec.stile / 2
    front = -spec.leaf - 0.002
    lower = ((-x, front, z[0]), (x, front + spec.leaf, meeting + lap))
    upper = ((-x, 0.002, meeting - lap), (x, 0.002 + spec.leaf, z[1]))
    up = sliding(lower, vec3(0.0, 0.0, 1.0), z[1] - meeting - lap)
    return [_leaf(lower, spec, up), _leaf(upper, spec, None)]


def _hung(span: Span, edge: Edge, spec: WindowSpec) -> PieceDraft:
    leaf = _leaf(span, spec, turning(span, edge, spec.at_back))
    if not spec.handle:
        return leaf
    return replace(leaf, attached=(*leaf.attached, _handle(span, edge, spec)))


def _leaf(span: Span, spec: WindowSpec, motion: PieceMotion | None) -> PieceDraft:
    (x0, y0, z0), (x1, y1, z1) = span
    frame = ring(PartLabel.DOOR, "leaf", spec.finish.front, span, spec.stile)
    middle, lap = (y0 + y1) / 2, spec.stile - 0.008
    pane = ((x0 + lap, middle - 0.003, z0 + lap), (x1 - lap, middle + 0.003, z1 - lap))
    return replace(frame, motion=motion, attached=(plank(PartLabel.MISC, "pane", spec.finish.glass, pane),))


def _handle(span: Span, edge: Edge, spec: WindowSpec) -> PieceDraft:
    """Returns a handle on the stile across from the hinges, on the side to which the leaf opens."""
    (x0, y0, z0), (x1, y1, z1) = span
    away, half = spec.stile / 2, (0.055, 0.012)
    x = {"left": x1 - away, "right": x0 + away}.get(edge, (x0 + x1) / 2)
    z = {"top": z0 + away, "bottom": z1 - away}.get(edge, (z0 + z1) / 2)
    wide, high = half if edge in ("top", "bottom") else half[::-1]
    face, out = (y1, 1.0) if spec.at_back else (y0, -1.0)
    near, far = sorted((face, face + 0.03 * out))
    stem = ((x - 0.008, near, z - 0.008), (x + 0.008, far, z + 0.008))
    near, far = sorted((face + 0.025 * out, face + 0.04 * out))
    return plank(
        PartLabel.HANDLE, "handle", spec.finish.metal, stem, ((x - wide, near, z - high), (x + wide, far, z + high))
    )
