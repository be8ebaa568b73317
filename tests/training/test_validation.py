"""The fixed set that weights are chosen by."""

from dataclasses import replace

import pytest
import torch
from little_runs import LITTLE, FewModels

from grafu.data.asked import VARIANTS
from grafu.graph.arrays import UNKNOWN
from grafu.network.grafu import GraFu
from grafu.training.source import SynthSource
from grafu.training.validation import SCORED, validate, validation_batches


def test_each_model_is_judged_three_times() -> None:
    batches = validation_batches(FewModels(), LITTLE)
    assert sum(len(batch) for batch in batches) == 3 * LITTLE.validation.models
    labels, mask = batches[0].graphs.labels, batches[0].graphs.mask
    assert (labels[1][mask[1]] == UNKNOWN).all()
    assert not (labels[0][mask[0]] == UNKNOWN).all()


def test_figures_have_a_score_and_leave_the_mode_alone() -> None:
    torch.manual_seed(0)
    network = GraFu(LITTLE.network).train()
    figures = validate(network, validation_batches(FewModels(), LITTLE), LITTLE.loss)
    assert network.training
    assert 0.0 <= figures["score"] <= 1.0
    assert {f"{variant}/{name}" for variant in VARIANTS for name in SCORED} <= figures.keys()
    assert figures == pytest.approx(
        validate(network, validation_batches(FewModels(), LITTLE), LITTLE.loss), nan_ok=True
    )


def test_batches_of_one_model_give_the_same_figures() -> None:
    torch.manual_seed(0)
    network = GraFu(LITTLE.network)
    single = replace(LITTLE, validation=replace(LITTLE.validation, batch=1))
    some, one = (validate(network, validation_batches(FewModels(), c), LITTLE.loss) for c in (LITTLE, single))
    del some["loss"], one["loss"]  # a mean over batches
    assert some == pytest.approx(one, nan_ok=True, abs=1e-4)


def test_judging_furniture_is_made_of_its_own_seed() -> None:
    batches = validation_batches(SynthSource(990_001, 64), LITTLE)
    assert sum(len(batch) for batch in batches) == 6
