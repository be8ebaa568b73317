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


@pytest.fixture
def checkpoint(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A checkpoint of the authors' layout; it is exported as the shipped network, for that takes no half minute."""
    torch = pytest.importorskip("torch")
    from authors_network import authors
    from grafu.cli import weights_option

    monkeypatch.setattr(weights_option, "exported", lambda *_, **__: SHIPPED_WEIGHTS.read_bytes())
    torch.save({"model": authors().state_dict()}, tmp_path / "grafu_full.pt")
    return tmp_path / "grafu_full.pt"


def test_the_authors_checkpoint_is_converted_once_and_used(
    checkpoint: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from grafu.cli import weights_option

    out = tmp_path / "out"
    args = ["functionalize", str(write_cabinet(tmp_path)), "--weights", str(checkpoint), "--no-page"]
    assert main([*args, "--out", str(out)]) == 0
    (converted,) = (out / "weights").iterdir()
    assert converted.name.startswith("grafu_full-")
    assert f"was converted: {converted}" in capsys.readouterr().out
    assert json.loads((out / "cabinet" / "settings.json").read_text())["weights"] == str(converted)

    monkeypatch.setattr(weights_option, "exported", lambda *_, **__: pytest.fail("exported again"))
    evaluated = ["evaluate", "--data", "synth:990002:1", "--methods", "network", "--tables", "motion", "--jobs", "1"]
    assert main([*evaluated, "--weights", str(checkpoint), "--out", str(out)]) == 0
    assert f"--weights {checkpoint}" in (out / "tables" / "index.md").read_text()


def test_a_run_starts_from_the_authors_weights(checkpoint: Path) -> None:
    torch = pytest.importorskip("torch")
    from authors_network import authors
    from grafu.network.config import PAPER
    from grafu.network.grafu import GraFu
    from grafu.network.official_weights import start_weights
    from grafu.network.stored import start_from
    from grafu.network.vocabulary import official_places

    network = GraFu(PAPER)
    assert start_from(network, start_weights(checkpoint, PAPER)) == ()
    theirs = authors()
    assert torch.equal(network.encoder.nodes.category.weight, theirs.node_encoder.cat_embed.weight[official_places()])
    assert torch.equal(network.decoder.free, theirs.slot_decoder.free_queries)


def test_a_file_that_is_no_checkpoint_is_one_line(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("torch")
    (tmp_path / "grafu_full.pt").write_bytes(b"no checkpoint")
    args = ["functionalize", str(write_cabinet(tmp_path)), "--weights", str(tmp_path / "grafu_full.pt")]
    assert main([*args, "--out", str(tmp_path / "out")]) == 2
    said = capfd.readouterr().err
    assert "grafu_full.pt" in said
    assert said.count("\n") == 1
    assert not (tmp_path / "out").exists()
