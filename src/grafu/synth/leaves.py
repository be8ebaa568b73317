"""Door leaves and drawer fronts in every style, and where their outer face lies. They know no hinge and no handle.

A leaf faces -Y. Its rectangle is its outline from the front; curved leaves bulge before it.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import final

from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.finish import Finish, surface_of
from grafu.synth.hold import Grip
from grafu.synth.layout import LeafStyle, Rect, Side
from grafu.synth.shapes import bowed_board, chamfered_board, framed_opening, rounded_board


@final
@dataclass(frozen=True, slots=True)
class LeafShape:
    """A leaf in its place, metres: its outline, the y of its outer face, its thickness; `free` is opposite the hinge.

    `grip_side` is the edge that its grip is cut into.
    """

    style: LeafStyle
    rect: Rect
    front: float
    thickness: float
    free: Side = "top"
    grip: Grip = "none"
    grip_side: Side = "top"

    @property
    def box(self) -> Box:
        """The board that the leaf is made of."""
        r = self.rect
        return Box(vec3(r.x0, self.front, r.z0), vec3(r.x1, self.front + self.thickness, r.z1))


def leaf_surfaces(leaf: LeafShape, finish: Finish) -> tuple[Surface, ...]:
    """Returns the surfaces of a leaf."""
    box, rect = leaf.box, leaf.rect
    edge = min(0.4 * leaf.thickness, rect.width / 8, rect.height / 8)
    plain: dict[str, Callable[[], TriangleMesh]] = {
        "slab": lambda: TriangleMesh.box_mesh(box),
        "chamfered": lambda: chamfered_board(box, edge),
        "rounded": lambda: rounded_board(box, edge),
        "bowed": lambda: bowed_board(box, min(0.03, rect.width / 12)),
    }
    if leaf.style in plain:
        return (surface_of(plain[leaf.style](), finish.front),)
    width = min(0.065, rect.width / 4, rect.height / 4)
    return (
        *(surface_of(m, finish.front) for m in framed_opening(box, width)),
        _infill(leaf.style, box, width, finish),
    )


def _infill(style: LeafStyle, box: Box, width: float, finish: Finish) -> Surface:
    share, material = (0.15, finish.glass) if style == "glass" else (0.4, finish.front)
    half = box.half - vec3(width, (1 - share) * box.half[1], width)
    return surface_of(TriangleMesh.box_mesh(Box.from_center(box.center, half)), material)
