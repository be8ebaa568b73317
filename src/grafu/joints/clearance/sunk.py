"""Presses a side of a drawer back that is drawn sunk into a case of one piece, where that side is not seen.

A case of many boards is pressed from board by board (`trim`); of one piece, its box is no wall, and only what is cut
into by the meshes themselves tells how deep a drawer is sunk into it.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from grafu.asset.part import Part
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster, outer_points
from grafu.geometry.sampling import sample_surface
from grafu.joints.clearance.carve import Path, obstruction
from grafu.joints.config import RealizationConfig
from grafu.joints.report import Clearance
from grafu.scene.scene import Scene

_STEPS = (0.25, 0.5, 0.75, 1.0)  # of what a hidden side may lose
_SAMPLES = 1000  # points on a part where it is looked at

_Sides = tuple[tuple[int, int], ...]


def narrow_sunk(
    scene: Scene, path: Path, ids: Sequence[str], config: RealizationConfig
) -> tuple[Scene, list[Clearance]]:
    """Returns the scene with one side of what slides, or a few, pressed back by the least that frees its path.

    It is at most `config.max_hidden_trim`, and nothing is pressed back that is seen while all is closed.
    """
    if path.is_turn:
        return scene, []
    for sides in _in_turn(path):
        if _freed(scene, path, sides, config.max_hidden_trim, config) is None:
            continue
        gaps = (ratio * config.max_hidden_trim for ratio in _STEPS)
        found = ((gap, _freed(scene, path, sides, gap, config)) for gap in gaps)
        gap, narrowed = next((gap, made) for gap, made in found if made is not None)
        if _is_seen(scene, path, sides, gap, config):
            continue
        size = Box.around(scene.parts[path.moving].mesh.vertices @ path.axes).size
        ratio = max(gap / float(size[axis]) for axis, _ in sides)
        return narrowed, [Clearance(path.moving, "trimmed", gap, ratio, f"was drawn sunk into {', '.join(ids)}")]
    return scene, []


def _in_turn(path: Path) -> Iterator[_Sides]:
    """Yields the sides, an axis and its low (0) or high end (1), that are pressed: few first, then with its back."""
    across = [k for k in range(3) if k != path.slide_axis]
    sides: list[_Sides] = [(side,) for side in product(across, (0, 1))]
    sides += [((axis, 0), (axis, 1)) for axis in across]
    back = path.slide_axis, int(path.shift[path.slide_axis] < 0)
    yield from (*sides, *((*few, back) for few in sides))


def _freed(scene: Scene, path: Path, sides: _Sides, gap: float, config: RealizationConfig) -> Scene | None:
    """Returns the scene with some sides pressed back by `gap` metres; None where that does not free the path."""
    pressed = _pressed(scene.parts[path.moving], path, sides, gap, config)
    if pressed is None:
        return None
    narrowed = scene.replaced([pressed])
    return None if obstruction(narrowed, path, config).blockers else narrowed


def _pressed(part: Part, path: Path, sides: _Sides, gap: float, config: RealizationConfig) -> Part | None:
    """Returns the part with sides pressed back; None where a board at one of them would be pressed too thin."""
    box = Box.around(part.mesh.vertices @ path.axes)
    limits = [(axis, end, (box.low[axis] + gap) if end == 0 else (box.high[axis] - gap)) for axis, end in sides]
    surfaces = []
    for surface in part.surfaces:
        local = surface.mesh.vertices @ path.axes
        for axis, end, limit in limits:
            sign = 1.0 if end == 0 else -1.0
            inner = sign * (local[:, axis] - limit)
            if not (inner > 0).any() or float(inner[inner > 0].min()) < config.kept * gap:
                return None
            local[:, axis] = sign * np.maximum(sign * local[:, axis], sign * limit)
        surfaces.append(replace(surface, mesh=TriangleMesh(local @ path.axes.T, surface.mesh.faces)))
    return replace(part, surfaces=tuple(surfaces))


def _is_seen(scene: Scene, path: Path, sides: _Sides, gap: float, config: RealizationConfig) -> bool:
    """Whether more than hardly any of what is pressed back is seen from outside while all is closed."""
    mesh = scene.parts[path.moving].mesh
    points = sample_surface(mesh, _SAMPLES).points
    local, box = points @ path.axes, Box.around(mesh.vertices @ path.axes)
    gone = np.zeros(len(points), dtype=bool)
    for axis, end in sides:
        gone |= (local[:, axis] < box.low[axis] + gap) if end == 0 else (local[:, axis] > box.high[axis] - gap)
    drawn = merge_meshes([part.mesh for part in scene.parts.values() if len(part.mesh.faces)])
    seen = outer_points(points[gone], RayCaster(drawn), float(drawn.box.size.max()))
    return bool(np.count_nonzero(seen) > config.max_carve_seen * _SAMPLES)
