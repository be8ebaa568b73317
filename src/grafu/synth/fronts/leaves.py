"""Door leaves and drawer fronts in every style, and where their outer face lies. They know no hinge and no handle.

A leaf faces -Y. Its rectangle is its outline from the front; curved leaves and lips come before it.
"""

from collections.abc import Callable
from dataclasses import replace

from grafu.geometry.appearance import Surface
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.fronts.grips import gripped_slab
from grafu.synth.fronts.layout import Rect
from grafu.synth.fronts.leaf_frames import framed_surfaces, recess
from grafu.synth.fronts.leaf_relief import relief_of
from grafu.synth.fronts.leaf_shape import LeafShape as LeafShape
from grafu.synth.pieces.finish import Finish, surface_of
from grafu.synth.pieces.shapes import chamfered_board, rounded_board

_CUT = ("scoop", "slot", "finger hole")


def leaf_surfaces(leaf: LeafShape, finish: Finish) -> tuple[Surface, ...]:
    """Returns the surfaces of a leaf; each is closed."""
    relief = relief_of(leaf)
    if relief is not None:
        return (surface_of(relief.mesh, finish.front),)
    if leaf.style in _BOARDS:
        mesh = gripped_slab(leaf) if leaf.grip in _CUT else _BOARDS[leaf.style](leaf)
        return (surface_of(mesh, finish.front),)
    return framed_surfaces(leaf, finish)


def face_at(leaf: LeafShape, x: float, z: float) -> float:
    """Returns the y of the leaf's outer face at a point of the front."""
    relief = relief_of(leaf)
    if relief is not None:
        return relief.face_at(x, z)
    return leaf.front + (0.0 if leaf.style in _BOARDS else recess(leaf, x, z))


def filled_rect(leaf: LeafShape) -> Rect:
    """Returns the part of the leaf's outline that it fills whatever its style: not the corners beside an arch."""
    return replace(leaf.rect, z1=leaf.rect.z1 - leaf.rise)


def _softening(leaf: LeafShape) -> float:
    return min(0.4 * leaf.thickness, leaf.rect.width / 8, leaf.rect.height / 8)


_BOARDS: dict[str, Callable[[LeafShape], TriangleMesh]] = {
    "slab": lambda leaf: TriangleMesh.box_mesh(leaf.box),
    "chamfered": lambda leaf: chamfered_board(leaf.box, _softening(leaf)),
    "rounded": lambda leaf: rounded_board(leaf.box, _softening(leaf)),
}
