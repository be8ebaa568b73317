"""--motion with another system's file, through the real command."""

import json
from pathlib import Path

import pytest
from obj_inputs import write_cabinet

from grafu.asset.load import load_asset
from grafu.cli.main import main
from grafu.export.files import write_files
from grafu.export.particulate import export_particulate
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.templates.gallery import builtin_gallery


@pytest.fixture(scope="module")
def cabinet(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_cabinet(tmp_path_factory.mktemp("input"))


@pytest.fixture(scope="module")
def run(cabinet: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Particulate's files about the cabinet, in a folder of its name."""
    folder = tmp_path_factory.mktemp("theirs")
    made = functionalize(load_asset(cabinet), MotionSource.RULE, builtin_gallery()).object
    write_files(export_particulate(made), folder / cabinet.stem)
    return folder


@pytest.mark.parametrize("entry", ["cabinet", "cabinet/eval/pred.npz", "."])
def test_a_prediction_is_a_motion_source(entry: str, cabinet: Path, run: Path, tmp_path: Path) -> None:
    arguments = ["--motion", f"particulate:{run / entry}", "--formats", "urdf", "--out", str(tmp_path / "out")]

    assert main(["functionalize", str(cabinet), *arguments]) == 0
    report = json.loads((tmp_path / "out" / "cabinet" / "report.json").read_text())
    assert report["motion"]["source"] == "particulate"
    assert {joint["part"] for joint in report["joints"]} == {"door", "drawer"}
    graph = json.loads((tmp_path / "out" / "cabinet" / "graph.json").read_text())
    assert "particulate" in json.dumps(graph["completion"])


def test_with_several_inputs_one_without_an_entry_fails_alone(
    cabinet: Path, run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other = tmp_path / "other.obj"
    other.write_bytes(cabinet.read_bytes())
    arguments = ["--motion", f"particulate:{run}", "--formats", "urdf", "--jobs", "1", "--out", str(tmp_path / "out")]

    assert main(["functionalize", str(cabinet), str(other), *arguments]) == 1
    assert f"{run} holds nothing for other: for several inputs" in capsys.readouterr().err
    assert (tmp_path / "out" / "cabinet" / "report.json").exists()
    assert not (tmp_path / "out" / "other").exists()


@pytest.mark.parametrize(
    ("motion", "why"),
    [
        ("particulate", "motions of particulate are read from a file, which must be named: particulate:FILE"),
        ("grafu-pred:", "motions of grafu-pred are read from a file"),
        ("rule:x.json", "the motion source rule reads no file"),
        ("wind", "must be one of auto, annotation, network, rule, particulate:FILE"),
    ],
)
def test_a_choice_that_is_none_is_said_in_one_line(
    motion: str, why: str, cabinet: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["functionalize", str(cabinet), "--motion", motion, "--out", str(tmp_path / "out")])
    assert ended.value.code == 2
    assert why in capsys.readouterr().err


def test_a_file_that_is_not_there_exits_with_2(
    cabinet: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = ["--motion", "singapo:nowhere.json", "--out", str(tmp_path / "out")]

    assert main(["functionalize", str(cabinet), *arguments]) == 2
    assert "nowhere.json does not exist: expected SINGAPO's or CAGE's object.json" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()
