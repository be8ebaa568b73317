"""Small files appear whole."""

from pathlib import Path

import pytest

from grafu.errors import ExportError
from grafu.export.whole_file import write_whole


def test_a_file_is_written_and_nothing_else(tmp_path: Path) -> None:
    write_whole("old", tmp_path / "new" / "a.txt")
    write_whole("é", tmp_path / "new" / "a.txt")
    assert (tmp_path / "new" / "a.txt").read_text(encoding="utf-8") == "é"
    assert len(list((tmp_path / "new").iterdir())) == 1


def test_what_cannot_be_written_is_said(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(ExportError, match="cannot write"):
        write_whole("text", tmp_path / "file" / "a.txt")
