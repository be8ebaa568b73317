"""Rails: a mirrored pair beside the container, held on both sides, whatever the drawer hangs in."""

from math import radians

import numpy as np
import pytest
from judging import hardware, installed, made_kind, realized, realized_kind
from small_scenes import box, drawer, scene, sliding

from grafu.asset.edit import yawed
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import merge_meshes
from grafu.synth.cabinet import Cabinet, make_cabinet
from grafu.synth.case import Case
from grafu.synth.layout import Drawer, Stack
from grafu.vocabulary import MechanismClass


def boxes(visuals, word: str) -> np.ndarray:
    found = [v.mesh.box for v in visuals if word in v.name and v.name.startswith("rail")]
    return np.array([[b.low, b.high] for b in found])


@pytest.mark.parametrize("gap", [0.004, 0.0125, 0.04])
def test_the_rails_are_mirror_images(gap):
    moving, still = hardware(realized(drawer(gap)), "drawer")
    for side in (moving, still):
        (left,), (right,) = boxes(side, "_left_"), boxes(side, "_right_")
        np.testing.assert_allclose(left[0] * [-1, 1, 1], [right[1][0], *right[0][1:]], atol=1e-6)
        np.testing.assert_allclose(left[1] * [-1, 1, 1], [right[0][0], *right[1][1:]], atol=1e-6)


def test_rails_are_shorter_than_the_drawer_and_run_along_it():
    moving, still = hardware(realized(drawer()), "drawer")
    for low, high in (*boxes(moving, "rail"), *boxes(still, "rail")):
        assert low[1] >= -0.2
        assert high[1] <= 0.2 + 1e-9
        assert high[1] - low[1] == pytest.approx(0.9 * 0.4, rel=0.05)
        assert 0.02 <= low[2] <= high[2] <= 0.17


@pytest.mark.parametrize("gap", [0.0125, 0.03, 0.08])
def test_each_rail_touches_drawer_and_wall_or_a_block_bridges_the_gap(gap):
    asset, result = drawer(gap), realized(drawer(gap))
    moving, still = hardware(result, "drawer")
    container = MeshCollider(asset.part("drawer").mesh)
    case = MeshCollider(merge_meshes([p.mesh for p in asset.parts if p.id != "drawer"]))
    for side in ("_left_", "_right_"):
        assert min(MeshCollider(v.mesh).distance(container) for v in moving if side in v.name) <= 5e-4
        assert min(MeshCollider(v.mesh).distance(case) for v in still if side in v.name) <= 5e-4
    has_block = any(v.name.startswith("support") for v in still)
    assert has_block is (gap > 0.0125)


def test_a_drawer_keeps_a_lap_on_its_rails():
    outcome = installed(realized(drawer()))["drawer"]
    assert 0.7 * 0.4 <= outcome.opening <= 0.8 * 0.4
    assert (outcome.count, outcome.mechanism) == (2, MechanismClass.CENTRE)


def test_a_board_before_a_drawer_ends_its_travel():
    board = box("board", (-0.1, -0.33, 0.05), (0.1, -0.3, 0.1))
    asset = drawer()
    outcome = installed(realized(scene(*asset.parts, board, joints=asset.joints)))["drawer"]
    assert outcome.opening == pytest.approx(0.1, abs=0.005)
    assert outcome.restricted
    assert outcome.collision_share == 0.0


@pytest.mark.parametrize("degrees", [30.0, 180.0])
def test_drawers_may_face_any_way(degrees):
    asset = yawed(make_cabinet(Cabinet(case=Case(0.45), layout=Drawer(), mount="inset")), radians(degrees))
    outcome, (joint,) = installed(realized(asset))["drawer"], asset.joints
    assert outcome.opening >= 0.9 * joint.upper
    assert outcome.axis.angle_to(joint.axis) < 1e-3


@pytest.mark.parametrize("box_style", ["whole", "shell", "front only"])
@pytest.mark.parametrize("leaf", ["slab", "bowed"])
def test_containers_of_every_make_get_rails(box_style, leaf):
    asset = make_cabinet(Cabinet(case=Case(0.45), layout=Stack((Drawer(box_style, leaf),) * 2), mount="inset"))
    result = realized(asset)
    for joint in asset.joints:
        outcome = installed(result)[joint.part]
        assert outcome.opening >= 0.7 * joint.upper
        assert not outcome.restricted


def test_a_drawer_between_nothing_hangs_from_the_top_by_blocks():
    asset, result = made_kind("table without aprons"), realized_kind("table without aprons")
    top = MeshCollider(asset.part("table_top").mesh)
    for part in ("drawer_1", "drawer_2"):
        blocks = [v for v in hardware(result, part)[1] if v.name.startswith("support")]
        assert len(blocks) == 2
        assert min(MeshCollider(v.mesh).distance(top) for v in blocks) <= 5e-4


def test_a_drawer_that_opens_to_the_back_is_no_trouble():
    asset = drawer()
    parts = tuple(p for p in asset.parts if p.id != "back")
    outcome = installed(realized(scene(*parts, joints=(sliding("drawer", (0.0, 1.0, 0.0)),))))["drawer"]
    np.testing.assert_allclose(outcome.axis.direction, [0.0, 1.0, 0.0], atol=1e-9)
    assert outcome.opening == pytest.approx(0.3, abs=0.02)
