"""The fixed set that weights are chosen by."""

from dataclasses import replace
from math import isnan

import pytest
import torch
from little_runs import LITTLE, FewModels
from perfect_answers import perfect, two_cabinets

from grafu.data.corruption.corrupt import VARIANTS
from grafu.graph.arrays import DOOR, UNKNOWN
from grafu.metrics.graph_accuracy import total_accuracy
from grafu.network.grafu import GraFu
from grafu.training.source import SynthSource
from grafu.training.validation import SCORED, batch_accuracy, validate, validation_batches


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


def test_perfect_answers_are_perfect() -> None:
    targets = two_cabinets()
    for accuracy in batch_accuracy(perfect(targets), targets):
        figures = accuracy.by_name()
        errors = {figures.pop(name) for name in ("centre", "half", "added_centre")}
        assert max(errors) < 1e-6
        assert all(value == 1.0 or isnan(value) for value in figures.values()), figures


def test_a_door_on_the_other_side_is_wrong() -> None:
    targets = two_cabinets()
    right = perfect(targets)
    figures = total_accuracy(batch_accuracy(replace(right, border=right.border.flip(-1)), targets)).by_name()
    assert figures["border"] == figures["joint"] == 0.0
    assert figures["sign"] == figures["mount"] == 1.0


def test_what_no_slot_answers_for_is_missing() -> None:
    targets = two_cabinets()
    right = perfect(targets, free=4)
    silent = replace(right, exists=torch.full_like(right.exists, -5.0))
    first = batch_accuracy(silent, targets)[0]
    assert first.added.value == 0.0
    assert 0.9 < first.existence.value < 1.0


def test_a_door_taken_for_another_part_hangs_nowhere() -> None:
    targets = two_cabinets()
    right = perfect(targets)
    category = right.category.clone()
    category[..., DOOR] = -100.0
    figures = total_accuracy(batch_accuracy(replace(right, category=category), targets)).by_name()
    assert figures["mount"] == 0.0
    assert figures["category"] < 1.0
