"""Makes a path free, step by step, only as far as needed.

What lies enclosed in the moving part, or is a fitting of its hinge, moves with it; the moving part is trimmed; a static
part that fits without clearance is shrunk; a static part that intrudes into the path is carved. A step stays only if it
helps.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import final

import numpy as np

from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat3, Vec3
from grafu.geometry.box import Box
from grafu.geometry.transform import from_rotation
from grafu.joints.clearance.adopt import adopt, adopt_fittings, adopt_pins
from grafu.joints.clearance.behind import narrow_behind
from grafu.joints.clearance.carve import Carving, Change, ClearanceStep, Path, box_in, carve, obstruction
from grafu.joints.clearance.channel import carve_channel
from grafu.joints.clearance.in_frame import GAPS, WIDE_GAPS
from grafu.joints.clearance.separate import separate
from grafu.joints.clearance.sunk import narrow_sunk
from grafu.joints.clearance.trim import trim
from grafu.joints.config import RealizationConfig
from grafu.joints.limits import SweepVerdict
from grafu.joints.report import Clearance
from grafu.scene.scene import Scene


@final
@dataclass(frozen=True, eq=False)
class Cleared:
    """The scene after clearance, what was done to it, and what still blocks the path."""

    scene: Scene
    clearances: tuple[Clearance, ...]
    blockers: tuple[str, ...]


def make_clearance(
    scene: Scene, path: Path, config: RealizationConfig, carrying: frozenset[str] = frozenset()
) -> Cleared:
    """Returns the scene in which the path is free, or as free as the limits allow.

    The parts that are `carrying` what moves, drawn hinges, do not move with it.
    """
    done: list[Change] = []
    vain: set[ClearanceStep] = set()  # what does not help this scene does not help it later either
    left = obstruction(scene, path, config)
    for step in _STEPS if config.trim else (adopt, adopt_fittings, separate):
        if not left.blockers:
            break
        if step in vain:
            continue
        vain.add(step)
        ids = tuple(name for name in left.blockers if step is not adopt_fittings or name not in carrying)
        tried, clearances = step(scene, path, ids, config)
        if not clearances:
            continue
        remaining = obstruction(tried, path, config)
        if _is_better(remaining, left):
            scene, left = tried, remaining
            done += clearances
            vain.clear()
    recorded = (one.recorded() if isinstance(one, Carving) else one for one in done)
    return Cleared(scene, tuple(recorded), left.blockers)


def _is_better(after: SweepVerdict, before: SweepVerdict) -> bool:
    """Whether a step helped: fewer blockers, or as many in fewer poses."""
    return (len(after.blockers), after.ratio) < (len(before.blockers), before.ratio)


def shrink(
    plays: float, scene: Scene, path: Path, ids: Sequence[str], config: RealizationConfig
) -> tuple[Scene, list[Clearance]]:
    """Shrinks static parts that fit without clearance on all sides by `plays` times the tolerated penetration.

    A frame or a case around the moving part stays: its opening would become smaller.
    """
    play = plays * config.depth * scene.extent
    shrunk: list[Part] = []
    done: list[Clearance] = []
    moving = scene.parts[path.moving].box
    for name in ids:
        part = scene.parts[name]
        if _is_around(part.box, moving):
            continue
        size = np.maximum(part.box.size, 1e-12)
        lost = float(1.0 - np.prod(np.maximum(size - 2 * play, 0.0) / size))
        if lost < config.max_carve:
            shrunk.append(_shrunk(part, play))
            why = f"{path.moving} ran in it without clearance"
            done.append(Clearance(name, "eased", play, lost, why, volume_share=lost))
    return scene.replaced(shrunk), done


def _is_around(box: Box, inner: Box) -> bool:
    """Whether a box reaches beyond both ends of another along two axes at least."""
    return int(np.count_nonzero((box.low < inner.low) & (box.high > inner.high))) > 1


def _shrunk(part: Part, play: float) -> Part:
    """Returns the part with every side of its box moved in by `play`."""
    return _inset(part, np.eye(3), np.full(3, play))


def narrow(scene: Scene, path: Path, ids: Sequence[str], config: RealizationConfig) -> tuple[Scene, list[Clearance]]:
    """Makes a moving part that fills its opening smaller on the sides along which it meets a frame around it.

    It gets the least of a few gaps that takes a static part out of its way, or none. A thick leaf that turns needs a
    wide one: the far edge of its back is farther from the pin than the edge of its front.
    """
    part = scene.parts[path.moving]
    size = box_in(path.axes, part.mesh).size
    across = size > size.min() if path.is_turn else np.abs(path.shift) < 1e-9
    gaps = (*GAPS, *WIDE_GAPS) if path.is_turn else GAPS
    for gap in (plays * config.depth * scene.extent for plays in gaps):
        if not (gap <= config.max_trim * size[across]).all():
            break
        narrowed = scene.replaced([_inset(part, path.axes, np.where(across, gap, 0.0))])
        if len(obstruction(narrowed, path, config).blockers) < len(ids):
            why = f"filled its opening in {', '.join(ids)}"
            return narrowed, [Clearance(path.moving, "trimmed", gap, gap / float(size[across].max()), why)]
    return scene, []


def _inset(part: Part, axes: Mat3, by: Vec3) -> Part:
    """Returns the part with the sides of its box along each of the axes moved in by `by`."""
    box = box_in(axes, part.mesh)
    factors = np.where(box.size > 1e-12, (box.size - 2 * by) / np.maximum(box.size, 1e-12), 1.0)
    A = axes @ np.diag(factors) @ axes.T
    center = axes @ box.center
    T = from_rotation(A, center - A @ center)
    return replace(part, surfaces=tuple(s.transformed(T) for s in part.surfaces))


def carve_more(
    scene: Scene, path: Path, ids: Sequence[str], config: RealizationConfig
) -> tuple[Scene, Sequence[Change]]:
    """Carves like `carve`, up to `max_carve_last`."""
    return carve(scene, path, ids, replace(config, max_carve=max(config.max_carve, config.max_carve_last)))


_FINELY = 2000  # solids with which a path is cut by triangles where hulls would cut away too much
_STEPS: tuple[ClearanceStep, ...] = (
    adopt,
    adopt_fittings,
    adopt_pins,
    separate,
    trim,
    narrow_behind,
    narrow,
    partial(shrink, 1.0),
    carve,
    partial(shrink, 1.6),
    trim,
    carve,
    partial(trim, at_back=True),
    carve,
    partial(narrow_behind, then=carve),
    carve_channel,
    partial(carve, most=_FINELY),
    narrow_sunk,
    carve_more,
)
