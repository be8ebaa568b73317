"""The log of a run: each step once, also after it was cut."""

from pathlib import Path

import pytest

from grafu.errors import AssetError
from grafu.training.logbook import STEPS, VALIDATION, Logbook
from spoiled_files import SPOILS


def lines(path: Path) -> list[str]:
    return path.read_text(encoding="utf-8").split()


def test_lines_after_the_step_that_a_run_goes_on_from_are_forgotten(tmp_path: Path) -> None:
    book = Logbook(tmp_path)
    for step in (10, 20, 30):
        book.step(step, {"total": step / 4})
    book.validation(20, {"score": 0.5})
    book.close()
    again = Logbook(tmp_path, 20)
    again.step(30, {"total": 9.0, "new": 1.0})
    again.close()
    assert lines(tmp_path / STEPS) == ["step,total", "10,2.5", "20,5", "30,9"]
    assert lines(tmp_path / VALIDATION) == ["step,score", "20,0.5"]


def test_a_new_run_begins_a_new_log(tmp_path: Path) -> None:
    book = Logbook(tmp_path)
    book.step(10, {"total": 1.0})
    book.close()
    fresh = Logbook(tmp_path)
    fresh.step(10, {"other": 2.0})
    fresh.close()
    assert lines(tmp_path / STEPS) == ["step,other", "10,2"]


@pytest.mark.parametrize("what", SPOILS)
def test_a_log_that_is_no_plain_file_is_refused(tmp_path: Path, what: str) -> None:
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / STEPS).write_text("step,total\n10,1\n")
    SPOILS[what](tmp_path / "run" / STEPS)
    with pytest.raises(AssetError, match=what):
        Logbook(tmp_path / "run", 10)


def test_a_log_that_is_no_text_is_refused(tmp_path: Path) -> None:
    (tmp_path / STEPS).write_bytes(b"step\n\xff\n")
    with pytest.raises(AssetError, match=r"train.csv is damaged .*; remove it"):
        Logbook(tmp_path, 10)
