"""Separates from a drawer the shells that belong to the case: a frame around its opening, and slivers.

Models often hold a drawer together with the rails above and below it, or with ends of boards that stand in the posts of
the case. Such shells stay with the static part that they reach into.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from grafu.asset.loose import faces_of_part
from grafu.asset.part import Part
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Indices
from grafu.geometry.box import Box
from grafu.geometry.components import part_numbers
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.sampling import sample_surface
from grafu.geometry.shells import shell_numbers
from grafu.joints.clearance.carve import Path, box_in
from grafu.joints.config import RealizationConfig
from grafu.joints.report import Clearance
from grafu.scene.scene import Scene
from grafu.shapes import Bool
from grafu.vocabulary import PartLabel

_FaceMask = Bool[np.ndarray, " n"]
_SAMPLES = 400  # points on a shell where it is looked at


def separate(scene: Scene, path: Path, ids: Sequence[str], config: RealizationConfig) -> tuple[Scene, list[Clearance]]:
    """Returns the scene in which those shells of what slides that belong to the case are of static parts."""
    whole = scene.moving_mesh(path.moving).area
    done: list[Clearance] = []
    for name in scene.moving_bodies[path.moving].members:
        part, given = scene.parts[name], dict[str, _FaceMask]()
        for faces in _shells_of_case(part, path, whole, config):
            host = _host(scene, part.mesh.with_faces(faces), ids)
            if host is not None:
                given[host] = given.get(host, np.zeros_like(faces)) | faces
        for host, faces in given.items():
            area = float(part.mesh.face_areas[faces].sum())
            why = f"belongs to the case and stays with {host}"
            done.append(Clearance(name, "separated", float(np.sqrt(area)), area / whole, why))
        scene = _with_given(scene, part, given) if given else scene
    return scene, done


def _with_given(scene: Scene, part: Part, given: dict[str, _FaceMask]) -> Scene:
    """Returns the scene with some faces of a part as surfaces of other parts instead."""
    left = ~np.logical_or.reduce(list(given.values()))
    hosts = [
        replace(scene.parts[host], surfaces=(*scene.parts[host].surfaces, *_of_faces(part, faces)))
        for host, faces in given.items()
    ]
    return scene.replaced([replace(part, surfaces=_of_faces(part, left)), *hosts])


def _of_faces(part: Part, faces: _FaceMask) -> tuple[Surface, ...]:
    return faces_of_part(part, np.flatnonzero(faces))


def _host(scene: Scene, shell: TriangleMesh, ids: Sequence[str]) -> str | None:
    """Returns the static part whose box a shell reaches into most, None where it reaches into none."""
    shared = {name: scene.parts[name].box.shared_volume(shell.box) for name in ids}
    best = max(shared, key=lambda name: shared[name])
    return best if shared[best] > 0 else None


def _shells_of_case(part: Part, path: Path, whole: float, config: RealizationConfig) -> Iterator[_FaceMask]:
    """Yields the faces of what in a part belongs to the case: a frame around the rest, then slivers; never of all.

    `whole` is the area of the moving body. Nothing of a door: its frame is its own, and slivers of it are knuckles.
    """
    if path.is_turn or part.label is PartLabel.HANDLE:
        return
    mesh = part.mesh
    left = np.ones(len(mesh.faces), dtype=bool)
    for own in _alike(part_numbers(mesh), config.clearance.shells):
        large = mesh.with_faces(own).area >= config.clearance.frame * mesh.area
        if large and _surrounds(mesh.with_faces(own), mesh.with_faces(~own), path, config):
            left &= ~own
            yield own
    small = np.zeros_like(left)
    shells = [own for own in _alike(shell_numbers(mesh), config.clearance.shells) if left[own].all()]
    for own in shells:
        if mesh.face_areas[own].sum() < config.clearance.sliver * whole:
            small |= own
    if not small.any() or mesh.face_areas[small].sum() > config.clearance.slivers * whole or not (left & ~small).any():
        return
    rest = box_in(path.axes, mesh.with_faces(left & ~small))
    yield from (own for own in shells if small[own].all() and _stands_out(mesh.with_faces(own), rest, path, config))


def _alike(numbers: Indices, most: int) -> list[_FaceMask]:
    """Returns the faces of each number; none where there is one number, or more than `most`."""
    count = int(numbers.max()) + 1 if len(numbers) else 0
    return [numbers == k for k in range(count)] if 1 < count <= most else []


def _stands_out(sliver: TriangleMesh, rest: Box, path: Path, config: RealizationConfig) -> bool:
    """Whether a sliver is next to the rest, and most of it beside its outline, as the path sees it."""
    if not box_in(path.axes, sliver).overlaps(rest, config.contact):
        return False
    points = sliver.triangles.mean(axis=1) @ path.axes
    across = [k for k in range(3) if k != path.slide_axis]
    inside = ((points > rest.low) & (points < rest.high))[:, across].all(axis=1)
    return bool(inside.mean() < config.clearance.inside)


def _surrounds(frame: TriangleMesh, rest: TriangleMesh, path: Path, config: RealizationConfig) -> bool:
    """Whether a shell is a frame around the rest, which reaches through it: none of it lies before or behind that."""
    outer, inner = box_in(path.axes, frame), box_in(path.axes, rest)
    axis = path.slide_axis
    across = [k for k in range(3) if k != axis]
    margins = np.concatenate([(inner.low - outer.low)[across], (outer.high - inner.high)[across]])
    reaches = min(inner.high[axis] - outer.low[axis], outer.high[axis] - inner.low[axis])
    if (margins < -config.thinnest_front).any() or np.count_nonzero(
        margins > config.thinnest_front
    ) < config.clearance.sides:
        return False
    if reaches < outer.size[axis] - config.thinnest_front - 1e-9:
        return False
    points = sample_surface(frame, _SAMPLES).points @ path.axes
    low, high = inner.low + config.thinnest_front, inner.high - config.thinnest_front
    within = ((points > low) & (points < high))[:, across].all(axis=1)
    return bool(np.count_nonzero(within) <= config.max_carve_seen * _SAMPLES)
