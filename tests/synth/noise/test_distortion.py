"""Furniture out of shape, and joints that follow."""

import numpy as np
import pytest

from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.cabinets.corner import CornerCabinet, make_corner_cabinet
from grafu.synth.fronts.layout import Door, Drawer, Stack
from grafu.synth.noise.distortion import ajar, bent, stretched
from sweeping import collisions

TIDY = make_cabinet(Cabinet(layout=Stack((Door(), Drawer()))))


@pytest.mark.parametrize("factors", [(1.2, 0.8, 1.1), (-0.9, 1.0, 1.0), (-1.1, 1.2, 0.8)])
def test_a_stretched_model_stands_centred_and_still_works(factors: tuple[float, float, float]) -> None:
    asset = stretched(TIDY, np.array(factors))

    assert np.allclose(asset.box.size, TIDY.box.size * np.abs(factors))
    assert np.allclose(asset.box.low, [-asset.box.half[0], -asset.box.half[1], 0.0])
    assert not collisions(asset, "door")
    assert not collisions(asset, "drawer")


def test_slides_scale_and_angles_stay() -> None:
    before = {joint.part: joint for joint in TIDY.joints}
    after = {joint.part: joint for joint in stretched(TIDY, np.array([1.0, 1.25, 1.0])).joints}

    assert after["drawer"].upper == pytest.approx(1.25 * before["drawer"].upper)
    assert after["door"].upper == before["door"].upper


def test_a_mirrored_door_opens_the_other_way_about() -> None:
    before, after = TIDY.joints[0], stretched(TIDY, np.array([-1.0, 1.0, 1.0])).joints[0]

    assert np.allclose(after.axis.direction, -before.axis.direction)
    assert after.axis.point[0] == pytest.approx(-before.axis.point[0])


def test_an_angled_front_keeps_its_angle() -> None:
    corner = make_corner_cabinet(CornerCabinet())

    asset = stretched(corner, np.array([1.2, 0.8, 1.1]))

    assert np.allclose(asset.box.size / corner.box.size, [1.0, 1.0, 1.1])


def test_a_factor_of_nothing_is_refused() -> None:
    with pytest.raises(ValueError, match="must not be 0"):
        stretched(TIDY, np.array([1.0, 0.0, 1.0]))


@pytest.mark.parametrize("part", ["door", "drawer"])
def test_what_is_ajar_has_that_much_less_to_go(part: str) -> None:
    asset = ajar(TIDY, part, 0.25)
    before, after = (next(j for j in a.joints if j.part == part) for a in (TIDY, asset))

    assert after.upper == pytest.approx(0.75 * before.upper)
    assert after.lower == 0.0
    assert asset.part(part).box.low[1] < TIDY.part(part).box.low[1] - 0.02
    assert asset.part("side_panel_left") == TIDY.part("side_panel_left")


def test_handles_go_with_what_is_ajar() -> None:
    grip = next(p.id for p in TIDY.parts if p.carried_by == "drawer")

    shift = ajar(TIDY, "drawer", 0.5).part(grip).box.center - TIDY.part(grip).box.center

    assert np.allclose(shift, [0.0, -0.5 * TIDY.joints[-1].upper, 0.0])


def test_a_fraction_is_a_fraction() -> None:
    with pytest.raises(ValueError, match="ratio"):
        ajar(TIDY, "door", 1.5)


def test_a_bent_model_stays_within_the_amplitude() -> None:
    asset = bent(TIDY, 0.002, np.random.default_rng(0))

    for before, after in zip(TIDY.parts, asset.parts, strict=True):
        assert 0 < np.abs(before.mesh.vertices - after.mesh.vertices).max() <= 0.002 + 1e-12
