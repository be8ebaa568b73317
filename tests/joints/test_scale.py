"""Models outside 0.5 to 4 m get the same joints and hardware as furniture of usual size, in their own scale."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import Asset
from grafu.geometry.axis import Axis
from grafu.geometry.config_checks import at_scale
from grafu.joints.config import RealizationConfig
from judging import GALLERY, hardware, installed, realized
from small_scenes import DOOR, box, drawer, hinged, scene

BESIDE = box("side", (-0.02, -0.02, 0.0), (-0.002, 0.4, 0.6))
FILLER = box("filler", (-0.6, 0.0, 0.0), (0.05, 0.02, 0.6))
BEHIND = box("side", (-0.02, 0.015, 0.0), (0.0, 0.4, 0.6))
BOARDS = [box(f"board_{z}", (-0.02, -0.02, z), (0.4, 0.4, z + 0.018)) for z in (-0.02, 0.602)]
DOORS = {
    "contact": scene(DOOR, BESIDE, joints=(hinged(),)),
    "perpendicular": scene(DOOR, FILLER, joints=(hinged(),)),
    "pivots": scene(DOOR, BEHIND, *BOARDS, joints=(hinged(),)),
}


def tall(asset: Asset, height: float) -> Asset:
    """The scene with a post whose height is the largest side."""
    behind, floor = float(asset.box.high[1]), float(asset.box.low[2])
    post = box("post", (-0.2, behind + 0.01, floor), (0.2, behind + 0.03, floor + height))
    return scene(*asset.parts, post, joints=asset.joints)


def scaled(asset: Asset, factor: float) -> Asset:
    T = np.diag([factor, factor, factor, 1.0])
    parts = (replace(p, surfaces=tuple(s.transformed(T) for s in p.surfaces)) for p in asset.parts)
    joints = (replace(j, axis=Axis(factor * np.asarray(j.axis.point), j.axis.direction)) for j in asset.joints)
    return scene(
        *parts, joints=tuple(replace(j, upper=motion_kind(j.type).length_scale(factor) * j.upper) for j in joints)
    )


CASES = [
    (drawer(), "drawer", 4.0, 10.0),
    (drawer(), "drawer", 0.5, 0.1),
    *((door, "door", 4.0, 10.0) for door in DOORS.values()),
]


@pytest.mark.parametrize(("asset", "moving", "height", "factor"), CASES, ids=["drawer", "small drawer", *DOORS])
def test_a_model_in_another_scale_gets_the_same_hardware_in_its_own(asset, moving, height, factor):
    usual = tall(asset, height)
    plain, other = realized(usual), realized(scaled(usual, factor))
    before, after = installed(plain)[moving], installed(other)[moving]
    assert (after.template, after.count, after.mechanism) == (before.template, before.count, before.mechanism)
    lengths = motion_kind(before.type).length_scale(factor)
    assert after.opening == pytest.approx(lengths * before.opening, rel=1e-6)
    for mine, theirs in zip(hardware(other, moving), hardware(plain, moving), strict=True):
        assert [v.name for v in mine] == [v.name for v in theirs]
        assert len(mine) >= 2
        for one, usual_one in zip(mine, theirs, strict=True):
            np.testing.assert_allclose(one.mesh.vertices, factor * usual_one.mesh.vertices, atol=1e-6 * factor)


def test_the_doors_hang_on_three_kinds_of_hardware():
    found = {kind: installed(realized(tall(asset, 4.0)))["door"] for kind, asset in DOORS.items()}
    assert {kind: outcome.template == "pivot" for kind, outcome in found.items()} == {
        "contact": False, "perpendicular": False, "pivots": True
    }  # fmt: skip


def test_furniture_of_usual_size_has_the_configuration_and_the_templates_as_they_are():
    config = RealizationConfig()
    assert at_scale(config, 1.0) is config
    assert GALLERY.at_scale(1.0) is GALLERY
    larger = at_scale(config, 2.0)
    assert larger.hinge.radius == 2 * config.hinge.radius
    assert larger.rail.flank.thinner == tuple(2 * length for length in config.rail.flank.thinner)
    assert larger.hinge.radius_ratio == config.hinge.radius_ratio
    assert [m.natural for m in GALLERY.at_scale(2.0).hinges] == [m.natural.scaled(2.0) for m in GALLERY.hinges]
