"""Physics for which there is no time: boxes stand for parts, and it states so; where there is time nothing changes."""

import gc
from dataclasses import replace

import numpy as np
import pytest

from clocks import Clock
from grafu.articulation import physics
from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual, VisualRole
from grafu.articulation.mass import moments_of, moments_of_box
from grafu.articulation.physics import physics_known, physics_of
from grafu.export.urdf import export_urdf
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box, OrientedBox
from grafu.geometry.budget import Budget
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.vocabulary import JointType, PartLabel

THICK = 0.015


def board(low: tuple[float, float, float], high: tuple[float, float, float]) -> TriangleMesh:
    return TriangleMesh.box_mesh(Box(vec3(*map(float, low)), vec3(*map(float, high))))


def visual(name: str, mesh: TriangleMesh) -> Visual:
    return Visual(name, (Surface(mesh, Material()),), VisualRole.PART, PartLabel.UNKNOWN)


@pytest.fixture
def cabinet() -> ArticulatedObject:
    """A carcass of two sides in one mesh, open between them, and a drawer that slides out."""
    sides = merge_meshes([board((0, 0, 0), (THICK, 0.4, 0.6)), board((0.5, 0, 0), (0.5 + THICK, 0.4, 0.6))])
    drawer = board((0.05, 0, 0.1), (0.45, 0.38, 0.3))
    joint = Joint(
        "rail",
        JointType.PRISMATIC,
        "base",
        "drawer",
        Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0)),
        JointLimits(0.0, 0.3),
    )
    links = Link("base", (visual("sides", sides),)), Link("drawer", (visual("drawer", drawer),))
    return ArticulatedObject("cabinet", "base", links, (joint,))


def spent() -> Budget:
    clock = Clock()
    budget = Budget.lasting(1.0, clock=clock)
    clock.now = 2.0
    return budget


def test_without_time_each_part_is_one_box_with_the_mass_of_boards(cabinet: ArticulatedObject) -> None:
    with spent().in_force():
        hasty = physics_of(cabinet)
    assert all(isinstance(shape, OrientedBox) for held in hasty.shapes.values() for shape in held)
    assert [len(hasty.shapes[link]) for link in ("base", "drawer")] == [1, 1]
    assert hasty.touching == (("base", "drawer"),)
    whole = physics_of(cabinet)
    assert 0.5 < hasty.masses["base"].mass / whole.masses["base"].mass < 2.0
    assert len(whole.shapes["base"]) == 2
    assert [note.split(":")[0] for note in hasty.notes] == [
        "2 parts got the mass of boards all over the box around",
        "2 parts collide as one box each",
        "collision shapes were not cut back where joints make them meet",
        "collision shapes were not cut where fingers go",
        "what is near at rest does not collide",
    ]


def test_what_was_found_in_haste_is_not_kept_for_who_has_time(cabinet: ArticulatedObject) -> None:
    with spent().in_force():
        physics_of(cabinet)
        assert physics_of(cabinet) is physics_of(cabinet)
    whole = physics_of(cabinet)
    assert whole.notes == ()
    assert physics_of(cabinet) is whole
    with spent().in_force():
        assert physics_of(cabinet) is whole


def test_shapes_that_are_left_out_are_noted_and_found_once() -> None:
    shelves = merge_meshes([board((0.3 * k, 0, 0.2), (0.3 * k + 0.02, 0.3, 0.5)) for k in range(70)])
    base = Link("base", (Visual("base", (Surface(shelves),)),))
    made = ArticulatedObject("o", "base", (base,), ())

    found = physics_of(made)

    assert found.notes == ("base does not collide where it is smallest: 64 shapes are kept, 6 are left out",)
    assert physics_of(made) is found
    assert export_urdf(made).notes == found.notes


def test_a_board_weighs_the_same_by_its_box() -> None:
    mesh = board((1.0, 0, 0), (1.0 + THICK, 0.5, 0.8))
    exact, by_box = moments_of(mesh), moments_of_box(mesh)
    assert by_box.volume == pytest.approx(exact.volume)
    np.testing.assert_allclose(by_box.first, exact.first)
    np.testing.assert_allclose(by_box.second, exact.second)


def test_no_faces_have_no_moments() -> None:
    assert moments_of_box(TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), np.int64))).volume == 0.0


def test_physics_is_known_of_the_object_itself_as_long_as_that_is_there(cabinet: ArticulatedObject) -> None:
    made = replace(cabinet, name="made")
    found, number = physics_of(made), id(made)
    assert physics_known(made) is found
    assert physics_known(replace(made)) is None
    del made
    gc.collect()
    assert number not in physics._LATEST
