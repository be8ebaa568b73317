"""The process that builds: what it answers, and that one which was stopped is replaced."""

import json
from dataclasses import replace
from itertools import product
from pathlib import Path
from threading import Thread

import numpy as np
import pytest
from editing import write_model

from grafu.asset.part import Part, PartSource
from grafu.editor.builder import STOPPED, BuildProcess
from grafu.editor.building import GEOMETRY, STATE, TEXTURES, Bench, Order, order_of
from grafu.editor.scripts import SCRIPTS
from grafu.errors import NotBuilt
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.motion_choice import FIXED
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.settings import Settings
from grafu.pipeline.stages import RATIOS
from grafu.vocabulary import PartLabel

ROWS = (0.2, 0.35, 0.5, 0.65)
RULE = Settings(MotionSource.RULE)


def order(model: Path, folder: Path, settings: Settings = RULE) -> Order:
    return Order("build", model, "cabinet", folder, settings.to_json())


def test_an_order_is_one_line(model, tmp_path):
    asked = replace(order(model, tmp_path), name="a name\nof two lines \u2028")
    assert len(asked.line().splitlines()) == 1
    assert order_of(asked.line()) == asked


@pytest.mark.slow
def test_it_builds_states_faults_and_is_replaced_after_a_stop(model, tmp_path):
    builder, stages = BuildProcess(), list[str]()
    try:
        first = builder.ask(order(model, tmp_path), stages.append)
        assert stages[:2] == ["load", "parse"]
        assert stages[-1] == "write"
        state = json.loads((tmp_path / STATE).read_text())
        assert {name: state[name] for name in first.made} == first.made
        assert (tmp_path / GEOMETRY).stat().st_size > 0
        assert json.loads((tmp_path / TEXTURES).read_text()) == []

        with pytest.raises(NotBuilt, match=r"nothing\.glb"):
            builder.ask(order(tmp_path / "nothing.glb", tmp_path), stages.append)
        with pytest.raises(NotBuilt, match=STOPPED):
            builder.ask(order(model, tmp_path), lambda _: Thread(target=builder.stop).start())
        assert builder.ask(order(model, tmp_path), stages.append).made == first.made
    finally:
        builder.stop()


def test_only_what_a_choice_touches_is_built_anew(model, tmp_path):
    bench = Bench(lambda _: None)
    bench.carry_out(order(model, tmp_path))
    made = dict(bench.cache.made)
    bench.carry_out(order(model, tmp_path))
    assert bench.cache.made == made
    bench.carry_out(order(model, tmp_path, RULE.with_motion("drawer", FIXED)))
    again = {name for name, count in bench.cache.made.items() if count != made.get(name)}
    assert "parse" not in again
    assert "sides" not in again
    made = dict(bench.cache.made)
    stages: list[str] = []
    bench.say = lambda said: stages.append(said["stage"])
    bench.carry_out(order(model, tmp_path))  # undone
    assert (bench.cache.made, stages) == (made, ["write"])
    assert bench.cache.made["surface"] - made["surface"] < made["surface"]


def test_the_verdict_is_that_of_the_report_that_is_written(tmp_path):
    places = product(np.linspace(-0.2, 0.2, 5), np.linspace(0.35, 0.65, 4), ROWS)
    bars = [Box(vec3(x, y, z), vec3(x + 0.02, y + 0.02, z + 0.06)) for x, y, z in places]
    boards = tuple(Surface(TriangleMesh.box_mesh(bar)) for bar in bars)
    grille = Part("grille", PartLabel.MISC, boards, PartSource("", "grille"), "name")
    bench, made = Bench(lambda _: None), write_model(tmp_path / "cabinet.glb", grille)
    bench.carry_out(order(made, tmp_path))
    shown = json.loads((tmp_path / STATE).read_text())["report"]["verdict"]
    judged = bench.carry_out(replace(order(made, tmp_path), do="judge"))
    exported = bench.carry_out(replace(order(made, tmp_path / "out"), do="export"))
    written = json.loads((tmp_path / "out" / "report.json").read_text())

    assert "64 shapes are kept" in written["notes"][0]
    assert shown != written["verdict"]
    assert judged["report"]["verdict"] == written["verdict"] == exported["report"]["verdict"]
    assert written["notes"][0] in judged["markup"]["header"]


def test_the_page_has_words_for_every_stage():
    words = SCRIPTS["edit.js"]().partition("const STAGES = {")[2].partition("};")[0]
    for stage in (*RATIOS, "judge", "load", "match", "plan", "export", "write", "page"):
        assert f'{stage}: "' in words or f'"{stage}": "' in words, stage
