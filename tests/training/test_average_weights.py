"""Weights of one network and of another with more inputs: their mean, and the one with what it lacks of the other."""

import sys
from dataclasses import replace
from pathlib import Path

import pytest
import torch

sys.path.insert(0, str(Path(__file__).parents[2] / "scripts"))

from average_weights import averaged, extended, network_of

from grafu.network.grafu import GraFu
from grafu.training.config import CONFIGS

WIDER = CONFIGS["tune"].network
NARROW = replace(WIDER, materials=False)
BOXES = "encoder.nodes.box.0.weight"


@pytest.fixture(scope="module")
def weights():
    """Two networks, the second with one input more; all weights of the first are 1, of the second 3."""
    return [
        {name: torch.full_like(value, fill) for name, value in GraFu(config).state_dict().items()}
        for config, fill in ((NARROW, 1.0), (WIDER, 3.0))
    ]


def test_a_mean_has_the_inputs_that_one_of_its_sources_knows(weights):
    narrow, wide = weights
    assert network_of(WIDER, [narrow, narrow]) == NARROW
    assert network_of(WIDER, [narrow, wide]) == WIDER
    mean = averaged([narrow, wide], wide)
    assert set(mean[BOXES][:, :-1].unique().tolist()) == {2.0}
    assert set(mean[BOXES][:, -1].unique().tolist()) == {3.0}


def test_only_what_is_new_comes_from_the_last_source(weights):
    narrow, wide = weights
    found = extended(narrow, wide, wide)
    assert found.keys() == wide.keys()
    assert set(found[BOXES][:, -1].unique().tolist()) == {3.0}
    assert set(found[BOXES][:, :-1].unique().tolist()) == {1.0}
    assert all(set(value.unique().tolist()) == {1.0} for name, value in found.items() if name != BOXES)
    assert set(wide[BOXES].unique().tolist()) == {3.0}
