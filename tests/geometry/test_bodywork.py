"""Cutting bodies of several surfaces: closed stays closed, what is left looks as it did, sheets are clipped."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.bodywork import Bodywork, CutOut, cut_out
from grafu.geometry.box import Box
from grafu.geometry.components import patches_of
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.solids import ConvexSolid

BOARD = Box(vec3(0.0, 0.0, 0.0), vec3(0.4, 0.018, 0.6))
POCKET = Box(vec3(0.3, -0.01, 0.2), vec3(0.33, 0.01, 0.3))


def textured(mesh: TriangleMesh, name: str = "oak") -> Surface:
    """A surface whose texture coordinates, normals and colours are reported by where its vertices are."""
    v = mesh.vertices
    uv = np.stack([2 * v[:, 0] + v[:, 1], 3 * v[:, 2] - v[:, 1]], axis=1)
    colors = np.column_stack([np.round(100 * v), np.full(len(v), 255)]).astype(np.uint8)
    normals = (v - v.mean(axis=0)) / np.linalg.norm(v - v.mean(axis=0), axis=1, keepdims=True)
    return Surface(mesh, Material(name), uv, normals, colors)


def cutter(box: Box) -> ConvexSolid:
    solid = ConvexSolid.around(box.corners())
    assert solid is not None
    return solid


def cut(*surfaces: Surface, box: Box = POCKET) -> CutOut:
    return cut_out(Bodywork.of(surfaces), [cutter(box)])


def whole(result: CutOut) -> TriangleMesh:
    return merge_meshes([*(s.mesh for s in result.surfaces), result.wall])


def sides(mesh: TriangleMesh) -> list[Surface]:
    """A box of two materials: its front, and all the rest."""
    front = mesh.face_normals[:, 1] < -0.5
    return [textured(mesh.with_faces(front), "front"), textured(mesh.with_faces(~front), "rest")]


def doubled(surface: Surface) -> Surface:
    mesh = surface.mesh
    twice = np.vstack([mesh.faces[:, ::-1], mesh.faces])
    return replace(surface, mesh=TriangleMesh(mesh.vertices, twice))


BOX = TriangleMesh.box_mesh(BOARD)
BODIES = {
    "a board": [textured(BOX)],
    "a board inside out": [textured(TriangleMesh(BOX.vertices, BOX.faces[:, ::-1]))],
    "a board drawn twice": [doubled(textured(BOX))],
    "a board with split vertices": [textured(TriangleMesh(BOX.triangles.reshape(-1, 3), np.arange(36).reshape(-1, 3)))],
    "a board of two materials": sides(BOX),
}


@pytest.mark.parametrize("name", BODIES)
def test_a_pocket_leaves_a_closed_body_without_its_volume(name):
    result = cut(*BODIES[name])
    assert result.volume == pytest.approx(0.03 * 0.01 * 0.1, rel=1e-9)
    mesh = whole(result)
    assert mesh.is_watertight
    assert mesh.to_trimesh().volume == pytest.approx(BOARD.volume - result.volume, rel=1e-9)
    assert result.is_whole


@pytest.mark.parametrize("name", BODIES)
def test_what_is_left_keeps_material_texture_and_colours(name):
    before, result = BODIES[name], cut(*BODIES[name])
    assert [s.material for s in result.surfaces] == [s.material for s in before]
    for surface in result.surfaces:
        v = surface.mesh.vertices
        assert surface.uv == pytest.approx(np.stack([2 * v[:, 0] + v[:, 1], 3 * v[:, 2] - v[:, 1]], axis=1))
        assert np.abs(surface.colors[:, :3] - 100 * v).max() <= 1.0
        assert np.linalg.norm(surface.normals, axis=1) == pytest.approx(1.0)


def test_the_skin_is_the_surface_that_was_cut_open():
    result = cut(*sides(BOX))
    assert result.skin == 0
    assert result.area == pytest.approx(0.03 * 0.1)
    assert result.surfaces[1].mesh.area == pytest.approx(sides(BOX)[1].mesh.area)


def test_normals_of_a_board_inside_out_come_to_look_outwards():
    flat = TriangleMesh(BOX.triangles.reshape(-1, 3), np.arange(36).reshape(-1, 3)[:, ::-1])
    inside_out = Surface(flat, normals=-np.repeat(BOX.face_normals, 3, axis=0))
    (surface,) = cut(inside_out).surfaces
    corners = surface.normals[surface.mesh.faces[:, 0]]
    assert np.einsum("ij,ij->i", corners, surface.mesh.face_normals).min() > 0.99


def test_a_sheet_is_clipped_and_gets_no_wall():
    sheet = textured(BOX.with_faces(BOX.face_normals[:, 1] < -0.5))
    result = cut(sheet)
    assert result.volume == 0.0
    assert len(result.wall.faces) == 0
    assert result.surfaces[0].mesh.area == pytest.approx(0.4 * 0.6 - 0.03 * 0.1)


def test_what_lies_aside_stays_the_very_same():
    aside = textured(BOX.translated(vec3(1.0, 0.0, 0.0)))
    result = cut(textured(BOX), aside)
    assert result.surfaces[1] is aside
    alone = cut(aside)
    assert alone.surfaces[0] is aside
    assert (alone.volume, alone.area, len(alone.wall.faces)) == (0.0, 0.0, 0)


def test_shells_that_run_through_one_another_are_each_cut_and_stay_closed():
    other = TriangleMesh.box_mesh(Box(vec3(0.25, -0.002, 0.1), vec3(0.32, 0.03, 0.5)))
    result = cut(textured(BOX), textured(other, "other"))
    assert patches_of(whole(result)).closed.all()
    assert result.volume > 0.03 * 0.01 * 0.1


def test_a_body_that_falls_apart_is_told():
    assert not cut(textured(BOX), box=Box(vec3(0.2, -1.0, -1.0), vec3(0.21, 1.0, 1.0))).is_whole
    assert not cut(textured(BOX), box=BOARD.grown(0.1)).is_whole


# Flush with a face, or so far inside that what is left before it is thicker than the micrometre within which points
# are one.
INSIDE = st.just(0.0) | st.floats(1e-3, 0.9)


@settings(max_examples=40, deadline=None)
@given(st.tuples(INSIDE, INSIDE, INSIDE), st.tuples(*[st.floats(0.05, 0.9)] * 3), st.floats(0.02, 20.0))
def test_any_box_cut_at_any_scale_takes_what_the_two_share(low, size, scale):
    board = Box(np.zeros(3), scale * np.array(BOARD.high))
    tool = Box(vec3(*low) * board.high, (vec3(*low) + vec3(*size)) * board.high + 1e-3 * scale)
    shared = Box(np.maximum(board.low, tool.low), np.minimum(board.high, tool.high)).volume
    result = cut(textured(TriangleMesh.box_mesh(board)), box=tool)
    assert result.volume == pytest.approx(shared, rel=1e-6)
    assert whole(result).is_watertight
