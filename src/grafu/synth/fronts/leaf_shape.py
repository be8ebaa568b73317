"""What a door leaf or drawer front is: a style in an outline at a place. It builds nothing."""

from dataclasses import dataclass
from typing import final

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.synth.fronts.hold import Grip
from grafu.synth.fronts.layout import LeafStyle, Rect, Side

FRAME = 0.065  # metres: how wide the stiles and rails of framed leaves are; at most a quarter of a side


@final
@dataclass(frozen=True, slots=True)
class LeafShape:
    """A leaf in its place, metres: its outline, the y of its outer face, its thickness; `free` is opposite the hinge.

    `grip_side` is the edge that its grip is cut into, `grip_along` the share of the way along it.
    """

    style: LeafStyle
    rect: Rect
    front: float
    thickness: float
    free: Side = "top"
    grip: Grip = "none"
    grip_side: Side = "top"
    grip_along: float = 0.5

    @property
    def box(self) -> Box:
        """The board that the leaf is made of."""
        r = self.rect
        return Box(vec3(r.x0, self.front, r.z0), vec3(r.x1, self.front + self.thickness, r.z1))

    @property
    def frame(self) -> float:
        """The width of its stiles and rails, if it has some."""
        return min(FRAME, self.rect.width / 4, self.rect.height / 4)

    @property
    def rise(self) -> float:
        """How much lower its upper edge is at its ends than at its highest point: 0 but for arched outlines."""
        share = {"arched": 0.16, "half arched": 0.25}.get(self.style, 0.0)
        return min(share * self.rect.width, 0.15 * self.rect.height)
