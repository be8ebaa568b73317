"""Compartments: maximal empty boxes inside storage furniture, from real meshes; labels are not needed.

Cells say where there is room, rays where exactly it ends. A compartment is a box: rooms of other shapes hold several or
none.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.additions.interior.config import InteriorConfig, Sizes
from grafu.additions.interior.faces import Face, FaceFinder
from grafu.additions.interior.occupied import Taken, taken_cells
from grafu.additions.interior.rooms import FRONTS, LID, find_rooms, inside_cells_of, odd_rooms
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.free_space import Grid
from grafu.scene.scene import Scene


@final
@dataclass(frozen=True)
class Compartment:
    """An empty box inside furniture, metres in the object frame.

    `opening` is the face that it opens to (0..5: -X, +X, -Y, +Y, -Z, +Z; 5 is a chest under its lid). `walls` holds
    for each face, in that order, the ids of the still parts that bound it; `behind` the moving bodies in its opening.
    `arms` are further boxes that open into it at the side: in a corner cabinet it is an L.
    """

    box: Box
    opening: int
    walls: tuple[tuple[str, ...], ...]
    behind: tuple[str, ...] = ()
    arms: tuple[Box, ...] = ()

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
    return scene.once(compartments_found, config)


def compartments_found(scene: Scene, config: InteriorConfig) -> tuple[Compartment, ...]:
    """Does what `find_compartments` states, each time anew."""
    if not scene.parts or scene.extent <= 0:
        return ()
    sizes = config.sizes(scene.extent)
    taken, inside = inside_cells(scene, config)
    rough = find_rooms(taken, sizes, config.rooms)
    found: list[tuple[Box, Compartment]] = []
    if rough:
        finder = _finder(scene, [box for _, box in rough], sizes, config)
        made = ((box, _compartment(box, opens, finder, sizes, config)) for opens, box in rough)
        found = [(box, compartment) for box, compartment in made if compartment is not None]
    odd = odd_rooms(taken, [box for box, _ in found], sizes, config.rooms)
    if odd:
        finder = _finder(scene, [box for _, box in odd], sizes, config)
        more = ((box, _odd_compartment(box, opening, finder, sizes)) for opening, box in odd)
        found += [(box, compartment) for box, compartment in more if compartment is not None]
    return with_arms([compartment for _, compartment in found][: config.rooms.most], taken, inside, config)


def _finder(scene: Scene, boxes: Sequence[Box], sizes: Sizes, config: InteriorConfig) -> FaceFinder:
    return FaceFinder(scene, Box.enclosing(boxes), sizes.cell, config.rooms)


def inside_cells(scene: Scene, config: InteriorConfig) -> tuple[Taken, Grid]:
    """Returns what is taken of a scene's space, and the free cells inside furniture, whichever way it opens."""
    return scene.once(_cells_inside, config)


def _cells_inside(scene: Scene, config: InteriorConfig) -> tuple[Taken, Grid]:
    taken = taken_cells(scene, config.sizes(scene.extent), config.rooms)
    return taken, inside_cells_of(taken)


def with_arms(
    found: Sequence[Compartment], taken: Taken, inside: Grid, config: InteriorConfig
) -> tuple[Compartment, ...]:
    """Returns compartments of which those that open into a larger one at its side are its arms."""
    whole: list[Compartment] = []
    for compartment in found:
        home = next((k for k, one in enumerate(whole) if _is_arm(one, compartment, taken, inside, config)), None)
        if home is None:
            whole.append(compartment)
            continue
        one = whole[home]
        walls = tuple(tuple(dict.fromkeys((*a, *b))) for a, b in zip(one.walls, compartment.walls, strict=True))
        behind = tuple(dict.fromkeys((*one.behind, *compartment.behind)))
        whole[home] = replace(one, walls=walls, behind=behind, arms=(*one.arms, compartment.box))
    return tuple(whole)


def _is_arm(one: Compartment, other: Compartment, taken: Taken, inside: Grid, config: InteriorConfig) -> bool:
    """Whether nothing parts a compartment from another that stands beside it and is as high."""
    if one.is_chest or other.is_chest:
        return False
    low, high = np.maximum(one.box.low, other.box.low), np.minimum(one.box.high, other.box.high)
    shared, least = high - low, np.minimum(one.box.size, other.box.size)
    for axis in (0, 1):
        across = [1 - axis, 2]
        gap = float(-shared[axis]) / taken.cell
        if not (-2 <= gap <= config.rooms.arm_cells and (shared[across] >= config.alike * least[across]).all()):
            continue
        start, stop = ((end - taken.origin) / taken.cell for end in (low, high))
        start[axis], stop[axis] = sorted((start[axis], stop[axis]))
        start[axis], stop[axis] = start[axis] - 1, stop[axis] + 1
        between = ~inside[tuple(slice(round(float(a)), round(float(b))) for a, b in zip(start, stop, strict=True))]
        if between.size and 1 - between.any(axis=axis).mean() >= config.rooms.arm:
            return True
    return False


def _odd_compartment(rough: Box, opening: int, finder: FaceFinder, sizes: Sizes) -> Compartment | None:
    """Returns the compartment that is the largest box of a closed space of another shape."""
    faces = finder.faces_of(rough)
    box = _between_faces(faces)
    if (box.size < sizes.least_side).any():
        return None
    box = finder.within_walls(box, opening) if not faces[opening].moving else box
    return Compartment(box, opening, tuple(face.walls for face in faces), finder.bodies_before(box, opening))


def _between_faces(faces: Sequence[Face]) -> Box:
    return Box(np.array([faces[2 * k].at for k in range(3)]), np.array([faces[2 * k + 1].at for k in range(3)]))


def _compartment(
    rough: Box, opens: str, finder: FaceFinder, sizes: Sizes, config: InteriorConfig
) -> Compartment | None:
    """Returns the compartment that a box of free cells stands for, its faces where the meshes are; None: it is none."""
    faces = finder.faces_of(rough)
    box = _between_faces(faces)
    if (box.size < sizes.least_side).any():
        return None
    still = [face.still for face in faces]
    fronts = (LID,) if opens == "z" else (2, 3) if opens == "y" else (0, 1)
    doors = [faces[front].moving for front in fronts]
    opening = fronts[int(np.argmax(doors))] if max(doors) >= config.rooms.door else None
    opening = next((f for f in fronts if still[f] < config.rooms.closed), None) if opening is None else opening
    if opening is None:
        return None
    depth = opening // 2
    sides = [f for f in range(4) if f // 2 != depth]
    is_walled = all(still[f] >= config.wall_ratio for f in sides)
    has_door = faces[opening].moving >= config.rooms.door
    held = (still[f] >= config.wall_ratio or finder.meets_a_drawer(box, f) for f in (4, 5))
    is_held = has_door or all(held)  # a door's cells are held one by one
    if not (is_walled and is_held):
        return None
    box = finder.within_walls(box, opening) if not faces[opening].moving else box
    walls = tuple(face.walls for face in faces)
    return Compartment(box, opening, walls, finder.bodies_before(box, opening))
