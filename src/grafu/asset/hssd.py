"""HSSD models with S2O annotations: `<id>.glb` beside `<id>.artpre.json` and `<id>.articulations.json`.

The parts are cut from the GLB's few large meshes along the annotated triangles. It settles no frame.
"""

from dataclasses import replace
from pathlib import Path
from typing import final

import numpy as np

from grafu.asset.bodies import Body, BodyVisual, StatedMotion, annotation_of_bodies, drafts_of_visuals
from grafu.asset.drafts import parts_of_drafts
from grafu.asset.gltf import read_scene_meshes
from grafu.asset.hssd_annotation import (
    MOTIONS,
    AnnotatedPart,
    Articulation,
    HssdAnnotation,
    TriangleRun,
    find_motions,
    read_annotation,
)
from grafu.asset.labels import label_of
from grafu.asset.options import LoadOptions, check_parts
from grafu.asset.part import Annotation, Part
from grafu.asset.reading import Convention, Reading
from grafu.asset.resources import ModelFiles
from grafu.dataclass import dataclass
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Surface, selected
from grafu.geometry.box import Box
from grafu.vocabulary import PartLabel

REST = "rest"  # the part of the triangles that no part claims
# How far a part's box may lie from the annotated one, as a fraction of the object's diagonal: rounding, not another
# frame.
_AGREES = 0.01
# What moves in HSSD and is no furniture's door or drawer: taps, wheels, knobs.
_STAYS = (PartLabel.HANDLE, PartLabel.MISC, PartLabel.LEG)


@final
@dataclass(frozen=True)
class _Mesh:
    """What the annotation counts as one mesh: the triangles of its surfaces, one after the other."""

    surfaces: tuple[Surface, ...]

    @property
    def count(self) -> int:
        return sum(len(s.mesh.faces) for s in self.surfaces)


def read_hssd(path: Path, options: LoadOptions, files: ModelFiles | None = None) -> Reading:
    """Returns the annotated parts of a model in the coordinates of its GLB, with the joints that are stated.

    Raises:
        UnreadableAsset: if a file is damaged, or the annotation does not fit the GLB.
        AssetTooLarge: if it has more bytes, parts or faces than the limits allow.
    """
    files = files or ModelFiles(path, options.limits)
    annotation = read_annotation(path, files)
    check_parts(len(annotation.parts), path, options.limits)
    nodes, notes = read_scene_meshes(path, files)
    meshes = _fitting(nodes, annotation, path)
    cut, said = _cut(meshes, annotation)
    bodies, kept = _bodies(annotation, cut, path.name)
    stated = annotation_of_bodies(bodies, up=_up_axis(annotation))
    silent = [] if find_motions(path) else [f"there is no {path.stem}{MOTIONS}: no joint is stated"]
    convention = Convention(
        "the annotation (upAxis, frontAxis; metres)", annotation.up or "+Y", annotation.front or "+Z", unit=1.0
    )
    words = tuple(dict.fromkeys([*notes, *said, *silent, *_misplaced(annotation, cut)]))
    pieces = parts_of_drafts(drafts_of_visuals(visual for body in bodies for visual in body.visuals))
    parts = tuple(_named_still(part, annotation) for part in pieces)
    if stated is not None:
        still = tuple(_named_still(part, annotation) for part in stated.parts)
        stated = Annotation(still, stated.joints, (*kept, *stated.notes))
    return Reading("hssd", parts, convention, stated, None, words, grouped=True)


def _named_still(part: Part, annotation: HssdAnnotation) -> Part:
    """Returns the part as `misc` where the annotators' word is none of ours (`base`): it is no door or drawer.

    The authors do the same with names outside their vocabulary; what has no word stays unknown.
    """
    named = {_link(p.pid) for p in annotation.parts if p.word} | {REST}
    if part.label is not PartLabel.UNKNOWN or part.source.link not in named:
        return part
    return replace(part, label=PartLabel.MISC, labelled_by="annotation")


def _up_axis(annotation: HssdAnnotation) -> int:
    return "XYZ".index((annotation.up or "+Y")[1])


def _fitting(nodes: tuple[tuple[Surface, ...], ...], annotation: HssdAnnotation, path: Path) -> list[_Mesh]:
    """Returns the meshes as the annotation counts them: each primitive one, or each node's as one.

    Where both may be meant, the one counts that puts more parts where the annotation states that they are.

    Raises:
        UnreadableAsset: if it names a mesh or triangle that is there in neither way of counting.
    """
    primitives = [_Mesh((surface,)) for surfaces in nodes for surface in surfaces]
    whole = [_Mesh(surfaces) for surfaces in nodes]
    fitting = [meshes for meshes in (primitives, whole) if not _misfit(meshes, annotation)]
    if not fitting:
        misfit = _misfit(primitives, annotation)
        raise UnreadableAsset(f"{path}: {misfit}; the annotation is of another model: fetch both again")
    if len(fitting) == 1 or len(primitives) == len(whole):
        return fitting[0]
    return min(fitting, key=lambda meshes: len(_strays(annotation, _cut(meshes, annotation)[0])))


def _misfit(meshes: list[_Mesh], annotation: HssdAnnotation) -> str:
    """Returns in words which triangles are not there, or nothing."""
    for part in annotation.parts:
        for run in part.runs:
            if run.mesh >= len(meshes):
                return f"part {part.pid} names mesh {run.mesh} of {len(meshes)}"
            count = meshes[run.mesh].count
            if (run.last or 0) > count:
                return f"part {part.pid} names triangle {(run.last or 0) - 1} of mesh {run.mesh}, which has {count}"
    return ""


def _cut(meshes: list[_Mesh], annotation: HssdAnnotation) -> tuple[dict[str, tuple[Surface, ...]], list[str]]:
    """Returns each part's surfaces by pid, those of no part as `REST`, and notes; the first that names one has it."""
    free = {place: np.ones(mesh.count, dtype=bool) for place, mesh in enumerate(meshes)}
    cut: dict[str, tuple[Surface, ...]] = {}
    twice = 0
    for part in annotation.parts:
        taken = _taken(part, meshes)
        twice += sum(int((t & ~free[place]).sum()) for place, t in taken.items())
        cut[part.pid] = _surfaces(meshes, {place: t & free[place] for place, t in taken.items()})
        for place, t in taken.items():
            free[place] &= ~t
    notes = [f"{twice:,} triangles are annotated as two parts: the first has them"] if twice else []
    left = sum(int(f.sum()) for f in free.values())
    if left:
        cut[REST] = _surfaces(meshes, free)
        notes.append(f"{left:,} triangles belong to no annotated part: kept in place as `{REST}`")
    return cut, notes


def _taken(part: AnnotatedPart, meshes: list[_Mesh]) -> dict[int, np.ndarray]:
    """Returns which triangles a part names, for each mesh that it names."""
    taken: dict[int, np.ndarray] = {}
    for run in part.runs:
        marks = taken.setdefault(run.mesh, np.zeros(0, dtype=bool))
        if not len(marks):
            marks = taken[run.mesh] = np.zeros(meshes[run.mesh].count, dtype=bool)
        marks[_slice(run)] = True
    return dict(sorted(taken.items()))


def _slice(run: TriangleRun) -> slice:
    return slice(run.first, run.last)


def _surfaces(meshes: list[_Mesh], masks: dict[int, np.ndarray]) -> tuple[Surface, ...]:
    """Returns the marked triangles, each mesh's mask running over its surfaces in turn; empty ones are left out."""
    found = []
    for place, mask in masks.items():
        first = 0
        for surface in meshes[place].surfaces:
            last = first + len(surface.mesh.faces)
            marked = np.flatnonzero(mask[first:last])
            if len(marked):
                found.append(selected(surface, marked))
            first = last
    return tuple(found)


def _bodies(annotation: HssdAnnotation, cut: dict[str, tuple[Surface, ...]], file: str) -> tuple[list[Body], list[str]]:
    """Returns a body per part: moving bodies with their motion, what hangs on one of them alone with it as parent."""
    known = {part.pid: part for part in annotation.parts}
    motions: dict[str, Articulation] = {}
    notes: list[str] = []
    for stated in annotation.articulations:
        name = known[stated.pid].name
        if stated.pid in motions:
            notes.append(f"{name} has several motions: the first counts")
        elif label_of(known[stated.pid].word) in _STAYS:
            notes.append(f"{name} is annotated to move, but is no door or drawer: kept in place")
        else:
            motions[stated.pid] = stated
    carriers = _carriers(annotation, motions, cut)
    bodies = [_body(part, motions.get(part.pid), carriers.get(part.pid), cut, file) for part in annotation.parts]
    if REST in cut:
        bodies.append(Body(REST, _link(REST), (BodyVisual(REST, cut[REST], _link(REST), file),)))
    return bodies, notes


def _body(
    part: AnnotatedPart,
    stated: Articulation | None,
    carrier: str | None,
    cut: dict[str, tuple[Surface, ...]],
    file: str,
) -> Body:
    name, link = part.name, _link(part.pid)
    motion = stated and StatedMotion(stated.type, stated.axis, stated.lower, stated.upper, stated.limited)
    visuals = (BodyVisual(name, cut[part.pid], link, file),) if cut[part.pid] else ()
    return Body(name, link, visuals, motion, None if carrier is None else _link(carrier))


def _link(pid: str) -> str:
    return f"pid_{pid}" if pid != REST else REST


def _carriers(
    annotation: HssdAnnotation, motions: dict[str, Articulation], cut: dict[str, tuple[Surface, ...]]
) -> dict[str, str]:
    """Returns what carries each part that does not stand by itself, by pid.

    A moving body's base carries it where that moves, too. Still parts that hang together and touch one moving body and
    nothing else ride on it; the largest such group is the body, which rides on nothing.
    """
    found = {}
    for pid, stated in motions.items():
        moving = [base for base in stated.base if base in motions and base != pid]
        if moving:
            found[pid] = moving[0]
    groups = _groups(annotation, motions)
    bases = {base for stated in motions.values() for base in stated.base}
    body = max(groups, key=lambda group: sum(_extent(cut[pid]) for pid in group), default=frozenset())
    for group in groups:
        moving_bodies = {other for pid in group for other in annotation.neighbours[pid]} & motions.keys()
        if len(moving_bodies) == 1 and group is not body and not group & bases:
            found.update(dict.fromkeys(group, moving_bodies.pop()))
    return found


def _groups(annotation: HssdAnnotation, motions: dict[str, Articulation]) -> list[frozenset[str]]:
    """Returns the still parts in groups that touch each other, directly or by way of others."""
    left = [part.pid for part in annotation.parts if part.pid not in motions]
    groups = []
    while left:
        group, edge = {left[0]}, [left[0]]
        while edge:
            new = annotation.neighbours[edge.pop()] - motions.keys() - group
            group |= new
            edge += new
        groups.append(frozenset(group))
        left = [pid for pid in left if pid not in group]
    return groups


def _extent(surfaces: tuple[Surface, ...]) -> float:
    return _box(surfaces).diagonal if surfaces else 0.0


def _box(surfaces: tuple[Surface, ...]) -> Box:
    return Box.around(np.vstack([s.mesh.vertices for s in surfaces]))


def _misplaced(annotation: HssdAnnotation, cut: dict[str, tuple[Surface, ...]]) -> list[str]:
    """Returns a note where parts lie elsewhere than the boxes that the annotation states for them."""
    strays = _strays(annotation, cut)
    if not strays:
        return []
    count = len(annotation.parts)
    return [f"{len(strays)} of {count} parts lie elsewhere than annotated (part {strays[0]}): joints may be misplaced"]


def _strays(annotation: HssdAnnotation, cut: dict[str, tuple[Surface, ...]]) -> list[str]:
    """Returns the pids of the parts whose triangles lie elsewhere than the annotation's boxes."""
    boxes = {pid: _box(surfaces) for pid, surfaces in cut.items() if surfaces}
    if not boxes:
        return []
    reach = _AGREES * Box.enclosing(boxes.values()).diagonal
    pairs = [(p.pid, p.box, boxes[p.pid]) for p in annotation.parts if p.box is not None and p.pid in boxes]
    return [pid for pid, stated, box in pairs if np.abs(stated.center - box.center).max() > reach]
