"""Dishwashers, ovens and microwave ovens, with what moves in them and on them, and its true motion."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import pi
from typing import Literal, final

import numpy as np

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.graph.edges import Slide
from grafu.synth.appliances.body import Edge, Pull, dial, disc, door, hollow, pulled_drawer, rack
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, Span, assemble, plank
from grafu.synth.pieces.finish import PLAIN, Finish
from grafu.synth.sampling.chance import between, chance, count, pick
from grafu.vocabulary import JointType, PartLabel

ApplianceKind = Literal["dishwasher", "oven", "microwave"]
PANEL_ABOVE, PANEL_BESIDE = 0.12, 0.25  # of the height, of the width
_PRESS = 0.003  # metres: how far a button goes
_KEY = 0.6  # of its cell in a keypad, each way: a key
_GAP = 0.003  # metres
_BURNER = 0.17  # of the width of a hob: the radius of a burner
# How microwave ovens open: most doors turn about their left edge, with the panel at the right. Built-in ones drop down,
# with the panel above. A fraction has no handle but a button that opens it.
MICROWAVE_EDGES: Mapping[Edge, float] = {"left": 0.86, "right": 0.06, "bottom": 0.08}
OVEN_EDGES: Mapping[Edge, float] = {"bottom": 0.94, "left": 0.04, "right": 0.02}
MICROWAVE_PULLS: Mapping[Pull, float] = {"bar": 0.45, "long": 0.15, "none": 0.4}
OVEN_PULLS: Mapping[Pull, float] = {"bar": 0.4, "long": 0.6}
KEYPADS = 0.5  # of microwave ovens
STORAGE = 0.3  # of ovens: a drawer below the door
HOBS = 0.4  # of ovens with a drawer below


@final
@dataclass(frozen=True, slots=True)
class Appliance:
    """An appliance, metres: `racks` slide in it, of a dishwasher baskets; `knobs` and `buttons` are on its panel.

    With a `window` its door is a frame around a pane. The door turns about `edge`. A microwave oven whose door turns
    about a side has its panel beside the door, at the other side; others have it above, a dishwasher none. `keys` are
    the keys of a keypad, one part. An oven may have a drawer of height `drawer` below its door, and burners on top.

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
    edge: Edge = "bottom"
    pull: Pull = "bar"
    keys: int = 0
    drawer: float = 0.0
    burners: int = 0

    def __post_init__(self) -> None:
        on_panel = self.knobs + self.buttons + self.keys
        if min(self.racks, self.knobs, self.buttons, self.keys, self.burners, self.drawer) < 0 or (
            self.kind == "dishwasher" and on_panel
        ):
            got = f"{self.racks} racks, {self.knobs} knobs, {self.buttons} buttons"
            raise ValueError(f"`Appliance` needs numbers of at least 0, and knobs a panel: got {got}")

    @property
    def has_panel_beside(self) -> bool:
        """Whether the panel is beside the door: the other things on it are above one another then."""
        return self.kind == "microwave" and self.edge != "bottom"


def drawn_appliance(rng: np.random.Generator, name: str, kind: ApplianceKind) -> Appliance:
    """Returns an appliance of random size."""
    if kind == "microwave":
        return _drawn_microwave(rng, name)
    low = (0.8, 0.9) if kind == "dishwasher" else (0.55, 0.7)
    size = between(rng, (0.5, 0.65)), between(rng, low), between(rng, (0.5, 0.62))
    knobs = 0 if kind == "dishwasher" else int(rng.integers(1, 6))
    drawn = Appliance(name, kind, *size, between(rng, (0.025, 0.04)), int(rng.integers(1, 3)), knobs)
    drawn = replace(drawn, pull=pick(rng, OVEN_PULLS))
    if kind == "dishwasher":
        return drawn
    if not chance(rng, STORAGE):
        return replace(drawn, edge=pick(rng, OVEN_EDGES))
    drawer = between(rng, (0.12, 0.22))
    burners = 4 if chance(rng, HOBS) else 0
    return replace(drawn, height=drawn.height + drawer, drawer=drawer, burners=burners)


def _drawn_microwave(rng: np.random.Generator, name: str) -> Appliance:
    edge = pick(rng, MICROWAVE_EDGES)
    size = between(rng, (0.4, 0.6)), between(rng, (0.25, 0.35)), between(rng, (0.3, 0.45))
    wall, knobs, buttons = between(rng, (0.02, 0.03)), int(rng.integers(0, 3)), int(rng.integers(0, 3))
    keys = 3 * count(rng, 3, 5) if chance(rng, KEYPADS) else 0
    pull: Pull = "bar" if edge == "bottom" else pick(rng, MICROWAVE_PULLS)
    return Appliance(name, "microwave", *size, wall, 0, knobs, buttons, edge=edge, pull=pull, keys=keys)


def make_appliance(spec: Appliance) -> Asset:
    """Returns the appliance with its true joints; those of knobs, buttons and trays are its small joints."""
    body, leaf = _outer(spec)
    white, metal = spec.finish.case, spec.finish.metal
    window = spec.finish.glass if spec.window else None
    pieces = [
        hollow(white, body, spec.wall, spec.drawer),
        door(spec.finish.front, metal, leaf, spec.edge, window, spec.pull, "front" if spec.drawer else "back"),
        *_within(spec, body, leaf),
        *_on_top(spec, body),
    ]
    if spec.drawer:
        pieces.append(_storage(spec, body, leaf))
    panel = _panel(spec, body, leaf)
    if panel is not None:
        pieces += [plank(PartLabel.MISC, "panel", white, panel), *_on_panel(spec, panel)]
    return assemble(spec.name, pieces)


def _outer(spec: Appliance) -> tuple[Span, Span]:
    """Returns the boxes of the body and of the door before it."""
    x, y, gap = spec.width / 2, spec.depth / 2, _GAP
    foot = 0.0 if spec.kind == "microwave" else 0.06
    body = ((-x, -y, foot), (x, y, spec.height))
    beside = PANEL_BESIDE * spec.width if spec.has_panel_beside else 0.0
    left = -x + (beside if spec.edge == "right" else 0.0)
    right = x - (beside if spec.edge == "left" else 0.0)
    has_panel_above = spec.kind != "dishwasher" and not spec.has_panel_beside
    top = spec.height - (PANEL_ABOVE * spec.height if has_panel_above else 0.0)
    front, bottom = -y - 0.002, foot + spec.drawer
    return body, ((left + gap, front - 0.03, bottom + gap), (right - gap, front, top - gap))


def _panel(spec: Appliance, body: Span, leaf: Span) -> Span | None:
    if spec.kind == "dishwasher":
        return None
    (x0, y0, _), (x1, _, z1) = leaf
    if not spec.has_panel_beside:
        return (body[0][0], y0, z1 + _GAP), (body[1][0], body[0][1], body[1][2])
    if spec.edge == "right":
        return (body[0][0], y0, body[0][2]), (x0 - _GAP, body[0][1], body[1][2])
    return (x1 + _GAP, y0, body[0][2]), (body[1][0], body[0][1], body[1][2])


def _storage(spec: Appliance, body: Span, leaf: Span) -> PieceDraft:
    """Returns the drawer below the door, as deep as the body."""
    front = ((leaf[0][0], leaf[0][1], body[0][2] + _GAP), (leaf[1][0], leaf[1][1], leaf[0][2] - 2 * _GAP))
    room = ((body[0][0] + spec.wall, leaf[1][1], body[0][2] + spec.wall), (body[1][0] - spec.wall, 0.0, 0.0))
    inner = (room[0], (room[1][0], body[1][1] - spec.wall, front[1][2]))
    return pulled_drawer(spec.finish.front, spec.finish.metal, front, inner, spec.pull)


def _on_top(spec: Appliance, body: Span) -> Iterator[PieceDraft]:
    """Yields the burners of a hob."""
    (x0, y0, _), (x1, y1, z) = body
    for k in range(spec.burners):
        x, y = x0 + (0.27 if k % 2 else 0.73) * (x1 - x0), y0 + (0.28 if k < 2 else 0.72) * (y1 - y0)
        yield disc(spec.finish.metal, "burner", (x, y, z), _BURNER * (x1 - x0) * (1.0 if k in (0, 3) else 0.75), 0.008)


def _within(spec: Appliance, body: Span, leaf: Span) -> Iterator[PieceDraft]:
    """Yields the racks, or the tray of a microwave oven."""
    wall, steel = spec.wall, spec.finish.metal
    (x0, y0, z0), (x1, y1, _) = body
    x0, x1, y0, y1, z0, z1 = x0 + wall, x1 - wall, y0 + 0.02, y1 - wall, z0 + wall, leaf[1][2] - wall
    z0 += spec.drawer
    if spec.kind == "microwave":
        x0, x1 = max(x0, leaf[0][0]), min(x1, leaf[1][0] - wall)
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
    """Yields knobs and buttons, side by side or above each other, then the keypad, which has as much room as they."""
    (x0, y0, z0), (x1, _, z1) = panel
    metal, wide = spec.finish.metal, not spec.has_panel_beside
    count = spec.knobs + spec.buttons
    cells = count + (max(count, 1) if spec.keys else 0)
    radius = 0.28 * min((x1 - x0) / (cells if wide else 1), (z1 - z0) / (1 if wide else cells), 0.09) if count else 0.0
    for k in range(count):
        ratio = (k + 0.5) / cells
        x, z = (x0 + ratio * (x1 - x0), (z0 + z1) / 2) if wide else ((x0 + x1) / 2, z0 + ratio * (z1 - z0))
        inwards = Axis(vec3(x, y0, z), vec3(0.0, 1.0, 0.0))
        if k < spec.knobs:
            yield replace(dial(metal, x, y0, z, radius, 0.02), motion=turn_of(Axis(inwards.point, -inwards.direction)))
        else:
            pressed = PieceMotion(Slide.joint_type, inwards, _PRESS, small=True)
            square = ((x - radius, y0 - 0.01, z - radius), (x + radius, y0, z + radius))
            yield replace(plank(PartLabel.MISC, "button", metal, square), motion=pressed)
    if spec.keys:
        ratio = count / cells
        low = (x0 + ratio * (x1 - x0), z0) if wide else (x0, z0 + ratio * (z1 - z0))
        yield plank(PartLabel.MISC, "keypad", metal, *_keys(spec.keys, low, (x1, z1), y0))


def _keys(number: int, low: tuple[float, float], high: tuple[float, float], y: float) -> Iterator[Span]:
    """Yields the boxes of keys in rows of three between two corners (x, z) of a panel whose front is at y."""
    rows = max(number // 3, 1)
    size = (high[0] - low[0]) / 3, (high[1] - low[1]) / rows
    half = 0.5 * _KEY * size[0], 0.5 * _KEY * size[1]
    for k in range(number):
        x, z = low[0] + (k % 3 + 0.5) * size[0], low[1] + (k // 3 + 0.5) * size[1]
        yield (x - half[0], y - 0.003, z - half[1]), (x + half[0], y, z + half[1])


def turn_of(axis: Axis) -> PieceMotion:
    """Returns the motion of a knob or a turntable: about an axis, without end."""
    return PieceMotion(JointType.CONTINUOUS, axis, 2 * pi, small=True)
