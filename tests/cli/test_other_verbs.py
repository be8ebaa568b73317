"""`inspect` and `templates` through the real command."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from obj_inputs import CABINET, write_cabinet

from grafu.cli.main import main
from grafu.pipeline.inspection import Inspection

SAMPLES = Path(__file__).parents[2] / "samples"


def blank_sheet(*_: object) -> np.ndarray:
    """Stands in for the rendered sheet, which takes seconds."""
    return np.zeros((2, 2, 4), np.uint8)


def test_inspect_prints_a_table_of_all_parts(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["inspect", str(write_cabinet(tmp_path))]) == 0
    said = capsys.readouterr().out
    assert all(name in said for name in CABINET)
    assert "pairs of parts touch" in said


def test_on_a_terminal_of_80_columns_each_part_has_one_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("grafu.cli.terminal.PIPE_WIDTH", 80)
    assert main(["inspect", str(SAMPLES / "wardrobe.glb")]) == 0
    lines = capsys.readouterr().out.splitlines()
    first = next(k for k, line in enumerate(lines) if line.startswith("part ")) + 1
    last = lines.index("* its mesh is not watertight")
    assert last - first == 23
    assert any(re.search(r"door_1 .* x \d+\.\d +60 \*$", line.rstrip()) for line in lines[first:last])


def test_inspect_prints_json_that_reads_back(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source = write_cabinet(tmp_path)
    assert main(["inspect", str(source), "--json", "--up", "+Z", "--front", "-Y", "--scale", "2"]) == 0
    data = json.loads(capsys.readouterr().out)

    inspection = Inspection.read(data)
    assert data["schema"] == "grafu.inspection/1"
    assert {part.source.name for part in inspection.parts} == set(CABINET)
    assert inspection.size == pytest.approx((1.2, 1.08, 1.64))
    assert ("door", "handle") in inspection.contacts


def test_inspect_masks_labels(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["inspect", str(write_cabinet(tmp_path)), "--json", "--labels", "none"])
    data = json.loads(capsys.readouterr().out)
    assert {part["category"] for part in data["parts"]} == {"unknown"}


def test_templates_lists_the_gallery(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["templates"]) == 0
    said = capsys.readouterr().out
    assert all(word in said for word in ("butt", "piano", "centre_mount", "170°"))


def test_a_missing_template_folder_is_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["templates", "--templates", str(tmp_path / "nowhere")]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_templates_keeps_a_folder_that_is_not_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "diary.txt").write_text("mine")
    for name in ("gallery_sheet", "handle_sheet"):
        monkeypatch.setattr(f"grafu.render.gallery.{name}", blank_sheet)

    assert main(["templates", "--out", str(tmp_path), "--overwrite"]) == 2
    assert [p.name for p in tmp_path.iterdir()] == ["diary.txt"]


def test_templates_writes_one_file_each(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("grafu.render.gallery.gallery_sheet", blank_sheet)

    assert main(["templates", "--out", str(tmp_path / "gallery")]) == 0
    names = {p.name for p in (tmp_path / "gallery").iterdir()}
    assert {"butt.glb", "centre_mount.glb", "templates.png", "handles.png"} <= names
