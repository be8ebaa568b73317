"""Guides for racks: a strip on either wall, beside the outermost wires, where nothing that is drawn holds them."""

from typing import final

import numpy as np

from grafu.articulation.articulated_object import Visual
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.limits import in_the_way, is_free
from grafu.joints.rack_guide_config import RackGuideConfig
from grafu.joints.rail.search import DrawerSearch
from grafu.joints.support_block import METAL, Footing, block
from grafu.scene.obstacles import Obstacle

GUIDE = "guide"
"""`Placement.template` of a rack between guides."""


def rack_guides(search: DrawerSearch, upper: float, reach: float) -> tuple[tuple[Visual, ...], float]:
    """Returns the left and the right guide of a rack, and how far it slides in them, metres: `upper` or a little less.

    There are none unless both have a place. Each fills the gap, at most `reach` metres, from the rack's outermost wires
    to the wall beside them. The rack stays in both until it is open, and they are in no other body's way at rest.
    """
    mesh, config = search.scene.moving_mesh(search.request.moving), search.config.rail.guide
    slide = np.asarray(search.frame.slide)
    across = np.cross([0.0, 0.0, 1.0], slide)
    guides: list[Visual] = []
    held = upper
    for side, sense in (("left", -1.0), ("right", 1.0)):
        run = _run(mesh, slide, sense * across, config)
        held = 0.0 if run is None else min(held, run.length * (1 - config.kept))
        if run is None or held < config.travel * upper:
            return (), upper
        footing = run.footing(slide, sense * across, config)
        gap = footing.gap(search.static_rays, reach, search.config.block)
        if not np.isfinite(gap):
            return (), upper
        guides.append(block(f"rail_{search.request.moving}_{side}_static", footing, gap, search.config.block, METAL))
    return (tuple(guides), held) if _are_free(guides, search, held) else ((), upper)


@final
@dataclass(frozen=True, eq=False)
class _Run:
    """The outermost wire of a rack at one side: its middle, its length along the slide, and its height."""

    middle: Vec3
    length: float
    height: float

    def footing(self, slide: Vec3, outwards: Vec3, config: RackGuideConfig) -> Footing:
        """Returns the rectangle beside the wire that looks for the wall."""
        half = min(max(self.height, config.low), config.high) / 2
        start = self.middle + config.clear * outwards
        return Footing(start, outwards, slide * self.length / 2, np.array([0.0, 0.0, half]))


def _run(mesh: TriangleMesh, slide: Vec3, outwards: Vec3, config: RackGuideConfig) -> _Run | None:
    """Returns the longest run of what lies outermost at one side of a rack, the uppermost of those as long."""
    out = mesh.vertices @ outwards
    outer = mesh.vertices[out >= out.max() - config.beside]
    heights, along = outer[:, 2], outer @ slide
    best: _Run | None = None
    for top in np.unique(np.round(heights / config.low))[::-1] * config.low:
        near = np.abs(heights - top) <= config.low
        length = float(np.ptp(along[near]))
        if length > 0 and (best is None or length > best.length + config.beside):
            z = heights[near]
            middle = slide * (along[near].min() + length / 2) + outwards * out.max()
            best = _Run(middle + np.array([0.0, 0.0, (z.min() + z.max()) / 2]), length, float(np.ptp(z)))
    return best


def _are_free(guides: list[Visual], search: DrawerSearch, upper: float) -> bool:
    """Whether the rack slides between its guides, and no other moving body at rest meets them."""
    beside = [Obstacle(guide.name, MeshCollider(guide.mesh)) for guide in guides]
    if not is_free(search.body, search.motion, upper, beside, search.config.rail.poses):
        return False
    return not any(
        one.collider.intersects(other.collider)
        for one in beside
        for other in in_the_way(search.neighbours, one.collider.box)
    )
