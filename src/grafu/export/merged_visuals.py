"""The visuals of a link as one, with one surface per material: fewer draw calls. Names and labels of parts are lost."""

from collections.abc import Sequence

import numpy as np

from grafu.articulation.articulated_object import Link, Visual
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.mesh import merge_meshes

_Kind = tuple[Material, bool, bool, bool]


def merged_visuals(link: Link) -> tuple[Visual, ...]:
    """Returns the visuals of a link as one, named `<link>_parts`; hardware that turns against it stays apart."""
    kinds: dict[_Kind, list[Surface]] = {}
    for visual in link.rigid_visuals:
        for surface in visual.surfaces:
            if not surface.is_empty:
                stated = surface.uv is not None, surface.normals is not None, surface.colors is not None
                kinds.setdefault((surface.material, *stated), []).append(surface)
    swinging = tuple(visual for visual in link.visuals if visual.swing is not None)
    whole = tuple(_merged(surfaces) for surfaces in kinds.values())
    return (Visual(f"{link.id}_parts", whole), *swinging) if whole else swinging


def _merged(surfaces: Sequence[Surface]) -> Surface:
    """Returns surfaces of one material as one; all state normals, colours and coordinates in images, or none does."""
    uv = _joined([surface.uv for surface in surfaces])
    normals = _joined([surface.normals for surface in surfaces])
    colors = _joined([surface.colors for surface in surfaces])
    mesh = merge_meshes([surface.mesh for surface in surfaces])
    return Surface(mesh, surfaces[0].material, uv=uv, normals=normals, colors=colors)


def _joined(arrays: Sequence[np.ndarray | None]) -> np.ndarray | None:
    stated = [rows for rows in arrays if rows is not None]
    return np.vstack(stated) if stated else None
