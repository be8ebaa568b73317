"""docs/paper.md: every row names files that exist, one of four verdicts, and a command that is one."""

import re
import shlex
from pathlib import Path

import pytest

from grafu.cli.main import build_parser

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "paper.md").read_text("utf-8")
ROWS = [
    [cell.strip() for cell in line.strip().strip("|").split("|")]
    for line in PAGE.splitlines()
    if line.startswith("|") and not line.startswith(("|---", "| in the paper"))
]
VERDICTS = ("same", "departs", "beyond", "open")


def named(cell: str) -> list[str]:
    return re.findall(r"`([^`]+)`", cell)


def require_command(command: str) -> None:
    """Fails unless a command's program, verb, options and files are there."""
    program, *words = shlex.split(command)
    if program == "grafu":
        options, unknown = build_parser().parse_known_args(words)
        assert not unknown, f"{command}: {unknown}"
        assert callable(options.run)
        samples = [word for word in words if word.startswith("samples/")]
        assert all((ROOT / word).is_file() for word in samples), command
    elif program == "python":
        script = (ROOT / words[0]).read_text("utf-8")
        assert all(word in script for word in words[1:] if word.startswith("--")), command
    else:
        assert program == "pytest", command
        assert all((ROOT / word).exists() for word in words), command


def test_the_page_has_rows_of_every_part_of_the_paper() -> None:
    assert len(ROWS) > 100
    assert all(len(row) == 4 and all(row) for row in ROWS), [row for row in ROWS if len(row) != 4 or not all(row)]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: re.sub(r"\W+", "_", row[0])[:60])
def test_a_row_names_files_a_verdict_and_a_command(row: list[str]) -> None:
    _, files, verdict, shown = row
    assert named(files)
    assert [name for name in named(files) if not (ROOT / name).is_file()] == []
    assert re.match(rf"({'|'.join(VERDICTS)})\b", verdict), verdict
    assert named(shown)
    for command in named(shown):
        require_command(command)


@pytest.mark.parametrize(
    "wrong",
    ["grafu nothing", "grafu train --colour red", "pytest tests/none.py", "make all", "python scripts/docs.py --x"],
)
def test_a_command_that_is_none_is_noticed(wrong: str) -> None:
    with pytest.raises((AssertionError, SystemExit)):
        require_command(wrong)
