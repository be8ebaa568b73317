"""Small files appear whole."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from grafu.cli.main import main
from grafu.errors import ExportError
from grafu.export.whole_file import clear_remains, hidden_name, write_whole
from small_assets import write_grouped_obj


def test_a_file_is_written_and_nothing_else(tmp_path: Path) -> None:
    write_whole("old", tmp_path / "new" / "a.txt")
    write_whole("é", tmp_path / "new" / "a.txt")
    assert (tmp_path / "new" / "a.txt").read_text(encoding="utf-8") == "é"
    assert len(list((tmp_path / "new").iterdir())) == 1


def test_what_cannot_be_written_is_said(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(ExportError, match="cannot write"):
        write_whole("text", tmp_path / "file" / "a.txt")


_DIES = """
import os, signal, sys
from pathlib import Path
from grafu.export import files
files._swap = lambda *_: os.kill(os.getpid(), signal.SIGKILL)
files.write_files(files.ExportFiles({"model.urdf": b"new"}), Path(sys.argv[1]), overwrite=True)
"""


def dead_process() -> int:
    process = subprocess.Popen([sys.executable, "-c", ""])
    process.wait()
    return process.pid


def of_process(path: Path, process: int) -> Path:
    return path.with_name(path.name.replace(f"-{os.getpid()}-", f"-{process}-"))


@pytest.mark.skipif(os.name != "posix", reason="no one can ask there whether a process lives")
def test_what_a_killed_process_was_writing_is_gone_after_the_next_run(tmp_path: Path) -> None:
    out = tmp_path / "out"
    killed = subprocess.run([sys.executable, "-c", _DIES, str(out / "cabinet")], check=False)
    assert killed.returncode == -signal.SIGKILL
    assert [path.name.endswith(".new") for path in out.iterdir()] == [True]

    command = [
        "functionalize",
        str(write_grouped_obj(tmp_path / "cabinet.obj")),
        "--formats",
        "urdf",
        "--no-page",
        "--out",
        str(out),
    ]
    assert main(command) == 0
    assert os.listdir(out) == ["cabinet"]


@pytest.mark.skipif(os.name != "posix", reason="no one can ask there whether a process lives")
def test_an_output_that_was_put_aside_comes_back_unless_its_place_is_taken(tmp_path: Path) -> None:
    dead = dead_process()
    for name in ("lost", "taken"):
        aside = of_process(hidden_name(tmp_path / name, "old"), dead)
        aside.mkdir()
        (aside / "model.urdf").write_text("old")
    (tmp_path / "taken").mkdir()
    of_process(hidden_name(tmp_path / "index.html", "new"), dead).touch()
    clear_remains(tmp_path)

    assert sorted(os.listdir(tmp_path)) == ["lost", "taken"]
    assert (tmp_path / "lost" / "model.urdf").read_text() == "old"
    assert os.listdir(tmp_path / "taken") == []


def test_what_is_being_made_or_is_none_of_ours_stays(tmp_path: Path) -> None:
    living = hidden_name(tmp_path / "a", "new")
    elsewhere = living.with_name(f".a.00000000-{dead_process()}-0123abcd.new")
    for path in (living, elsewhere, tmp_path / ".a.new", tmp_path / ".cache", tmp_path / "a.0-1-2.new"):
        path.mkdir()
    before = sorted(os.listdir(tmp_path))
    clear_remains(tmp_path)
    clear_remains(tmp_path / "nowhere")

    assert sorted(os.listdir(tmp_path)) == before


@pytest.mark.skipif(sys.platform != "linux", reason="only /proc tells")
def test_what_a_process_left_that_no_one_has_waited_for_is_cleared(tmp_path: Path) -> None:
    ended = subprocess.Popen([sys.executable, "-c", ""])
    os.waitid(os.P_PID, ended.pid, os.WEXITED | os.WNOWAIT)  # it is dead, and still has its number
    left = of_process(hidden_name(tmp_path / "a", "new"), ended.pid)
    left.mkdir()
    clear_remains(tmp_path)
    there = left.exists()
    ended.wait()

    assert not there
