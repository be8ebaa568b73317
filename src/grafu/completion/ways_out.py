"""Which way a drawer can come out, or a lid open: towards the side from which it is seen, whatever was predicted.

Rays are cast on the meshes. What is predicted stays where they do not tell: a drawer that is seen from both sides, or
from none.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.geometry.mesh import TriangleMesh, merge_meshes, triangle_bounds
from grafu.geometry.raycast import RayCaster, open_ratios
from grafu.graph.completion import BY_RULE, Decision, GraphCompletion
from grafu.graph.edges import AxisSign, Hinge, Rail, SignedAxis
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import sign_for_opening, signed_axis

_UP = 2
_BESIDE = 1e-3  # of the largest side of a box: rays along its border are traced in single precision


@final
@dataclass(frozen=True, slots=True)
class WayOutConfig:
    """When rays tell which way a drawer comes out.

    Raises:
        ValueError: if a number is not between 0 and 1.
    """

    seen: float = 0.5
    """How much more of one side of a drawer than of the opposite one must be seen from outside (fraction)."""
    plate: float = 0.25
    """Largest thickness of a drawer that is only a front (fraction of its shorter other side)."""
    unclear: float = 0.6
    """Score of the side that an upright door opens to below which rays decide it."""

    def __post_init__(self) -> None:
        require_ratios(self, "seen", "plate", "unclear")


def with_ways_out(completion: GraphCompletion, asset: Asset, config: WayOutConfig = WayOutConfig()) -> GraphCompletion:
    """Returns the completion in which drawers and lids move to the side that they are seen from, where only one is.

    So do upright doors where what is predicted is not clear. A drawer that is only a plate slides across that plate.
    Drawers on moving parts, and coupled ones, stay as they are.
    """
    return _with_doors(_with_drawers(completion, asset, config), asset, config)


def _with_doors(completion: GraphCompletion, asset: Asset, config: WayOutConfig) -> GraphCompletion:
    """Returns the completion in which level doors open up where they are seen from above, and down from below.

    Those that are seen from neither side open up where there is room for that, below a shelf high above them. Upright
    doors of which it is not clear which way they open do so to the side from which they are seen.
    """
    graph = completion.completed
    given = {part.id for part in asset.parts}
    doors = [hinge for hinge in graph.hinges if hinge.child in given and _is_asked(hinge, completion, config)]
    new: dict[str, tuple[AxisSign, float]] = {}
    for hinge in doors:
        box = graph.node(hinge.child).box
        thin = box.thin_axis
        low, high = _seen_from(rest_through(asset, hinge.child, graph), box, config)
        sign = sign_for_opening(thin, hinge.border, signed_axis(thin, high > low))
        if abs(high - low) >= config.seen and (sign != hinge.sign or thin != _UP):
            new[hinge.child] = sign, abs(high - low)
    if not new:
        return completion
    edges = tuple(
        replace(e, sign=new[e.child][0]) if isinstance(e, Hinge) and e.child in new else e for e in graph.edges
    )
    kept = (d for d in completion.decisions if d.part not in new or d.question != "sign")
    told = (Decision(p, "sign", str(sign), sure, str(1 - sign), 1.0 - sure, BY_RULE) for p, (sign, sure) in new.items())
    return replace(completion, completed=replace(graph, edges=edges), decisions=(*kept, *told))


def _seen_from(rest: RayCaster, box: Box, config: WayOutConfig) -> tuple[float, float]:
    """Returns how much of a door is seen from its lower and upper side across (fractions).

    Where that does not tell of a level one, what is higher above it than it reaches as it opens hides nothing of it.
    """
    low, high = open_ratios(rest, box, box.thin_axis)
    if box.thin_axis != _UP or abs(high - low) >= config.seen:
        return low, high
    return low, open_ratios(rest, box, _UP, float(box.size[:_UP].min()))[1]


def _is_asked(hinge: Hinge, completion: GraphCompletion, config: WayOutConfig) -> bool:
    if completion.completed.node(hinge.child).box.thin_axis == _UP:
        return True
    decision = completion.decision(hinge.child, "sign")
    return decision is not None and decision.score < config.unclear and hinge.coupling is None


def _with_drawers(completion: GraphCompletion, asset: Asset, config: WayOutConfig) -> GraphCompletion:
    graph = completion.completed
    axes = {rail.child: rail.axis for rail in graph.edges if isinstance(rail, Rail) and _is_free(rail, graph)}
    found = {part: _way_out(part, axis // 2, asset, graph, config) for part, axis in axes.items()}
    new = {part: told for part, told in found.items() if told is not None and told[0] != axes[part]}
    if not new:
        return completion
    edges = tuple(
        replace(e, axis=new[e.child][0]) if isinstance(e, Rail) and e.child in new else e for e in graph.edges
    )
    kept = (d for d in completion.decisions if d.part not in new or d.question != "slide")
    told = (Decision(p, "slide", str(axis), sure, str(axes[p]), 1.0 - sure, BY_RULE) for p, (axis, sure) in new.items())
    return replace(completion, completed=replace(graph, edges=edges), decisions=(*kept, *told))


def _is_free(rail: Rail, graph: FunctionalGraph) -> bool:
    return rail.parent not in graph.moving and rail.coupling is None


def _way_out(
    part: str, predicted: int, asset: Asset, graph: FunctionalGraph, config: WayOutConfig
) -> tuple[SignedAxis, float] | None:
    """Returns the signed axis that leads out, and how much more is seen of that side; None where rays do not tell."""
    known = {p.id: p for p in asset.parts}
    if part not in known or predicted == 2:
        return None
    axis = _across(known[part].box, predicted, config)
    low, high = open_ratios(rest_through(asset, part, graph), known[part].box, axis)
    sure = abs(high - low)
    return (signed_axis(axis, high > low), sure) if sure >= config.seen else None


def _across(box: Box, predicted: int, config: WayOutConfig) -> int:
    """Returns the level axis that a drawer slides along: a plate's thin one, else the predicted one."""
    thin = int(np.argmin(box.size[:2]))
    return thin if box.size[thin] <= config.plate * min(box.size[1 - thin], box.size[2]) else predicted


def rest_of(asset: Asset, part: str, graph: FunctionalGraph) -> RayCaster:
    """Returns what casts rays on everything but a part and what is attached to it."""
    return RayCaster(merge_meshes(_others(asset, part, graph)))


def rest_through(asset: Asset, part: str, graph: FunctionalGraph) -> RayCaster:
    """Returns the same for rays that run along an axis through the part's box: what they cannot meet is left out."""
    return RayCaster(_in_columns(_others(asset, part, graph), graph.node(part).box))


def _others(asset: Asset, part: str, graph: FunctionalGraph) -> list[TriangleMesh]:
    own = {part, *(edge.child for edge in graph.attachments if edge.parent == part)}
    return [part.mesh for part in asset.parts if part.id not in own]


def _in_columns(meshes: Sequence[TriangleMesh], box: Box) -> TriangleMesh:
    """Returns the faces of some meshes that lie within a box along two of the axes at least, if only in part."""
    around, near = box.grown(_BESIDE * float(box.size.max())), []
    for mesh in meshes:
        if len(mesh.faces) and _is_beside(mesh.box.low, mesh.box.high, around):
            keep = _is_beside(*triangle_bounds(mesh.triangles), around)
            near.append(mesh if keep.all() else mesh.with_faces(keep))
    return merge_meshes(near)


def _is_beside(low: np.ndarray, high: np.ndarray, box: Box) -> np.ndarray:
    return np.asarray(((low <= box.high) & (high >= box.low)).sum(axis=-1) >= 2)
