"""Nodes of a scene to pieces of furniture, for every format with a node hierarchy. It reads no files.

Nodes below a node that is named as one whole door or drawer (`drawer_1` over `front`, `side`, ...) become one part;
handles among them ride on it. Every other node with a mesh is a part of its own.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import final

from grafu.asset.drafts import PartDraft
from grafu.asset.labels import is_whole_part, label_of
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


def drafts_of_nodes(nodes: Sequence[SceneNode], file: str, by_name: bool = True) -> list[PartDraft]:
    """Returns one draft for each node; `by_name` groups nodes below one that is named as a whole door or drawer."""
    wholes = _whole_nodes([node.chain for node in nodes]) if by_name else set()
    return [_draft(node, file, wholes) for node in nodes]


def _draft(node: SceneNode, file: str, wholes: set[int]) -> PartDraft:
    group = next(((i, name) for i, name in node.chain if i in wholes), None)
    if group is not None:
        return PartDraft(node.name, node.surfaces, group=f"node {group[0]}", group_name=group[1], file=file)
    # Exporters often name a mesh's parent and not the mesh; the scene's own root states nothing about its parts.
    parent = node.chain[-2][1] if len(node.chain) > 2 else ""
    borrowed = parent if label_of(node.name) is PartLabel.UNKNOWN else ""
    return PartDraft(node.name, node.surfaces, label_name=borrowed, file=file)


def _whole_nodes(chains: Sequence[Chain]) -> set[int]:
    """Returns the nodes that stand over the pieces of one door or drawer: well named, and not over several such."""
    above = {i for chain in chains for i, _ in chain[:-1]}
    below: dict[int, set[int]] = {}
    for chain in chains:
        named = [i for i, name in chain if is_whole_part(name)]
        for upper, lower in pairwise(named):
            below.setdefault(upper, set()).add(lower)
    wholes = {i for chain in chains for i, name in chain if is_whole_part(name)}
    return {i for i in wholes & above if len(below.get(i, ())) < 2}
