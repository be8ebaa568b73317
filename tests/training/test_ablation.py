"""What an ablation trains: one thing at a time, against the config as it is."""

import csv
import io
import math
from dataclasses import fields

import pytest
from little_runs import LITTLE, FewModels

from grafu.data.corruption.corrupt import VARIANTS
from grafu.metrics.graph_accuracy import GraphAccuracy
from grafu.training import ablation
from grafu.training.ablation import (
    CHOICES,
    FOLDS_TRIED,
    FULL,
    MEAN,
    AblationResult,
    Experiment,
    FirstModels,
    csv_table,
    experiments,
    markdown_table,
    training_models,
)
from grafu.training.config import PAPER, SMALL
from grafu.training.loss_config import HOLD_OUTS, OFFICIAL
from grafu.training.loss_config import PAPER as PAPER_LOSS


def test_losses_are_held_out_and_chosen_one_by_one() -> None:
    first, *others = experiments("losses", SMALL)
    assert (first.name, first.config) == (FULL, SMALL)
    assert [row.name for row in others] == [*(f"no_{name}" for name in HOLD_OUTS), *CHOICES]
    by_name = {row.name: row.config.loss for row in others}
    assert by_name["paper"] == PAPER_LOSS
    assert by_name["official"] == OFFICIAL
    assert by_name["no_firing"].free_exists == by_name["no_firing"].count == 0.0
    assert len(set(by_name.values()) | {SMALL.loss}) == len(others) + 1


def test_all_but_the_loss_stays() -> None:
    for row in experiments("losses", SMALL):
        assert {name for name, value in vars(row.config).items() if value != vars(SMALL)[name]} <= {"loss"}


def test_single_choices_lead_from_ours_to_the_papers_and_the_authors() -> None:
    ours = vars(SMALL.loss)
    for goal in ("paper", "official"):
        wanted = {(name, value) for name, value in CHOICES[goal][1].items() if value != ours[name]}
        single = {change for name, (_, changes) in CHOICES.items() if name != goal for change in changes.items()}
        assert wanted <= single


def test_what_the_config_chooses_already_is_no_experiment() -> None:
    names = {row.name for row in experiments("losses", PAPER)}
    assert not names & {"paper", "all_assigned", "squared_boxes", "free_positive_10", "entropy_assigns"}
    assert {"official", "exists_balanced", "light_motions"} <= names


def test_copies_are_counted() -> None:
    rows = experiments("folds", SMALL)
    assert [row.config.mix.folds for row in rows] == [*FOLDS_TRIED, None]
    assert [row.config.mix.natural for row in rows[:2]] == [1.0, 1 / 6]
    assert {row.config.sampling.models * row.config.sampling.copies for row in rows} == {8}
    assert {row.config.sampling.copies for row in rows} == {1}


def test_copies_are_of_few_models_that_are_made_once() -> None:
    few = training_models("folds", FewModels())
    assert training_models("losses", FewModels()) == FewModels()
    assert few == FirstModels(FewModels(), ablation.FOLD_MODELS)
    assert few.name == "the first 200 models of few models"
    two = FirstModels(FewModels(), 2)
    assert two.pair(0) is two.pair(2) is two.pair(4)
    assert two.pair(1) is not two.pair(0)
    assert two.maker_seed == FewModels().maker_seed


def test_no_models_are_refused() -> None:
    with pytest.raises(ValueError, match="at least 1"):
        FirstModels(FewModels(), 0)


KIND_COUNTS = (("losses", 17), ("folds", 6), ("departures", 21))  # without points that are hidden, which it never does


def test_every_config_can_be_varied() -> None:
    assert all(len(experiments(kind, LITTLE)) == count for kind, count in KIND_COUNTS)


def result(name: str, value: float, seed: int = 1, **others: float) -> AblationResult:
    figures = {f"{variant}/{f.name}": value for variant in VARIANTS for f in fields(GraphAccuracy)}
    return AblationResult(Experiment(name, f"{name} in words", LITTLE), seed, figures | {"score": value} | others)


def cells(table: str, row: int) -> list[str]:
    return [cell.strip() for cell in table.splitlines()[row].strip("|").split("|")]


def test_a_figure_is_the_mean_over_what_has_it() -> None:
    one = result("full", 0.5, **{"natural/added": math.nan, "masked/added": 0.75})
    assert one.of(MEAN)["added"] == 0.625
    assert math.isnan(one.of("natural")["added"])
    none = result("full", 0.5, **{f"{variant}/rail": math.nan for variant in VARIANTS})
    assert math.isnan(none.of(MEAN)["rail"])


def test_the_best_of_a_column_is_bold() -> None:
    table = markdown_table([result("full", 0.9), result("no_parent", 0.8)])
    heads, full, other = (dict(zip(cells(table, 0), cells(table, row), strict=True)) for row in (0, 2, 3))
    assert heads["experiment"] == "experiment"
    assert (full["experiment"], full["hinge F1"], other["hinge F1"]) == ("`full`", "**0.900**", "0.800")
    assert (full["centre ↓"], other["centre ↓"]) == ("0.900", "**0.800**")
    assert "- `no_parent`: no_parent in words" in table


def test_nothing_is_bold_where_all_are_as_good() -> None:
    assert "**" not in markdown_table([result("full", 0.9), result("no_parent", 0.9)])


def test_several_seeds_are_one_row_with_their_deviation() -> None:
    table = markdown_table([result("full", 0.9), result("no_parent", 0.5), result("full", 0.7, seed=2)])
    assert cells(table, 2)[:2] == ["`full`", "**0.800** ± 0.141"]
    assert cells(table, 3)[:2] == ["`no_parent`", "0.500"]
    assert table.count("- `full`") == 1


def test_what_nobody_has_is_left_empty() -> None:
    missing = {f"{variant}/rail": math.nan for variant in VARIANTS}
    table = markdown_table([result("full", 0.9, **missing)])
    assert dict(zip(cells(table, 0), cells(table, 2), strict=True))["rail F1"] == ""


def test_the_csv_has_every_figure_of_every_input() -> None:
    rows = list(csv.DictReader(io.StringIO(csv_table([result("full", 0.25, **{"masked/rail": math.nan})]))))
    assert [row["input"] for row in rows] == [*VARIANTS, MEAN]
    assert set(rows[0]) == {"experiment", "seed", "input", *(f.name for f in fields(GraphAccuracy))}
    assert (rows[0]["rail"], rows[1]["rail"], rows[3]["rail"]) == ("0.25", "", "0.25")


def test_nothing_gives_an_empty_table() -> None:
    assert len(markdown_table([]).splitlines()) == 3
    assert len(csv_table([]).splitlines()) == 1
