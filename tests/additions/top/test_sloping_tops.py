"""A rim that slopes gets a top that follows it, no level one, and none where something closes it or it is no rim."""

from dataclasses import replace
from math import cos, radians

import numpy as np
import pytest

from grafu.additions.top.complete import TopVerdict, missing_tops
from grafu.additions.top.config import TopConfig
from grafu.asset.part import Asset, Part
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.joints.plan import JointRequest
from grafu.synth.cabinets.bureau import Bureau, make_bureau
from grafu.synth.pieces.shapes import prism_along_x
from grafu.vocabulary import JointType, PartLabel
from odd_rooms import BOARD, board, piece, under_a_slope_to_the_back, under_a_slope_to_the_side

PIECES = {
    "to the back": under_a_slope_to_the_back(),
    "steeper": under_a_slope_to_the_back(depth=0.8),
    "to the side": under_a_slope_to_the_side(door=True),
}
OVER_THE_SIDES = ("to the back", "steeper")  # the old top lies between them, the new one on them


def without(asset: Asset, *names: str) -> Asset:
    joints = tuple(joint for joint in asset.joints if joint.part not in names)
    return replace(asset, parts=tuple(part for part in asset.parts if part.id not in names), joints=joints)


def judged(asset: Asset, config: TopConfig = TopConfig()) -> TopVerdict:
    asked = [JointRequest(j.part, j.type, j.axis, "test", j.upper) for j in asset.joints]
    return missing_tops(asset.parts, asked, config)


def heights(mesh: TriangleMesh, points: np.ndarray, upwards: bool) -> np.ndarray:
    """Where vertical rays from far below or above meet a mesh first."""
    sign = 1.0 if upwards else -1.0
    origins = np.column_stack([points, np.full(len(points), -9.0 * sign)])
    return -9.0 * sign + sign * RayCaster(mesh).along(origins, np.array([0.0, 0.0, sign]))


@pytest.mark.parametrize("name", PIECES)
def test_a_sloping_rim_gets_the_top_that_it_had(name: str) -> None:
    asset = PIECES[name]
    old = asset.part("top")

    verdict = judged(without(asset, "top"))

    assert len(verdict.additions) == 1
    new = verdict.additions[0].part
    assert "slopes by" in verdict.why
    rng = np.random.default_rng(7)
    low, high = old.box.low[:2], old.box.high[:2]
    points = rng.uniform(low + 0.03, high - 0.03, (200, 2))
    rim = heights(old.mesh, points, name not in OVER_THE_SIDES)
    assert np.abs(heights(new.mesh, points, True) - rim).max() < 0.001
    upright = heights(new.mesh, points, False) - heights(new.mesh, points, True)
    assert upright == pytest.approx(0.025 / float(old.mesh.face_normals[:, 2].max()), rel=0.01)
    shape = new.mesh.to_trimesh()
    shape.merge_vertices(merge_tex=True, merge_norm=True)
    assert shape.is_watertight


@pytest.mark.parametrize("name", PIECES)
def test_what_has_its_sloping_top_gets_none(name: str) -> None:
    assert judged(PIECES[name]).additions == ()


def test_a_leaning_flap_closes_its_rim_itself() -> None:
    asset = make_bureau(Bureau(holes=0))

    assert judged(asset).additions == ()


def test_an_open_front_below_a_slope_is_no_rim() -> None:
    asset = without(under_a_slope_to_the_back(door=False), "top")

    assert not any("slop" in addition.style for addition in judged(asset).additions)


def test_cheeks_that_run_out_on_a_board_carry_no_top() -> None:
    desk = board((-0.5, -0.4, 0.70), (0.5, 0.4, 0.72))
    cheek = ((-0.4, 0.72), (0.4, 0.72), (0.4, 1.1))
    parts = (
        piece("desk", PartLabel.TOP_PANEL, desk),
        piece("left", PartLabel.SIDE_PANEL, prism_along_x(cheek, -0.5, BOARD - 0.5)),
        piece("right", PartLabel.SIDE_PANEL, prism_along_x(cheek, 0.5 - BOARD, 0.5)),
        piece("back", PartLabel.BACK_PANEL, board((BOARD - 0.5, 0.4 - BOARD, 0.72), (0.5 - BOARD, 0.4, 1.08))),
        piece("leg", PartLabel.LEG, board((-0.5, -0.4, 0.0), (0.5, 0.4, 0.70))),
    )

    assert not any("slop" in a.style for a in missing_tops(parts).additions)


def test_sizes_and_corners_are_those_that_are_asked_for() -> None:
    asset = without(PIECES["to the back"], "top")
    thick = judged(asset, replace(TopConfig(), thickness=0.04, side=0.05, front=0.0)).additions[0]
    thin = judged(asset, replace(TopConfig(), side=0.0, front=0.0)).additions[0]

    middle = np.array([[0.0, 0.0]])

    def rise(part: Part) -> float:
        return float((heights(part.mesh, middle, False) - heights(part.mesh, middle, True))[0])

    assert rise(thick.part) * cos(radians(45)) == pytest.approx(0.04, abs=1e-6)
    assert thick.part.box.size[0] - thin.part.box.size[0] == pytest.approx(0.1, abs=1e-6)
    assert judged(asset, replace(TopConfig(), shape="rounded")).additions[0].style == "sloping, rounded"


def test_a_lid_in_the_plane_is_a_top() -> None:
    asset = PIECES["to the back"]
    hinge = Axis(vec3(0.0, 0.43, 0.5), vec3(1.0, 0.0, 0.0))
    asked = [JointRequest("top", JointType.REVOLUTE, hinge, "test", radians(80))]

    assert missing_tops(asset.parts, asked).additions == ()
