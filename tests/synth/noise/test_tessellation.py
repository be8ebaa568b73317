"""How faces are drawn: boards keep their places and boxes, other shapes are left alone."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.graph.parse import parse_graph
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.fronts.layout import Door, Drawer, Stack
from grafu.synth.generate import as_exported, with_noise
from grafu.synth.noise.modelling_noise import ModellingNoise
from grafu.synth.noise.tessellation import SPLITS, STEPS, Density, is_two_sided, rounded_board, tessellated
from grafu.synth.truth.clashes import clashes_of

TIDY = make_cabinet(Cabinet(layout=Stack((Door(shelves=1), Drawer()))))
BOARD = "side_panel_left"


@pytest.mark.parametrize(("steps", "faces"), [(1, 44), (4, 236), (10, 1052)])
def test_rounded_boards_are_closed_and_fill_their_box_but_for_their_edges(steps: int, faces: int) -> None:
    box = Box(vec3(0.1, 0.2, 0.0), vec3(0.118, 0.7, 0.9))
    vertices, triangles = rounded_board(box.low[None], box.high[None], 0.002, steps)
    mesh = TriangleMesh(vertices[0], triangles)

    assert len(triangles) == faces
    assert mesh.is_watertight
    assert np.allclose([mesh.box.low, mesh.box.high], [box.low, box.high])
    assert 0.98 * TriangleMesh.box_mesh(box).area < mesh.area < TriangleMesh.box_mesh(box).area
    assert mesh.to_trimesh().volume == pytest.approx(box.volume, rel=0.01)


@pytest.mark.parametrize("density", [*STEPS, *SPLITS])
def test_finer_boards_stand_where_the_plain_ones_did(density: Density) -> None:
    fine = tessellated(TIDY, density)

    assert len(fine.part(BOARD).mesh.faces) > 40
    assert all(s.mesh.is_watertight for s in fine.part(BOARD).surfaces)
    for before, after in zip(TIDY.parts, fine.parts, strict=True):
        assert np.allclose([before.box.low, before.box.high], [after.box.low, after.box.high])
        assert len(after.mesh.faces) >= len(before.mesh.faces)


def test_faces_from_both_sides_are_twice_as_many_and_drawn_once() -> None:
    twice = tessellated(TIDY, both_sides=True)

    assert all(is_two_sided(s.mesh.faces) for p in twice.parts for s in p.surfaces)
    assert not any(is_two_sided(s.mesh.faces) for s in TIDY.part(BOARD).surfaces)
    assert tessellated(twice, both_sides=True).parts == twice.parts
    assert tessellated(TIDY) is TIDY


def test_boards_drawn_from_both_sides_are_boards_to_the_search_for_clashes() -> None:
    twice = tessellated(TIDY, both_sides=True)

    for joint in TIDY.joints:
        assert clashes_of(twice).hits(joint.part) == clashes_of(TIDY).hits(joint.part)


@pytest.mark.parametrize("density", ["broken edges", "split"])
def test_exported_specimens_touch_as_their_meshes_do(density: Density) -> None:
    noise = replace(ModellingNoise("clean cad"), density=density, edge=0.002, both_sides=True, missing=("top_panel",))
    plain = with_noise("made", "cabinet", TIDY, noise, 8)
    exported = as_exported(plain, noise)

    assert [p.id for p in exported.asset.parts] == [p.id for p in plain.asset.parts]
    assert exported.truth.hinges == plain.truth.hinges
    given = {frozenset((e.a, e.b)) for e in exported.given.contacts}
    parsed = {frozenset((e.a, e.b)) for e in parse_graph(exported.asset).contacts}
    assert given == parsed
    assert as_exported(plain, ModellingNoise("clean cad")) is plain
