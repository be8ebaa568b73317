"""What an ablation trains: one thing at a time, against the config as it is."""

import pytest
from little_runs import LITTLE, FewModels

from grafu.training import ablation
from grafu.training.ablation import CHOICES, FOLDS_TRIED, FULL, FirstModels, experiments, training_models
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
    assert {row.config.deal.models * row.config.deal.copies for row in rows} == {8}
    assert {row.config.deal.copies for row in rows} == {1}


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


def test_every_config_can_be_varied() -> None:
    assert all(len(experiments(kind, LITTLE)) == count for kind, count in (("losses", 15), ("folds", 6)))
