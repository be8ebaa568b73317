"""The process that stays: what it keeps changes no byte of what comes out; it ends when no one listens any more."""

import json
import subprocess
import sys
from contextlib import contextmanager
from dataclasses import replace
from functools import cache as memo
from pathlib import Path

import numpy as np
import pytest

from grafu.additions.handle.config import HandleChoice
from grafu.additions.interior.request import CompartmentChoice
from grafu.additions.top.config import TopConfig
from grafu.asset.load import load_asset
from grafu.errors import FunctionalizationError
from grafu.export.blend.process import unpacked
from grafu.export.glb import export_glb
from grafu.joints.plan import JointChoice
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.report import report_of
from grafu.pipeline.report_schema import Report
from grafu.pipeline.settings import Settings
from grafu.pipeline.worker import compartments_to_json, run
from grafu.processes.cache import Cache
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel
from spoiled_files import DAMAGED, SPOILS

SAMPLE = Path(__file__).parents[2] / "samples" / "sideboard.glb"
BASE = Settings(motion=MotionSource.RULE)
KNOBS = HandleChoice("knob-round", 2)
STACKED = BASE.with_joint("door_1", JointChoice(template="piano"))
CHANGES = {
    "as it is": BASE,
    "hinges": BASE.with_joint("door_1", JointChoice(count=3, scale=0.8)),
    "opening and grip": BASE.with_joint("drawer_1", JointChoice(opening=0.2)).with_front(
        "door_2", HandleChoice("grip")
    ),
    "handle and top": replace(
        STACKED, additions=replace(STACKED.additions, top=TopConfig(thickness=0.04), fronts={"drawer_1": KNOBS})
    ),
    "interior": STACKED.with_compartment(0, CompartmentChoice(1, 1)),
    "category, no trimming": replace(BASE, trim=False).with_label("door_2", PartLabel.MISC),
}


def everything(result) -> tuple:
    report = report_of(result).to_json()
    del report["timings"]
    return export_glb(result.object).contents["model.glb"], report, result.completion, compartments_to_json(result)


def made(settings, cache):
    return everything(
        functionalize(load_asset(SAMPLE), settings.motion, builtin_gallery(), PipelineConfig(settings), cache=cache)
    )


@memo
def made_afresh(change):
    return made(CHANGES[change], Cache(0))


@pytest.fixture(scope="module")
def cache():
    return Cache(400)


@pytest.mark.parametrize("change", [*CHANGES, "as it is"])
def test_a_run_that_keeps_gives_what_a_fresh_one_gives(change, cache):
    assert made(CHANGES[change], cache) == made_afresh(change)


def test_only_what_a_change_touches_is_made_again(cache):
    def made_by(settings):
        before = dict(cache.made)
        functionalize(load_asset(SAMPLE), settings.motion, builtin_gallery(), PipelineConfig(settings), cache=cache)
        return {name: count - before.get(name, 0) for name, count in cache.made.items() if count > before.get(name, 0)}

    made_by(BASE)
    assert made_by(BASE) == {}
    assert made_by(BASE.with_front("drawer_2", HandleChoice("bar-round"))).keys() == {"fittings", "grasps"}
    assert not {"joint", "expected motion", "measure"} & made_by(without_top()).keys()
    last = made_by(BASE.with_joint("drawer_2", JointChoice(template="corner_mount")))
    assert last["joint"] <= 2  # of five: its own, and one whose rails run beside it
    assert not {"parse", "complete by rule", "plan by rule", "closed"} & last.keys()


def without_top() -> Settings:
    return replace(BASE, additions=replace(BASE.additions, top=None))


@contextmanager
def working(folder):
    command = [sys.executable, "-m", "grafu.pipeline.worker", str(folder)]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=subprocess.PIPE, text=True, bufsize=1) as process:
        try:
            yield process
        finally:
            process.kill()


def asked(process, folder, settings, source=SAMPLE) -> list[str]:
    (folder / "settings.json").write_text(json.dumps(settings if isinstance(settings, dict) else settings.to_json()))
    process.stdin.write(json.dumps([str(source), str(folder / "settings.json"), str(folder)]) + "\n")
    said = []
    while not said or not (said[-1] == "done" or said[-1].startswith("error ")):
        said.append(process.stdout.readline().rstrip("\n"))
        assert said[-1], said
    return said


def test_one_process_answers_again_and_again_and_ends_with_its_input(tmp_path):
    folder = tmp_path / "shared"
    folder.mkdir()
    with working(folder) as process:
        said = asked(process, folder, BASE)
        stages = ["load", "parse", "complete", "plan", "close", "body", "realize", "fittings", "stays"]
        stages += ["grasp frames", "write"]
        assert said == [*(f"stage {name}" for name in stages), "done"]
        (first,) = [j for j in unpacked((folder / "object.packed").read_bytes()).joints if j.child == "drawer_1"]
        assert asked(process, folder, {"schema": "none"})[-1].startswith("error settings must be")
        unknown = BASE.with_joint("door_1", JointChoice(template="spring"))
        assert asked(process, folder, unknown)[-1].startswith("error ")
        assert asked(process, folder, BASE, tmp_path / "none.glb")[-1].startswith("error ")
        assert asked(process, folder, CHANGES["opening and grip"])[-1] == "done"
        (second,) = [j for j in unpacked((folder / "object.packed").read_bytes()).joints if j.child == "drawer_1"]
        assert second.limits.upper == pytest.approx(0.2)
        assert first.limits.upper > 0.2
        process.stdin.close()
        assert process.wait(10) == 0
        assert not folder.exists()


def test_it_ends_amid_its_work_when_nobody_listens_any_more(tmp_path):
    folder = tmp_path / "shared"
    folder.mkdir()
    (folder / "settings.json").write_text(json.dumps(BASE.to_json()))
    with working(folder) as process:
        line = json.dumps([str(SAMPLE), str(folder / "settings.json"), str(folder)]) + "\n"
        process.stdin.write(30 * line)
        assert process.stdout.readline() == "stage load\n"
        process.stdin.close()
        rest = process.stdout.read()
        assert process.wait(10) == 0
        assert rest.count("done") < 30
        assert not folder.exists()


def test_a_fault_of_ours_is_one_line_and_the_end(tmp_path):
    folder = tmp_path / "shared"
    folder.mkdir()
    with working(folder) as process:
        process.stdin.write("5\n")
        assert process.stdout.readline().startswith("error internal fault: TypeError")
        assert process.wait(10) == 1


def test_a_run_of_its_own_writes_all_that_was_asked_for(tmp_path):
    settings = BASE.with_joint("door_1", JointChoice(count=3))
    (tmp_path / "settings.json").write_text(json.dumps(settings.to_json()))
    run(SAMPLE, tmp_path / "settings.json", tmp_path)
    made = unpacked((tmp_path / "object.packed").read_bytes())
    report = Report.read_json((tmp_path / "report.json").read_text())
    assert {j.child for j in made.moving_joints} == {j.part for j in report.joints}
    assert {j.part: j.count for j in report.joints}["door_1"] == 3
    assert "nodes" in (tmp_path / "graph.json").read_text()
    boxes = json.loads((tmp_path / "interior.json").read_text())["compartments"]
    assert boxes
    assert all(np.shape(box["corners"]) == (8, 3) for box in boxes)


@pytest.mark.parametrize("what", [*SPOILS, *DAMAGED])
def test_settings_that_cannot_be_read_are_one_line(tmp_path, what):
    path = tmp_path / "settings.json"
    path.write_text("{}")
    SPOILS[what](path) if what in SPOILS else path.write_bytes(DAMAGED[what])
    with pytest.raises(FunctionalizationError, match=what if what in SPOILS else "settings") as error:
        run(SAMPLE, path, tmp_path)
    assert "\n" not in str(error.value)
    assert not (tmp_path / "object.packed").exists()
