"""Nodes of a scene with their meshes; a mesh that an exporter parted into nodes below one is whole again."""

from collections import defaultdict
from collections.abc import Sequence
from typing import final

from grafu.asset.labels import label_of
from grafu.asset.split_meshes import is_one_mesh
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.vocabulary import PartLabel

Chain = tuple[tuple[int, str], ...]


@final
@dataclass(frozen=True)
class SceneNode:
    """A node with a mesh: its name, its surfaces in the scene's coordinates, and the nodes from the root down to it.

    Each node of the chain is a number of its own within the scene, and its name; the last is the node itself.
    """

    name: str
    chain: Chain
    surfaces: tuple[Surface, ...]


def telling_name(node: SceneNode) -> str:
    """Returns what a shape is called: by its own name or those above it, whichever gives a label first."""
    names = [name for _, name in reversed(node.chain)]
    return next((name for name in names if label_of(name) is not PartLabel.UNKNOWN), node.name)


def with_split_meshes_whole(nodes: Sequence[SceneNode]) -> list[SceneNode]:
    """Returns the nodes in their order; where an exporter parted a mesh, its node stands for all its pieces."""
    below: dict[int, list[SceneNode]] = defaultdict(list)
    for node in nodes:
        if len(node.chain) > 1:
            below[node.chain[-2][0]].append(node)
    others = {number for node in nodes for number, _ in node.chain[:-2]} | {node.chain[-1][0] for node in nodes}
    whole = {above for above, pieces in below.items() if above not in others and _are_one(pieces)}
    found: list[SceneNode] = []
    for node in nodes:
        above = node.chain[-2][0] if len(node.chain) > 1 else None
        if above not in whole:
            found.append(node)
        elif node is below[above][0]:
            surfaces = tuple(surface for piece in below[above] for surface in piece.surfaces)
            found.append(SceneNode(node.chain[-2][1] or node.name, node.chain[:-1], surfaces))
    return found


def _are_one(pieces: Sequence[SceneNode]) -> bool:
    names, surfaces = [piece.name for piece in pieces], [piece.surfaces for piece in pieces]
    return is_one_mesh(pieces[0].chain[-2][1], names, surfaces)
