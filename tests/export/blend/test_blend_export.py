"""The side of the .blend export that needs no Blender: what it asks for, and how it fails."""

import os
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryFile
from typing import IO

import pytest

import grafu.export.blend.exporter as exporter
import grafu.export.blend.process as process
from grafu.cli.main import main
from grafu.errors import ExportError
from grafu.export.blend.exporter import INTERPRETER_VARIABLE, export_blend, find_interpreter
from grafu.export.blend.process import blender_process
from grafu.export.formats import exporter_for


@pytest.fixture
def without_blender(monkeypatch):
    monkeypatch.delenv(INTERPRETER_VARIABLE, raising=False)
    monkeypatch.setattr(exporter, "find_spec", lambda _: None)


def fake_python(folder: Path, script: str) -> str:
    path = folder / "python"
    path.write_text(f"#!/bin/sh\n{script}\n")
    path.chmod(0o700)
    return str(path)


@pytest.fixture
def blenders(monkeypatch, tmp_path):
    """Names a script as the Python with Blender; what it started is stopped in the end."""

    def name(script: str) -> str:
        path = fake_python(tmp_path, script)
        monkeypatch.setenv(INTERPRETER_VARIABLE, path)
        return path

    yield name
    blender_process(str(tmp_path / "python")).stop()


def test_without_blender_one_line_says_what_to_install(without_blender, cabinet):
    with pytest.raises(ExportError, match=r"pip install 'grafu\[blender\]'"):
        export_blend(cabinet)


def test_the_format_is_refused_before_anything_is_read(without_blender, tmp_path, capsys):
    arguments = ["functionalize", str(tmp_path / "missing.glb"), "--out", str(tmp_path / "out"), "--formats", "blend"]

    assert main(arguments) == 2
    error = capsys.readouterr().err
    assert "pip install 'grafu[blender]'" in error
    assert len(error.strip().splitlines()) == 1
    assert not (tmp_path / "out").exists()


def test_asking_for_the_exporter_imports_no_blender():
    code = "import sys, grafu.export.blend.exporter; sys.exit('bpy' in sys.modules)"

    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_an_interpreter_can_be_named(blenders):
    path = blenders("exit 0")

    assert find_interpreter() == path
    assert exporter_for("blend") is export_blend


def test_a_named_interpreter_must_be_there(monkeypatch, tmp_path):
    monkeypatch.setenv(INTERPRETER_VARIABLE, str(tmp_path / "nothing"))

    with pytest.raises(ExportError, match="must name a Python"):
        find_interpreter()


def test_what_blender_says_last_is_passed_on(blenders, cabinet):
    blenders("echo noise >&2; echo 'no display' >&2; exit 3")

    with pytest.raises(ExportError, match=r"exit 3.*no display$"):
        export_blend(cabinet)


@pytest.mark.parametrize("script", ["exit 0", "read line; echo written", "read line; echo Blender 5.0"])
def test_a_blender_that_writes_nothing_is_no_success(blenders, cabinet, script):
    blenders(script)

    with pytest.raises(ExportError, match=r"exit 0.*it said nothing"):
        export_blend(cabinet)


WRITES = 'while IFS="	" read -r source target; do echo $$ > "$target"; echo written; done'


def test_one_blender_writes_several_models(blenders, cabinet):
    blenders(WRITES)

    assert export_blend(cabinet)["model.blend"] == export_blend(cabinet)["model.blend"]  # its process id


def test_after_some_models_a_fresh_blender_takes_over(blenders, cabinet, monkeypatch):
    blenders(WRITES)
    monkeypatch.setattr(process, "MODELS", 1)

    assert export_blend(cabinet)["model.blend"] != export_blend(cabinet)["model.blend"]


def test_after_a_failure_the_next_model_is_written(blenders, cabinet):
    blenders(f'if test -e "$0.failed"; then {WRITES}; else touch "$0.failed"; exit 1; fi')

    with pytest.raises(ExportError, match="exit 1"):
        export_blend(cabinet)
    assert export_blend(cabinet).names == ("model.blend",)


def test_a_blender_that_hangs_is_stopped_and_leaves_nothing(blenders, monkeypatch, tmp_path, cabinet):
    blenders("exec sleep 60")
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)
    monkeypatch.setattr(exporter, "SECONDS", 0.3)

    with pytest.raises(ExportError, match="was stopped"):
        export_blend(cabinet)
    assert os.listdir(tmp_path) == ["python"]


def opened_files(monkeypatch) -> list[IO[bytes]]:
    """Returns the temporary files that are opened from now on."""
    opened: list[IO[bytes]] = []

    def open_one() -> IO[bytes]:
        opened.append(TemporaryFile())  # noqa: SIM115  # whoever asked for it closes it
        return opened[-1]

    monkeypatch.setattr(process, "TemporaryFile", open_one)
    return opened


@pytest.mark.parametrize("script", [WRITES, "exit 3"])
def test_no_file_stays_open_when_blender_has_ended(tmp_path, cabinet, monkeypatch, script):
    opened = opened_files(monkeypatch)
    blender = process.BlenderProcess([fake_python(tmp_path, script)])
    assert not opened  # nor before it has begun
    for _ in range(2):
        with suppress(ExportError):
            blender.write(tmp_path / "x.packed", tmp_path / "model.blend", 30.0)
        blender.stop()
    assert len(opened) == 2
    assert all(file.closed for file in opened)


def test_a_blender_that_cannot_be_run_leaves_no_file_open(tmp_path, monkeypatch):
    opened = opened_files(monkeypatch)
    with pytest.raises(ExportError, match="cannot run"):
        process.BlenderProcess([str(tmp_path / "none")]).write(tmp_path / "x", tmp_path / "y", 30.0)
    assert [file.closed for file in opened] == [True]


def test_the_command_writes_a_blender_file(interpreter, tmp_path):
    sample = Path(__file__).parents[3] / "samples" / "sideboard.glb"
    arguments = ["functionalize", str(sample), "--out", str(tmp_path), "--formats", "blend", "--no-page"]

    assert main(arguments) == 0
    written = [".grafu.json", "graph.json", "model.blend", "report.json", "settings.json"]
    assert sorted(os.listdir(tmp_path / "sideboard")) == written
    assert (tmp_path / "sideboard" / "model.blend").read_bytes()[:4] in (b"BLEN", b"\x28\xb5\x2f\xfd")  # plain or zstd
