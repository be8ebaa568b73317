"""The verbs that train say what to install where torch is not there."""

import sys
from pathlib import Path

import pytest

from grafu.cli.main import main


@pytest.mark.parametrize("verb", [["train"], ["ablate", "losses"]])
def test_they_say_what_to_install(
    verb: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    for name in [name for name in sys.modules if name.startswith("grafu.training")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "torch", None)
    assert main([*verb, "--out", str(tmp_path)]) == 2
    assert "pip install 'grafu[train]'" in capsys.readouterr().err
