"""Nodes of a scene with their meshes, those of one mesh together that an exporter wrote as a child for each material.

glTF keeps such a mesh in one node, as primitives. Tools that know no primitives part it, and name the pieces after it:

* trimesh: `drawer`, and below it `drawer_1b6a32`, `drawer_5b6346`: six hexadecimal digits, drawn by chance.
* Sketchfab: `Door`, and below it `Door_Wood_0`, `Door_Glass_0`: each with the name of its material.
* three.js: `Door`, and below it `Door_1`, `Door_2`: numbers, as several doors have them that somebody grouped. They are
  one object where no two have a material in common and each lies in the bounds of the others.
"""

import re
from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Final, final

import numpy as np

from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box

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


_BY_CHANCE: Final = re.compile(r"_[0-9a-f]{6}")
_NUMBER: Final = re.compile(r"[_.]?\d+")
_SIGNS: Final = re.compile(r"[^0-9a-z]+")


def with_split_meshes_whole(nodes: Sequence[SceneNode]) -> list[SceneNode]:
    """Returns the nodes in their order; where an exporter parted a mesh, its node stands for all its pieces."""
    below: dict[int, list[SceneNode]] = defaultdict(list)
    for node in nodes:
        if len(node.chain) > 1:
            below[node.chain[-2][0]].append(node)
    others = {number for node in nodes for number, _ in node.chain[:-2]} | {node.chain[-1][0] for node in nodes}
    whole = {above for above, pieces in below.items() if above not in others and _is_one_mesh(pieces)}
    found: list[SceneNode] = []
    for node in nodes:
        above = node.chain[-2][0] if len(node.chain) > 1 else None
        if above not in whole:
            found.append(node)
        elif node is below[above][0]:
            surfaces = tuple(surface for piece in below[above] for surface in piece.surfaces)
            found.append(SceneNode(node.chain[-2][1], node.chain[:-1], surfaces))
    return found


def _is_one_mesh(pieces: Sequence[SceneNode]) -> bool:
    """Whether the nodes below one are the pieces of its mesh: by their names, and numbered ones by what they are."""
    name = pieces[0].chain[-2][1]
    if len(pieces) < 2 or not name or not all(piece.name.startswith(name) for piece in pieces):
        return False
    endings = [piece.name[len(name) :] for piece in pieces]
    if all(map(_BY_CHANCE.fullmatch, endings)):
        return any(digit.isdigit() for ending in endings for digit in ending)
    if all(_names_material(piece, ending) for piece, ending in zip(pieces, endings, strict=True)):
        return True
    return all(map(_NUMBER.fullmatch, endings)) and _have_own_materials(pieces) and _lie_in_one_another(pieces)


def _names_material(piece: SceneNode, ending: str) -> bool:
    """Whether what follows the name is that of the piece's material, and a number."""
    word, _, number = ending.rpartition("_")
    names = {_plain(surface.material.name) for surface in piece.surfaces}
    return number.isdigit() and bool(_plain(word)) and names == {_plain(word)}


def _plain(name: str) -> str:
    return _SIGNS.sub("", name.lower())


def _have_own_materials(pieces: Sequence[SceneNode]) -> bool:
    used = [{(s.material.name, s.material.base_color) for s in piece.surfaces} for piece in pieces]
    return all(mine.isdisjoint(theirs) for mine, theirs in combinations(used, 2))


def _lie_in_one_another(pieces: Sequence[SceneNode]) -> bool:
    """Whether the boxes of the pieces hang together, each sharing room with another: fronts side by side share none."""
    boxes = [box for piece in pieces if (box := _box(piece)) is not None]
    if len(boxes) < len(pieces):
        return False
    reached, queue = {0}, [0]
    while queue:
        here = boxes[queue.pop()]
        new = {k for k, box in enumerate(boxes) if k not in reached and _share_room(here, box)}
        reached |= new
        queue += new
    return len(reached) == len(boxes)


def _box(piece: SceneNode) -> Box | None:
    boxes: Iterable[Box] = [surface.mesh.box for surface in piece.surfaces if not surface.is_empty]
    return Box.enclosing(boxes) if boxes else None


def _share_room(one: Box, other: Box) -> bool:
    """Whether two boxes overlap along every axis; a sheet overlaps what it lies in."""
    inside = np.minimum(one.high, other.high) - np.maximum(one.low, other.low)
    flat = np.minimum(one.size, other.size) <= 0
    return bool(np.all((inside > 0) | (flat & (inside >= 0))))
