"""The same furniture gives the same joints, whatever tool wrote its file, in whatever unit and place."""

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import trimesh
from trimesh.transformations import rotation_matrix, scale_matrix, translation_matrix

import grafu
from exported_again import DRAWINGS, as_it_is, drawn_again, flattened
from grafu.pipeline.words import Colour
from grafu.vocabulary import JointType

SAMPLES = Path(__file__).parents[2] / "samples"
NEAR = 0.01  # metres of an axis, metres and radians of a range
PLACES = {
    "in millimetres": scale_matrix(1000.0),
    "far from the origin": translation_matrix([30.0, 2.0, -17.0]),
    "front to the side": rotation_matrix(np.pi / 2, [0.0, 1.0, 0.0]),
    "turned by 30 degrees": rotation_matrix(np.pi / 6, [0.0, 1.0, 0.0]),
    "Z up": rotation_matrix(np.pi / 2, [1.0, 0.0, 0.0]),
}
MADE: dict[str, Callable[[Path], trimesh.Scene]] = {
    **{draw.__name__: lambda sample, draw=draw: drawn_again(sample, draw) for draw in DRAWINGS},
    **{name: lambda sample, at=at: drawn_again(sample, as_it_is, at) for name, at in PLACES.items()},
    "without hierarchy": flattened,
}


@cache
def of_sample(name: str) -> grafu.Result:
    return grafu.functionalize(SAMPLES / f"{name}.glb")


@pytest.mark.parametrize("made", MADE)
@pytest.mark.parametrize("name", ["wardrobe", "sideboard"])
def test_the_same_furniture_has_the_same_joints(name: str, made: str, tmp_path: Path) -> None:
    expected, path = of_sample(name), tmp_path / f"{name}.glb"
    MADE[made](SAMPLES / path.name).export(path)

    found = grafu.functionalize(path)

    assert found.report.verdict.colour == expected.report.verdict.colour
    left = list(found.joints)
    for joint in expected.joints:
        at = np.array(joint.origin)
        same = min(left, key=lambda other: float(np.linalg.norm(at - np.array(other.origin))))
        assert same.type is joint.type
        np.testing.assert_allclose(same.origin, at, atol=NEAR)
        np.testing.assert_allclose(same.axis, joint.axis, atol=1e-3)
        np.testing.assert_allclose((same.lower, same.upper), (joint.lower, joint.upper), atol=NEAR)
        left.remove(same)
    assert left == []


@pytest.mark.parametrize("name", ["wardrobe", "sideboard"])
def test_a_mirror_image_has_the_mirrored_joints(name: str, tmp_path: Path) -> None:
    expected, path = of_sample(name), tmp_path / f"{name}.glb"
    drawn_again(SAMPLES / path.name, as_it_is, np.diag([-1.0, 1.0, 1.0, 1.0])).export(path)

    found = grafu.functionalize(path)

    assert found.report.verdict.colour == expected.report.verdict.colour
    left = list(found.joints)
    for joint in expected.joints:
        turns = joint.type is not JointType.PRISMATIC
        image = np.array([-1.0, 1.0, 1.0])
        at, axis = image * joint.origin, (-image if turns else image) * joint.axis  # what turns about is a pseudovector
        same = min(left, key=lambda other: float(np.linalg.norm(at - np.array(other.origin))))
        assert same.type is joint.type
        np.testing.assert_allclose(same.origin, at, atol=NEAR)
        np.testing.assert_allclose(same.axis, axis, atol=1e-3)
        np.testing.assert_allclose((same.lower, same.upper), (joint.lower, joint.upper), atol=NEAR)
        left.remove(same)
    assert left == []


@pytest.mark.parametrize("name", ["wardrobe", "sideboard"])
@pytest.mark.parametrize("sizes", [(1.12, 1.0, 0.92), (0.9, 1.08, 1.0)])
def test_furniture_that_is_wider_or_higher_has_the_same_kinds_of_joints(name: str, sizes, tmp_path: Path) -> None:
    expected, path = of_sample(name), tmp_path / f"{name}.glb"
    drawn_again(SAMPLES / path.name, as_it_is, np.diag([*sizes, 1.0])).export(path)

    found = grafu.functionalize(path)

    assert found.report.verdict.colour is not Colour.RED  # confidences may differ
    described = [
        sorted((str(joint.type), *np.round(joint.axis).tolist()) for joint in result.joints)
        for result in (found, expected)
    ]
    assert described[0] == described[1]
