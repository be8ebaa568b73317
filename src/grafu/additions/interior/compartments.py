"""Compartments: maximal empty boxes inside storage furniture, from real meshes; labels are not needed.

Cells say where there is room, rays where exactly it ends. A compartment is a box: rooms of other shapes hold several or
none.
"""

from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.additions.interior.config import InteriorConfig, Sizes
from grafu.additions.interior.occupied import taken_cells
from grafu.additions.interior.rooms import FRONTS, LID, find_rooms
from grafu.additions.interior.surroundings import Surroundings
from grafu.geometry.box import Box
from grafu.scene.scene import Scene

_DOOR_RATIO = 0.3  # of an opening that moving bodies must cover where floor or ceiling is missing
_CLOSED = 0.6  # of a face that walls cover for it to be no opening
_MOST = 60  # compartments of one object; a pigeonhole desk has fewer


@final
@dataclass(frozen=True)
class Compartment:
    """An empty box inside furniture, metres in the object frame.

    `opening` is the face that it opens to (0..5: -X, +X, -Y, +Y, -Z, +Z; 5 is a chest under its lid). `walls` holds
    for each face, in that order, the ids of the still parts that bound it; `behind` the moving bodies in its opening.
    """

    box: Box
    opening: int
    walls: tuple[tuple[str, ...], ...]
    behind: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if self.opening not in (*FRONTS, LID) or len(self.walls) != 6:
            raise ValueError(f"`Compartment` needs six walls and an opening 0..3 or 5: got {self.opening}")

    @property
    def is_chest(self) -> bool:
        """Whether it opens upwards."""
        return self.opening == LID

    @property
    def depth_axis(self) -> int:
        """The axis of its opening: 0, 1 or 2."""
        return self.opening // 2

    @property
    def side_axis(self) -> int:
        """The level axis across its opening; for a chest its longer level side."""
        if self.is_chest:
            return 0 if self.box.size[0] >= self.box.size[1] else 1
        return 1 - self.depth_axis


def find_compartments(scene: Scene, config: InteriorConfig = InteriorConfig()) -> tuple[Compartment, ...]:
    """Returns the compartments of an object at rest, the largest first of each kind of opening; none overlap."""
    if not scene.parts or scene.extent <= 0:
        return ()
    sizes = config.sizes(scene.extent)
    rough = find_rooms(taken_cells(scene, sizes), sizes)
    if not rough:
        return ()
    ends = np.array([(box.low, box.high) for _, box in rough])
    around = Surroundings(scene, Box(ends[:, 0].min(axis=0), ends[:, 1].max(axis=0)), sizes.cell)
    made = (_compartment(box, opens, around, sizes, config) for opens, box in rough)
    return tuple(compartment for compartment in made if compartment is not None)[:_MOST]


def _compartment(
    rough: Box, opens: str, around: Surroundings, sizes: Sizes, config: InteriorConfig
) -> Compartment | None:
    """Returns the compartment that a box of free cells stands for, its faces where the meshes are; None: it is none."""
    faces = around.faces_of(rough)
    box = Box(
        np.array([faces[2 * k].at for k in range(3)]),
        np.array([faces[2 * k + 1].at for k in range(3)]),
    )
    if (box.size < sizes.least_side).any():
        return None
    still = [face.still for face in faces]
    fronts = (LID,) if opens == "z" else (2, 3) if opens == "y" else (0, 1)
    doors = [faces[front].moving for front in fronts]
    opening = fronts[int(np.argmax(doors))] if max(doors) >= _DOOR_RATIO else None
    opening = next((f for f in fronts if still[f] < _CLOSED), None) if opening is None else opening
    if opening is None:
        return None
    depth = opening // 2
    sides = [f for f in range(4) if f // 2 != depth]
    is_walled = all(still[f] >= config.wall_ratio for f in sides)
    has_door = faces[opening].moving >= _DOOR_RATIO
    held = (still[f] >= config.wall_ratio or around.meets_a_drawer(box, f) for f in (4, 5))
    is_held = has_door or all(held)  # a door's cells are held one by one
    if not (is_walled and is_held):
        return None
    box = around.within_walls(box, opening) if not faces[opening].moving else box
    walls = tuple(face.walls for face in faces)
    return Compartment(box, opening, walls, around.bodies_before(box, opening))
