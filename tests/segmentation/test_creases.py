"""Fronts that are drawn on one welded surface: grooves, raised and sunk panels, another material."""

import numpy as np
import pytest
import trimesh
from trimesh.visual import TextureVisuals
from trimesh.visual.material import PBRMaterial

import grafu
from grafu.asset.load import load_asset
from grafu.errors import UnsegmentedAsset
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.segmentation.backs import back_of
from grafu.segmentation.creased_surface import CreasedSurface
from grafu.segmentation.creases import drawn_fronts
from grafu.segmentation.surface_config import CreaseConfig
from solids import as_mesh, solid

FRONT = np.array([0.0, -1.0, 0.0])
SIZE = (0.6, 0.4, 0.8)
# Two drawers above each other and a door below them, each as x and z from the lower left corner.
FRONTS = (((0.03, 0.57), (0.64, 0.77)), ((0.03, 0.57), (0.48, 0.61)), ((0.03, 0.57), (0.03, 0.45)))


def cabinet(drawn: str, fronts=FRONTS) -> TriangleMesh:
    """One closed surface of a cabinet whose front, at y = 0, has fronts drawn on it."""
    body = solid((0, 0, 0), SIZE)
    for (left, right), (low, high) in fronts:
        if drawn == "groove":
            ring = solid((left - 0.004, -1, low - 0.004), (right + 0.004, 0.02, high + 0.004))
            body -= ring - solid((left, -2, low), (right, 2, high))
        elif drawn == "raised":
            body += solid((left, -0.015, low), (right, 0.1, high))
        else:
            body -= solid((left, -1, low), (right, 0.01, high))
    return as_mesh(body)


def cut(*meshes, materials=None):
    numbers = materials or [np.zeros(len(m.faces), np.int64) for m in meshes]
    return drawn_fronts(meshes, [True] * len(meshes), numbers)


def outlines(mesh, pieces, role="front"):
    boxes = [mesh.with_faces(piece.faces).box for piece in pieces if piece.role == role]
    return sorted(tuple(np.round([b.low[0], b.high[0], b.low[2], b.high[2]], 4)) for b in boxes)


EXPECTED = sorted((*x, *z) for x, z in FRONTS)


@pytest.mark.parametrize("drawn", ["groove", "raised", "sunk"])
def test_fronts_drawn_on_one_surface_are_found(drawn):
    mesh = cabinet(drawn)
    found = cut(mesh)
    assert outlines(mesh, found[0]) == EXPECTED
    assert all(np.allclose(piece.towards, FRONT) for piece in found[0] if piece.role == "front")
    assert sum(len(piece.faces) for piece in found[0]) == len(mesh.faces)


def as_downloaded(mesh: TriangleMesh) -> TriangleMesh:
    """The mesh in smaller faces, each drawn from both sides, in any order, and with corners of its own."""
    mesh = TriangleMesh(*trimesh.remesh.subdivide(*trimesh.remesh.subdivide(mesh.vertices, mesh.faces)))
    faces = np.random.default_rng(3).permutation(np.vstack([mesh.faces, mesh.faces[:, ::-1]]))
    return TriangleMesh(mesh.vertices[faces].reshape(-1, 3), np.arange(faces.size).reshape(-1, 3))


@pytest.mark.parametrize("drawn", ["groove", "raised", "sunk"])
def test_a_surface_that_is_drawn_from_both_sides_has_the_same_fronts(drawn):
    mesh = as_downloaded(cabinet(drawn))
    found = cut(mesh)
    assert outlines(mesh, found[0]) == EXPECTED
    assert sum(len(piece.faces) for piece in found[0]) == len(mesh.faces)


def test_each_material_of_a_surface_drawn_from_both_sides_is_a_front():
    mesh, drawn = even_faces()
    faces = np.vstack([mesh.faces, mesh.faces[:, ::-1]])
    found = cut(TriangleMesh(mesh.vertices, faces), materials=[np.tile(np.where(drawn > 0, 1, 0), 2)])
    assert [piece.role for piece in found[0]].count("front") == 2


def test_nothing_is_drawn_on_loose_triangles():
    fine = trimesh.creation.icosphere(subdivisions=5)
    triangles = np.asarray(fine.triangles)
    middle = triangles.mean(axis=1, keepdims=True)
    loose = (middle + 0.9 * (triangles - middle)).reshape(-1, 3)
    mesh = TriangleMesh(loose, np.arange(len(loose)).reshape(-1, 3))
    config, numbers = CreaseConfig(), np.zeros(len(mesh.faces), np.int64)
    assert len(mesh.faces) > config.most
    assert not CreasedSurface.of(mesh, numbers, config).patches(FRONT, config).any()


def test_a_low_step_along_a_wide_frame_is_a_corner():
    """The back has the edges of the fronts, as loops of edges run around a case: it must not come along."""
    xs, zs = (0.0, 0.02, 1.58, 1.6), (0.0, 0.02, 0.19, 0.21, 0.38, 0.4)
    fronts = [(x, z) for x in (1,) for z in (1, 3)]
    body = solid((0, 0, 0), (xs[-1], 0.4, zs[-1]))
    for x, z in fronts:
        body += solid((xs[x], -0.008, zs[z]), (xs[x + 1], 0.1, zs[z + 1]))
    mesh = as_mesh(body)
    for axis, places in ((0, xs), (2, zs)):
        for at in places[1:-1]:
            normal = np.eye(3)[axis]
            halves = [
                trimesh.intersections.slice_faces_plane(mesh.vertices, mesh.faces, sign * normal, at * normal)[:2]
                for sign in (1.0, -1.0)
            ]
            mesh = merge_meshes([TriangleMesh(*half) for half in halves])
    pieces = cut(mesh)[0]
    assert [mesh.with_faces(p.faces).box.high[1] for p in pieces if p.role == "front"] == pytest.approx([0.0, 0.0])


def test_straps_on_the_edge_of_a_lid_do_not_part_it_into_drawers():
    """Each face between two straps has a piece of the lid behind it, as deep as a drawer."""
    lid = solid((-0.02, -0.02, 0.9), (1.02, 0.68, 0.97))
    for x in (0.25, 0.6):
        lid += solid((x, -0.03, 0.9), (x + 0.02, -0.01, 0.97))
    assert cut(as_mesh(lid), as_mesh(solid((0, 0, 0), (1, 0.66, 0.9)))) == {}


@pytest.mark.parametrize("turn", [1, 2, 3])
def test_they_are_found_from_whichever_side_they_look(turn):
    T = np.linalg.matrix_power(np.array([[0.0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]), turn)
    found = cut(cabinet("groove").transformed(T))
    towards = [piece.towards for piece in found[0] if piece.role == "front"]
    assert len(towards) == 3
    assert np.allclose(towards, T[:3, :3] @ FRONT)


def test_a_surface_that_is_inside_out_is_read_as_it_is_meant():
    mesh = cabinet("groove")
    turned, one = TriangleMesh(mesh.vertices, mesh.faces[:, ::-1]), np.zeros(len(mesh.faces), np.int64)
    config, views = CreaseConfig(), ((mesh, FRONT), (turned, -FRONT))
    found = [len(np.unique(CreasedSurface.of(m, one, config).patches(d, config))) for m, d in views]
    assert found[0] == found[1]


def test_another_material_draws_a_front_on_an_even_face():
    mesh, drawn = even_faces()
    found = cut(mesh, materials=[np.where(drawn > 0, 1, 0)])
    assert [piece.role for piece in found[0]].count("front") == 2


def even_faces():
    """A plain box in small faces, and for each face whether it lies in one of two fronts (1, 2) or elsewhere (0)."""
    body = trimesh.creation.box(SIZE)
    body.apply_translation(np.array(SIZE) / 2)
    mesh = TriangleMesh(*trimesh.remesh.subdivide_to_size(body.vertices, body.faces, max_edge=0.06))
    middles = mesh.triangles.mean(axis=1)
    ahead = (mesh.face_normals @ FRONT > 0.9) & (np.abs(middles[:, 0] - 0.3) < 0.25)
    upper = ahead & (middles[:, 2] > 0.45) & (middles[:, 2] < 0.75)
    lower = ahead & (middles[:, 2] > 0.05) & (middles[:, 2] < 0.4)
    return mesh, np.where(upper, 1, np.where(lower, 2, 0))


@pytest.mark.parametrize("islands", [True, False])
def test_islands_of_the_texture_draw_fronts_on_an_even_face(tmp_path, islands):
    mesh, drawn = even_faces()
    corners = mesh.triangles.reshape(-1, 3)
    of = np.repeat(drawn, 3) if islands else 0
    uv = corners[:, [0, 2]] * 0.3 + corners[:, 1:2] * 0.01 + np.multiply.outer(of, [0.31, 0.0])
    visual = TextureVisuals(uv=uv, material=PBRMaterial(baseColorFactor=[180, 120, 60, 255], name="oak"))
    body = trimesh.Trimesh(corners, np.arange(len(corners)).reshape(-1, 3), visual=visual, process=False)
    body.apply_transform(trimesh.transformations.rotation_matrix(-np.pi / 2, (1, 0, 0)))
    body.export(tmp_path / "cabinet.glb")
    if not islands:
        with pytest.raises(UnsegmentedAsset, match="along its creases, materials and texture islands"):
            load_asset(tmp_path / "cabinet.glb")
        return
    asset = load_asset(tmp_path / "cabinet.glb")
    fronts = [part for part in asset.parts if part.id.startswith("geometry_0_front")]
    assert len(fronts) == 2
    assert all(surface.uv is not None for part in fronts for surface in part.surfaces[:1])
    assert sorted(round(float(part.box.size[2]), 2) for part in fronts) == [0.3, 0.35]


@pytest.mark.parametrize(
    "mesh",
    [
        cabinet("groove", ()),
        cabinet("raised", FRONTS[2:]),
        TriangleMesh.from_trimesh(trimesh.creation.icosphere(3, 0.4)),
        TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), np.int64)),
    ],
    ids=["a plain box", "a single panel without a handle", "a ball", "nothing"],
)
def test_a_surface_without_clear_fronts_stays_whole(mesh):
    assert cut(mesh) == {}


def test_what_lies_behind_drawers_of_their_own_is_their_case():
    """Two panels raised on one surface, and three drawers on each that are objects of their own."""
    sides = ((0.03, 0.28), (0.32, 0.57))
    case = cabinet("raised", tuple((x, (0.05, 0.75)) for x in sides))
    plates = [
        as_mesh(solid((left + 0.01, -0.035, low), (right - 0.01, -0.015, low + 0.21)))
        for left, right in sides
        for low in (0.06, 0.29, 0.52)
    ]
    assert [piece.role for piece in cut(case)[0]].count("front") == 2
    assert cut(case, *plates) == {}


def test_where_an_object_is_a_front_none_is_drawn_on_the_other_sides():
    T = np.array([[0.0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    case = cabinet("raised").transformed(T)
    low, high = case.box.low, case.box.high
    door = as_mesh(solid((low[0] + 0.01, low[1] - 0.02, 0.01), (high[0] - 0.03, low[1], 0.79)))
    assert [piece.role for piece in cut(case)[0]].count("front") == 3
    assert cut(case, door) == {}


@pytest.mark.parametrize("is_held", [True, False])
def test_beside_a_door_of_its_own_only_drawn_fronts_with_handles_count(is_held):
    case, door = cabinet("raised"), as_mesh(solid((0.61, -0.02, 0.02), (1.18, 0.0, 0.78)))
    bars = [as_mesh(solid((0.2, -0.045, z), (0.4, -0.02, z + 0.015))) for z in (0.7, 0.54, 0.38)]
    found = cut(merge_meshes([case, *bars]) if is_held else case, as_mesh(solid((0.6, 0, 0), (1.2, 0.4, 0.8))), door)
    assert [piece.role for piece in found.get(0, [])].count("front") == (3 if is_held else 0)


def test_a_single_front_with_a_handle_is_clear():
    handle = TriangleMesh.box_mesh(Box(np.array([0.5, -0.05, 0.2]), np.array([0.52, -0.015, 0.35])))
    mesh = merge_meshes([cabinet("raised", FRONTS[2:]), handle])
    assert [piece.role for piece in cut(mesh)[0]] == ["rest", "front", "handle"]


@pytest.mark.parametrize(("drawn", "thick"), [("groove", 0.02), ("raised", 0.015), ("sunk", 0.012)])
def test_a_front_gets_a_back_and_bounds_a_solid(drawn, thick):
    mesh = cabinet(drawn)
    for piece in cut(mesh)[0]:
        if piece.role == "front":
            front = mesh.with_faces(piece.faces)
            whole = merge_meshes([front, back_of(front, FRONT, 0.012)])
            assert whole.box.size[1] == pytest.approx(thick, abs=1e-6)
            assert trimesh.Trimesh(whole.vertices, whole.faces).is_watertight
            assert trimesh.Trimesh(whole.vertices, whole.faces).volume > 0


def test_such_a_cabinet_works_and_the_report_says_what_was_cut(tmp_path):
    mesh = cabinet("groove")
    material = PBRMaterial(baseColorFactor=[180, 120, 60, 255], name="oak")
    visual = TextureVisuals(uv=mesh.vertices[:, [0, 2]], material=material)
    path = tmp_path / "cabinet.glb"
    upright = trimesh.Trimesh(mesh.vertices, mesh.faces, visual=visual, process=False)
    upright.apply_transform(trimesh.transformations.rotation_matrix(-np.pi / 2, (1, 0, 0)))
    upright.export(path)
    result = grafu.functionalize(path)

    assert len(result.joints) == 3
    assert result.report.verdict.colour != "red"
    assert any("was cut into 3 fronts" in note for note in result.report.input.notes)
    fronts = [part for part in result.made.asset.parts if part.id in {joint.part for joint in result.joints}]
    assert {surface.material.name for part in fronts for surface in part.surfaces} == {"oak"}
