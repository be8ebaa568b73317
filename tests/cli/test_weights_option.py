"""`--weights FILE` through the real command: the user's network is used, and a wrong file is one line."""

import json
import shutil
from pathlib import Path

import pytest
from obj_inputs import write_cabinet

from grafu.cli.main import main
from grafu.completion.session import SHIPPED_WEIGHTS


def test_the_network_of_a_file_completes_the_graph(tmp_path: Path) -> None:
    own = tmp_path / "own.onnx"
    shutil.copy(SHIPPED_WEIGHTS, own)
    args = ["functionalize", str(write_cabinet(tmp_path)), "--weights", str(own), "--no-page"]
    assert main([*args, "--out", str(tmp_path / "out")]) == 0
    result = tmp_path / "out" / "cabinet"
    assert json.loads((result / "report.json").read_text())["motion"]["source"] == "network"
    assert json.loads((result / "settings.json").read_text())["weights"] == str(own)

    again = ["functionalize", args[1], "--settings", str(result / "settings.json"), "--no-page"]
    own.unlink()  # the settings name it
    assert main([*again, "--out", str(tmp_path / "again")]) == 2


@pytest.mark.parametrize(
    ("name", "content", "motion", "states"),
    [
        ("none.onnx", None, "auto", "must be a file that `grafu train` exported"),
        ("damaged.onnx", b"no network", "auto", "must be a network in ONNX form"),
        ("whole.onnx", b"whatever", "rule", "`--weights` and `--motion rule` exclude each other"),
    ],
)
def test_wrong_weights_are_one_line(
    name: str, content: bytes | None, motion: str, states: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    if content is not None:
        (tmp_path / name).write_bytes(content)
    args = ["functionalize", str(write_cabinet(tmp_path)), "--weights", str(tmp_path / name), "--motion", motion]
    assert main([*args, "--out", str(tmp_path / "out")]) == 2
    said = capfd.readouterr().err
    assert states in said
    assert said.count("\n") == 1
    assert not (tmp_path / "out").exists()
