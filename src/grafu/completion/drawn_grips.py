"""The grip of a door that is drawn in one with it: small shells that stand out of its leaf, to the outside.

It reads no names.
"""

from collections.abc import Sequence
from typing import Final

import numpy as np

from grafu.asset.grips import DrawnGripConfig, grip_among
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.shells import shell_numbers

DEFAULT_ONE_MESH_CONFIG: Final = DrawnGripConfig(out=0.015)
"""As of doors that are drawn in pieces, but for how far a grip stands out: a strip to pull at is flatter than a bar.
Mouldings, which may be as thick, lie about the middle of a door, and state no side."""


def grips_in(mesh: TriangleMesh, inside: Box, config: DrawnGripConfig = DEFAULT_ONE_MESH_CONFIG) -> list[Box]:
    """Returns the boxes of what is the grip of a door, by its shells; none where no leaf or no grip is plain.

    Args:
        mesh: the door, metres.
        inside: the box around the whole piece: what stands out of the leaf towards its middle is no grip.
        config: the shapes of grips.
    """
    boxes = _boxes_of_shells(mesh)
    thin = mesh.box.thin_axis
    outwards = float(mesh.box.center[thin] - inside.center[thin])
    found = [boxes[k] for k in grip_among(boxes, config=config)]
    if not found:
        return []
    leaf = max(boxes, key=lambda box: float(np.prod(np.sort(box.size)[1:])))
    outside = [box for box in found if float(box.center[thin] - leaf.center[thin]) * outwards > 0]
    return _whole(outside, config.touch * float(leaf.size.max()))


def _whole(boxes: Sequence[Box], touch: float) -> list[Box]:
    """Returns the boxes of grips whose shells touch: a bar with its posts is one."""
    made: list[Box] = []
    for box in boxes:
        near = [other for other in made if other.overlaps(box, touch)]
        made = [other for other in made if other not in near] + [Box.enclosing([box, *near])]
    return made


def _boxes_of_shells(mesh: TriangleMesh) -> Sequence[Box]:
    number, corners = shell_numbers(mesh), mesh.triangles
    order = np.argsort(number, kind="stable")
    starts = np.searchsorted(number[order], np.arange(int(number.max(initial=-1)) + 1))
    groups = np.split(corners[order], starts[1:])
    return [Box.around(group.reshape(-1, 3)) for group in groups if len(group)]
