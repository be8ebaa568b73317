"""New parts take after those around them."""

import numpy as np
import pytest

from grafu.additions.likeness import surface_like
from grafu.additions.step import added_part, free_ids
from grafu.asset.part import Part, PartSource
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import PartLabel

OAK = Material("oak", (0.6, 0.4, 0.2, 1.0))
GLASS = Material("glass", (0.9, 0.9, 0.9, 0.2), alpha_mode="BLEND")
GRAIN = Material("grain", base_color_texture=Texture("grain.png", b"...", "image/png"))


def board(width: float) -> TriangleMesh:
    return TriangleMesh.box_mesh(Box(vec3(0.0, 0.0, 0.0), vec3(width, 0.5, 0.02)))


def part(*surfaces: Surface) -> Part:
    return Part("board", PartLabel.SHELF, surfaces, PartSource("board"))


def test_the_material_that_covers_most_is_taken() -> None:
    small, large = Surface(board(0.1), Material("red")), Surface(board(0.4), OAK)
    assert surface_like(board(1.0), [part(small, large)]).material == OAK


def test_glass_is_not() -> None:
    assert surface_like(board(1.0), [part(Surface(board(3.0), GLASS), Surface(board(0.1), OAK))]).material == OAK


def test_without_any_the_fallback_is_taken() -> None:
    assert surface_like(board(1.0), [], OAK).material == OAK
    assert surface_like(board(1.0), [part(Surface(board(3.0), GLASS))], OAK).material == OAK


def test_textures_are_as_large_as_on_the_parts() -> None:
    mesh = board(0.4)
    laid = 2.5 * mesh.vertices[:, :2]  # seen from above: 2.5 widths on a metre, nothing on the flanks
    found = surface_like(board(1.0), [part(Surface(mesh, GRAIN, uv=laid))])
    top = found.mesh.vertices[:, 2] > 0.01
    assert found.uv is not None
    assert found.normals is not None
    upward = top & (found.normals[:, 2] > 0.9)
    scale = np.ptp(found.uv[upward], axis=0) / np.ptp(found.mesh.vertices[upward][:, :2], axis=0)
    area = 2 * (0.4 * 0.5 + 0.4 * 0.02 + 0.5 * 0.02)
    assert scale == pytest.approx(2.5 * np.sqrt(2 * 0.4 * 0.5 / area))


def test_flanks_of_a_textured_board_are_covered_too() -> None:
    mesh = board(0.4)
    found = surface_like(board(1.0), [part(Surface(mesh, GRAIN, uv=mesh.vertices[:, :2]))])
    assert found.uv is not None
    corners = found.uv[found.mesh.faces]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    assert np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).min() > 1e-4


def test_ids_are_free() -> None:
    assert free_ids("shelf", 1, ()) == ("shelf",)
    assert free_ids("shelf", 1, {"shelf"}) == ("shelf_1",)
    assert free_ids("shelf", 3, {"shelf_2"}) == ("shelf_1", "shelf_3", "shelf_4")


def test_what_was_added_says_so() -> None:
    made = added_part("worktop", PartLabel.TOP_PANEL, [Surface(board(1.0), OAK)])
    assert (made.labelled_by, made.carried_by, made.source.name) == ("added", None, "")
