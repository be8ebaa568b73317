"""Makes the box of a drawer smaller where its front hides it: less deep, then also narrower and lower.

The front keeps its size; where front and box are of one cross-section, only the depth changes.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from grafu.asset.part import Part
from grafu.geometry.arrays import Points
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.clearance.carve import Change, ClearanceStep, Path, obstruction
from grafu.joints.clearance.trim import DrawerFront, drawer_front
from grafu.joints.config import RealizationConfig
from grafu.joints.report import Clearance
from grafu.scene.scene import Scene

_STEPS = (0.25, 0.5, 1.0)  # of what a hidden side may lose
_KEPT = 0.8  # of each side of a box, at least


def narrow_behind(
    scene: Scene, path: Path, ids: Sequence[str], config: RealizationConfig, then: ClearanceStep | None = None
) -> tuple[Scene, list[Change]]:
    """Returns the scene with a drawer's box smaller, by the least that takes a static part out of its way.

    With `then`, by the least with which that step does so: a box that ends before the back of the case leaves it whole
    as the rest is carved. Nothing changes where even the most that hidden sides may lose does not help, nor for what
    turns.
    """
    why = f"its box ran into {', '.join(ids)}"
    sizes = list(smaller_behind(scene, path, why, config))
    for rank, (narrowed, done) in enumerate((*sizes[-1:], *sizes)):
        made, more = then(narrowed, path, ids, config) if then else (narrowed, [])
        helps = len(obstruction(made, path, config).blockers) < len(ids)
        if rank == 0 and not helps:
            break
        if rank and helps:
            return made, [done, *more]
    return scene, []


def smaller_behind(scene: Scene, path: Path, why: str, config: RealizationConfig) -> Iterator[tuple[Scene, Clearance]]:
    """Yields the scene with a drawer's box smaller by ever more: first less deep, then on all sides that are hidden.

    Each side loses at most `config.max_hidden_trim`; `why` is what the report states.
    """
    part = scene.parts[path.moving]
    front = drawer_front(part.mesh.vertices @ path.axes, path, config.thinnest_front)
    if front is None:
        return
    for is_all in (False, True) if front.back is not None else (False,):
        for gap in (ratio * config.max_hidden_trim for ratio in _STEPS):
            smaller = _smaller(part, front, path, gap, is_all)
            if smaller is not None:
                ratio_of_size = gap / float(front.body.size.max())
                yield scene.replaced([smaller]), Clearance(part.id, "trimmed", gap, ratio_of_size, why)


def _smaller(part: Part, front: DrawerFront, path: Path, gap: float, is_all: bool) -> Part | None:
    """Returns the part with its box less deep by `gap` metres, or on all hidden sides; None if too little is left."""
    body = _box_behind(front)
    lost = np.full(3, 2 * gap if is_all else 0.0)
    lost[front.axis] = gap
    if (lost > (1 - _KEPT) * body.size).any():
        return None
    factors = 1 - lost / np.maximum(body.size, 1e-12)
    fixed = np.array(body.center)
    fixed[front.axis] = (body.high if front.sign > 0 else body.low)[front.axis]

    def moved(points: Points) -> Points:
        hidden = front.sections(points)[-1]
        return np.where(hidden[:, None], fixed + (points - fixed) * factors, points)

    surfaces = tuple(
        replace(s, mesh=TriangleMesh(moved(s.mesh.vertices @ path.axes) @ path.axes.T, s.mesh.faces))
        for s in part.surfaces
    )
    return replace(part, surfaces=surfaces)


def _box_behind(front: DrawerFront) -> Box:
    """Returns the box, in the drawer's own axes, of what is behind its front: as deep as from there to its rear end."""
    low, high = np.array(front.body.low), np.array(front.body.high)
    at = front.sign * (front.plane if front.back is None else front.back)
    low[front.axis], high[front.axis] = min(low[front.axis], at), max(high[front.axis], at)
    return Box(low, high)
