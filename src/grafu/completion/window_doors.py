"""A front with a window and a long level bar along its upper edge is the door of an oven: it drops.

No drawer has a window, and a door that is pulled sideways has its handle at a side. Names are not asked. It builds
nothing.
"""

from typing import Final, final

import numpy as np

from grafu.asset.part import Asset
from grafu.completion.level_bars import are_level_bars
from grafu.completion.lone_fronts import as_doors, is_alone
from grafu.completion.rehang import hung_on
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Hinge, Rail
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import face_to_border, signed_axis
from grafu.vocabulary import PartLabel

_LEVEL: Final = 0
_DEPTH: Final = 1
_UP: Final = 2
_FRONT: Final = 2  # the face that looks to -Y
_RAYS: Final = 9  # along each side of the middle of a front


@final
@dataclass(frozen=True, slots=True)
class WindowDoorConfig:
    """What the door of an oven is by its shape.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    middle: float = 0.4
    """A window is open in this part of the middle of the front (fraction of its width and of its height)."""
    pane: float = 0.8
    """Least part of that middle that a pane covers (fraction of its width and of its height)."""
    bar: float = 0.5
    """Least width of the bar (fraction of the front's)."""
    upper: float = 0.3
    """How far above the middle of the front the bar is at least (fraction of its height)."""
    high: float = 1.3
    """Greatest height of the front (ratio to its width): a cabinet's door with glass is higher."""

    def __post_init__(self) -> None:
        require_positive(self, "high")
        require_ratios(self, "middle", "pane", "bar", "upper")


def with_window_doors(
    completion: GraphCompletion, asset: Asset, config: WindowDoorConfig = WindowDoorConfig()
) -> GraphCompletion:
    """Returns the completion in which fronts with a window and a bar above it drop; drawers only if guessed."""
    graph = completion.completed
    guessed = {d.part for d in completion.decisions if d.question == "label"}
    asked = {d.part for d in completion.decisions if d.question == "border"}
    lower = face_to_border(_DEPTH, signed_axis(_UP, positive=False))
    rails: list[Rail] = []
    hinges: list[Hinge] = []
    for edge in graph.motions:
        if edge.coupling is not None or not _is_oven_door(edge.child, graph, asset, config):
            continue
        if isinstance(edge, Rail) and edge.child in guessed and edge.axis == _FRONT:
            rails.append(edge)
        elif isinstance(edge, Hinge) and edge.child in asked and edge.border != lower:
            hinges.append(edge)
    turned = as_doors(completion, dict.fromkeys(rails, lower)) if rails else completion
    return hung_on(turned, {hinge.child: lower for hinge in hinges})


def _is_oven_door(name: str, graph: FunctionalGraph, asset: Asset, config: WindowDoorConfig) -> bool:
    known = {part.id for part in asset.parts}
    box = graph.node(name).box
    if name not in known or not is_alone(name, graph) or box.size[_UP] > config.high * box.size[_LEVEL]:
        return False
    riding = (graph.node(edge.child) for edge in graph.attachments if edge.parent == name and edge.child in known)
    handles = [node.box for node in riding if node.label is PartLabel.HANDLE]
    if not handles or not are_level_bars(handles, box) or not all(_is_along_top(h, box, config) for h in handles):
        return False
    middle = _middle(box, config)
    panes = (node.box for node in graph.nodes if node.id != name and node.label is not PartLabel.HANDLE)
    return any(_is_pane(pane, middle, box, config) for pane in panes) and _is_open(asset.part(name).mesh, middle)


def _is_along_top(bar: Box, front: Box, config: WindowDoorConfig) -> bool:
    above = float(bar.center[_UP] - front.center[_UP])
    return bool(bar.size[_LEVEL] >= config.bar * front.size[_LEVEL] and above >= config.upper * front.size[_UP])


def _middle(front: Box, config: WindowDoorConfig) -> Box:
    """Returns the part of a front in which a window is."""
    low, high = np.array(front.low), np.array(front.high)
    for axis in (_LEVEL, _UP):
        low[axis] = front.center[axis] - config.middle * front.half[axis]
        high[axis] = front.center[axis] + config.middle * front.half[axis]
    return Box(low, high)


def _is_pane(pane: Box, middle: Box, front: Box, config: WindowDoorConfig) -> bool:
    """Whether a plate fills a window from within the front."""
    if pane.thin_axis != _DEPTH or pane.axis_gaps(front)[_DEPTH] > 0:
        return False
    covered = np.minimum(pane.high, middle.high) - np.maximum(pane.low, middle.low)
    inside = all(pane.size[axis] <= front.size[axis] for axis in (_LEVEL, _UP))
    return bool(inside and all(covered[axis] >= config.pane * middle.size[axis] for axis in (_LEVEL, _UP)))


def _is_open(mesh: TriangleMesh, middle: Box) -> bool:
    """Whether nothing of a mesh lies in the middle of it, seen from in front."""
    steps = (np.arange(_RAYS) + 0.5) / _RAYS
    places = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    origins = np.full((len(places), 3), middle.low[_DEPTH] - float(middle.size.max()))
    across = [_LEVEL, _UP]
    origins[:, across] = middle.low[across] + places * middle.size[across]
    return bool(RayCaster(mesh).is_clear(origins, np.eye(3)[_DEPTH]).all())
