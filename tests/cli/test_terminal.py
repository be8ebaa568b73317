"""Names that others chose reach the terminal with what would steer it shown as escapes, whatever the verb."""

import json
import os
from pathlib import Path

import numpy as np
import pytest
from obj_inputs import CABINET, write_cabinet

from grafu.cli.job import Failed, Job, JobOptions
from grafu.cli.main import main
from grafu.cli.stage_bar import with_stages
from grafu.cli.summary import print_place, print_results
from grafu.cli.terminal import plain_table, wide_console
from grafu.cli.verb import internal_fault
from grafu.visible import visible

HOSTILE = "a\x1b]0;owned\x07\x1b[2J\u202egpj\x9b:door:"
SHOWN = r"a\x1b]0;owned\x07\x1b[2J\u202egpj\x9b:door:"

pytestmark = pytest.mark.skipif(os.name != "posix", reason="such names exist on POSIX alone")


def heard(capsys: pytest.CaptureFixture[str]) -> str:
    """Returns all that was said, once nothing in it steers a terminal."""
    said = "".join(capsys.readouterr())
    assert all(line == visible(line) for line in said.split("\n"))
    return said


@pytest.fixture
def hostile(tmp_path: Path) -> Path:
    named = {f"{name}{HOSTILE}" if name == "door" else name: corners for name, corners in CABINET.items()}
    return write_cabinet(tmp_path, HOSTILE, named)


def test_functionalize_shows_names_escaped(hostile: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / f"out{HOSTILE}"
    arguments = ["--out", str(out), "--formats", "urdf", "--no-page"]

    assert main(["functionalize", str(hostile), *arguments]) == 2  # no folder can be called so
    assert SHOWN in heard(capsys)
    hostile = hostile.rename(tmp_path / "\u202egpj.obj")
    assert main(["functionalize", str(hostile), *arguments]) == 0
    assert f"{SHOWN}/\\u202egpj" in heard(capsys)
    assert main(["functionalize", str(hostile), *arguments]) == 2  # it exists already
    assert f"{SHOWN}/\\u202egpj" in heard(capsys)


def test_several_inputs_are_shown_escaped(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    options = JobOptions(tmp_path)
    failed = [Failed(Job(Path(HOSTILE), f"{HOSTILE}{n}", options), f"{HOSTILE} is no model", True) for n in range(2)]
    print_results(failed)
    print_place("all on one page", tmp_path / HOSTILE)

    assert heard(capsys).count(SHOWN) == 5


def test_inspect_shows_names_escaped(hostile: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["inspect", str(hostile)]) == 0
    assert SHOWN in heard(capsys)

    assert main(["inspect", str(hostile), "--json"]) == 0
    assert json.loads(heard(capsys))["input"]["name"] == HOSTILE


@pytest.mark.parametrize(
    "arguments",
    [
        ["inspect", "gone"],
        ["functionalize", "gone", "--out", "out"],
        ["templates", "--templates", "gone"],
        ["synth", "--stats", "gone"],
        ["evaluate", "--out", "out", "--data", "gone"],
    ],
)
def test_what_is_not_there_is_named_escaped(
    arguments: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)

    assert main([HOSTILE if word == "gone" else word for word in arguments]) == 2
    assert SHOWN in heard(capsys)


def test_arguments_at_fault_are_shown_escaped(capsys: pytest.CaptureFixture[str]) -> None:
    for arguments in (["inspect", "a.glb", f"--{HOSTILE}"], [HOSTILE]):
        with pytest.raises(SystemExit):
            main(arguments)
        assert r"\x1b]0;owned" in heard(capsys)


def test_templates_says_where_it_wrote_escaped(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("gallery_sheet", "handle_sheet"):  # they are rendered, which takes seconds
        monkeypatch.setattr(f"grafu.render.gallery.{name}", lambda *_: np.zeros((2, 2, 4), np.uint8))
    assert main(["templates", "--out", str(tmp_path / HOSTILE)]) == 0
    assert SHOWN in heard(capsys)


def test_a_fault_of_ours_is_told_escaped(capsys: pytest.CaptureFixture[str]) -> None:
    assert SHOWN in visible(internal_fault(RuntimeError(HOSTILE), "grafu", debug=True))
    assert SHOWN in heard(capsys)


def test_a_line_break_in_a_name_makes_no_row(capsys: pytest.CaptureFixture[str]) -> None:
    table = plain_table("part", "notes")
    table.add_row("door\nfake  row", "\u2028")
    wide_console().print(table)

    assert heard(capsys).rstrip("\n").count("\n") == 1


def test_the_progress_shows_the_name_escaped(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("FORCE_COLOR", "1")  # as on a terminal
    monkeypatch.setenv("TERM", "xterm")
    with with_stages(HOSTILE) as on_stage:
        on_stage("load")
    said = capsys.readouterr().err

    assert SHOWN in said
    assert "\x1b]0;" not in said


def test_a_name_that_is_no_unicode_is_made_and_shown(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    named = tmp_path / os.fsdecode(b"caf\xe9.obj")
    try:
        write_cabinet(tmp_path).rename(named)
    except OSError:
        pytest.skip("this disk holds Unicode names alone")

    assert main(["inspect", str(named), "--json"]) == 0
    assert json.loads(heard(capsys))["input"]["name"] == r"caf\udce9"
    assert main(["functionalize", str(named), "--out", str(tmp_path / "out")]) == 0
    assert "out/caf_~" in heard(capsys)
    report = next((tmp_path / "out").glob("*/report.json"))
    assert json.loads(report.read_text(encoding="utf-8"))["input"]["path"] == visible(str(named))
