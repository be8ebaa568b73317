"""Runs of an ablation: each goes on to its end, none twice, and no folder holds two things."""

import json
import math
import os
import signal
from dataclasses import replace
from pathlib import Path

import pytest
from little_runs import FewModels, little

from grafu.errors import ExportError, UnreadableAsset
from grafu.training import ablation_run
from grafu.training.ablation import Experiment
from grafu.training.ablation_run import AblationRun, begin_ablation, do_run, do_runs, known_figures
from grafu.training.checkpoint import load_best
from spoiled_files import DAMAGED, SPOILS

pytestmark = pytest.mark.usefixtures("one_thread", "remembered")


def a_run(folder: Path, name: str = "full", steps: int = 2, seed: int = 1) -> AblationRun:
    return AblationRun(Experiment(name, "as it is", little(steps)), seed, FewModels(), folder / name, "cpu")


def test_a_run_ends_with_its_figures_and_keeps_them(tmp_path: Path) -> None:
    run = a_run(tmp_path, seed=5)
    assert known_figures(run) is None
    *steps, last = do_run(run)
    assert [event.steps for event in steps] == [0, 1, 1]
    assert not any(event.is_last for event in steps)
    assert last.figures == known_figures(run) or any(math.isnan(value) for value in (last.figures or {}).values())
    assert load_best(run.folder).config == little(2, seed=5)
    assert "NaN" not in (run.folder / "figures.json").read_text()


def test_a_run_that_was_stopped_goes_on(tmp_path: Path) -> None:
    run = a_run(tmp_path, steps=4)
    for event in do_run(run):
        assert not event.is_last
        if event.steps:
            os.kill(os.getpid(), signal.SIGTERM)
    assert known_figures(run) is None
    *steps, last = do_run(run)
    assert [event.steps for event in steps] == [2, 1, 1]
    assert last.figures


def test_a_folder_with_another_run_is_refused(tmp_path: Path) -> None:
    list(do_run(a_run(tmp_path)))
    for other in (a_run(tmp_path, steps=3), a_run(tmp_path, seed=2)):
        with pytest.raises(UnreadableAsset, match="choose another --out"):
            known_figures(other)


def test_damaged_files_are_refused(tmp_path: Path) -> None:
    run = a_run(tmp_path)
    list(do_run(run))
    figures, config = run.folder / "figures.json", run.folder / "config.json"
    no_numbers = [b'{"schema": "grafu.ablation/1"}', b'{"schema": "grafu.ablation/1", "figures": {"score": "x"}}']
    for path, texts in ((figures, [b"{}", *no_numbers, *DAMAGED.values()]), (config, [*DAMAGED.values()])):
        whole = path.read_bytes()
        for text in texts:
            path.write_bytes(text)
            with pytest.raises(UnreadableAsset, match=r"remove|config"):
                known_figures(run)
        path.write_bytes(whole)
    SPOILS["link that leads out"](figures)
    with pytest.raises(UnreadableAsset, match="link that leads out"):
        known_figures(run)


def test_one_run_that_fails_leaves_the_others(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    begun = ablation_run.train

    def diverges(config, source, folder, workers, options):  # type: ignore[no-untyped-def]
        if folder.name == "bad":
            raise ArithmeticError("no numbers")
        return begun(config, source, folder, workers, options)

    monkeypatch.setattr(ablation_run, "train", diverges)
    last = [(run.folder.name, event) for run, event in do_runs([a_run(tmp_path, "bad"), a_run(tmp_path, "good")])]
    assert [(name, event.failure) for name, event in last if event.is_last] == [("bad", "no numbers"), ("good", "")]


def test_being_asked_to_stop_ends_all_runs(tmp_path: Path) -> None:
    seen = []
    for run, event in do_runs([a_run(tmp_path, "one", steps=4), a_run(tmp_path, "two", steps=4)]):
        seen.append(run.folder.name)
        if event.steps:
            os.kill(os.getpid(), signal.SIGTERM)
    assert set(seen) == {"one"}
    assert not (tmp_path / "two").exists()


def test_processes_do_the_same_as_one(tmp_path: Path) -> None:
    runs = [replace(run, source=run.source) for run in (a_run(tmp_path, "one"), a_run(tmp_path, "two"))]
    ended = {run.folder.name for run, event in do_runs(runs, jobs=2) if event.figures}
    assert ended == {"one", "two"}
    alone = a_run(tmp_path / "alone", "one")
    list(do_run(alone))
    one, other = known_figures(runs[0]), known_figures(alone)
    assert one is not None
    assert other is not None
    assert one == pytest.approx(other, nan_ok=True, abs=1e-5)


def test_processes_stop_together_and_go_on(tmp_path: Path) -> None:
    runs = [a_run(tmp_path, name, steps=5000) for name in ("one", "two")]
    for _, event in do_runs(runs, jobs=2):
        assert not event.is_last
        if event.steps:
            os.kill(os.getpid(), signal.SIGTERM)
    assert any((run.folder / "last.pt").is_file() for run in runs)
    assert all(known_figures(run) is None for run in runs)


def test_numbers_below_one_are_refused() -> None:
    with pytest.raises(ValueError, match="at least 1"):
        next(do_runs([], jobs=0))


def test_a_folder_keeps_to_one_ablation(tmp_path: Path) -> None:
    begin_ablation(tmp_path / "new", {"kind": "losses", "steps": "2"})
    begin_ablation(tmp_path / "new", {"kind": "losses", "steps": "2"})
    assert json.loads((tmp_path / "new" / "ablation.json").read_text())["kind"] == "losses"
    with pytest.raises(ExportError, match="another ablation"):
        begin_ablation(tmp_path / "new", {"kind": "folds", "steps": "2"})


def test_tables_of_others_stay(tmp_path: Path) -> None:
    (tmp_path / "table.csv").write_text("mine")

    with pytest.raises(ExportError, match=r"table\.csv"):
        begin_ablation(tmp_path, {"kind": "losses"})
    assert [path.name for path in tmp_path.iterdir()] == ["table.csv"]
