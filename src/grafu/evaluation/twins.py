"""Models of one geometry whose annotations differ: found by numbers that no turn changes, confirmed on the surfaces.

The dataset of the paper holds many models several times. What another annotation of the same geometry states about a
part is a reasonable motion of it. It compares no predictions.
"""

from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import final

import numpy as np

from grafu.asset.edit import centred, scaled, yawed
from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.evaluation.moving_parts import MovingPart, counted_parts
from grafu.geometry.arrays import Points
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.sampling import distances_up_to, sample_surfaces
from grafu.metrics.motion import Motion

ALIKE = 0.01  # relative: fingerprints that differ more are of other models
SAME_BOX = 0.01  # of the largest side: a part's twin has its box within this
ON = 0.005  # of the same: what is farther lies on another surface
_POINTS = 30  # on each part


@final
@dataclass(frozen=True)
class Twins:
    """Whether two models are one geometry, and what each one's annotation states of the other's parts (by part id)."""

    same: bool
    for_first: Mapping[str, Motion]
    for_second: Mapping[str, Motion]


NOT_TWINS = Twins(False, {}, {})


def fingerprint(asset: Asset) -> tuple[float, ...]:
    """Returns numbers of the whole surface that no move, turn about the vertical by 90 degrees or scale changes.

    Its area, the sides of its box (the two level ones sorted) and the spread of its surface along its own axes, each
    over the largest side. How the surface is split into parts, and in which order, changes nothing.
    """
    mesh, extent = merge_meshes([part.mesh for part in asset.parts]), asset.extent
    weights = mesh.face_areas
    total = float(weights.sum())
    if not total > 0:
        return (0.0,) * 7
    middles = mesh.triangles.mean(axis=1)
    center = weights @ middles / total
    corners = mesh.triangles - center
    spread = np.einsum("f,fki,fkj->ij", weights, corners, corners) / (3 * total)
    sizes = asset.box.size / extent
    level = sorted(sizes[:2].tolist())
    axes = np.sqrt(np.maximum(np.linalg.eigvalsh(spread), 0.0)) / extent
    return (float(np.sqrt(total) / extent), *level, float(sizes[2]), *(float(v) for v in axes))


def alike_pairs(fingerprints: Mapping[str, Sequence[float]]) -> tuple[tuple[str, str], ...]:
    """Returns the pairs of models, by id and in order, whose fingerprints agree: candidates to be confirmed."""
    ids = sorted(fingerprints)
    return tuple((a, b) for a, b in combinations(ids, 2) if _agree(fingerprints[a], fingerprints[b]))


def compare_twins(first: Asset, second: Asset) -> Twins:
    """Returns whether two assets are one geometry, in any quarter turn and at any scale, and the motions to exchange.

    Points on every part of each must lie on the other's surface, whatever its parts. A part's twin is the part that
    counts with the same box.
    """
    first_home = centred(first)
    points, extent = _samples(first_home), first.extent
    for turns in range(4):
        turned = centred(yawed(scaled(second, extent / second.extent), turns * np.pi / 2))
        if not np.allclose(turned.box.size, first_home.box.size, atol=ALIKE * extent):
            continue
        if _covers(points, turned, extent) and _covers(_samples(turned), first_home, extent):
            return _exchanged(first, first_home, second, turned)
    return NOT_TWINS


def _agree(a: Sequence[float], b: Sequence[float]) -> bool:
    return bool(np.allclose(a, b, rtol=ALIKE, atol=ALIKE * 0.1))


def _covers(points: Points, asset: Asset, extent: float) -> bool:
    """Whether all points lie on the surface of an asset."""
    mesh, near = merge_meshes([part.mesh for part in asset.parts]), ON * extent
    clusters = np.array_split(points, max(1, len(points) // _POINTS))  # of one part each: a small region
    return all(bool((distances_up_to(cluster, mesh, near) <= near).all()) for cluster in clusters)


def _samples(asset: Asset) -> Points:
    """Returns points on each part, as many on a knob as on a panel."""
    meshes = [part.mesh for part in asset.parts if len(part.mesh.faces)]
    return np.concatenate([cloud.points for cloud in sample_surfaces(meshes, _POINTS)])


def _exchanged(first: Asset, first_home: Asset, second: Asset, turned: Asset) -> Twins:
    """Returns the motions that each annotation gives the other's parts, each in the other's own frame."""
    here, there = counted_parts(first_home), counted_parts(turned)
    own = {part.id: part for part in counted_parts(first)}, {part.id: part for part in counted_parts(second)}
    near = SAME_BOX * first.extent
    pairs = [(a, b) for a in here for b in there if _same_place(first_home, a, turned, b, near)]
    # back into each model's own frame: both were moved by similarities that keep lines lines
    to_first = first.frame.input_to_output @ np.linalg.inv(first_home.frame.input_to_output)
    to_second = second.frame.input_to_output @ np.linalg.inv(turned.frame.input_to_output)
    return Twins(
        True,
        {a.id: _moved(b.motion, to_first, own[0][a.id]) for a, b in pairs if a.id in own[0]},
        {b.id: _moved(a.motion, to_second, own[1][b.id]) for a, b in pairs if b.id in own[1]},
    )


def _same_place(first: Asset, a: MovingPart, second: Asset, b: MovingPart, near: float) -> bool:
    boxes = first.part(a.id).box, second.part(b.id).box
    return bool(
        np.allclose(boxes[0].low, boxes[1].low, atol=near) and np.allclose(boxes[0].high, boxes[1].high, atol=near)
    )


def _moved(motion: Motion, T: np.ndarray, part: MovingPart) -> Motion:
    return Motion(motion.type, motion.axis.transformed(T), part.motion.center, motion.both_ways)
