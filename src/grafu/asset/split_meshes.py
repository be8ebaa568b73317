"""Whether objects are the pieces of one mesh, which an exporter parted by material and named after it.

glTF keeps a mesh of several materials in one object, as primitives. Tools that know no primitives part it:

* trimesh: `drawer_1b6a32`, `drawer_5b6346`: six hexadecimal digits, drawn by chance, letters among them; no numbers.
* Sketchfab: `Door_Wood_0`, `Door_Glass_0`: each with the name of its material.
* Assimp: `drawer_1-0`, `drawer_1-1`; three.js: `drawer_1_1`, `drawer_1_2`. Doors that the user numbered are
  called so as well: pieces of one mesh touch, and either the mesh has a number of its own before theirs, or no two of
  them have a material in common and each lies in the bounds of others.
* three.js, after the mesh and not its node: `Cube003`, `Cube003_1`, `Cube003_2` below `Door`. No two of them have a
  material in common, all hang together, and they are not copies, alike in size.
"""

import re
from collections.abc import Callable, Sequence
from itertools import combinations, takewhile
from typing import Final, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios

Surfaces = tuple[Surface, ...]
_BY_CHANCE: Final = re.compile(r"_[0-9a-f]{6}")
_WITH_CHANCE: Final = re.compile(r"(.+)_[0-9a-f]{6}")
_NUMBER: Final = re.compile(r"[-_.]?\d+")
_FIRST: Final = re.compile(r"(.+)-0")
_SIGNS: Final = re.compile(r"[^0-9a-z]+")


@final
@dataclass(frozen=True, slots=True)
class SplitMeshConfig:
    """How near pieces of one mesh lie.

    Raises:
        ValueError: if a ratio is not between 0 and 1.
    """

    apart: float = 0.005
    """The widest gap between the box of a piece and those of the others (fraction of the largest side of all)."""
    alike: float = 0.9
    """Copies: each side of each box has at least this fraction of the longest such side."""

    counted: float = 1e-4
    """Numbers of six digits that count pieces are no farther apart than this, in the mean (fraction of a million)."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def is_one_mesh(
    name: str, names: Sequence[str], pieces: Sequence[Surfaces], config: SplitMeshConfig = SplitMeshConfig()
) -> bool:
    """Whether objects are the pieces of a mesh of this name: by their names, and numbered ones by what they are."""
    if len(names) < 2:
        return False
    boxes = [Box.enclosing(solid) for of in pieces if (solid := [s.mesh.box for s in of if not s.is_empty])]
    if len(boxes) < len(pieces):
        return False
    near = config.apart * float(Box.enclosing(boxes).size.max())
    if all(piece == f"{names[0]}_{k}" for k, piece in enumerate(names) if k):
        return _have_own_materials(pieces) and _hang_together(boxes, near) and not _are_alike(boxes, config.alike)
    if not name or not all(piece.startswith(name) for piece in names):
        return False
    endings = [piece[len(name) :] for piece in names]
    if all(map(_BY_CHANCE.fullmatch, endings)):
        return _are_by_chance(endings, config)
    if all(_is_material(ending, surfaces) for ending, surfaces in zip(endings, pieces, strict=True)):
        return True
    if not all(map(_NUMBER.fullmatch, endings)):
        return False
    if name[-1].isdigit() and not endings[0][0].isdigit():
        return _hang_together(boxes, near)
    return _have_own_materials(pieces) and _hang_together(boxes, None)


def split_objects(names: Sequence[str], pieces: Sequence[Surfaces]) -> dict[int, tuple[str, int]]:
    """Returns the pieces of one mesh among objects that no node stands over, as Assimp and trimesh name and order them.

    By the place of the first: the name of the mesh, and how many pieces follow one another, it counted in.
    """
    found: dict[int, tuple[str, int]] = {}
    place = 0
    while place < len(names):
        stem, count = _row_of_pieces(names[place:])
        if count > 1 and is_one_mesh(stem, names[place : place + count], pieces[place : place + count]):
            found[place] = stem, count
        place += max(count, 1)
    return found


def _row_of_pieces(names: Sequence[str]) -> tuple[str, int]:
    """Returns the name of the mesh that the first names may be pieces of, and how many do; the first alone: 0 or 1."""
    if (named := _FIRST.fullmatch(names[0])) is not None:
        numbered = (f"{named[1]}-{k}" == name for k, name in enumerate(names))
        return named[1], sum(1 for _ in takewhile(bool, numbered))
    if (named := _WITH_CHANCE.fullmatch(names[0])) is not None:
        mesh = named[1]
        alike = ((other := _WITH_CHANCE.fullmatch(name)) is not None and other[1] == mesh for name in names)
        return mesh, sum(1 for _ in takewhile(bool, alike))
    return names[0], 0


def _are_by_chance(endings: Sequence[str], config: SplitMeshConfig) -> bool:
    """Whether endings of six hexadecimal digits are drawn at random: words have no digits, counted ones lie close."""
    if not _has(endings, str.isalpha):
        drawn = [int(ending[1:]) / 1e6 for ending in endings]
        return max(drawn) - min(drawn) > config.counted * len(drawn)
    return _has(endings, str.isdigit)


def _has(endings: Sequence[str], is_such: Callable[[str], bool]) -> bool:
    return any(is_such(sign) for ending in endings for sign in ending)


def _is_material(ending: str, surfaces: Surfaces) -> bool:
    """Whether what follows the name is that of the piece's material, and a number."""
    word, _, number = ending.rpartition("_")
    return number.isdigit() and bool(_plain(word)) and {_plain(s.material.name) for s in surfaces} == {_plain(word)}


def _plain(name: str) -> str:
    return _SIGNS.sub("", name.lower())


def _have_own_materials(pieces: Sequence[Surfaces]) -> bool:
    used = [{(s.material.name, s.material.base_color) for s in surfaces} for surfaces in pieces]
    return all(mine.isdisjoint(theirs) for mine, theirs in combinations(used, 2))


def _hang_together(boxes: Sequence[Box], apart: float | None) -> bool:
    """Whether each box is joined to the others: at most so far apart, or (None) by room that they have in common."""
    reached, queue = {0}, [0]
    while queue:
        here = boxes[queue.pop()]
        near = (k for k, box in enumerate(boxes) if k not in reached)
        new = {k for k in near if (_share_room(here, boxes[k]) if apart is None else here.gap(boxes[k]) <= apart)}
        reached |= new
        queue += new
    return len(reached) == len(boxes)


def _are_alike(boxes: Sequence[Box], ratio: float) -> bool:
    sizes = np.array([box.size for box in boxes])
    return bool((sizes.min(axis=0) >= ratio * sizes.max(axis=0)).all())


def _share_room(one: Box, other: Box) -> bool:
    """Whether two boxes overlap along every axis; a sheet overlaps what it lies in."""
    inside = np.minimum(one.high, other.high) - np.maximum(one.low, other.low)
    flat = np.minimum(one.size, other.size) <= 0
    return bool(np.all((inside > 0) | (flat & (inside >= 0))))
