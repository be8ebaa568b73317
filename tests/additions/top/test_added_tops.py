"""The slab that a topless piece is given: closed, on what carries it, out of the way of all that moves."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely.affinity import rotate
from shapely.geometry import Polygon, box
from topless import D, H, T, W, board, carcass, drawer, front, lift, merged, slide, swing

from grafu.additions.top.complete import missing_top
from grafu.additions.top.config import TopConfig, TopShape
from grafu.additions.top.section import slab_mesh, with_corners, without_block
from grafu.asset.part import Part
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.swept_body import SweptBody
from grafu.joints.limits import sweep
from grafu.joints.plan import JointRequest
from grafu.scene.obstacles import Obstacle
from grafu.vocabulary import PartLabel

SHAPES: tuple[TopShape, ...] = ("rectangle", "rounded", "chamfered", "oval", "capsule")
OAK = Material("oak", (0.5, 0.3, 0.1, 1.0))
CHROME = Material("chrome", (0.9, 0.9, 0.9, 1.0))


def added(parts: list[Part], *joints: JointRequest, config: TopConfig | None = None) -> Part:
    verdict = missing_top(parts, joints, config or TopConfig())
    assert verdict.addition is not None, verdict.why
    assert verdict.addition.part.mesh.is_watertight
    return verdict.addition.part


def volume(mesh: TriangleMesh) -> float:
    t = mesh.triangles
    return float(np.einsum("nd,nd->n", t[:, 0], np.cross(t[:, 1], t[:, 2])).sum() / 6)


def opens_freely(moving: Part, joint: JointRequest, top: Part, reach: float) -> bool:
    body = SweptBody(moving.mesh, 4e-4, np.eye(3))
    motion = joint.kind.along(joint.axis)
    return sweep(body, motion, reach, [Obstacle("top", MeshCollider(top.mesh))], 41).ratio == 0.0


@settings(max_examples=40, deadline=None)
@given(
    points=st.lists(st.tuples(st.floats(0.2, 1.0), st.floats(0.02, 0.6)), min_size=3, max_size=12),
    thickness=st.floats(0.005, 0.06),
    shape=st.sampled_from(SHAPES),
)
def test_slabs_are_closed_and_keep_to_their_outline(
    points: list[tuple[float, float]], thickness: float, shape: TopShape
) -> None:
    turns = np.cumsum([step for _, step in points])
    turns = turns / (turns[-1] + 0.3) * 2 * np.pi
    star = Polygon([(r * np.cos(a), r * np.sin(a)) for (r, _), a in zip(points, turns, strict=True)])
    if not star.is_valid or star.area < 1e-3:
        return
    mesh = slab_mesh(star, 0.7, 0.7 + thickness, shape, TopConfig().edge)
    assert mesh.is_watertight
    assert mesh.box.low[2] == pytest.approx(0.7)
    assert mesh.box.size[2] == pytest.approx(thickness)
    least = 1.0 if shape == "rectangle" else 0.3
    assert least * star.area * thickness - 1e-9 <= volume(mesh) <= star.area * thickness * (1 + 1e-6)


def test_slabs_have_holes_and_grooves() -> None:
    plate = box(-0.5, -0.3, 0.5, 0.3).difference(box(-0.2, -0.1, 0.2, 0.1))
    mesh = slab_mesh(plate, 0.0, 0.03, "chamfered", TopConfig().edge)
    assert mesh.is_watertight
    grooved = without_block(mesh, box(-0.6, -0.4, 0.6, -0.25), -0.01, 0.005)
    assert grooved.is_watertight
    assert volume(mesh) - volume(grooved) == pytest.approx(0.05 * 0.005 * 1.0, rel=1e-3)


@pytest.mark.parametrize(("outline", "low", "high"), [(Polygon(), 0.0, 1.0), (box(0, 0, 1, 1), 1.0, 1.0)])
def test_no_slab_without_an_outline_or_a_thickness(outline: Polygon, low: float, high: float) -> None:
    with pytest.raises(ValueError, match="a slab needs"):
        slab_mesh(outline, low, high)


@pytest.mark.parametrize(("shape", "corners"), [("rectangle", 4), ("chamfered", 8), ("rounded", 20)])
def test_shapes_break_the_corners(shape: TopShape, corners: int) -> None:
    outline = with_corners(box(-0.5, -0.3, 0.5, 0.3), shape, TopConfig().corner)
    assert len(outline.exterior.coords) - 1 == corners
    assert outline.bounds == pytest.approx((-0.5, -0.3, 0.5, 0.3))


@pytest.mark.parametrize(
    ("shape", "half", "area"),
    [("oval", (0.5 * 2**0.5, 0.3 * 2**0.5), np.pi * 0.3), ("capsule", (0.8, 0.3), 0.6 + np.pi * 0.09)],
)
@pytest.mark.parametrize("turn", [0.0, 0.4, np.pi / 2])
def test_ovals_and_capsules_hold_the_rectangle(shape: TopShape, half: tuple, area: float, turn: float) -> None:
    plain = rotate(box(-0.5, -0.3, 0.5, 0.3), turn, origin=(0.0, 0.0), use_radians=True)
    outline = with_corners(plain, shape, TopConfig().corner)
    assert outline.buffer(1e-3).contains(plain)
    assert outline.area == pytest.approx(area, rel=2e-3)
    back = rotate(outline, -turn, origin=(0.0, 0.0), use_radians=True)
    assert back.bounds == pytest.approx((-half[0], -half[1], half[0], half[1]), abs=1e-6)


def test_the_top_stands_on_the_sides_with_its_overhang_and_the_bodys_look() -> None:
    parts = [replace(p, surfaces=tuple(Surface(s.mesh, OAK) for s in p.surfaces)) for p in carcass()]
    door = front(H - 0.003)
    knob = board("handle", (0.3, -0.3, 0.5), (0.33, -D / 2 - T, 0.6), PartLabel.HANDLE)
    knob = replace(knob, surfaces=(Surface(knob.mesh, CHROME),), carried_by="door")
    top = added([*parts, door, knob], swing())
    assert top.box.low == pytest.approx([-W / 2 - 0.01, -D / 2 - T - 0.02, H], abs=1e-5)
    assert top.box.high == pytest.approx([W / 2 + 0.01, D / 2, H + 0.025], abs=1e-5)
    assert top.surfaces[0].material == OAK
    assert (top.label, top.labelled_by, top.carried_by) == (PartLabel.TOP_PANEL, "added", None)


def test_the_id_is_free() -> None:
    assert added([*carcass(), board("top_panel", (0.0, 0.0, 0.2), (0.1, 0.1, 0.22))]).id == "top_panel_1"


@pytest.mark.parametrize("rise", [-0.002, 0.0, 0.006, 0.014, 0.03])
def test_doors_open_below_and_before_it(rise: float) -> None:
    door = front(H + rise)
    top = added([*carcass(), door], swing())
    assert opens_freely(door, swing(), top, float(np.radians(90)))
    assert top.box.low[2] == pytest.approx(H, abs=1e-5)


@pytest.mark.parametrize("rise", [-0.002, 0.0, 0.006, 0.02])
def test_drawers_come_out_below_it(rise: float) -> None:
    box_ = drawer(H + rise)
    top = added([*carcass(), box_], slide())
    assert opens_freely(box_, slide(), top, 0.4)


def test_nothing_juts_out_over_a_flap_that_rises() -> None:
    door = front(H - 0.002)
    top = added([*carcass(), door], lift(height=H - 0.002))
    assert top.box.low[1] >= -D / 2 - T - 1e-6
    assert added([*carcass(), door], swing()).box.low[1] < -D / 2 - T - 0.01


def test_the_edge_over_flaps_between_legs_is_straight() -> None:
    """Flaps as wide as what lies between the legs: an overhang before the legs alone would stand out as two horns."""
    flap = board("door", (-W / 2 + 0.08, -D / 2 - T, H - 0.3), (W / 2 - 0.08, -D / 2, H - 0.002))
    legs = [
        board(f"leg_{side}", (side * (W / 2 - 0.04) - 0.04, -D / 2 - T, 0.0), (side * (W / 2 - 0.04) + 0.04, -D / 2, H))
        for side in (-1, 1)
    ]
    top = added([*carcass(), *legs, flap], lift(height=H - 0.002))
    front_edge = top.mesh.vertices[top.mesh.vertices[:, 1] < -D / 2 + 0.05]

    assert np.ptp(front_edge[:, 1]) <= 2e-3
    assert np.ptp(front_edge[:, 0]) >= W


def test_an_l_shaped_outline_stays_one() -> None:
    walls = [
        board("back", (0.0, 0.88, 0.0), (0.9, 0.9, H)),
        board("left", (0.0, 0.0, 0.0), (0.02, 0.88, H)),
        board("front_long", (0.0, 0.0, 0.0), (0.4, 0.02, H)),
        board("inner_a", (0.38, 0.02, 0.0), (0.4, 0.5, H)),
        board("inner_b", (0.4, 0.48, 0.0), (0.9, 0.5, H)),
        board("right", (0.88, 0.5, 0.0), (0.9, 0.88, H)),
    ]
    top = added(walls, config=TopConfig(front=0.0, side=0.0))
    assert volume(top.mesh) == pytest.approx(0.025 * (0.9 * 0.9 - 0.5 * 0.48), rel=0.01)


def test_a_cut_off_corner_stays_cut_off() -> None:
    corners = [(0.0, 0.0), (0.55, 0.0), (0.9, 0.35), (0.9, 0.9), (0.0, 0.9)]
    ring = Polygon(corners)
    shell = slab_mesh(ring.difference(ring.buffer(-0.02, join_style="mitre")), 0.0, H)
    body = replace(board("body", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), surfaces=(Surface(shell),))
    top = added([body], config=TopConfig(front=0.0, side=0.0))
    assert volume(top.mesh) == pytest.approx(0.025 * ring.area, rel=0.01)


def test_one_top_spans_a_kneehole() -> None:
    parts = [*carcass(0.4, x=-0.5), *carcass(0.4, x=0.5)]
    top = added(parts)
    assert top.box.size[0] == pytest.approx(1.42, abs=1e-3)
    assert missing_top([*parts, top]).covered


def test_posts_and_backs_that_go_through_are_left_out() -> None:
    post = merged("post", ((-0.02, -0.02, 0.0), (0.02, 0.02, 1.4)))
    mirror = board("mirror", (-W / 2, D / 2 - 0.01, 0.0), (W / 2, D / 2, 1.4))
    top = added([*carcass(), post, mirror])
    for part in (post, mirror):
        body = SweptBody(part.mesh, 4e-4, np.eye(3))
        body.place(np.eye(4))
        assert not body.penetrates(MeshCollider(top.mesh))


@pytest.mark.parametrize("shape", SHAPES)
def test_every_shape_covers(shape: TopShape) -> None:
    parts = [*carcass(), front(H - 0.003)]
    top = added(parts, swing(), config=TopConfig(shape=shape))
    after = missing_top([*parts, top], [swing()])
    assert after.covered
    assert after.ratio >= 0.97
