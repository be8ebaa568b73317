"""Guessed doors that are drawers: low and wide right above a higher door of their width, or in a stack with a drawer.

So cupboards, sideboards and washstands are built: a drawer below the top, and doors below it. A flap above a door is
rare, and stands higher. Fronts of one size right above one another are those of a chest or a filing cabinet.
"""

from typing import Final, final

import numpy as np

from grafu.asset.part import Asset
from grafu.completion.lone_fronts import is_alone
from grafu.completion.thick_doors import as_drawers, bare_doors
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Hinge
from grafu.graph.functional_graph import FunctionalGraph
from grafu.vocabulary import PartLabel

_LEVEL: Final = 0
_DEPTH: Final = 1
_UP: Final = 2


@final
@dataclass(frozen=True, slots=True)
class DrawerAboveConfig:
    """Which fronts above a door are drawers. On furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    wide: float = 1.4
    """Least width (ratio to the height)."""
    low: float = 0.6
    """Greatest height (fraction of that of the door below it)."""
    aligned: float = 0.05
    """How far its sides, and the door's upper border, lie from those of the other at most (fraction of its width)."""
    top: float = 1.1
    """How high above the floor it ends at most (m)."""
    alike: float = 0.03
    """By how much the sides of fronts of one size differ at most (fraction of each side)."""
    off: float = 0.25
    """A handle so far off its middle (fraction of the width) is that of a door."""

    def __post_init__(self) -> None:
        require_positive(self, "wide", "top")
        require_ratios(self, "low", "aligned", "alike", "off")


def with_drawers_above_doors(
    completion: GraphCompletion, asset: Asset, config: DrawerAboveConfig = DrawerAboveConfig()
) -> GraphCompletion:
    """Returns the completion in which guessed doors slide out that are low, wide and right above a door, or in a stack.

    What the input labels as a door stays one, and so does what has a handle off its middle.
    """
    graph = completion.completed
    doors = [graph.node(hinge.child).box for hinge in graph.hinges if graph.node(hinge.child).box.thin_axis == _DEPTH]
    low = [
        hinge
        for hinge in _guessed(completion, asset, config)
        if is_alone(hinge.child, graph)
        and any(_is_above(graph.node(hinge.child).box, other, config) for other in doors)
    ]
    completion = as_drawers(completion, low) if low else completion
    while stacked := [hinge for hinge in _guessed(completion, asset, config) if _is_stacked(hinge, completion, config)]:
        completion = as_drawers(completion, stacked)
    return completion


def _guessed(completion: GraphCompletion, asset: Asset, config: DrawerAboveConfig) -> list[Hinge]:
    """Returns the hinges of fronts that are only guessed to be doors, and may be drawers."""
    graph = completion.completed
    guessed = bare_doors(completion)
    given = {part.id for part in asset.parts}
    return [
        hinge
        for hinge in graph.hinges
        if hinge.child in guessed
        and hinge.coupling is None
        and graph.node(hinge.child).box.thin_axis == _DEPTH
        and graph.node(hinge.child).box.high[_UP] - graph.box.low[_UP] <= config.top
        and not _is_held_aside(hinge, graph, given, config)
    ]


def _is_stacked(hinge: Hinge, completion: GraphCompletion, config: DrawerAboveConfig) -> bool:
    """Whether the front of a drawer that has the size of a door is right above or below it."""
    graph = completion.completed
    door = graph.node(hinge.child).box
    drawers = (graph.node(rail.child).box for rail in graph.rails if rail.child != hinge.child)
    return any(_is_alike(door, box, config) for box in drawers)


def _is_alike(door: Box, drawer: Box, config: DrawerAboveConfig) -> bool:
    """Whether the outlines of two fronts are of one size, one right above the other, their faces in one plane."""
    across, near = [_LEVEL, _UP], config.aligned * float(door.size[_LEVEL])
    is_one_size = np.all(np.abs(door.size - drawer.size)[across] <= config.alike * door.size[across])
    apart = max(abs(float(end)) for end in (*(door.low - drawer.low)[:2], (door.high - drawer.high)[_LEVEL]))
    gap = max(float(door.low[_UP] - drawer.high[_UP]), float(drawer.low[_UP] - door.high[_UP]))
    return bool(is_one_size and apart <= near and -near <= gap <= near)


def _is_above(front: Box, door: Box, config: DrawerAboveConfig) -> bool:
    """Whether a front is low and wide, and right above a higher one of its width, in one plane with it."""
    width, height = float(front.size[_LEVEL]), float(front.size[_UP])
    near = config.aligned * width
    apart = max(abs(float(end)) for end in (*(front.low - door.low)[:2], (front.high - door.high)[_LEVEL]))
    is_right_above = -near <= float(front.low[_UP] - door.high[_UP]) <= near
    is_low = height <= config.low * float(door.size[_UP]) and width >= config.wide * height
    return apart <= near and is_right_above and is_low


def _is_held_aside(hinge: Hinge, graph: FunctionalGraph, given: set[str], config: DrawerAboveConfig) -> bool:
    """Whether a handle that the input has is off the middle of a front."""
    nodes = (graph.node(edge.child) for edge in graph.attachments if edge.parent == hinge.child and edge.child in given)
    box = graph.node(hinge.child).box
    off = (abs(float(n.box.center[_LEVEL] - box.center[_LEVEL])) for n in nodes if n.label is PartLabel.HANDLE)
    return any(one > config.off * float(box.size[_LEVEL]) for one in off)
