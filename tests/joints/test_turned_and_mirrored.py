"""Equivariance: turned and mirrored furniture gets the same mechanisms, turned and mirrored."""

import numpy as np
import pytest

from grafu.asset.edit import moved, scaled
from grafu.geometry.arrays import vec3
from grafu.geometry.transform import from_rotation, reflection, rotation_matrix
from grafu.vocabulary import JointType
from judging import installed, made_kind, realized, realized_kind, true_joints


def yaw(degrees: float) -> np.ndarray:
    return from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), np.radians(degrees)))


MIRROR_X, MIRROR_Y = (reflection(np.zeros(3), np.eye(3)[k]) for k in (0, 1))
MAPS = {"90": yaw(90), "180": yaw(180), "270": yaw(270), "mirror x": MIRROR_X, "mirror y": MIRROR_Y}
# one of each: doors and a drawer, a chained drawer, a divider, a flap, a lid, a slanted door, tables, clearance
WIDE = ("drawers behind an inset door", "table without aprons")
NARROW = (
    "half-overlay doors on one divider",
    "inset flap under an overhang",
    "chest with a lid",
    "corner door at 30 degrees",
    "sheets for doors",
    "inset door into the side",
    "drawer into both walls",
    "drawer fronts alone",
)
CASES = [(kind, name) for kind in WIDE for name in MAPS] + [
    (kind, list(MAPS)[k % len(MAPS)]) for k, kind in enumerate(NARROW)
]


def assert_same(kind: str, T: np.ndarray, length: float = 1.0) -> None:
    plain, mapped = installed(realized_kind(kind)), installed(realized(moved(made_kind(kind), T)))
    assert mapped.keys() == plain.keys()
    for part, outcome in mapped.items():
        before = plain[part]
        turns = before.type is JointType.REVOLUTE
        expected = before.axis.transformed(T, rotational=turns)
        assert (outcome.mechanism, outcome.template, outcome.count) == (
            before.mechanism,
            before.template,
            before.count,
        )
        assert outcome.opening == pytest.approx(before.opening * (1.0 if turns else length), abs=1e-3)
        assert set(outcome.after) == set(before.after)
        assert outcome.axis.angle_to(expected) < 1e-3
        assert not turns or outcome.axis.distance_to(expected.point) < 1e-3 * length


@pytest.mark.parametrize(("kind", "name"), CASES)
def test_a_turned_or_mirrored_piece_gets_the_same_mechanisms(kind, name):
    assert_same(kind, MAPS[name])


@pytest.mark.parametrize("degrees", [30.0, -45.0])
@pytest.mark.parametrize("kind", ["table without aprons", "sheets for doors"])
def test_a_piece_that_stands_askew_gets_the_same_mechanisms(kind, degrees):
    assert_same(kind, yaw(degrees))


@pytest.mark.parametrize("kind", ["inset pair", "whole drawer boxes"])
def test_a_mirror_image_carries_its_hardware_as_a_mirror_image(kind):
    plain, mapped = realized_kind(kind).object, realized(moved(made_kind(kind), MIRROR_X)).object
    for link in plain.links:
        expected = link.hardware_mesh.transformed(MIRROR_X).box
        found = mapped.link(link.id).hardware_mesh.box
        np.testing.assert_allclose([found.low, found.high], [expected.low, expected.high], atol=1e-4)


@pytest.mark.parametrize("factor", [0.5, 2.0])
@pytest.mark.parametrize("kind", ["overlay door, hinged right", "chest with a lid", "whole drawer boxes"])
def test_furniture_of_another_size_works_with_hardware_of_real_size(kind, factor):
    asset = scaled(made_kind(kind), factor)
    result = realized(asset)
    for part, joint in true_joints(asset).items():
        outcome = installed(result)[part]
        assert outcome.opening >= 0.7 * joint.upper
        assert outcome.collision_share == 0.0
    leaves = [v.mesh.box.size.max() for link in result.object.links for v in link.visuals if v.name.startswith("hinge")]
    assert max(leaves, default=0.0) <= 0.2  # a hinge does not grow with its door
