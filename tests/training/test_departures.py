"""Where `base` departs from the paper: every field is named, each can be taken back, and the page states them all."""

from dataclasses import replace
from pathlib import Path

import pytest

from grafu.network.grafu import GraFu
from grafu.training.ablation import FULL, experiments
from grafu.training.config import BASE, CONFIGS, PAPER, SMALL, TINY, TrainingConfig
from grafu.training.departures import DEPARTURES, Departure, flat_values, taken_back, uncovered, without_departures

PAGE = Path(__file__).parents[2] / "docs" / "training.md"


def test_no_field_departs_in_silence() -> None:
    assert uncovered() == ()


def test_with_all_departures_taken_back_base_is_the_paper_s_run() -> None:
    made = replace(without_departures(BASE), steps=PAPER.steps, precision=PAPER.precision)
    period = replace(made.optimiser, period=PAPER.optimiser.period)
    assert replace(made, optimiser=period) == PAPER


@pytest.mark.parametrize("departure", DEPARTURES, ids=lambda one: one.name)
def test_a_departure_names_fields_that_differ(departure: Departure) -> None:
    ours, theirs = flat_values(BASE), flat_values(PAPER)
    assert departure.fields
    assert all(ours[name] != theirs[name] for name in departure.fields)


@pytest.mark.parametrize("config", [SMALL, TINY, BASE], ids=["small", "tiny", "base"])
def test_taking_one_back_changes_its_fields_alone(config: TrainingConfig) -> None:
    before = flat_values(config)
    for departure in DEPARTURES:
        after = flat_values(taken_back(config, departure))
        changed = {name for name in before if before[name] != after[name]}
        assert changed <= set(departure.fields), departure.name
        assert changed, departure.name
        assert after["network.hidden"] == before["network.hidden"]


def test_the_network_of_each_experiment_can_be_made() -> None:
    for row in experiments("departures", TINY):
        assert sum(p.numel() for p in GraFu(row.config.network).parameters()) > 0


def test_experiments_are_the_config_each_departure_and_all_of_them() -> None:
    names = [row.name for row in experiments("departures", SMALL)]
    assert names == [FULL, *(one.name for one in DEPARTURES), "paper"]


def test_the_page_states_each_departure() -> None:
    table = PAGE.read_text().split("<!-- departures:")[1].split("<!-- end of departures -->")[0]
    ours = flat_values(CONFIGS["base"])
    for departure in DEPARTURES:
        assert f"| `{departure.name}` |" in table
        assert departure.taken_back in table
        assert all(f"`{name}" in table for name in departure.fields if name in ours)
