"""Asset to contact-only functional graph: which parts touch. It guesses no motion and changes no label.

The paper asks only whether two boxes come within 0.005 of a unit cube; L-shaped and round parts then
touch things that they only surround. Here the boxes choose the pairs and the distance of the meshes decides
(`grafu.geometry.touching`).
"""

from collections.abc import Sequence
from typing import Literal, final

from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.sampling import PointCloud, sample_surfaces
from grafu.geometry.touching import near_pairs, touching_pairs
from grafu.graph.edges import Contact
from grafu.graph.functional_graph import FunctionalGraph, PartNode


@final
@dataclass(frozen=True, slots=True)
class ParsingConfig:
    """How contacts are found. Tolerances are fractions of the object's largest side (the paper's unit cube).

    `contact` is `mesh` (boxes, then the distance of the meshes), `box` (the paper's rule alone) or `none`. `points` is
    the number of surface points kept on each node (the network's; 0: none), drawn with `seed`.

    Raises:
        ValueError: if a number is negative.
    """

    contact: Literal["mesh", "box", "none"] = "mesh"
    box_tolerance: float = 0.005  # the authors' number
    mesh_tolerance: float = 0.005  # the same, so that the meshes only take contacts away
    points: int = 0
    seed: int = 0

    def __post_init__(self) -> None:
        if min(self.box_tolerance, self.mesh_tolerance, self.points) < 0:
            raise ValueError("the tolerances and `points` of a ParsingConfig must not be negative")


def parse_graph(asset: Asset, config: ParsingConfig = ParsingConfig()) -> FunctionalGraph:
    """Returns the asset's parts as nodes, in order, and a contact between each two that touch."""
    nodes = _nodes(asset.parts, config)
    if config.contact == "none":
        return FunctionalGraph(asset.name, nodes, ())
    pairs = near_pairs([n.box for n in nodes], config.box_tolerance * asset.extent)
    if config.contact == "mesh":
        pairs = touching_pairs([part.mesh for part in asset.parts], pairs, config.mesh_tolerance * asset.extent)
    edges = tuple(Contact(nodes[a].id, nodes[b].id) for a, b in pairs)
    return FunctionalGraph(asset.name, nodes, edges)


def _nodes(parts: tuple[Part, ...], config: ParsingConfig) -> tuple[PartNode, ...]:
    clouds: Sequence[PointCloud | None] = [None] * len(parts)
    if config.points:
        clouds = sample_surfaces([part.mesh for part in parts], config.points, config.seed)
    return tuple(
        PartNode(p.id, p.label, p.box, c, p.source.name, _transparent(p)) for p, c in zip(parts, clouds, strict=True)
    )


def _transparent(part: Part) -> float:
    """Returns the fraction of a part's surface that is of a transparent material."""
    clear = [surface.mesh.area for surface in part.surfaces if surface.material.is_transparent]
    area = part.mesh.area if clear else 0.0
    return min(sum(clear) / area, 1.0) if area > 0.0 else 0.0
