"""A job for another program: its stages, what the command writes, the object; or one line that states why not."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from furniture_rooms import cabinet, numbered, write_scene
from grafu.asset.options import LoadOptions
from grafu.cli.finalize import finalize
from grafu.cli.main import main
from grafu.export.blend.process import unpacked
from grafu.joints.plan import JointChoice
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.settings import Settings
from spoiled_files import DAMAGED, SPOILS

SAMPLE = Path(__file__).parents[2] / "samples" / "chest.glb"
SETTINGS = Settings(motion=MotionSource.RULE).with_joint("lid", JointChoice(count=2))


def order_in(folder: Path) -> dict[str, object]:
    return {
        "source": str(SAMPLE),
        "settings": str(folder / "settings.json"),
        "out": str(folder / "out"),
        "formats": ["glb", "singapo"],
        "overwrite": False,
        "object": str(folder / "object.packed"),
    }


def finalized(folder: Path, **changes) -> tuple[int, list[str]]:
    (folder / "settings.json").write_text(json.dumps(SETTINGS.to_json()))
    (folder / "order.json").write_text(json.dumps(order_in(folder) | changes))
    command = [sys.executable, "-m", "grafu.cli.finalize", str(folder / "order.json")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
    return done.returncode, done.stdout.splitlines()


def test_it_writes_what_the_command_writes_and_hands_the_object_over(tmp_path):
    code, said = finalized(tmp_path)
    assert code == 0
    stages = ["load", "parse", "complete", "plan", "close", "body", "realize", "fittings", "stays"]
    stages += ["grasp frames", "export", "write"]
    assert said == [*(f"stage {name}" for name in stages), "done"]
    given = ["functionalize", str(SAMPLE), "--settings", str(tmp_path / "settings.json"), "--formats", "glb,singapo"]
    assert main([*given, "--out", str(tmp_path / "command")]) == 0
    ours, commands = tmp_path / "out" / "chest", tmp_path / "command" / "chest"
    assert {p.name for p in ours.iterdir()} == {p.name for p in commands.iterdir()}
    assert (ours / "model.glb").read_bytes() == (commands / "model.glb").read_bytes()
    made = unpacked((tmp_path / "object.packed").read_bytes())
    assert [joint.child for joint in made.moving_joints] == ["lid"]


def test_a_piece_of_a_file_keeps_its_name(tmp_path):
    row = write_scene(tmp_path / "my.row.glb", {**cabinet("a", (-0.6, 0, 0)), **numbered(cabinet("", (0.6, 0, 0)))})
    (tmp_path / "settings.json").write_text(
        json.dumps(Settings(reading=LoadOptions(pieces="split", piece=2)).to_json())
    )
    ordered = order_in(tmp_path) | {"source": str(row), "piece": "my.row_piece_2", "formats": ["urdf"]}
    (tmp_path / "order.json").write_text(json.dumps(ordered))
    assert finalize(tmp_path / "order.json") == ""
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["my.row_piece_2"]
    (tmp_path / "order.json").write_text(
        json.dumps(ordered | {"piece": "my.row_../up", "out": str(tmp_path / "other")})
    )
    assert finalize(tmp_path / "order.json") == ""
    assert [path.name for path in (tmp_path / "other").iterdir()] == ["my.row"]


@pytest.mark.parametrize("name", ["order.json", "settings.json"])
@pytest.mark.parametrize("what", [*SPOILS, *DAMAGED])
def test_an_order_or_settings_that_cannot_be_read_are_one_line(tmp_path, name, what):
    (tmp_path / "settings.json").write_text(json.dumps(SETTINGS.to_json()))
    (tmp_path / "order.json").write_text(json.dumps(order_in(tmp_path)))
    SPOILS[what](tmp_path / name) if what in SPOILS else (tmp_path / name).write_bytes(DAMAGED[what])
    why = finalize(tmp_path / "order.json")
    assert what in why if what in SPOILS else "grafu" in why
    assert "\n" not in why
    assert not (tmp_path / "out").exists()


def test_what_is_wrong_is_one_line_and_nothing_is_written(tmp_path):
    for changes, why in (
        ({"formats": ["dxf"]}, "unknown format `dxf`"),
        ({"source": str(tmp_path / "none.glb")}, "none.glb"),
        ({"settings": str(tmp_path / "order.json")}, "settings must be"),
    ):
        code, said = finalized(tmp_path, **changes)
        assert code == 2
        assert said[-1].startswith("error ")
        assert why in said[-1]
        assert not (tmp_path / "out").exists()
