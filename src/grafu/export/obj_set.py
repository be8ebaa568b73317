"""The OBJ files of an object, the same for every format that names them: visuals whole, convex pieces for collision."""

from dataclasses import dataclass
from typing import final

from grafu.articulation.articulated_object import ArticulatedObject, Link, Visual
from grafu.articulation.physics import PhysicsModel
from grafu.export.obj import ObjFolder
from grafu.geometry.solids import ConvexSolid

MESHES = "meshes"
"""The folder of the OBJ files, beside the file that names them."""


@final
@dataclass(frozen=True, slots=True)
class ObjSet:
    """A folder of OBJ files and which of them is what.

    `visuals` are by link, in the link's order, those without faces left out. `pieces` are by link and by the place of a
    hull among the link's shapes; boxes need no file.
    """

    folder: ObjFolder
    visuals: dict[str, tuple[tuple[Visual, str], ...]]
    pieces: dict[tuple[str, int], str]


def obj_set(articulated: ArticulatedObject, physics: PhysicsModel, crease_angle: float) -> ObjSet:
    """Returns the OBJ files of an object, relative to the frames of its links; `crease_angle` is radians."""
    made = ObjSet(ObjFolder(crease_angle), {}, {})
    for link in articulated.links_from_root:
        _add_link(made, link, physics)
    return made


def collision_name(link: str, number: int) -> str:
    """Returns the name of the collision shape at a place among a link's shapes."""
    return f"{link}_collision_{number}"


def _add_link(made: ObjSet, link: Link, physics: PhysicsModel) -> None:
    origin = physics.origins[link.id]
    drawn = [visual for visual in link.visuals if len(visual.mesh.faces)]
    made.visuals[link.id] = tuple((visual, made.folder.add_visual(visual, origin)) for visual in drawn)
    for number, shape in enumerate(physics.shapes[link.id]):
        if isinstance(shape, ConvexSolid):
            name = collision_name(link.id, number)
            made.pieces[link.id, number] = made.folder.add_mesh(name, shape.mesh, origin)
