"""The process that builds: what it answers, and that one which was stopped is replaced."""

import json
from dataclasses import replace
from pathlib import Path
from threading import Thread

import pytest

from grafu.editor.builder import STOPPED, BuildProcess
from grafu.editor.building import GEOMETRY, STATE, TEXTURES, Bench, Order, order_of
from grafu.editor.scripts import SCRIPTS
from grafu.errors import NotBuilt
from grafu.joints.motion_choice import FIXED
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.settings import Settings
from grafu.pipeline.stages import RATIOS

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
    assert bench.cache.made["surface"] - made["surface"] < made["surface"]


def test_the_page_has_words_for_every_stage():
    words = SCRIPTS["edit.js"]().partition("const STAGES = {")[2].partition("};")[0]
    for stage in (*RATIOS, "load", "match", "plan", "export", "write", "page"):
        assert f'{stage}: "' in words or f'"{stage}": "' in words, stage
