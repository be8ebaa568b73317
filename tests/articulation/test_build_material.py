from pathlib import Path

import numpy as np
import pytest

from grafu.articulation.articulated_object import Link, Visual, VisualRole
from grafu.articulation.build_material import MassConfig, MaterialBuild, builds_of
from grafu.articulation.mass import mass_of_link
from grafu.asset.load import load_asset
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.solids import ConvexSolid, subtract
from grafu.vocabulary import PartLabel

SAMPLES = Path(__file__).parents[2] / "samples"


def box(*size: float, at: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> TriangleMesh:
    return TriangleMesh.box_mesh(Box(vec3(*at), vec3(*at) + np.array(size)))


PANEL = box(0.4, 0.018, 0.7)


def mass_of(mesh: TriangleMesh, name: str = "", **visual) -> float:
    return mass_of_link(Link("a", (Visual("a", (Surface(mesh, Material(name)),), **visual),))).mass


@pytest.mark.parametrize(
    ("visual", "density"),
    [
        (Visual("door", (Surface(PANEL),)), 650),
        (Visual("door", (Surface(PANEL, Material("Frosted Glass 01")),)), 2500),
        (Visual("door", (Surface(PANEL, Material("pane", (1.0, 1.0, 1.0, 0.2), alpha_mode="BLEND")),)), 2500),
        (Visual("hinge_1", (Surface(PANEL),), VisualRole.HARDWARE), 7800),
        (Visual("support_1", (Surface(PANEL),), VisualRole.HARDWARE), 650),
        (Visual("handle_1", (Surface(PANEL),), label=PartLabel.HANDLE), 2700),
        (Visual("handle_1", (Surface(PANEL, Material("brass")),), label=PartLabel.HANDLE), 8500),
        (Visual("nothing", ()), 650),
    ],
)
def test_density_follows_material_role_and_label(visual, density):
    assert [build.density for build in builds_of(visual)] == [density]


def test_a_visual_of_two_materials_weighs_as_half_of_each():
    half = (Surface(PANEL, Material("steel sheet")), Surface(PANEL, Material("oak")))

    steel, oak = mass_of(PANEL, "steel sheet"), mass_of(PANEL, "oak")

    assert list(builds_of(Visual("door", half)).values()) == [0.5, 0.5]
    assert mass_of_link(Link("a", (Visual("a", half),))).mass == pytest.approx((steel + oak) / 2)


def test_a_panel_of_steel_is_folded_from_sheet():
    assert mass_of(PANEL, "brushed steel") == pytest.approx(7800 * 0.001 * PANEL.area)


def test_a_thick_pane_weighs_as_one_of_5_mm():
    assert mass_of(box(0.4, 0.02, 0.7), "glass") == pytest.approx(2500 * 0.005 * 0.4 * 0.7, rel=0.1)
    assert mass_of(box(0.4, 0.004, 0.7), "glass") == pytest.approx(2500 * 0.004 * 0.4 * 0.7)


def test_a_sheet_of_steel_without_thickness_is_1_mm():
    front = PANEL.with_faces(PANEL.face_normals[:, 1] < -0.5)

    assert mass_of(front, "metal") == pytest.approx(7800 * 0.001 * 0.4 * 0.7)


def test_boards_and_posts_of_wood_are_solid_and_a_thick_block_is_not():
    assert mass_of(PANEL) == pytest.approx(650 * 0.4 * 0.018 * 0.7)
    assert mass_of(box(0.07, 0.07, 0.7)) == pytest.approx(650 * 0.07 * 0.07 * 0.7)
    assert mass_of(box(0.6, 0.6, 0.85)) == pytest.approx(650 * 0.02 * box(0.6, 0.6, 0.85).area)


def test_a_hollow_block_turns_as_a_shell_does():
    side = 0.6
    made = mass_of_link(Link("a", (Visual("a", (Surface(box(side, side, side)),)),)))

    solid = made.mass * side**2 / 6
    assert np.diag(made.inertia) == pytest.approx(np.full(3, solid * 5 / 3), rel=1e-2)  # of a thin hollow cube


def tool_cabinet(material: str) -> Link:
    """A drawer cabinet as modellers draw it: a case of thick walls and five drawers."""
    case = subtract(Surface(box(1.1, 0.6, 0.9)), [hollow(1.05, 0.6, 0.85, at=(0.025, -0.025, 0.025))]).mesh
    drawers = [
        subtract(
            Surface(box(1.0, 0.55, 0.15, at=(0.05, 0.0, 0.03 + 0.17 * k))),
            [hollow(0.96, 0.51, 0.3, at=(0.07, 0.02, 0.05 + 0.17 * k))],
        ).mesh
        for k in range(5)
    ]
    return Link("body", (Visual("body", (Surface(merge_meshes([case, *drawers]), Material(material)),)),))


def hollow(*size: float, at: tuple[float, float, float]) -> ConvexSolid:
    made = ConvexSolid.around(box(*size, at=at).vertices)
    assert made is not None
    return made


@pytest.mark.parametrize("material", ["red_powder_coated_steel", "oak", "aluminium", "painted"])
def test_a_cabinet_weighs_what_cabinets_weigh(material):
    link = tool_cabinet(material)

    assert 40 <= mass_of_link(link).mass / link.mesh.box.volume <= 400  # kg of each cubic metre


@pytest.mark.parametrize("name", ["kitchen_base.glb", "dresser.glb"])
def test_samples_weigh_what_furniture_weighs(name):
    asset = load_asset(SAMPLES / name)
    link = Link("all", tuple(Visual(part.id, part.surfaces) for part in asset.parts))

    assert 40 <= mass_of_link(link).mass / link.mesh.box.volume <= 400


@pytest.mark.parametrize("name", ["density", "wall", "sheet"])
def test_a_build_without_substance_is_refused(name):
    with pytest.raises(ValueError, match=f"`MaterialBuild.{name}` must be above 0"):
        MaterialBuild(**{"density": 650.0, "wall": 0.02, "sheet": 0.016} | {name: 0.0})


def test_a_word_of_ones_own_counts():
    cork = MaterialBuild(200.0, 0.02, 0.005)
    stool = Visual("a", (Surface(PANEL, Material("Cork")),))

    assert builds_of(stool, MassConfig(build_by_word={"cork": cork})) == {cork: 1.0}
