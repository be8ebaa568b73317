"""What the README and docs/prepare.md tell a reader to type runs as it stands."""

import re
import shlex
from pathlib import Path

import pytest

from grafu.cli.main import build_parser, main

ROOT = Path(__file__).parent.parent.parent
README = (ROOT / "README.md").read_text()
PREPARE = (ROOT / "docs" / "prepare.md").read_text()
LINES = re.findall(r"^    (grafu [^#\n]+)", README + PREPARE, re.MULTILINE)
SHORT = [line for line in LINES if re.match(r"grafu (inspect|functionalize samples/\w+\.glb )", line)]


def arguments_of(line: str) -> list[str]:
    words = shlex.split(line)[1:]
    found = (sorted(str(p.relative_to(ROOT)) for p in ROOT.glob(word)) if "*" in word else [word] for word in words)
    return [word for each in found for word in each]


def test_every_line_is_a_command_on_what_the_checkout_holds() -> None:
    assert len(LINES) >= 14
    for line in LINES:
        words = arguments_of(line)
        build_parser().parse_args(words)
        assert all((ROOT / word).exists() for word in words if word.startswith("samples/"))


@pytest.mark.parametrize("line", SHORT)
def test_a_command_runs_as_it_stands(line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "samples").symlink_to(ROOT / "samples")
    assert main([*arguments_of(line), *(["--no-page"] if "functionalize" in line else [])]) == 0


def test_the_python_runs_as_it_stands(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "samples").symlink_to(ROOT / "samples")
    (code,) = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    exec(compile(code, "README.md", "exec"), {})
    assert (tmp_path / "results" / "changed" / "model.urdf").is_file()
