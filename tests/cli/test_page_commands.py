"""Commands of the reference pages run as they stand on stand-ins: small models, few of them.

What is left out needs data or programs that cannot be fetched here, a server that waits, or hours; other tests run it.
"""

import json
import re
import shlex
from pathlib import Path
from shutil import copyfile

import pytest

from grafu.cli.main import main

ROOT = Path(__file__).parents[2]
SAMPLES = ROOT / "samples"
PAGES = ("additions", "datasets", "dataset", "synthetic", "exports", "templates", "blender", "evaluation", "training")
LEFT_OUT = re.compile(
    r"grafu_full|FurFun|particulate|llm|ablate|--config (?!tiny)|--start|--export|--pictures|welded"
    r"|--count 10000 --check|--data models|--stats models|glb-draco"
)
NEEDED = {"training": "torch", "exports": "mujoco"}
FEWER = {
    "--count 10000": "--count 2",
    "--count 200": "--count 2",
    "990002:100": "990002:1",
    "--config tiny": "--config tiny --steps 2",
}
MORE = {
    "functionalize": ["--overwrite", "--no-page"],
    "synth": ["--overwrite"],
    "dataset": ["--overwrite"],
    "evaluate": ["--overwrite", "--tables", "motion,models"],
}
"""Options that are added to a verb: commands of a page write to one folder, and tables are many."""


def lines_of(page: str) -> list[str]:
    """Returns the commands of a page with small numbers, without those that other tests run."""
    text = (ROOT / "docs" / f"{page}.md").read_text("utf-8").replace("\\\n", " ")
    found = re.findall(
        r"^(?: {4,6})?grafu ((?:functionalize|synth|dataset|templates|check|evaluate|train) [^\n]+)", text, re.MULTILINE
    )
    lines = [line for line in found if not LEFT_OUT.search(line)]
    for many, few in FEWER.items():
        lines = [line.replace(many, few) for line in lines]
    return lines


@pytest.fixture
def stand_ins(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Returns the working folder: a cabinet, samples, results of two models, and a template of one's own."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("webbrowser.open", lambda _: True)
    (tmp_path / "samples").mkdir()
    for name in ("cabinet.glb", "source.glb"):
        copyfile(SAMPLES / "chest.glb", tmp_path / name)
    for name in ("dresser.glb", "kitchen_base.glb"):
        copyfile(SAMPLES / name, tmp_path / "samples" / name)
    (tmp_path / "settings.json").write_text(json.dumps({"schema": "grafu.settings/1"}))
    own = tmp_path / "my_templates" / "art_deco_pull"
    own.mkdir(parents=True)
    shown = re.findall(r"```json\n(.*?)```", (ROOT / "docs" / "templates.md").read_text("utf-8"), re.DOTALL)
    (own / "template.json").write_text(next(block for block in shown if '"handle"' in block))
    (own / "handle.obj").write_text(box_of_handle())
    return tmp_path


def box_of_handle() -> str:
    """Returns an OBJ of a bar, 128 by 10 by 30 mm, whose feet are at z = 0."""
    corners = [(x, y, z) for x in (-64, 64) for y in (-5, 5) for z in (0, 30)]
    faces = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
    return "".join(f"v {x} {y} {z}\n" for x, y, z in corners) + "".join(f"f {' '.join(map(str, f))}\n" for f in faces)


@pytest.mark.slow
@pytest.mark.parametrize("page", PAGES)
def test_the_commands_of_a_reference_page_run(page: str, stand_ins: Path, capsys: pytest.CaptureFixture[str]) -> None:
    if page in NEEDED:
        pytest.importorskip(NEEDED[page])
    lines = lines_of(page)
    assert lines
    if page in ("datasets", "exports"):
        made = [
            "functionalize",
            "samples/kitchen_base.glb",
            "samples/dresser.glb",
            "--no-page",
            "--formats",
            "glb,urdf,mjcf",
        ]
        assert main([*made, "--out", "results"]) == 0
    for line in lines:
        words = shlex.split(line, comments=True)
        words = [
            found for word in words for found in (sorted(map(str, stand_ins.glob(word))) if "*" in word else [word])
        ]
        assert main([*words, *MORE.get(words[0], ())]) == 0, (line, capsys.readouterr().err)
