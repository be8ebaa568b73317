import pytest

from grafu.cli.main import build_parser, main
from grafu.export.files import write_files
from grafu.export.particulate import export_particulate
from grafu.synth.truth.clashes import articulated_of
from predictions import cabinet
from small_assets import write_glb


@pytest.mark.parametrize(
    ("text", "metres"),
    [
        ("0.72", 0.72),
        ("72cm", 0.72),
        ("720 mm", 0.72),
        ("1e-1M", 0.1),
        ("10in", 0.254),
        ("-2ft", -0.6096),
    ],
)
def test_a_height_may_have_a_unit(text, metres):
    assert build_parser().parse_args(["inspect", "a.glb", f"--height={text}"]).height == pytest.approx(metres)


@pytest.mark.parametrize("text", ["72 furlongs", "cm", "", "7 2cm", "0.7e"])
def test_what_is_no_length_is_refused(text, capsys):
    with pytest.raises(SystemExit):
        build_parser().parse_args(["inspect", "a.glb", f"--height={text}"])
    assert "one with a unit of mm, cm, m, in, ft: got" in capsys.readouterr().err


@pytest.mark.parametrize("verb", ["inspect", "functionalize"])
def test_a_limit_is_lowered_and_the_message_says_how_to_raise_it(tmp_path, capsys, verb):
    path = write_glb(tmp_path / "cabinet.glb")
    more = ["--out", str(tmp_path / "out")] if verb == "functionalize" else []
    assert main([verb, str(path), "--limit", "faces=131", "--limit", "parts=50", *more]) == 2
    said = capsys.readouterr().err
    assert "132 faces: at most 131 are read" in said
    assert "--limit faces=132" in said


@pytest.mark.parametrize("text", ["faces", "faces=", "faces=0", "faces=-1", "face=7", "faces=1e9", "faces=" + "0" * 99])
def test_what_is_no_limit_is_refused(tmp_path, capsys, text):
    try:
        code = main(["inspect", str(write_glb(tmp_path / "a.glb")), "--limit", text])
    except SystemExit as stopped:
        code = stopped.code
    assert code == 2
    assert "must be NAME=NUMBER, NAME one of bytes, parts, faces" in capsys.readouterr().err


def test_settings_that_are_no_file_are_refused_at_once(tmp_path, capsys):
    path = write_glb(tmp_path / "a.glb")
    assert main(["functionalize", str(path), "--out", str(tmp_path / "out"), "--settings", "/dev/zero"]) == 2
    assert "it is a device" in capsys.readouterr().err


def test_a_limit_holds_for_the_prediction_of_another_system_too(tmp_path, capsys):
    path = write_glb(tmp_path / "cabinet.glb")  # which has no lines of OBJ
    write_files(export_particulate(articulated_of(cabinet())), tmp_path / "run")
    motion = f"particulate:{tmp_path / 'run'}"
    arguments = ["functionalize", str(path), "--out", str(tmp_path / "out"), "--motion", motion]
    assert main([*arguments, "--limit", "lines=9"]) == 2
    said = capsys.readouterr().err
    assert "pred.obj has" in said
    assert "lines: at most 9 are read; simplify it, or allow more by --limit lines=" in said
    assert not (tmp_path / "out").exists()
