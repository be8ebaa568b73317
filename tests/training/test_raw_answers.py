"""Figures of answers taken at their face."""

from dataclasses import replace
from math import isnan

import torch
from perfect_answers import perfect, two_cabinets

from grafu.graph.arrays import DOOR
from grafu.metrics.graph_accuracy import total_accuracy
from grafu.training.raw_answers import batch_accuracy


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
