"""New parts look like those around them: the material that covers most, its texture at the same scale."""

from collections import defaultdict
from collections.abc import Iterable

import numpy as np

from grafu.asset.part import Part
from grafu.geometry.appearance import OPAQUE_ALPHA, Material, Surface
from grafu.geometry.mesh import TriangleMesh
from grafu.shapes import Float
from grafu.templates.solids import finished

PLAIN_MATERIAL = Material()
DEFAULT_TEXTURE_DENSITY = 1.0
"""Texture widths per metre, where the parts' own cannot be measured."""


def surface_like(mesh: TriangleMesh, parts: Iterable[Part], fallback: Material = PLAIN_MATERIAL) -> Surface:
    """Returns a mesh in the opaque material that covers most of some parts (`fallback`: of none).

    Where that material has a texture, it is laid on from the six sides, as large as it is on those parts.
    """
    alike = _commonest([s for part in parts for s in part.surfaces])
    if not alike:
        return finished(mesh, fallback)
    material = alike[0].material
    plain = finished(mesh, material)
    if material.base_color_texture is None:
        return plain
    normals = plain.normals if plain.normals is not None else np.zeros_like(plain.mesh.vertices)
    uv = _texture_density(alike) * _projected(plain.mesh.vertices, normals)
    return Surface(plain.mesh, material, uv, plain.normals)


def _commonest(surfaces: list[Surface]) -> list[Surface]:
    """Returns the surfaces of the opaque material that covers most."""
    found: dict[Material, list[Surface]] = defaultdict(list)
    for surface in surfaces:
        if surface.material.base_color[3] >= OPAQUE_ALPHA and surface.material.alpha_mode == "OPAQUE":
            found[surface.material].append(surface)
    return max(found.values(), key=lambda group: sum(s.mesh.area for s in group), default=[])


def _texture_density(surfaces: list[Surface]) -> float:
    """Returns how many texture widths lie on a metre of some surfaces."""
    laid, covered = 0.0, 0.0
    for surface in surfaces:
        if surface.uv is not None:
            corners = surface.uv[surface.mesh.faces]
            a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
            laid += 0.5 * float(np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum())
            covered += surface.mesh.area
    return float(np.sqrt(laid / covered)) if laid > 0 and covered > 0 else DEFAULT_TEXTURE_DENSITY


def _projected(points: Float[np.ndarray, "n 3"], normals: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 2"]:
    """Returns metres along the two axes across which each point's normal does not look."""
    facing = np.abs(normals).argmax(axis=1)
    across, along = np.where(facing == 0, 1, 0), np.where(facing == 2, 1, 2)
    rows = np.arange(len(points))
    return np.stack([points[rows, across], points[rows, along]], axis=1)
