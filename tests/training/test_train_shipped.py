"""The chain of runs and means that made the shipped weights: each begins with what was made before, none twice."""

import argparse
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from train_shipped import CHAIN, QUICK_STEPS, Mean, Run, commands, is_made  # noqa: E402

from grafu.cli.main import build_parser  # noqa: E402

OPTIONS = argparse.Namespace(list=False, quick=False, threads=1, jobs=1)


def files_of(stage: Run | Mean) -> set[str]:
    return {stage.made} if isinstance(stage, Mean) else {f"{stage.made}/best.pt", f"{stage.made}/last.pt"}


def test_each_stage_begins_with_what_was_made_before_and_the_last_one_is_what_ships() -> None:
    there = {"named.onnx"}
    for stage in CHAIN:
        assert set(stage.sources if isinstance(stage, Mean) else [stage.start]) <= there
        there |= files_of(stage)
    assert CHAIN[-1].made == "grafu.onnx"


def test_the_page_states_each_run() -> None:
    page = " ".join((ROOT / "docs" / "network.md").read_text("utf-8").split())
    for run in (stage for stage in CHAIN if isinstance(stage, Run)):
        assert (
            f"{run.steps:,} steps on that of commit {run.commit}" in page
            or f"{run.steps:,} on that of commit {run.commit}" in page
        )
    seeds = ", ".join(str(stage.seed) for stage in CHAIN if isinstance(stage, Run))
    assert f"(`tune`, seeds {seeds})" in page


@pytest.mark.parametrize("begun", [False, True])
def test_a_run_is_begun_once_and_then_resumed(begun: bool, tmp_path: Path) -> None:
    run = next(stage for stage in CHAIN if isinstance(stage, Run))
    if begun:
        (tmp_path / run.made).mkdir()
        (tmp_path / run.made / "last.pt").touch()
    words = next(words for stage, words in commands(tmp_path, OPTIONS) if stage is run)
    options = build_parser().parse_args(list(words[3:]))
    assert (options.resume, options.start) == ((True, None) if begun else (False, tmp_path / run.start))
    assert (options.config, options.steps, options.seed) == ("tune", run.steps, run.seed)


def test_what_is_made_is_not_made_again(tmp_path: Path) -> None:
    run, mean = CHAIN[0], CHAIN[1]
    assert not is_made(tmp_path, run, quick=False)
    (tmp_path / run.made).mkdir()
    log = tmp_path / run.made / "validation.csv"
    log.write_text(f"step,loss\n500,1.0\n{run.steps - 100},1.0\n")
    assert not is_made(tmp_path, run, quick=False)
    log.write_text(f"step,loss\n500,1.0\n{run.steps},1.0\n")
    assert is_made(tmp_path, run, quick=False)
    assert not is_made(tmp_path, run, quick=True)
    log.write_text(f"step,loss\n{QUICK_STEPS},1.0\n")
    assert is_made(tmp_path, run, quick=True)
    assert not is_made(tmp_path, mean, quick=False)
    (tmp_path / mean.made).touch()
    assert is_made(tmp_path, mean, quick=False)


def test_a_command_that_fails_ends_the_chain_with_its_code(tmp_path: Path) -> None:
    (tmp_path / "named.onnx").write_bytes(b"no weights")
    (tmp_path / "code").mkdir()
    for stage in CHAIN:
        if isinstance(stage, Run):
            (tmp_path / "code" / stage.commit).symlink_to(ROOT)
    script = [sys.executable, str(ROOT / "scripts" / "train_shipped.py"), "--out", str(tmp_path), "--quick"]
    done = subprocess.run(script, capture_output=True, text=True, cwd=ROOT)
    assert done.returncode != 0
    assert "the same command goes on from here" in done.stderr
    assert not (tmp_path / "second.onnx").exists()
