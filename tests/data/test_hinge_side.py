"""A learner of a few lines, trained on made doors alone, knows on which side real doors hang."""

import os
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("sklearn")

from tools.hinge_side import SIDES, accuracy, real_doors, synthetic_doors

MODELS = Path(os.environ.get("GRAFU_MODELS", Path(__file__).parents[2].parent / "shared" / "models")) / "pnm"


def test_made_doors_are_described_by_finite_numbers():
    doors = synthetic_doors(12)
    assert {d.side for d in doors} <= set(SIDES)
    assert np.isfinite([d.features for d in doors]).all()
    assert len({d.features.shape for d in doors}) == 1


def test_a_mirror_image_swaps_left_and_right():
    from grafu.graph.edit import mirrored
    from grafu.synth.generate import make_specimen
    from tools.hinge_side import doors_in

    swap = {"left": "right", "right": "left", "top": "top", "bottom": "bottom"}
    for index in range(12):
        truth = make_specimen(0, index, 0).truth
        for door, image in zip(doors_in("a", truth), doors_in("b", mirrored(truth, 0)), strict=True):
            assert image.side == swap[door.side]
            np.testing.assert_allclose(image.handle[1:], door.handle[1:])
            np.testing.assert_allclose(image.handle[0], -door.handle[0], atol=1e-9)
            left, right = door.features[:2]
            np.testing.assert_allclose(image.features[:2], [1 - right, 1 - left], atol=1e-9)
            np.testing.assert_allclose(image.features[2:9], door.features[2:9])


@pytest.mark.slow
@pytest.mark.skipif(not MODELS.is_dir(), reason="the real furniture is not here")
def test_made_doors_teach_about_real_ones():
    train, asked = synthetic_doors(200), real_doors(MODELS)
    chance = max(float(np.mean([d.side == side for d in asked])) for side in SIDES)
    assert accuracy(train, asked, with_handles=True) > chance + 0.3
    assert accuracy(train, asked, with_handles=False) > chance + 0.2
