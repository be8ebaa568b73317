"""What is printed while a run goes on: bars on a terminal, lines in a pipe, JSON, silence, and the log."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from obj_inputs import write_cabinet

from grafu.cli import telling
from grafu.cli.main import main

QUICK = ("--motion", "rule", "--formats", "urdf", "--no-page")
TIME = re.compile(r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}[+-]\d\d:\d\d ")


def command(tmp_path: Path, *more: str, inputs: tuple[str, ...] = ("cabinet",)) -> list[str]:
    models = [str(write_cabinet(tmp_path, name)) for name in inputs]
    return ["functionalize", *models, "--out", str(tmp_path / "out"), *QUICK, *more]


def test_a_line_of_json_for_each_model_as_it_ends(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "bad.obj").write_text("no mesh")
    verb, *words = command(tmp_path, "--json", "--jobs", "2", inputs=("first", "second"))
    assert main([verb, str(tmp_path / "bad.obj"), *words]) == 1
    said = capsys.readouterr().out
    found = {one["name"]: one for one in map(json.loads, said.splitlines())}

    assert set(found) == {"first", "second", "bad"}
    good, bad = found["first"], found["bad"]
    assert (good["verdict"], good["error"], good["skipped"]) == ("yellow", None, [])  # the rule guesses
    assert [(joint["part"], joint["type"]) for joint in good["joints"]] == [
        ("door", "revolute"),
        ("drawer", "prismatic"),
    ]
    assert good["seconds"] > 0
    assert Path(good["folder"]) == tmp_path / "out" / "first"
    on_disk = {p.relative_to(good["folder"]).as_posix() for p in Path(good["folder"]).rglob("*") if p.is_file()}
    assert {*good["files"], ".grafu.json"} == on_disk
    assert (bad["verdict"], bad["joints"], bad["files"]) == (None, [], [])
    assert "bad.obj" in bad["error"]
    assert set(good) == set(bad)


def test_the_only_model_has_its_line_too_and_a_fault_has_its_reasons(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["functionalize", str(write_cabinet(tmp_path)), "--out", str(tmp_path / "out"), *QUICK[2:], "--json"]
    assert main([*words, "--motion", "annotation"]) == 0
    (line,) = capsys.readouterr().out.splitlines()
    found = json.loads(line)
    assert found["verdict"] == "red"
    assert {one["part"] for one in found["reasons"]} == {"door", "drawer"}
    assert [(one["request"], one["reason"]) for one in found["skipped"]] == [
        ("door", "no motion"),
        ("drawer", "no motion"),
    ]


def test_a_model_that_is_stopped_has_its_line(tmp_path: Path) -> None:
    words = command(tmp_path, "--json", "--timeout", "0.001")
    done = subprocess.run([sys.executable, "-m", "grafu", *words], capture_output=True, text=True, check=False)
    (line,) = done.stdout.splitlines()
    assert done.returncode == 2
    assert json.loads(line)["verdict"] is None
    assert "--timeout" in json.loads(line)["error"]


def test_quiet_prints_errors_alone(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(command(tmp_path, "--quiet", "--jobs", "1", inputs=("first", "second"))) == 0
    assert capsys.readouterr() == ("", "")
    assert main(command(tmp_path, "--quiet")) == 0
    assert main(command(tmp_path, "--quiet")) == 2  # it is there already
    assert capsys.readouterr().err.count("\n") == 1


@pytest.mark.parametrize("inputs", [("cabinet",), ("first", "second")])
def test_verbose_prints_each_stage_with_its_seconds(
    inputs: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(command(tmp_path, "-v", "--jobs", "1", inputs=inputs)) == 0
    said = capsys.readouterr().err
    for name in inputs:
        stages = re.findall(rf"^{name}: ([a-z ,]+): \d+\.\d\d s$", said, re.MULTILINE)
        assert stages[:3] == ["reading", "finding what touches", "deciding what moves"]
        assert "making the files" in stages


@pytest.mark.parametrize("more", [(), ("--quiet",), ("--json",)])
def test_the_log_holds_all_with_times_whatever_is_printed(
    more: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("FORCE_COLOR", "1")  # colours are for terminals
    log = tmp_path / "logs" / "new" / "run.log"  # in folders that are not there yet
    for code in (0, 2):  # the second time it is there already
        assert main(command(tmp_path, "--log", str(log), *more)) == code
    lines = log.read_text(encoding="utf-8").splitlines()

    assert all(TIME.match(line) for line in lines)
    plain = "\n".join(TIME.sub("", line) for line in lines)
    assert plain.count("cabinet: reading: ") == 1
    assert "cabinet: yellow, 2 joints" in plain
    assert "yellow: Works, but check" in plain
    assert "grafu: " in plain.splitlines()[-1]
    assert "\x1b" not in plain
    assert bool(capsys.readouterr().out) == (more != ("--quiet",))


def test_a_log_that_cannot_be_written_is_one_line_before_any_work(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(command(tmp_path, "--log", str(tmp_path))) == 2
    said = capsys.readouterr()
    assert (said.out, said.err.count("\n")) == ("", 1)
    assert "`--log` must be a file that can be written" in said.err
    assert not (tmp_path / "out").exists()


def test_the_streams_are_given_back(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = sys.stdout, sys.stderr
    main(["functionalize", str(tmp_path / "gone.obj"), "--out", str(tmp_path), "--log", str(tmp_path / "log")])
    assert (sys.stdout, sys.stderr) == before
    assert telling.beneath(sys.stdout) is sys.stdout


def on_terminal(words: list[str]) -> tuple[str, str]:
    """Returns stdout, and what a terminal at stderr receives."""
    import pty

    ours, theirs = pty.openpty()
    environment = {**os.environ, "TERM": "xterm", "COLUMNS": "100"}
    run = subprocess.Popen(
        [sys.executable, "-m", "grafu", *words], env=environment, stdout=subprocess.PIPE, stderr=theirs, text=True
    )
    os.close(theirs)
    seen = b""
    while True:
        try:
            part = os.read(ours, 65536)
        except OSError:  # the last that held the terminal has ended
            break
        seen += part
    os.close(ours)
    out, _ = run.communicate()
    return out, re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", seen.decode())


@pytest.mark.skipif(sys.platform != "linux", reason="it needs a pseudo-terminal")
def test_a_bar_on_a_terminal_names_the_models_in_work_from_the_first_moment(tmp_path: Path) -> None:
    out, seen = on_terminal(command(tmp_path, "--jobs", "2", inputs=("first", "second")))
    assert seen.startswith("first.obj and 1 more: starting")
    frames = [frame.strip() for frame in re.split(r"[\r\n]+", seen) if frame.strip()]
    assert any(re.search(r"inputs ━+ 0/2 .*first, second$", frame) for frame in frames)
    assert any("2/2" in frame for frame in frames)
    assert "2 joints built" not in seen
    assert "4 joints built" in out

    out, seen = on_terminal([*command(tmp_path), "--json"])
    assert seen == ""  # no bar between lines of JSON
    assert json.loads(out)["name"] == "cabinet"
    _, seen = on_terminal([*command(tmp_path), "--overwrite"])
    shown = set(re.findall(r"━ cabinet: ([a-z]+ing)", seen)) - {"starting"}
    assert len(shown) > 1  # the terminal is drawn ten times a second: which stages are seen depends on the machine
