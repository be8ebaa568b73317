"""Washing machines and tumble dryers: a box with a round door before a drum, knobs and buttons, perhaps a drawer."""

from collections.abc import Iterator
from dataclasses import replace
from math import pi, radians
from typing import Literal, final

import numpy as np

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.graph.edges import Hinge, Rail
from grafu.shapes import Float
from grafu.synth.appliances.appliance import turn_of
from grafu.synth.appliances.body import dial, hollow
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, Span, assemble, plank, solid
from grafu.synth.pieces.finish import PLAIN, Finish, surface_of
from grafu.synth.sampling.chance import between, chance
from grafu.vocabulary import PartLabel

Outline = Float[np.ndarray, "n 2"]  # in X and Z, metres
_SIDES = 32  # of what is round
_THICK = 0.02  # metres: of the front plate
_LEAF = 0.045  # metres: how deep the door is, with its frame
_GAP = 0.003  # metres between the door and the front plate, and around the drawer
_PRESS = 0.003  # metres: how far a button goes
_OPENING = radians(120)


@final
@dataclass(frozen=True, slots=True)
class WashingMachine:
    """A front loader, metres: a round door of `radius`, hinged at the left or right, below a `panel` of that height.

    Raises:
        ValueError: if the door finds no room on the front.
    """

    name: str = "washing_machine"
    width: float = 0.6
    height: float = 0.85
    depth: float = 0.58
    panel: float = 0.13
    radius: float = 0.19
    hinge: Literal["left", "right"] = "left"
    has_drawer: bool = True
    buttons: int = 3
    finish: Finish = PLAIN

    def __post_init__(self) -> None:
        if self.radius + 0.03 > min(self.width, self.height - self.panel) / 2:
            raise ValueError(f"`WashingMachine.radius` must leave 3 cm of the front on each side: got {self.radius}")


def drawn_washing_machine(rng: np.random.Generator, name: str) -> WashingMachine:
    """Returns a machine of random size."""
    width, height, panel = between(rng, (0.45, 0.62)), between(rng, (0.8, 0.9)), between(rng, (0.09, 0.16))
    room = min(width, height - panel) / 2 - 0.03
    return WashingMachine(
        name,
        width,
        height,
        between(rng, (0.45, 0.62)),
        panel,
        room * between(rng, (0.65, 0.95)),
        "left" if chance(rng, 0.8) else "right",
        chance(rng, 0.6),
        int(rng.integers(0, 5)),
    )


def make_washing_machine(spec: WashingMachine) -> Asset:
    """Returns the machine with its true joints; those of the knob and the buttons are its small joints."""
    x, y = spec.width / 2, spec.depth / 2
    body = ((-x, -y + _THICK, 0.0), (x, y, spec.height))
    white = spec.finish.case
    middle = (spec.height - spec.panel) / 2
    plate = ((-x, -y, 0.0), (x, -y + _THICK, spec.height - spec.panel))
    pieces = [
        hollow(white, body, 0.012),
        solid(PartLabel.MISC, "front_plate", white, [_plate(plate, middle, 0.8 * spec.radius)]),
        solid(PartLabel.MISC, "drum", spec.finish.metal, [_drum(spec, middle)]),
        _door(spec, middle),
        *_panel(spec),
    ]
    return assemble(spec.name, pieces)


def _door(spec: WashingMachine, middle: float) -> PieceDraft:
    """Returns the door: a ring around a pane, with a grip at its free edge."""
    front, sign = -spec.depth / 2 - _GAP, -1.0 if spec.hinge == "left" else 1.0
    ring = _ring(_circle(spec.radius, middle), _circle(0.72 * spec.radius, middle), front - _LEAF, front)
    pane = _disc(0.73 * spec.radius, middle, front - 0.7 * _LEAF, front - 0.4 * _LEAF)
    surfaces = (surface_of(ring, spec.finish.front), surface_of(pane, spec.finish.glass))
    at, tall = -sign * 0.86 * spec.radius, 0.3 * spec.radius
    span = ((at - 0.012, front - _LEAF - 0.02, middle - tall), (at + 0.012, front - _LEAF, middle + tall))
    handle = plank(PartLabel.HANDLE, "handle", spec.finish.metal, span)
    pin = Axis(vec3(sign * spec.radius, front - _LEAF, middle), vec3(0.0, 0.0, sign))
    return PieceDraft(PartLabel.DOOR, "door", surfaces, PieceMotion(Hinge.joint_type, pin, _OPENING), (handle,))


def _panel(spec: WashingMachine) -> Iterator[PieceDraft]:
    """Yields the panel, a drawer for powder at its left, a knob, and buttons at its right."""
    x, front, low = spec.width / 2, -spec.depth / 2, spec.height - spec.panel
    left = -x + (0.3 * spec.width if spec.has_drawer else 0.0)
    face: Span = ((left, front, low + _GAP), (x, front + _THICK, spec.height))
    yield plank(PartLabel.MISC, "panel", spec.finish.case, face)
    if spec.has_drawer:
        yield _powder_drawer(spec, left)
    radius, level = 0.28 * spec.panel, low + spec.panel / 2
    out = Axis(vec3((left + x) / 2, front, level), vec3(0.0, -1.0, 0.0))
    turn = turn_of(out)
    yield replace(dial(spec.finish.metal, float(out.point[0]), front, level, radius, 0.025), motion=turn)
    for k in range(spec.buttons):
        at, half = x - 0.04 - 0.03 * k, 0.008
        square = ((at - half, front - 0.008, level - half), (at + half, front, level + half))
        inwards = Axis(vec3(at, front, level), vec3(0.0, 1.0, 0.0))
        button = plank(PartLabel.MISC, "button", spec.finish.metal, square)
        yield replace(button, motion=PieceMotion(Rail.joint_type, inwards, _PRESS, small=True))


def _powder_drawer(spec: WashingMachine, right: float) -> PieceDraft:
    x, front, low = -spec.width / 2, -spec.depth / 2, spec.height - spec.panel
    face = ((x + 0.012, front, low + 2 * _GAP), (right - _GAP, front + _THICK, spec.height - 0.015))
    (x0, _, z0), (x1, y1, z1) = face
    deep, wall = y1 + 0.22, 0.004
    x0, x1, z0, z1 = x0 + 0.01, x1 - 0.01, z0 + 0.005, z1 - 0.02
    boards = [
        face,
        ((x0, y1, z0), (x1, deep, z0 + wall)),
        ((x0, y1, z0 + wall), (x0 + wall, deep, z1)),
        ((x1 - wall, y1, z0 + wall), (x1, deep, z1)),
        ((x0 + wall, deep - wall, z0 + wall), (x1 - wall, deep, z1)),
    ]
    out = Axis(vec3((x0 + x1) / 2, front, z0), vec3(0.0, -1.0, 0.0))
    drawer = plank(PartLabel.DRAWER, "drawer", spec.finish.case, *boards)
    return replace(drawer, motion=PieceMotion(Rail.joint_type, out, 0.15))


def _drum(spec: WashingMachine, middle: float) -> TriangleMesh:
    """Returns a round wall and its back, open to the front."""
    radius, y0, y1 = 0.9 * spec.radius, -spec.depth / 2 + _THICK + 0.02, spec.depth / 2 - 0.05
    wall = _ring(_circle(radius, middle), _circle(radius - 0.004, middle), y0, y1)
    return merge_meshes([wall, _disc(radius - 0.004, middle, y1 - 0.004, y1)])


def _plate(span: Span, middle: float, radius: float) -> TriangleMesh:
    """Returns a plate that faces -Y, with a round hole."""
    (x0, y0, z0), (x1, y1, z1) = span
    half = np.array([(x1 - x0) / 2, (z1 - z0) / 2])
    corner = float(np.arctan2(half[1], half[0]))
    corners = np.array([corner, pi - corner, pi + corner, 2 * pi - corner])
    angles = np.unique(np.concatenate([np.linspace(0.0, 2 * pi, _SIDES, endpoint=False), corners]))
    directions = np.column_stack([np.cos(angles), np.sin(angles)])
    reach = np.min(half / np.maximum(np.abs(directions), 1e-12), axis=1)
    center = np.array([(x0 + x1) / 2, middle])
    return _ring(center + directions * reach[:, None], center + radius * directions, y0, y1)


def _circle(radius: float, z: float) -> Outline:
    """Returns points in X and Z about (0, z)."""
    angles = np.linspace(0.0, 2 * pi, _SIDES, endpoint=False)
    return np.column_stack([radius * np.cos(angles), z + radius * np.sin(angles)])


def _ring(outer: Outline, inner: Outline, y0: float, y1: float) -> TriangleMesh:
    """Returns what lies between two outlines in X and Z, counter-clockwise seen from -Y, from depth y0 to y1."""
    count = len(outer)
    loops = [np.insert(outline, 1, y, axis=1) for outline, y in ((outer, y0), (inner, y0), (inner, y1), (outer, y1))]
    here, there = np.arange(count), (np.arange(count) + 1) % count
    faces = []
    for k in range(4):
        a, b = k * count, (k + 1) % 4 * count
        faces += [np.column_stack([a + here, a + there, b + there]), np.column_stack([a + here, b + there, b + here])]
    return TriangleMesh(np.concatenate(loops), np.concatenate(faces))


def _disc(radius: float, z: float, y0: float, y1: float) -> TriangleMesh:
    rim = _circle(radius, z)
    return _ring(rim, np.tile([0.0, z], (len(rim), 1)) + 1e-3 * (rim - [0.0, z]), y0, y1)
