"""Axes and arcs in a real Blender window: seen, switched off, quick; the eyedropper on parts and hardware."""

import json

import numpy as np
import pytest
from real_window import ROOT, missing, read_screen, run_in_window

from grafu.cli.main import main


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    why = missing()
    if why:
        pytest.skip(why)
    made = tmp_path_factory.mktemp("overlay")
    sample = ROOT / "samples" / "sideboard.glb"
    arguments = ["--motion", "rule", "--formats", "glb", "--no-page", "--out", str(made / "out")]
    assert main(["functionalize", str(sample), *arguments]) == 0
    probe = ROOT / "tests/blender_addon/overlay_probe.py"
    done = run_in_window(probe, [str(made / "out" / "sideboard")], made, 600.0)
    assert done.returncode == 0, (done.stdout + done.stderr)[-3000:]
    assert "Traceback" not in done.stdout + done.stderr
    return made


@pytest.fixture(scope="module")
def facts(folder):
    return json.loads((folder / "facts.json").read_text())


def green(picture) -> int:
    """How many pixels have the colour of a joint that is well."""
    red, other, blue = (picture[..., k].astype(int) for k in range(3))
    return int(np.sum((other > 150) & (other > red + 60) & (other > blue + 60)))


def test_lines_are_seen_and_switched_off(folder):
    seen = {name: green(read_screen(folder / f"{name}.xwd")) for name in ("on", "off", "open")}
    assert seen["on"] > seen["off"] + 200
    assert seen["open"] > seen["off"] + 200


def test_every_joint_is_drawn_in_a_moment(facts):
    assert facts["strokes"] == 2 * facts["joints"]
    assert facts["seconds"] < 0.1


def test_the_eyedropper_finds_the_joint_of_parts_and_of_both_halves_of_hardware(facts):
    picked = facts["picked"]
    assert picked["door_1"] == "door_1"
    assert picked["drawer_2"] == "drawer_2"
    hardware = {name: part for name, part in picked.items() if name.startswith(("hinge_", "rail_", "support_"))}
    assert {name for name in hardware if name.endswith("_static")}
    assert {name: part for name, part in hardware.items() if not part or part not in name} == {}
    assert not picked["top_panel"]
