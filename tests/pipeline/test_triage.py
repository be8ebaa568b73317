"""Every door and drawer has a state: built well, built with something to look at, or not built, and why."""

from dataclasses import replace

import pytest

from grafu.additions.config import NO_ADDITIONS
from grafu.joints.plan import PIVOT, JointChoice
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.report import report_of
from grafu.pipeline.report_schema import Report
from grafu.pipeline.settings import Settings
from grafu.pipeline.triage import Level, joint_states, lost
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door, Drawer, Stack
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import MechanismClass

ASSET = make_cabinet(Cabinet("made", Case(0.5, 0.9), Stack((Drawer(), Door(handle="none")), (1.0, 3.0))))
BASE = Settings(MotionSource.ANNOTATION)


def reported(chosen: Settings) -> Report:
    return report_of(functionalize(ASSET, chosen.motion, builtin_gallery(), PipelineConfig(chosen)))


@pytest.fixture(scope="module")
def plain() -> Report:
    return reported(BASE)


def with_first(report: Report, **changes) -> Report:
    first, *rest = report.joints
    return report.with_changes(joints=(first.with_changes(**changes), *rest))


def test_what_works_is_ok(plain):
    assert {state.part: state.level for state in joint_states(plain)} == {j.part: Level.OK for j in plain.joints}


@pytest.mark.parametrize(
    ("changes", "level", "words"),
    [
        ({"collision_share": 0.1}, Level.ERROR, "10 % of its poses"),
        ({"largest_gap": 0.02}, Level.ERROR, "20.0 mm"),
        ({"restricted": True}, Level.WARNING, "restricted"),
        ({"opening": 0.0}, Level.ERROR, "does not open"),
        ({"grasp": "none"}, Level.WARNING, "no grasp"),
        ({"notes": ("butt was left out",)}, Level.WARNING, "left out"),
        ({"restricted": True, "collision_share": 0.1}, Level.ERROR, "restricted"),
    ],
)
def test_each_fault_has_its_level_and_its_words(plain, changes, level, words):
    state = joint_states(with_first(plain, **changes))[0]
    assert state.level is level
    assert words in state.why


def test_a_gap_counts_against_the_size_of_the_whole(plain):
    wide = plain.with_changes(size=(5.0, 1.0, 1.0))
    assert joint_states(with_first(wide, largest_gap=0.02))[0].level is Level.OK


def test_a_door_that_cannot_be_built_is_an_error_and_is_told_as_lost(plain):
    door = next(j.part for j in plain.joints if j.type == "revolute")
    after = reported(replace(BASE, additions=NO_ADDITIONS).with_joint(door, JointChoice(mechanism=MechanismClass.P)))
    state = {s.part: s for s in joint_states(after)}[door]
    assert (state.level, state.joint) == (Level.ERROR, "")
    assert lost(plain, after) == (f"{door}: {state.why.split(': ', 2)[2]}",)
    assert "class P" in state.why
    assert lost(plain, plain) == ()


def test_pivots_can_be_had_or_the_report_says_not(plain):
    door = next(j.part for j in plain.joints if j.type == "revolute")
    after = reported(BASE.with_joint(door, JointChoice(template=PIVOT)))
    assert {j.part: j.template for j in after.joints}.get(door, PIVOT) == PIVOT
