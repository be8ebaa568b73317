"""Carousels: round trays on an upright post, as large as turn freely in a compartment, in the corner of an L.

They are static parts here. What is called a carousel gets its joint with the small parts, which are built last.
"""

from collections.abc import Collection, Sequence
from typing import Final

import numpy as np
from shapely.geometry import Point

from grafu.additions.interior.compartments import Compartment
from grafu.additions.interior.config import CarouselConfig, InteriorConfig
from grafu.additions.interior.outline import FreeSpace
from grafu.additions.interior.panels import clearing_of
from grafu.additions.likeness import surface_like
from grafu.additions.step import Addition, added_part, free_ids
from grafu.additions.top.section import slab_mesh
from grafu.geometry.config_checks import at_scale
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.refusal import Asked, Reason, Refusal
from grafu.scene.scene import Scene
from grafu.vocabulary import PartLabel

CAROUSEL: Final = "carousel"
QUARTER_EDGES = 12
"""Straight edges of a quarter of a tray."""
POST_EDGES = 3
"""The same of its post."""


def carousels_in(
    compartments: Sequence[Compartment], trays: int, scene: Scene, config: InteriorConfig, but: Collection[int] = ()
) -> tuple[list[Addition], list[Refusal]]:
    """Returns a carousel of so many trays for each compartment, and why one has none.

    The compartments numbered in `but` get none.
    """
    sizes, own = config.sizes(scene.extent), at_scale(config.carousel, scene.metre)
    space, clearing = FreeSpace(scene, compartments, sizes, config), clearing_of(scene, config)
    made: list[tuple[int, TriangleMesh]] = []
    refused: list[Refusal] = []
    for number, compartment in enumerate(compartments):
        if number in but:
            continue
        found = _carousel(compartment, trays, space, own)
        if isinstance(found, Refusal):
            refused.append(found.of(_named(number), Asked.INTERIOR))
            continue
        blocked = ""
        for mesh in found:
            blocked = clearing.blocker(mesh)
            if not blocked:
                clearing.add(CAROUSEL, mesh)
                made.append((number, mesh))
                break
        else:
            why = f"`{blocked}` is in its way"
            refused.append(Refusal(_named(number), Reason.IN_THE_WAY, why, Asked.INTERIOR))
    names = free_ids(CAROUSEL, len(made), scene.parts)
    return [
        _part(name, mesh, compartments[k], trays, scene) for name, (k, mesh) in zip(names, made, strict=True)
    ], refused


def _named(number: int) -> str:
    return f"{CAROUSEL} of compartment {number + 1}"


def _carousel(
    compartment: Compartment, trays: int, space: FreeSpace, config: CarouselConfig
) -> list[TriangleMesh] | Refusal:
    """Returns carousels that fit a compartment at rest, the largest first, or why none does."""
    low, high = float(compartment.box.low[2]), float(compartment.box.high[2])
    pitch = (high - low - config.lift) / trays
    if compartment.is_chest:
        return Refusal("", Reason.UNSUITABLE, "a chest that opens upwards takes no carousel")
    if pitch < config.least_pitch:
        return Refusal("", Reason.NO_ROOM, f"its trays would be {pitch:.2f} m above each other")
    floors = [low + config.lift + k * pitch for k in range(trays)]
    circle = space.free_circle(compartment, [z + config.rim / 2 for z in floors], config.rim)
    if circle is None or circle[1] - config.clear < config.least_radius:
        return Refusal("", Reason.NO_ROOM, f"a tray would have a radius of less than {config.least_radius:.2f} m")
    (x, y), radius = circle[0], circle[1] - config.clear
    middle = Point(x, y)
    found = []
    for size in config.tried:
        if size * radius < config.least_radius:
            break
        post = slab_mesh(middle.buffer(config.post, POST_EDGES), low + config.play, high - config.play)
        outer = middle.buffer(size * radius, QUARTER_EDGES)
        rim = outer.difference(middle.buffer(size * radius - config.wall, QUARTER_EDGES))
        shells = [post]
        for z in floors:
            shells += [slab_mesh(outer, z, z + config.floor), slab_mesh(rim, z + config.floor, z + config.rim)]
        found.append(merge_meshes(shells))
    return found


def _part(name: str, mesh: TriangleMesh, compartment: Compartment, trays: int, scene: Scene) -> Addition:
    walls = [scene.parts[wall] for wall in dict.fromkeys(w for face in compartment.walls for w in face)]
    radius = float(np.ptp(mesh.vertices[:, 0])) / 2
    why = f"interior carousel={trays}: trays of {radius:.2f} m turn freely there"
    return Addition(added_part(name, PartLabel.MISC, [surface_like(mesh, walls)]), why, CAROUSEL)
