"""Bodies whose plane faces are objects of their own, as some CAD exports divide them, become one part each.

It looks at surfaces alone, in any frame. A single box of six sheets stays as it is: the one in front may be its door.
"""

from collections.abc import Sequence
from typing import final

import numpy as np

from grafu.asset.part import Part
from grafu.asset.pieces import with_pieces
from grafu.dataclass import dataclass
from grafu.geometry.arrays import distinct
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.shells import shell_numbers
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True, slots=True)
class BodiesOfFacesConfig:
    """When plane objects are faces of bodies.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    flat: float = 1e-4
    """How far the vertices of an object lie from one plane at most (fraction of its diagonal)."""
    faces: int = 4
    """A closed body has so many plane faces at least: a wedge of four."""
    bodies: int = 3
    """An export that divides bodies into faces has so many of them at least ..."""
    most: float = 0.6
    """... and this many of the plane objects are faces of one (fraction): the rest are bodies that are not closed."""

    def __post_init__(self) -> None:
        require_positive(self, "flat", "faces", "bodies")
        require_ratios(self, "most")


def with_bodies_of_faces(
    parts: tuple[Part, ...], config: BodiesOfFacesConfig = BodiesOfFacesConfig()
) -> tuple[tuple[Part, ...], list[str]]:
    """Returns the parts with the plane faces of each closed body joined, and a note; the parts where there are none.

    What a name tells to be another thing than its neighbours is no face of one body with them.
    """
    flat = [part for part in parts if part.carried_by is None and _is_flat(part.mesh, config)]
    if len(flat) < config.faces * config.bodies:
        return parts, []
    found = [group for group in _groups([part.mesh for part in flat]) if _is_body([flat[k] for k in group], config)]
    if len(found) < config.bodies or sum(map(len, found)) < config.most * len(flat):
        return parts, []
    hosts: dict[str, list[Part]] = {}
    for group in found:
        host, *others = sorted((flat[k] for k in group), key=lambda part: part.label is PartLabel.UNKNOWN)
        hosts[host.id] = others
    joined = {part.id: host for host, members in hosts.items() for part in members}
    kept = tuple(with_pieces(part, hosts.get(part.id, []), joined) for part in parts if part.id not in joined)
    count = sum(map(len, found))
    return kept, [f"{count} objects are plane faces of {len(found)} bodies, and joined to these (--parts auto)"]


def _is_flat(mesh: TriangleMesh, config: BodiesOfFacesConfig) -> bool:
    points = mesh.vertices[distinct(mesh.faces)]
    normal = mesh.face_normals[int(np.argmax(mesh.face_areas))]
    return bool(np.ptp(points @ normal) <= config.flat * mesh.box.diagonal)


def _groups(meshes: Sequence[TriangleMesh]) -> list[list[int]]:
    """Returns the numbers of the meshes that are connected across edges which two of their faces share."""
    shell = shell_numbers(merge_meshes(meshes))
    of = np.repeat(np.arange(len(meshes)), [len(mesh.faces) for mesh in meshes])
    groups: dict[int, list[int]] = {}
    for mesh in range(len(meshes)):
        groups.setdefault(int(shell[np.searchsorted(of, mesh)]), []).append(mesh)
    return list(groups.values())


def _is_body(faces: Sequence[Part], config: BodiesOfFacesConfig) -> bool:
    """Whether plane objects enclose a body, and no two have names of different things."""
    told = {part.label for part in faces} - {PartLabel.UNKNOWN}
    return len(faces) >= config.faces and len(told) <= 1 and merge_meshes([p.mesh for p in faces]).is_watertight
