"""Door leaves and drawer fronts of every style: solids inside their outline, with a face where it is said to be."""

from typing import get_args

import numpy as np
import pytest

from grafu.geometry.mesh import merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.synth.fronts.layout import LeafStyle, Rect
from grafu.synth.fronts.leaf_relief import LeafShape
from grafu.synth.fronts.leaves import face_at, filled_rect, leaf_surfaces
from grafu.synth.pieces.finish import PLAIN

STYLES = get_args(LeafStyle)
TALL, WIDE, SMALL = Rect(-0.2, 0.25, 0.1, 1.2), Rect(0.0, 1.1, 0.2, 0.5), Rect(0.0, 0.08, 0.0, 0.06)
every_style = pytest.mark.parametrize("style", STYLES)
THICK = 0.02


def leaf(style: str, rect: Rect = TALL, free: str = "right") -> LeafShape:
    return LeafShape(style, rect, -0.3, THICK, free)  # type: ignore[arg-type]


def meshes(shape: LeafShape):
    return [surface.mesh for surface in leaf_surfaces(shape, PLAIN)]


@every_style
@pytest.mark.parametrize("rect", [TALL, WIDE, SMALL], ids=["tall", "wide", "small"])
def test_leaves_are_closed_solids_that_fill_their_outline(style, rect):
    for mesh in meshes(leaf(style, rect)):
        assert mesh.is_watertight
        assert mesh.to_trimesh().volume > 0
    box = merge_meshes(meshes(leaf(style, rect))).box
    assert box.low[[0, 2]] == pytest.approx([rect.x0, rect.z0])
    assert box.high[[0, 2]] == pytest.approx([rect.x1, rect.z1])
    assert box.high[1] == pytest.approx(-0.3 + THICK)


@every_style
def test_only_curved_leaves_come_before_their_plane(style):
    before = -0.3 - merge_meshes(meshes(leaf(style))).box.low[1]
    assert before == pytest.approx({"bowed": 0.03, "swept": 0.06, "swept frame": 0.06}.get(style, 0.0))


@every_style
@pytest.mark.parametrize("at", [(0.5, 0.5), (0.9, 0.65), (0.3, 0.05), (0.5, 0.93)])
def test_the_face_is_where_it_is_said_to_be(style, at):
    shape = leaf(style)
    r = filled_rect(shape)
    x, z = r.x0 + at[0] * r.width + 0.0007, r.z0 + at[1] * r.height + 0.0007
    caster = RayCaster(merge_meshes(meshes(shape)))
    distance = caster.distances(np.array([[x, -1.0, z]]), np.array([[0.0, 1.0, 0.0]]))[0]
    tolerance = THICK if style in ("louvred", "muntins") else 0.003  # between slats and bars the face jumps
    assert face_at(shape, x, z) == pytest.approx(-1.0 + distance, abs=tolerance)


def test_a_swept_leaf_comes_forward_on_its_free_side():
    assert face_at(leaf("swept"), TALL.x1, 0.5) < face_at(leaf("swept"), TALL.x0, 0.5) - 0.05
    assert face_at(leaf("swept", free="left"), TALL.x1, 0.5) > face_at(leaf("swept", free="left"), TALL.x0, 0.5) + 0.05


@pytest.mark.parametrize(("style", "free", "x"), [("arched", "right", 0.025), ("half arched", "left", -0.2)])
def test_an_arch_is_highest_in_its_middle_or_on_the_free_side(style, free, x):
    shape = leaf(style, free=free)
    vertices = meshes(shape)[0].vertices
    top = vertices[vertices[:, 2] > filled_rect(shape).z1]
    assert top[np.argmax(top[:, 2]), 0] == pytest.approx(x)
    assert filled_rect(shape).z1 < TALL.z1


def test_mirrors_and_panes_have_materials_of_their_own():
    assert "mirror" in {s.material.name for s in leaf_surfaces(leaf("mirror"), PLAIN)}
    assert PLAIN.glass in {s.material for s in leaf_surfaces(leaf("muntins"), PLAIN)}


def test_louvres_are_one_mesh_of_many_slats():
    slats = meshes(leaf("louvred"))[-1]
    assert len(slats.faces) == 22 * 12


def test_a_wide_leaf_is_parted_by_a_stile_and_a_tall_one_by_a_rail():
    wide, tall = leaf("two panels", WIDE), leaf("two panels")
    assert face_at(wide, WIDE.x0 + 0.43 * WIDE.width, 0.35) == pytest.approx(-0.3)
    assert face_at(tall, 0.0, TALL.z0 + 0.43 * TALL.height) == pytest.approx(-0.3)
