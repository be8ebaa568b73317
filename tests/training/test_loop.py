"""The loop: it learns, leaves its files, and a run that was cut ends as if it had not been."""

import json
import math
import os
import signal
from dataclasses import replace
from itertools import islice
from pathlib import Path

import pytest
import torch
from little_runs import FewModels, little

from grafu.errors import ExportError, UnreadableAsset
from grafu.network.grafu import GraFu
from grafu.training.checkpoint import BEST, LAST, load_best
from grafu.training.config import TrainingConfig
from grafu.training.departures import without_departures
from grafu.training.logbook import STEPS, VALIDATION
from grafu.training.loop import RunOptions, StepReport, multiplies_bfloat16, train
from grafu.training.workers import Workers

ALONE = Workers(0, 1, torch.device("cpu"))
OFTEN = RunOptions(log_every=1)

pytestmark = pytest.mark.usefixtures("one_thread", "remembered")


def run(
    config: TrainingConfig, folder: Path, options: RunOptions = OFTEN, steps: int | None = None
) -> list[StepReport]:
    reports = train(config, FewModels(), folder, ALONE, options)
    taken = list(islice(reports, steps))
    reports.close()
    return taken


def weights(folder: Path) -> dict[str, torch.Tensor]:
    return torch.load(folder / LAST, weights_only=True)["network"]


def test_a_run_leaves_its_files(tmp_path: Path) -> None:
    reports = run(little(4), tmp_path)
    assert [report.step for report in reports] == [0, 1, 2, 3, 4]
    assert [bool(report.figures) for report in reports] == [False, False, True, False, True]
    assert {path.name for path in tmp_path.iterdir()} >= {BEST, LAST, STEPS, VALIDATION, "config.json"}
    assert len((tmp_path / STEPS).read_text().splitlines()) == 5
    assert json.loads((tmp_path / "config.json").read_text())["steps"] == 4
    best = load_best(tmp_path)
    assert best.config == little(4)
    assert best.figures["score"] == pytest.approx(reports[-1].best)
    assert not best.network().training


def test_losses_fall(tmp_path: Path) -> None:
    config = little(30, validation=replace(little().validation, every=30))
    means = [report.means["total"] for report in run(config, tmp_path) if report.means]
    assert sum(means[-5:]) < 0.9 * sum(means[:5])


def test_a_run_that_was_asked_to_stop_goes_on_to_the_same_end(tmp_path: Path) -> None:
    whole, cut = tmp_path / "whole", tmp_path / "cut"
    run(little(6), whole)
    reports = train(little(6), FewModels(), cut, ALONE, OFTEN)
    for report in reports:
        if report.step == 3:
            os.kill(os.getpid(), signal.SIGTERM)
    assert report.step == 4
    rest = run(little(6), cut, RunOptions(log_every=1, resume=True))
    assert [report.step for report in rest] == [4, 5, 6]
    wanted, found = weights(whole), weights(cut)
    assert all(torch.allclose(value, found[name], atol=1e-6) for name, value in wanted.items())
    assert (whole / VALIDATION).read_text().splitlines()[-1][:9] == (cut / VALIDATION).read_text().splitlines()[-1][:9]


def test_a_run_that_is_there_is_neither_begun_again_nor_mixed_with_another(tmp_path: Path) -> None:
    run(little(2), tmp_path)
    with pytest.raises(ExportError, match="--resume"):
        run(little(2), tmp_path)
    with pytest.raises(UnreadableAsset, match="another `mirror`"):
        run(little(2, mirror=0.25), tmp_path, RunOptions(resume=True))
    (tmp_path / LAST).write_bytes(b"not a checkpoint")
    with pytest.raises(UnreadableAsset, match="cannot be read"):
        run(little(2), tmp_path, RunOptions(resume=True))


def test_more_steps_may_be_asked_for(tmp_path: Path) -> None:
    run(little(2), tmp_path)
    assert [report.step for report in run(little(3), tmp_path, RunOptions(resume=True))] == [2, 3]


def test_without_weights_nothing_is_exported(tmp_path: Path) -> None:
    with pytest.raises(UnreadableAsset, match="train first"):
        load_best(tmp_path)


def test_half_precision_learns_too(tmp_path: Path) -> None:
    reports = run(little(2, precision="bf16"), tmp_path)
    assert all(torch.isfinite(torch.tensor(report.means["total"])) for report in reports[1:])
    assert isinstance(multiplies_bfloat16(torch.device("cpu")), bool)


@pytest.mark.parametrize("name", ["config.json", "train.csv", "best.pt"])
def test_files_of_others_stay(tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_text('{"mine": 1}')
    with pytest.raises(ExportError, match="choose another --out"):
        run(little(2), tmp_path)
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [(name, '{"mine": 1}')]


def test_the_paper_s_network_and_losses_learn_and_are_judged(tmp_path: Path) -> None:
    config = without_departures(little(4))
    assert (config.network.slots, config.network.second_grouping, config.loss.pinned) == (55, True, False)
    reports = run(config, tmp_path)
    best = max(report.figures["score"] for report in reports if report.figures)
    assert best == pytest.approx(load_best(tmp_path).figures["score"])
    assert all(math.isfinite(value) for report in reports for value in report.means.values())
    fresh = GraFu(config.network).state_dict()
    assert weights(tmp_path).keys() == fresh.keys()
