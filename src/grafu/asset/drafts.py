"""Unannotated inputs: named pieces to parts. Pieces that share a group become one door or drawer.

It reads no files. A piece belongs to a group where the input's hierarchy states it, or where its name is a piece's name
after a common, numbered beginning (`drawer_1_front`, `drawer_1_side`).

Nodes of a scene below a node that is named as one whole door or drawer (`drawer_1` over `front`, `side`, ...) become
one part; handles among them ride on it. Every other node with a mesh is a part of its own.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import final

import numpy as np

from grafu.asset.grips import grip_among
from grafu.asset.labels import is_piece, is_whole_part, label_of
from grafu.asset.names import unique_ids
from grafu.asset.part import Part, PartSource
from grafu.asset.scene_nodes import Chain, SceneNode, with_split_meshes_whole
from grafu.asset.split_meshes import split_objects
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.components import linked
from grafu.geometry.config_checks import require_ratios
from grafu.vocabulary import PartLabel

# Sweet Home 3D numbers what opens as one: `sweethome3d_opening_on_hinge_1_door`, `sweethome3d_window_pane_on_hinge_1`.
_OPENING = re.compile(r"^sweethome3d_(?:opening|window_pane)_on_((?:hinge|rail)_\d+)(?:_|$)", re.IGNORECASE)
_PANE = re.compile(r"^sweethome3d_window_pane_on_", re.IGNORECASE)  # what is glazed is a leaf, also on rails: a sash
# Where a numbered beginning may end: after `drawer_1` in `drawer_1_front`, after `Door02` in `Door02Panel`.
# What programs add to the name of a copy: `drawer_1_front.001`, `drawer_1_front_2`.
_COPY = re.compile(r"[-_. ]\d+$")
_NUMBERED = re.compile(r"\d+(?=[ _.-]*[^\W\d_])")


@final
@dataclass(frozen=True, slots=True)
class GroupConfig:
    """Which pieces belong to a door or drawer that numbered names tell.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    spare: float = 0.01
    """How far what lies within it may stand out of it (fraction of its largest side)."""
    near: float = 0.1
    """How far the pieces of one lie from each other at most where several have its name (fraction of the largest side
    of these pieces): copies of a cabinet have the names of the first, with numbers behind, or the same."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True)
class PartDraft:
    """A named piece. `group` is a key shared by the pieces of one door or drawer, `group_name` its name.

    `label_name` is the name that the label is read from, where it is not the piece's own.
    """

    name: str
    surfaces: tuple[Surface, ...]
    group: str = ""
    group_name: str = ""
    label_name: str = ""
    file: str = ""
    link: str = ""


@final
@dataclass(frozen=True)
class _Grouped:
    name: str
    label: PartLabel
    drafts: tuple[PartDraft, ...]
    carrier: str = ""


def parts_of_drafts(drafts: list[PartDraft], config: GroupConfig = GroupConfig()) -> tuple[Part, ...]:
    """Returns one part per group or single piece, in order; handles stay parts of their own and ride on their group."""
    grouped: dict[str, _Grouped] = {}
    drafts = _with_split_objects_whole(drafts)
    for index, draft in enumerate(_with_openings(_with_name_groups(drafts, config))):
        label = label_of(draft.label_name or draft.name)
        alone = not draft.group or label is PartLabel.HANDLE
        key = f"piece {index}" if alone else f"group {draft.group}"
        if key in grouped:
            before = grouped[key]
            grouped[key] = _Grouped(before.name, before.label, (*before.drafts, draft))
        elif alone:
            grouped[key] = _Grouped(draft.name, label, (draft,), f"group {draft.group}" if draft.group else "")
        else:
            grouped[key] = _Grouped(draft.group_name, label_of(draft.group_name), (draft,))
    grouped, whole = {key: _with_label_of_pieces(one) for key, one in grouped.items()}, _box(drafts)
    grouped = {key: one for group, all_of_it in grouped.items() for key, one in _with_grip(group, all_of_it, whole)}
    ids = unique_ids((g.name, g.label is PartLabel.HANDLE) for g in grouped.values())
    by_key = dict(zip(grouped, ids, strict=True))
    return tuple(_part(g, by_key[key], by_key.get(g.carrier)) for key, g in grouped.items())


def _with_label_of_pieces(grouped: _Grouped) -> _Grouped:
    """Returns a group that is not called a door or drawer with the one of both that most of its pieces' names give.

    As many names of doors as of drawers state nothing.
    """
    if len(grouped.drafts) < 2 or grouped.label.is_movable:
        return grouped
    said = [label_of(draft.name) for draft in grouped.drafts]
    doors, drawers = said.count(PartLabel.DOOR), said.count(PartLabel.DRAWER)
    if doors == drawers:
        return grouped
    return replace(grouped, label=PartLabel.DOOR if doors > drawers else PartLabel.DRAWER)


def _with_split_objects_whole(drafts: list[PartDraft]) -> list[PartDraft]:
    """Returns the drafts with the pieces of a mesh that an exporter parted as one draft each."""
    found, names = list(drafts), ["" if draft.group else draft.name for draft in drafts]
    for start, (name, count) in reversed(split_objects(names, [draft.surfaces for draft in drafts]).items()):
        surfaces = tuple(surface for draft in drafts[start : start + count] for surface in draft.surfaces)
        found[start : start + count] = [replace(drafts[start], name=name, surfaces=surfaces)]
    return found


def _with_grip(key: str, grouped: _Grouped, whole: Box | None) -> Iterator[tuple[str, _Grouped]]:
    """Yields a group, and apart from it the handle of a door that is drawn in nameless pieces."""
    drafts = [d for d in grouped.drafts if _box([d]) is not None]
    nameless = all(label_of(d.label_name or d.name) in (PartLabel.UNKNOWN, PartLabel.DOOR) for d in drafts)
    is_door = grouped.label is PartLabel.DOOR and len(drafts) > 1 and nameless
    grip = grip_among([box for d in drafts if (box := _box([d])) is not None], whole) if is_door else ()
    pieces = tuple(drafts[k] for k in grip)
    yield key, replace(grouped, drafts=tuple(d for d in grouped.drafts if not any(d is one for one in pieces)))
    if pieces:
        yield f"grip of {key}", _Grouped(f"{grouped.name} handle", PartLabel.HANDLE, pieces, key)


def _part(grouped: _Grouped, part_id: str, carrier: str | None) -> Part:
    surfaces = tuple(s for d in grouped.drafts for s in d.surfaces)
    files = dict.fromkeys(d.file for d in grouped.drafts if d.file)
    source = PartSource(grouped.name, ", ".join(sorted(files)), grouped.drafts[0].link)
    by = "none" if grouped.label is PartLabel.UNKNOWN else "name"
    return Part(part_id, grouped.label, surfaces, source, by, carrier)  # type: ignore[arg-type]


def _with_openings(drafts: list[PartDraft]) -> list[PartDraft]:
    """Returns the drafts with a group for all that Sweet Home 3D opens as one leaf: its faces, bars and panes."""
    members: dict[str, list[int]] = {}
    for index, draft in enumerate(drafts):
        found = None if draft.group else _OPENING.match(draft.name)
        if found is not None:
            members.setdefault(found[1].lower(), []).append(index)
    out = list(drafts)
    for opening, named in members.items():
        leaves = [i for i in named if label_of(drafts[i].name) is not PartLabel.HANDLE]
        if len(leaves) < 2:
            continue
        called = [i for i in leaves if label_of(drafts[i].name).is_movable]
        hung = f"sweethome3d_opening_on_{opening}_door"  # what turns, and is called by its sides: `in` and `out`
        is_leaf = opening.startswith("hinge") or any(_PANE.match(drafts[i].name) for i in leaves)
        name = drafts[called[0]].name if called else hung if is_leaf else drafts[leaves[0]].name
        for i in named:
            out[i] = replace(drafts[i], group=f"opening {opening}", group_name=name)
    return out


def _with_name_groups(drafts: list[PartDraft], config: GroupConfig) -> list[PartDraft]:
    """Returns the drafts with groups added where numbered names share a beginning and one of them is a piece.

    What shares the beginning, but is named otherwise (`drawer_0_divider`), belongs to the group if it lies within
    it. Where pieces with one name lie apart, as in copies of a cabinet, each place has its own group.
    """
    beginnings: dict[str, list[int]] = {}
    for index, draft in enumerate(drafts):
        beginning = "" if draft.group else numbered_whole(draft.name)
        if beginning:
            beginnings.setdefault(beginning, []).append(index)
    out = list(drafts)
    for beginning, all_named in beginnings.items():
        for place, named in enumerate(_by_place(drafts, all_named, config)):
            pieces = [i for i in named if is_piece(drafts[i].name)]
            members = [i for i in named if i in pieces or label_of(drafts[i].name) is PartLabel.HANDLE]
            if len(members) < 2 or not pieces:
                continue
            around = _box([drafts[i] for i in pieces])
            others = [i for i in named if i not in members]
            within = [i for i in others if around is not None and _lies_in(drafts[i], around, config.spare)]
            for i in (*members, *within):
                group = f"name {beginning}" + (f" at place {place}" if place else "")
                out[i] = replace(drafts[i], group=group, group_name=beginning)
    return out


def _by_place(drafts: list[PartDraft], named: list[int], config: GroupConfig) -> list[list[int]]:
    """Returns what has a beginning in common, parted by where it lies if a name is there twice, and lies apart."""
    stems = [_COPY.sub("", drafts[i].name) for i in named]
    boxes = [_box([drafts[i]]) for i in named]
    if len(set(stems)) == len(stems) or any(box is None for box in boxes):
        return [named]
    known = [box for box in boxes if box is not None]
    reach = config.near * max(float(box.size.max()) for box in known)
    near = np.array([[one.gap(other) <= reach for other in known] for one in known])
    place = linked(len(named), *np.nonzero(near))
    places = {stem: [int(p) for s, p in zip(stems, place, strict=True) if s == stem] for stem in stems}
    if not any(len(set(of)) > 1 for of in places.values()):
        return [named]
    return [[i for i, p in zip(named, place, strict=True) if p == k] for k in range(int(place.max()) + 1)]


def numbered_whole(name: str) -> str:
    """Returns the longest beginning of a name, up to a number, that names one door or drawer; empty where none does."""
    ends = [match.end() for match in _NUMBERED.finditer(name)]
    return next((name[:end] for end in reversed(ends) if is_whole_part(name[:end])), "")


def _box(drafts: list[PartDraft]) -> Box | None:
    boxes = [s.mesh.box for d in drafts for s in d.surfaces if not s.is_empty]
    return Box.enclosing(boxes) if boxes else None


def _lies_in(draft: PartDraft, around: Box, ratio: float) -> bool:
    box = _box([draft])
    spare = ratio * float(around.size.max())
    return box is not None and bool(np.all(box.low >= around.low - spare) and np.all(box.high <= around.high + spare))


def drafts_of_nodes(nodes: Sequence[SceneNode], file: str, by_name: bool = True) -> list[PartDraft]:
    """Returns one draft for each node; `by_name` groups nodes below one that is named as a whole door or drawer.

    Nodes that are pieces of one mesh, parted by an exporter, are one.
    """
    nodes = with_split_meshes_whole(nodes)
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
