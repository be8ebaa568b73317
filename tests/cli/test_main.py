"""The command as a whole: help, version, exit codes, and the last door that errors meet."""

import subprocess
import sys
from pathlib import Path

import pytest

from grafu.cli import inspect
from grafu.cli.input_options import join_directions
from grafu.cli.main import build_parser, main
from grafu.version import __version__

VERBS = (
    "functionalize",
    "inspect",
    "show",
    "check",
    "edit",
    "templates",
    "doctor",
    "completion",
    "synth",
    "train",
    "ablate",
    "evaluate",
    "dataset",
)


def test_version(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(["--version"])
    assert end.value.code == 0
    assert capsys.readouterr().out == f"grafu {__version__}\n"


def test_no_verb_is_imported_but_the_one_that_is_asked_for() -> None:
    code = (
        "import sys\nfrom grafu.cli.main import build_parser\nbuild_parser(['functionalize', 'a.glb'])\n"
        f"print(*[verb for verb in {VERBS} if f'grafu.cli.{{verb}}' in sys.modules])"
    )
    assert subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout.split() == [
        "functionalize"
    ]


@pytest.mark.parametrize("verb", VERBS)
def test_every_verb_explains_itself_with_an_example(verb: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main([verb, "--help"])
    said = capsys.readouterr().out
    assert end.value.code == 0
    assert f"examples:\n  grafu {verb}" in said


@pytest.mark.parametrize(
    "arguments",
    [
        ["fly"],
        ["functionalize", "a.glb"],
        ["functionalize", "--out", "x"],
        ["functionalize", "a.glb", "--out", "x", "--motion", "wind"],
        ["functionalize", "a.glb", "--out", "x", "--jobs", "0"],
        ["functionalize", "a.glb", "--out", "x", "--jobs", "two"],
        ["inspect", "a.glb", "--height", "tall"],
        ["inspect", "a.glb", "--labels", "some"],
        ["synth", "--out", "x", "--count", "0"],
        ["synth", "--out", "x", "--count", "many"],
        ["synth", "--out", "x", "--seed", "-1"],
        ["synth", "--out", "x", "--points", "1.5"],
        ["synth", "--out", "x", "--jobs", "0"],
        ["synth", "--out", "x", "--format", "zip"],
        ["synth", "--out", "x", "--gallery", "--stats"],
        ["ablate", "heads", "--out", "x"],
        ["ablate", "losses"],
        ["ablate", "losses", "--out", "x", "--seeds"],
        ["ablate", "losses", "--out", "x", "--steps", "0"],
    ],
)
def test_wrong_arguments_are_one_line(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(arguments)
    assert end.value.code == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert said.startswith("grafu")
    assert "usage" not in said


def test_the_bare_command_shows_its_help(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([]) == 0
    said = capsys.readouterr().out
    assert all(f"  {verb} " in said or f"  {verb}\n" in said for verb in VERBS)


@pytest.mark.parametrize(
    ("arguments", "near"),
    [
        (["functionlize", "a.glb"], "`functionalize`"),
        (["functionalize", "a.glb", "--out", "x", "--formatz", "glb"], "`--formats`"),
        (["inspect", "a.glb", "--labels=nome"], "`none`"),
        (["inspect", "a.glb", "--hieght=0.7"], "`--height`"),
        (["train", "--out", "x", "--config", "tiney"], "`tiny`"),
        (["--verison"], "`--version`"),
        (["functionalize", "a.glb", "--outt", "x"], "`--out`"),  # not: --out is missing
        (["functionalize", "a.glb", "--outt=x"], "`--out`"),
        (["functionalize", "a.glb", "--out", "x", "--base", "fixd"], "`fixed`"),
        (["functionalize", "a.glb", "--out", "x", "--catch", "detnt"], "`detent`"),
        (["functionalize", "a.glb", "--out", "x", "--motion", "ntwork"], "`network`"),
        (["functionalize", "a.glb", "--out", "x", "--move", "door_1=rigth"], "`right`"),
        (["functionalize", "a.glb", "--out", "x", "--limit", "faecs=3"], "`faces`"),
    ],
)
def test_what_looks_alike_is_offered(arguments: list[str], near: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(arguments)
    assert end.value.code == 2
    assert f"did you mean {near}?" in capsys.readouterr().err


def test_what_is_missing_is_named_where_all_words_are_known(capsys: pytest.CaptureFixture[str]) -> None:
    for words in (["a.glb"], ["a.glb", "--formats=glb", "-v"], ["a.glb", "--", "--outt"], ["a.glb", "--scale", "-1"]):
        with pytest.raises(SystemExit):
            main(["functionalize", *words])
        assert "required: --out" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["functionalize", "-desk.glb", "--out", "x"], "write ./-desk.glb for the file of this name"),
        (["functionalize", "a.glb", "--out", "x", "--height", "72", "cm"], "one word, such as 72cm"),
        (["desk.glb"], "; for a model: grafu functionalize desk.glb --out results"),
    ],
)
def test_a_slip_is_answered_with_what_to_write(
    words: list[str], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("-desk.glb", "desk.glb"):
        (tmp_path / name).touch()
    with pytest.raises(SystemExit) as end:
        main(words)
    assert end.value.code == 2
    assert said in capsys.readouterr().err


def test_a_file_whose_name_steers_a_terminal_is_shown_with_escapes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("-\x1b[31m.glb", "\x1b[31m.glb"):
        (tmp_path / name).touch()
        with pytest.raises(SystemExit):
            main([name])
        assert "\x1b" not in capsys.readouterr().err


@pytest.mark.parametrize(("words", "usage"), [([], "grafu [-h]"), (["inspect"], "grafu inspect [-h]")])
def test_help_is_a_word_too(words: list[str], usage: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(["help", *words])
    assert end.value.code == 0
    assert capsys.readouterr().out.startswith(f"usage: {usage}")


@pytest.mark.parametrize(
    ("given", "meant"),
    [
        ("models/dek.glb", "models/desk.glb"),
        ("models/desk.gltf", "models/desk.glb"),
        ("modles/desk.glb", "models/desk.glb"),
        ("models/zero.glb", ""),  # the same ending makes no likeness
        ("models/x", ""),
    ],
)
def test_a_model_that_is_not_there_is_answered_with_the_one_that_is_spelled_so(
    given: str, meant: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "models").mkdir()
    (tmp_path / "models" / "desk.glb").touch()
    monkeypatch.chdir(tmp_path)
    assert main(["inspect", given]) == 2
    said = capsys.readouterr().err
    assert f"{given} does not exist" in said
    assert (f"; did you mean `{meant}`?" in said) if meant else ("expected a PartNet-Mobility folder" in said)


def test_a_link_to_nothing_and_an_empty_file_are_called_so(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "link.glb").symlink_to(tmp_path / "gone.glb")
    (tmp_path / "empty.urdf").touch()
    for name, said in (("link.glb", "does not exist: it is a link"), ("empty.urdf", "is empty: fetch or export")):
        assert main(["inspect", str(tmp_path / name)]) == 2
        assert f"{name} {said}" in capsys.readouterr().err


def test_what_looks_like_nothing_gets_no_offer(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["inspect", "a.glb", "--\x1b[31mzzzz"])
    said = capsys.readouterr().err
    assert "did you mean" not in said
    assert "\x1b" not in said


@pytest.mark.parametrize(
    "arguments",
    [
        ["--up", "sideways"],
        ["--up", "Z", "--front", "-Z"],
        ["--scale", "0"],
        ["--height", "-1"],
        ["--height", "nan"],
    ],
)
def test_wrong_values_are_one_line(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["inspect", "a.glb", *arguments]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert arguments[0] in said


def test_a_negative_axis_is_no_option() -> None:
    assert join_directions(["--front", "-Y", "--json", "-X"]) == ["--front=-Y", "--json", "-X"]
    options = build_parser().parse_args(join_directions(["inspect", "a.glb", "--front", "-y"]))
    assert options.front == "-y"


def fail(_: object) -> int:
    raise ZeroDivisionError("two\nlines")


def test_an_error_of_ours_is_owned_and_kept(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(inspect, "run", fail)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))

    assert main(["inspect", "a.glb"]) == 1

    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "our fault" in said
    [log] = tmp_path.iterdir()
    assert str(log) in said
    assert "ZeroDivisionError" in log.read_text()


def test_debug_prints_the_traceback(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(inspect, "run", fail)

    assert main(["inspect", "a.glb", "--debug"]) == 1
    assert "Traceback" in capsys.readouterr().err


def interrupt(_: object) -> int:
    raise KeyboardInterrupt


def test_an_interruption_is_clean(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(inspect, "run", interrupt)

    assert main(["inspect", "a.glb"]) == 130
    assert capsys.readouterr().err.count("\n") == 1
