"""Rails: a mirrored pair beside the container, held on both sides, whatever the drawer hangs in."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest

from grafu.asset.edit import yawed
from grafu.asset.part import Part
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import merge_meshes
from grafu.refusal import Reason
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Drawer, Stack
from grafu.vocabulary import MechanismClass
from judging import hardware, installed, made_kind, realized, realized_kind
from small_scenes import box, drawer, scene, sliding


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


def test_a_drawer_that_is_stated_to_come_out_further_keeps_a_shorter_lap():
    asset = drawer()
    stated = replace(asset, joints=(sliding("drawer", (0.0, -1.0, 0.0), upper=0.38),))
    outcome = installed(realized(stated))["drawer"]
    assert outcome.opening == pytest.approx(0.9 * 0.95 * 0.4, rel=0.01)
    assert (outcome.count, outcome.restricted) == (2, False)


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


def case_around(low: float, *, depth: float = 0.45) -> list[Part]:
    """Walls, back and floor of a case 0.44 m wide inside, its floor at `low`."""
    return [
        box("side_left", (-0.24, -0.2, 0.0), (-0.22, depth - 0.2, 0.3)),
        box("side_right", (0.22, -0.2, 0.0), (0.24, depth - 0.2, 0.3)),
        box("back", (-0.22, depth - 0.22, 0.0), (0.22, depth - 0.2, 0.3)),
        box("floor", (-0.22, -0.2, 0.0), (0.22, depth - 0.22, low)),
    ]


def test_a_container_of_parts_that_ride_behind_the_front_carries_the_rails():
    front = box("drawer", (-0.21, -0.22, 0.03), (0.21, -0.2, 0.25))
    walls = [
        box("board_left", (-0.2, -0.2, 0.04), (-0.19, 0.2, 0.2), carried_by="drawer"),
        box("board_right", (0.19, -0.2, 0.04), (0.2, 0.2, 0.2), carried_by="drawer"),
        box("board_back", (-0.19, 0.19, 0.04), (0.19, 0.2, 0.2), carried_by="drawer"),
    ]
    result = realized(scene(*case_around(0.02), front, *walls, joints=(sliding("drawer", (0.0, -1.0, 0.0)),)))
    moving, _ = hardware(result, "drawer")
    for low, high in boxes(moving, "rail"):
        assert min(abs(low[0]), abs(high[0])) == pytest.approx(0.2, abs=3e-3)
        assert high[1] - low[1] == pytest.approx(0.36, rel=0.1)


@pytest.mark.parametrize("height", [0.05, 0.2], ids=["low and thick", "before the floor's edge"])
def test_a_mere_front_slides_as_far_as_the_case_is_deep(height):
    front = box("drawer", (-0.24, -0.22, 0.02), (0.24, -0.2, 0.02 + height))
    pull = box("drawer_pull", (-0.1, -0.25, 0.03), (0.1, -0.22, 0.04))
    whole = replace(front, surfaces=(*front.surfaces, *pull.surfaces))  # drawn as one, as some makers do
    asset = scene(*case_around(0.02 + height / 4), whole, joints=(sliding("drawer", (0.0, -1.0, 0.0)),))
    outcome = installed(realized(asset))["drawer"]
    assert outcome.opening >= 0.25
    assert not outcome.restricted
    assert outcome.collision_share == 0


def test_a_mere_front_passes_the_stiles_of_a_face_frame():
    front = box("drawer", (-0.22, -0.24, 0.03), (0.22, -0.22, 0.25))
    stiles = [
        box("stile_left", (-0.24, -0.22, 0.0), (-0.19, -0.2, 0.3)),
        box("stile_right", (0.19, -0.22, 0.0), (0.24, -0.2, 0.3)),
    ]
    result = realized(scene(*case_around(0.02), *stiles, front, joints=(sliding("drawer", (0.0, -1.0, 0.0)),)))
    moving, _ = hardware(result, "drawer")
    assert installed(result)["drawer"].opening >= 0.25
    assert np.abs(boxes(moving, "rail")[:, :, 0]).max() <= 0.19


def test_a_drawer_that_cannot_go_as_far_as_asked_is_said_to_be_restricted():
    asset = drawer()
    asked = replace(asset, joints=(sliding("drawer", (0.0, -1.0, 0.0), upper=0.6),))
    outcome = installed(realized(asked))["drawer"]
    assert outcome.opening < 0.7 * 0.6
    assert outcome.restricted


def test_mere_fronts_on_both_sides_of_a_table_hang_from_its_top():
    top = box("table_top", (-0.5, -0.4, 0.7), (0.5, 0.4, 0.73))
    fronts = [
        box("drawer_1", (-0.2, -0.36, 0.62), (0.2, -0.35, 0.69)),
        box("drawer_2", (-0.2, 0.35, 0.62), (0.2, 0.36, 0.69)),
    ]
    joints = (sliding("drawer_1", (0.0, -1.0, 0.0), upper=0.2), sliding("drawer_2", (0.0, 1.0, 0.0), upper=0.2))
    found = installed(realized(scene(top, *fronts, joints=joints)))
    assert found.keys() == {"drawer_1", "drawer_2"}
    assert all(not outcome.restricted and outcome.mount == "table_top" for outcome in found.values())


@pytest.mark.parametrize("thick", [0.0, 1e-6, 0.001])
def test_a_level_sheet_has_no_flanks_for_rails(thick):
    walls = [part for part in drawer(0.003).parts if part.id != "drawer"]
    sheet = box("drawer", (-0.2, -0.2, 0.1), (0.2, 0.2, 0.1 + thick))
    result = realized(scene(*walls, sheet, joints=(sliding("drawer", (0.0, -1.0, 0.0)),)))
    assert [(refusal.part, refusal.reason) for refusal in result.report.skipped] == [("drawer", Reason.NO_ROOM)]
