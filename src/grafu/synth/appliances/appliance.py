"""Dishwashers, ovens and microwave ovens, with what moves in them and on them, and its true motion."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import pi
from typing import Literal, final

import numpy as np

from grafu.asset.part import Asset
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.graph.edges import Slide
from grafu.synth.appliances.body import dial, disc, door, hollow, rack
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, Span, assemble, plank
from grafu.synth.pieces.finish import PLAIN, Finish
from grafu.synth.sampling.chance import between
from grafu.vocabulary import JointType, PartLabel

ApplianceKind = Literal["dishwasher", "oven", "microwave"]
_PANEL = {"dishwasher": 0.0, "oven": 0.12, "microwave": 0.25}  # of the height, beside the door of the width
_PRESS = 0.003  # metres: how far a button goes


@final
@dataclass(frozen=True, slots=True)
class Appliance:
    """An appliance, metres: `racks` slide in it, of a dishwasher baskets; `knobs` and `buttons` are on its panel.

    With a `window` its door is a frame around a pane. A microwave oven has its panel at the right of its door, an oven
    above; a dishwasher has none.

    Raises:
        ValueError: if there is a negative number of something, or a panel's things without a panel.
    """

    name: str = "dishwasher"
    kind: ApplianceKind = "dishwasher"
    width: float = 0.6
    height: float = 0.82
    depth: float = 0.6
    wall: float = 0.03
    racks: int = 2
    knobs: int = 0
    buttons: int = 0
    finish: Finish = PLAIN
    window: bool = False

    def __post_init__(self) -> None:
        if min(self.racks, self.knobs, self.buttons) < 0 or (self.kind == "dishwasher" and self.knobs + self.buttons):
            got = f"{self.racks} racks, {self.knobs} knobs, {self.buttons} buttons"
            raise ValueError(f"`Appliance` needs numbers of at least 0, and knobs a panel: got {got}")


def drawn_appliance(rng: np.random.Generator, name: str, kind: ApplianceKind) -> Appliance:
    """Returns an appliance of random size."""
    if kind == "microwave":
        size = between(rng, (0.4, 0.6)), between(rng, (0.25, 0.35)), between(rng, (0.3, 0.45))
        return Appliance(
            name, kind, *size, between(rng, (0.02, 0.03)), 0, int(rng.integers(1, 3)), int(rng.integers(0, 3))
        )
    low = (0.8, 0.9) if kind == "dishwasher" else (0.55, 0.7)
    size = between(rng, (0.5, 0.65)), between(rng, low), between(rng, (0.5, 0.62))
    knobs = 0 if kind == "dishwasher" else int(rng.integers(1, 6))
    return Appliance(name, kind, *size, between(rng, (0.025, 0.04)), int(rng.integers(1, 3)), knobs)


def make_appliance(spec: Appliance) -> Asset:
    """Returns the appliance with its true joints; those of knobs, buttons and trays are its small joints."""
    body, leaf = _outer(spec)
    edge: Literal["bottom", "left"] = "left" if spec.kind == "microwave" else "bottom"
    white, metal = spec.finish.case, spec.finish.metal
    window = spec.finish.glass if spec.window else None
    pieces = [
        hollow(white, body, spec.wall),
        door(spec.finish.front, metal, leaf, edge, window),
        *_within(spec, body, leaf),
    ]
    panel = _panel(spec, body, leaf)
    if panel is not None:
        pieces += [plank(PartLabel.MISC, "panel", white, panel), *_on_panel(spec, panel)]
    return assemble(spec.name, pieces)


def _outer(spec: Appliance) -> tuple[Span, Span]:
    """Returns the boxes of the body and of the door before it."""
    x, y, gap, beside = spec.width / 2, spec.depth / 2, 0.003, _PANEL[spec.kind]
    foot = 0.0 if spec.kind == "microwave" else 0.06
    body = ((-x, -y, foot), (x, y, spec.height))
    right = x - beside * spec.width if spec.kind == "microwave" else x
    top = spec.height - beside * spec.height if spec.kind == "oven" else spec.height
    front = -y - 0.002
    return body, ((-x + gap, front - 0.03, foot + gap), (right - gap, front, top - gap))


def _panel(spec: Appliance, body: Span, leaf: Span) -> Span | None:
    if spec.kind == "dishwasher":
        return None
    (_, y0, _), (x1, _, z1) = leaf
    gap = 0.003
    if spec.kind == "oven":
        return (body[0][0], y0, z1 + gap), (body[1][0], body[0][1], body[1][2])
    return (x1 + gap, y0, body[0][2]), (body[1][0], body[0][1], body[1][2])


def _within(spec: Appliance, body: Span, leaf: Span) -> Iterator[PieceDraft]:
    """Yields the racks, or the tray of a microwave oven."""
    wall, steel = spec.wall, spec.finish.metal
    (x0, y0, z0), (x1, y1, _) = body
    x0, x1, y0, y1, z0, z1 = x0 + wall, x1 - wall, y0 + 0.02, y1 - wall, z0 + wall, leaf[1][2] - wall
    if spec.kind == "microwave":
        x1 = leaf[1][0] - wall
        center, radius = ((x0 + x1) / 2, (y0 + y1) / 2, z0), 0.42 * min(x1 - x0, y1 - y0)
        up = Axis(vec3(*center), vec3(0.0, 0.0, 1.0))
        yield replace(disc(spec.finish.glass, "turntable", center, radius, 0.008), motion=turn_of(up))
    for k in range(spec.racks):
        low, is_basket = z0 + (k + 0.3) * (z1 - z0) / spec.racks, spec.kind == "dishwasher"
        high = low + (0.1 if is_basket else 0.006)
        span = ((x0 + 0.002, y0, low), (x1 - 0.002, y1 - 0.01, high))
        out = Axis(vec3(0.0, y0, low), vec3(0.0, -1.0, 0.0))
        grid = rack(steel, span, 0.06, is_basket)
        yield replace(grid, motion=PieceMotion(Slide.joint_type, out, 0.7 * (span[1][1] - span[0][1])))


def _on_panel(spec: Appliance, panel: Span) -> Iterator[PieceDraft]:
    """Yields knobs and buttons: side by side on an oven's panel, above each other on a microwave oven's."""
    (x0, y0, z0), (x1, _, z1) = panel
    metal, count = spec.finish.metal, spec.knobs + spec.buttons
    wide = spec.kind == "oven"
    radius = 0.28 * min((x1 - x0) / (count if wide else 1), (z1 - z0) / (1 if wide else count), 0.09)
    for k in range(count):
        ratio = (k + 0.5) / count
        x, z = (x0 + ratio * (x1 - x0), (z0 + z1) / 2) if wide else ((x0 + x1) / 2, z0 + ratio * (z1 - z0))
        inwards = Axis(vec3(x, y0, z), vec3(0.0, 1.0, 0.0))
        if k < spec.knobs:
            yield replace(dial(metal, x, y0, z, radius, 0.02), motion=turn_of(Axis(inwards.point, -inwards.direction)))
        else:
            pressed = PieceMotion(Slide.joint_type, inwards, _PRESS, small=True)
            square = ((x - radius, y0 - 0.01, z - radius), (x + radius, y0, z + radius))
            yield replace(plank(PartLabel.MISC, "button", metal, square), motion=pressed)


def turn_of(axis: Axis) -> PieceMotion:
    """Returns the motion of a knob or a turntable: about an axis, without end."""
    return PieceMotion(JointType.CONTINUOUS, axis, 2 * pi, small=True)
