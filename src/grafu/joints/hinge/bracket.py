"""Pivots of the outer leaf of a folding door: discs at its ends, where need be on brackets of the case.

A bracket is a plate beside the leaf's end, with a block to the front of the case behind the leaf, or on the case's end.
"""

from collections.abc import Iterator
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Visual
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.joints.config import BlockConfig, RealizationConfig
from grafu.joints.hinge.candidates import PinCandidate
from grafu.joints.hinge.pivot import PivotEnd, disc_at, door_end, met_by_rays, pivot_visual, two_discs
from grafu.joints.hinge_config import PivotConfig
from grafu.joints.support_block import METAL, Footing, block
from grafu.scene.border import BorderFrame


@final
@dataclass(frozen=True, eq=False)
class _End:
    """One end of a leaf that turns about a pin: the upper one along Z (`sign` 1) or the lower one, `on_leaf` away.

    `room` is how far it is from there to the floor, metres; infinite at the upper end.
    """

    frame: BorderFrame
    pin: PinCandidate
    static: RayCaster
    sign: float
    on_leaf: float
    config: PivotConfig
    blocks: BlockConfig
    room: float

    @property
    def play(self) -> float:
        """The distance between the leaf's end and the plate, metres: less where the floor is near."""
        return self.config.plate_play * self._scale

    @property
    def thickness(self) -> float:
        """The thickness of the plate, metres: less where the floor is near."""
        return self.config.plate * self._scale

    @property
    def _scale(self) -> float:
        return min(1.0, self.room / (self.config.plate_play + self.config.plate))

    def plate(self, inner: float, back: float) -> Visual:
        """Returns the plate beside the end, so far from the frame's middle, from before the pin back to a depth."""
        frame, pin = self.frame, self.pin
        middle = vec3(pin.x, (pin.y + pin.radius + back) / 2, self.sign * inner)
        footing = Footing(
            frame.to_object(middle[None])[0],
            frame.direction(0.0, 0.0, self.sign),
            frame.direction(pin.radius, 0.0, 0.0),
            frame.direction(0.0, (pin.y + pin.radius - back) / 2, 0.0),
        )
        return block("hinge_plate", footing, self.thickness, self.blocks, METAL)

    def with_discs(self, inner: float, *static: Visual) -> PivotEnd:
        """Returns the end on a plate so far from the frame's middle, with the plate and what holds it."""
        middle = self.sign * (self.on_leaf + self.play / 2)
        outer, on_leaf = inner + self.thickness, self.sign * (self.on_leaf - self.config.disc_inset)
        still = disc_at(self.frame, self.pin, middle, self.sign * outer, self.config.sides)
        moving = disc_at(self.frame, self.pin, on_leaf, middle, self.config.sides)
        return (pivot_visual("hinge_static", still), *static), (pivot_visual("hinge_dynamic", moving),)


def bracketed_ends(
    frame: BorderFrame,
    pin: PinCandidate,
    door: TriangleMesh,
    static: TriangleMesh,
    floor: float,
    realization: RealizationConfig,
) -> list[PivotEnd]:
    """Returns (static, dynamic) discs at each end of a leaf: on the body right beyond it, else on a bracket.

    `floor` is its height, metres: a plate between it and the leaf is as thin as there is room.
    """
    config, casters = realization.hinge.pivot, (RayCaster(door), RayCaster(static))
    found: list[PivotEnd] = []
    for sign in (1.0, -1.0):
        met = met_by_rays(frame, pin, casters, sign, config.plate_end, config)
        if met is not None:
            found.append(two_discs(frame, pin, met, sign, config))
            continue
        on_leaf = door_end(frame, pin, casters[0], sign, config)
        place = frame.to_object(vec3(pin.x, pin.y, sign * on_leaf)[None])[0] if np.isfinite(on_leaf) else None
        is_lower = float(frame.rotation[2, 2]) * sign < 0
        room = float(place[2]) - floor if place is not None and is_lower else np.inf
        if place is not None and room > config.plate_least:
            found += list(_brackets(_End(frame, pin, casters[1], sign, on_leaf, config, realization.block, room)))[:1]
    return found


def _brackets(end: _End) -> Iterator[PivotEnd]:
    """Yields the end on a bracket at the front of the case behind the leaf, then on one that lies on its end."""
    frame, pin, config = end.frame, end.pin, end.config
    inner, back = end.on_leaf + end.play, -frame.thickness
    foot = Footing(
        frame.to_object(vec3(pin.x, back, end.sign * (inner + end.thickness / 2))[None])[0],
        frame.direction(0.0, -1.0, 0.0),
        frame.direction(config.foot_width * pin.radius, 0.0, 0.0),
        frame.direction(0.0, 0.0, end.thickness / 2),
    )
    gap = foot.gap(end.static, config.plate_reach, end.blocks)
    if np.isfinite(gap):
        yield end.with_discs(inner, end.plate(inner, back), block("support_hinge", foot, gap, end.blocks, METAL))
    start = vec3(pin.x, back - config.plate_reach / 2, end.sign * (frame.length / 2 + config.start))
    down = end.static.along(frame.to_object(start[None]), frame.direction(0.0, 0.0, -end.sign))
    on_body = end.sign * float(start[2]) - float(down[0])
    if abs(on_body - end.on_leaf) <= config.plate_end:
        inner = max(inner, on_body)
        yield end.with_discs(inner, end.plate(inner, back - config.plate_reach))
