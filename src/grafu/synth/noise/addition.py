"""Parts that are added to furniture as it was modelled: plain blocks and sheets, and drawer runners beside their boxes.

Runners are bars in the gaps beside drawers' boxes, some with a slider on the drawer.
"""

from collections.abc import Iterator
from typing import final

import numpy as np

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.pieces.shapes import turned
from grafu.synth.sampling.chance import between, chance
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True)
class LooseObject:
    """A part to be: `fits` states that it must keep out of still parts, too; `carried_by` names what carries it."""

    label: PartLabel
    stem: str
    mesh: TriangleMesh
    fits: bool = False
    carried_by: str | None = None


def block(low: tuple[float, float, float], high: tuple[float, float, float]) -> TriangleMesh:
    """Returns the closed box between two opposite corners."""
    return TriangleMesh.box_mesh(Box(np.minimum(low, high), np.maximum(low, high)))


def sheet_of(box: Box) -> TriangleMesh:
    """Returns a box without depth along y as two triangles."""
    (x0, y, z0), (x1, _, z1) = box.low.tolist(), box.high.tolist()
    corners = np.array([(x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1)])
    return TriangleMesh(corners, np.array([[0, 1, 2], [0, 2, 3]]))


def knuckles(asset: Asset, rng: np.random.Generator) -> Iterator[LooseObject]:
    """Yields two or three barrels of hinges along the pin of each door, before its face, or plates; they ride on it."""
    radius, tall, number = between(rng, (0.003, 0.009)), between(rng, (0.03, 0.09)), 2 + int(chance(rng, 0.35))
    flat, margin = chance(rng, 0.35), between(rng, (0.06, 0.2))
    for joint in asset.joints:
        door = asset.part(joint.part)
        along = int(np.argmax(np.abs(joint.axis.direction)))
        turns = motion_kind(joint.type).turns and door.label is PartLabel.DOOR and along in (0, 2)
        if not turns or door.box.thin_axis != 1 or abs(joint.axis.direction[along]) < 0.999:
            continue
        across, low, high = 2 - along, door.box.low, door.box.high
        edge = float(low[across] if joint.axis.point[across] < door.box.center[across] else high[across])
        inward = radius if joint.axis.point[across] < door.box.center[across] else -radius
        size = min(tall, float(door.box.size[along]) / 5)
        for ratio in np.linspace(margin, 1.0 - margin, number).tolist():
            start, end = vec3(0.0, float(low[1]) - radius, 0.0), vec3(0.0, float(low[1]) - radius, 0.0)
            middle = float(low[along] + ratio * door.box.size[along])
            start[across] = end[across] = edge + inward
            start[along], end[along] = middle - size / 2, middle + size / 2
            if flat:
                far = vec3(*end.tolist())
                far[across], far[1] = edge + 5 * inward, float(low[1])
                start[1] = float(low[1]) - 0.4 * radius
                start[across] = edge
                ends = np.minimum(start, far), np.maximum(start, far)
                yield LooseObject(PartLabel.MISC, "hinge", TriangleMesh.box_mesh(Box(*ends)), carried_by=joint.part)
                continue
            mesh = turned(start, end, ((0.0, radius), (1.0, radius)), 8)
            yield LooseObject(PartLabel.MISC, "hinge", mesh, carried_by=joint.part)


CLEAR = 0.001  # metres between a drawer's box and its runner


def runners(asset: Asset, rng: np.random.Generator) -> Iterator[LooseObject]:
    """Yields a bar on either side of each drawer's box, in the gap to what stands there; or one more on the drawer."""
    height, double, ratio = between(rng, (0.012, 0.04)), chance(rng, 0.5), between(rng, (0.0, 0.6))
    still = [p for p in asset.parts if p.label.is_support]
    for joint in asset.joints:
        along = int(np.argmax(np.abs(joint.axis.direction)))
        drawer = asset.part(joint.part).label is PartLabel.DRAWER
        if not drawer or along == 2 or abs(joint.axis.direction[along]) < 0.999:
            continue
        body = _body(asset.part(joint.part), along, float(joint.axis.direction[along]))
        if body is None:
            continue
        z = float(body.low[2]) + ratio * float(body.size[2])
        for side in (-1.0, 1.0):
            gap = _gap(body, 1 - along, side, still)
            if not 0.003 < gap < 0.06:
                continue
            reach = (0.5 * gap, 0.95 * gap) if double else (CLEAR, 0.95 * gap)
            yield LooseObject(PartLabel.MISC, "drawer_runner", _bar_beside(body, 1 - along, side, reach, z, height))
            if double:
                mesh = _bar_beside(body, 1 - along, side, (0.0, 0.4 * gap), z, 0.6 * height)
                yield LooseObject(PartLabel.MISC, "drawer_slider", mesh, carried_by=joint.part)


def _body(drawer: Part, along: int, sense: float) -> Box | None:
    """Returns the box of a drawer behind its front, or None where there is only a front."""
    center, half = drawer.box.center[along], drawer.box.half[along]
    behind = drawer.mesh.vertices[(drawer.mesh.vertices[:, along] - center) * sense < half - 0.03]
    if len(behind) < 4 or half < 0.065:
        return None
    reach = np.zeros(3)
    reach[along] = sense * (half - 0.03)
    front = np.where(reach != 0, center + reach, behind[0])  # the walls begin at the front
    return Box.around(np.vstack([behind, front]))


def _gap(body: Box, across: int, side: float, still: list[Part]) -> float:
    gaps = [1.0]
    for part in still:
        apart = part.box.axis_gaps(body)
        others = [a for a in range(3) if a != across]
        beside = (part.box.center[across] - body.center[across]) * side > 0
        if beside and max(apart[others]) < -0.01 and part.box.size[across] < 0.1:
            gaps.append(float(apart[across]))
    return min(gaps)


def _bar_beside(
    body: Box, across: int, side: float, reach: tuple[float, float], z: float, height: float
) -> TriangleMesh:
    """Returns a bar as long as the box, between two distances from its flank."""
    low, high = vec3(*body.low.tolist()), vec3(*body.high.tolist())
    flank = float(body.high[across] if side > 0 else body.low[across])
    low[across], high[across] = sorted(flank + side * distance for distance in reach)
    low[2], high[2] = z, z + height
    return TriangleMesh.box_mesh(Box(low, high))
