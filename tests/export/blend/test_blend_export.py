"""The side of the .blend export that needs no Blender: what it asks for, and how it fails."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import grafu.export.blend.exporter as exporter
from grafu.cli.main import main
from grafu.errors import ExportError
from grafu.export.blend.exporter import INTERPRETER_VARIABLE, export_blend, find_interpreter
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


def test_an_interpreter_can_be_named(monkeypatch, tmp_path):
    monkeypatch.setenv(INTERPRETER_VARIABLE, fake_python(tmp_path, "exit 0"))

    assert find_interpreter() == str(tmp_path / "python")
    assert exporter_for("blend") is export_blend


def test_a_named_interpreter_must_be_there(monkeypatch, tmp_path):
    monkeypatch.setenv(INTERPRETER_VARIABLE, str(tmp_path / "nothing"))

    with pytest.raises(ExportError, match="must name a Python"):
        find_interpreter()


def test_what_blender_says_last_is_passed_on(monkeypatch, tmp_path, cabinet):
    monkeypatch.setenv(INTERPRETER_VARIABLE, fake_python(tmp_path, "echo noise >&2; echo 'no display' >&2; exit 3"))

    with pytest.raises(ExportError, match=r"exit 3.*no display$"):
        export_blend(cabinet)


def test_a_blender_that_writes_nothing_is_no_success(monkeypatch, tmp_path, cabinet):
    monkeypatch.setenv(INTERPRETER_VARIABLE, fake_python(tmp_path, "exit 0"))

    with pytest.raises(ExportError, match=r"exit 0.*it said nothing"):
        export_blend(cabinet)


def test_a_blender_that_hangs_is_stopped_and_leaves_nothing(monkeypatch, tmp_path, cabinet):
    monkeypatch.setenv(INTERPRETER_VARIABLE, fake_python(tmp_path, "exec sleep 60"))
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)
    monkeypatch.setattr(exporter, "SECONDS", 0.3)

    with pytest.raises(ExportError, match="was stopped"):
        export_blend(cabinet)
    assert os.listdir(tmp_path) == ["python"]
