"""Mends readings: faces without area and parts without faces are dropped, and said so. It changes no shape."""

from dataclasses import replace

import numpy as np

from grafu.asset.part import Annotation, Part
from grafu.asset.reading import Reading
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Mask
from grafu.geometry.mesh import TriangleMesh

# A triangle is degenerate where its height is below this share of its longest side.
_FLATNESS = 1e-9


def cleaned(reading: Reading) -> Reading:
    """Returns the reading without degenerate faces, and without parts (and their joints) that have no face left."""
    parts, notes = _cleaned(reading.parts)
    annotation = reading.annotation and _cleaned_annotation(reading.annotation)
    return replace(reading, parts=parts, annotation=annotation, notes=(*reading.notes, *notes))


def _cleaned_annotation(annotation: Annotation) -> Annotation:
    parts, _ = _cleaned(annotation.parts)
    known = {part.id for part in parts}
    joints = tuple(joint for joint in annotation.joints if joint.part in known)
    return replace(annotation, parts=parts, joints=joints)


def _cleaned(given: tuple[Part, ...]) -> tuple[tuple[Part, ...], list[str]]:
    """Returns the parts that keep a face, and in words what was dropped."""
    parts: list[Part] = []
    dropped_faces, mended, empty = 0, 0, []
    for part in given:
        surfaces, dropped = _without_degenerate(part.surfaces)
        dropped_faces += dropped
        mended += dropped > 0
        if surfaces:
            parts.append(replace(part, surfaces=surfaces) if dropped else part)
        else:
            empty.append(part)
    notes = [f"dropped {dropped_faces:,} faces without area in {mended} parts"] if dropped_faces else []
    notes += [f"part {part.source.name!r} has no faces and was left out" for part in empty]
    gone = {part.id for part in empty}
    return tuple(replace(p, rides_on=None) if p.rides_on in gone else p for p in parts), notes


def _without_degenerate(surfaces: tuple[Surface, ...]) -> tuple[tuple[Surface, ...], int]:
    kept, dropped = [], 0
    for surface in surfaces:
        good = has_area(surface.mesh)
        if good.all():
            kept.append(surface)
            continue
        dropped += int((~good).sum())
        mesh = TriangleMesh(surface.mesh.vertices, surface.mesh.faces[good])
        kept.append(replace(surface, mesh=mesh))
    return tuple(s for s in kept if not s.is_empty), dropped


def has_area(mesh: TriangleMesh) -> Mask:
    """Returns for each face whether it is a triangle rather than a line or a point."""
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    ab, ac, bc = b - a, c - a, c - b
    twice_area = np.linalg.norm(np.cross(ab, ac), axis=1)
    longest = np.maximum.reduce([(e * e).sum(axis=1) for e in (ab, ac, bc)])
    return twice_area > _FLATNESS * np.maximum(longest, 1e-300)
