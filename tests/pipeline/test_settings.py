"""Settings: what is chosen is built, comes back from JSON as it was, and what cannot be is said in one line."""

import json
from dataclasses import replace
from itertools import pairwise
from math import radians
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grafu.additions.config import NO_ADDITIONS
from grafu.additions.handle.config import HandleChoice
from grafu.additions.interior.request import CompartmentChoice
from grafu.additions.interior.turned import compartments_of
from grafu.additions.top.config import TopConfig
from grafu.articulation.base import BaseKind
from grafu.asset.lasso_cut import Lasso
from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.asset.part import Asset
from grafu.asset.regrouping import Regroup, Regrouping
from grafu.errors import OptionError
from grafu.joints.motion_choice import FIXED, MotionChoice, Moves, Side
from grafu.joints.plan import AUTOMATIC, JointChoice
from grafu.pipeline.functionalize import Functionalized, functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.report import report_of
from grafu.pipeline.settings import SCHEMA, Settings, _adapter, settings_from_json
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door, Drawer, Stack
from grafu.templates.gallery import builtin_gallery
from grafu.templates.handles import HANDLES
from grafu.vocabulary import MechanismClass, PartLabel

CABINET = Cabinet("made", Case(0.5, 0.9), Stack((Drawer(), Door(handle="none")), (1.0, 3.0)))
BASE = Settings(MotionSource.ANNOTATION)

choices = st.builds(
    JointChoice,
    mechanism=st.sampled_from([None, *(m for m in MechanismClass if m is not MechanismClass.NONE)]),
    scale=st.floats(0.25, 4.0),
    count=st.integers(0, 12),
    flipped=st.booleans(),
    opening=st.none() | st.floats(0.01, 3.0),
)
turns = st.builds(MotionChoice, st.just(Moves.TURNS), st.sampled_from(Side), st.booleans())
slides = st.builds(MotionChoice, st.just(Moves.SLIDES), st.none() | st.sampled_from(Side))
motions = turns | slides | st.just(FIXED)
handles = st.builds(
    HandleChoice,
    style=st.sampled_from(["", "none", "grip", *(h.id for h in HANDLES)]),
    count=st.integers(0, 4),
    offset=st.tuples(st.floats(-1, 1), st.floats(-1, 1)),
)


@pytest.fixture(scope="module")
def asset() -> Asset:
    return make_cabinet(CABINET)


def run(asset: Asset, chosen: Settings) -> Functionalized:
    again = settings_from_json(json.loads(json.dumps(chosen.to_json())))
    result = functionalize(asset, again.motion, builtin_gallery(), PipelineConfig(again))
    report_of(result)  # every choice can be reported
    return result


@given(
    st.builds(
        Settings,
        motion=st.sampled_from([MotionSource.AUTO, MotionSource.RULE]),
        trim=st.booleans(),
        labels=st.dictionaries(st.text(), st.sampled_from(PartLabel)),
        motions=st.dictionaries(st.text(), motions),
        joints=st.dictionaries(st.text(), choices),
    ),
    st.dictionaries(st.text(), handles),
    st.dictionaries(st.integers(0, 60), st.builds(CompartmentChoice, st.integers(0, 20), st.integers(0, 20))),
    st.frozensets(st.text()),
)
@settings(max_examples=60, deadline=None)
def test_settings_come_back_from_json_as_they_were(base, fronts, compartments, rejected):
    additions = replace(base.additions, fronts=fronts, compartments=compartments, rejected=rejected)
    chosen = replace(base, additions=additions)
    assert settings_from_json(json.loads(json.dumps(chosen.to_json()))) == chosen


def test_nothing_added_comes_back_too():
    chosen = replace(BASE, additions=NO_ADDITIONS, reading=LoadOptions(up="+Y", height=0.7))
    assert settings_from_json(chosen.to_json()) == chosen


def test_thresholds_of_additions_are_settings():
    chosen = settings_from_json({"schema": SCHEMA, "additions": {"top": {"outline": {"kneehole": 0.5}}}})
    top = chosen.additions.top
    assert top is not None
    assert (top.outline.kneehole, top.outline.span) == (0.5, TopConfig().outline.span)
    assert settings_from_json(json.loads(json.dumps(chosen.to_json()))) == chosen


def test_what_is_left_out_is_as_by_default():
    assert settings_from_json({"schema": SCHEMA}) == Settings()


@pytest.mark.parametrize(
    ("given_values", "words"),
    [
        ([], "must be a JSON object"),
        ({}, "`schema` grafu.settings/1: got None"),
        ({"schema": SCHEMA, "source": "auto"}, "there is no setting `source`"),
        ({"schema": SCHEMA, "joints": {"d": {"scael": 1}}}, "there is no setting `joints.d.scael`"),
        (
            {"schema": SCHEMA, "additions": {"top": {"outline": {"kneel": 1}}}},
            "no setting `additions.top.outline.kneel`",
        ),
        ({"schema": SCHEMA, "additions": {"grasp": {"relief": {"cell": 0}}}}, "`ReliefConfig.cell` must be above 0"),
        ({"schema": SCHEMA, "joints": {"d": {"scale": 9}}}, "`joints.d` is wrong.*must be in 0.25..4"),
        ({"schema": SCHEMA, "motion": "urdf"}, "reads a file"),
        ({"schema": SCHEMA, "reading": {"up": "Q"}}, "`reading` is wrong"),
        ({"schema": SCHEMA, "labels": {"a": "spoon"}}, "`labels.a` is wrong"),
        ({"schema": SCHEMA, "additions": {"fronts": {"d": {"count": 7}}}}, "HandleChoice.count"),
        ({"schema": SCHEMA, "additions": {"fronts": {"d": {"depth": -0.01}}}}, "HandleChoice.depth"),
        ({"schema": SCHEMA, "additions": {"fronts": {"d": {"profile": "round"}}}}, "profile"),
    ],
)
def test_wrong_settings_are_told_in_one_line(given_values, words):
    with pytest.raises(OptionError, match=words) as error:
        settings_from_json(given_values)
    assert "\n" not in str(error.value)


def test_a_choice_that_decides_nothing_is_forgotten():
    chosen = BASE.with_joint("door_1", JointChoice(count=3)).with_front("door_1", HandleChoice("none"))
    assert chosen.with_joint("door_1", AUTOMATIC).with_front("door_1", None) == BASE


def added(result: Functionalized) -> dict[str, str]:
    return {a.part.id: a.style for a in result.additions}


def moving_bodies(result: Functionalized) -> dict[str, str]:
    return {made.type.value: made.moving for made in result.report.installed}


def test_joints_are_built_as_chosen(asset):
    door = moving_bodies(run(asset, BASE))["revolute"]
    made = {
        m.moving: m
        for m in run(asset, BASE.with_joint(door, JointChoice(template="piano", opening=1.0))).report.installed
    }
    assert (made[door].template, made[door].opening) == ("piano", pytest.approx(1.0))


@pytest.mark.parametrize("count", [1, 2, 3])
@pytest.mark.parametrize("style", ["knob-round", "bar-strip"])
def test_a_drawer_gets_the_handles_that_are_chosen_instead_of_its_own(asset, style, count):
    drawer = moving_bodies(run(asset, BASE))["prismatic"]
    own = [p.id for p in asset.parts if p.carried_by == drawer and p.label is PartLabel.HANDLE]
    result = run(asset, BASE.with_front(drawer, HandleChoice(style, count)))
    names = {visual.name for visual in result.object.link(drawer).visuals}
    new = [a.part for a in result.additions if a.part.carried_by == drawer and a.part.label is PartLabel.HANDLE]
    assert own
    assert not names & set(own)
    assert set(own).isdisjoint(node.id for node in result.completion.completed.nodes)
    assert [added(result)[p.id] for p in new] == [style] * count
    middles = sorted(float(p.box.center[0]) for p in new)
    width = asset.part(drawer).box.size[0]
    assert all(b - a == pytest.approx(width / count, rel=0.1) for a, b in pairwise(middles))


def test_offsets_move_a_handle_and_never_off_its_front(asset):
    door = moving_bodies(run(asset, BASE))["revolute"]
    box = asset.part(door).box
    places = {}
    for up in (0.0, -0.1, -9.0):
        (handle,) = [
            a.part
            for a in run(asset, BASE.with_front(door, HandleChoice("knob-round", offset=(0.0, up)))).additions
            if a.part.carried_by == door
        ]
        places[up] = float(handle.box.center[2])
        assert box.low[2] < handle.box.low[2]
    assert places[-0.1] == pytest.approx(places[0.0] - 0.1, abs=0.005)


def test_a_front_can_be_left_without_or_be_carved(asset):
    door = moving_bodies(run(asset, BASE))["revolute"]
    bare = run(asset, BASE.with_front(door, HandleChoice("none")))
    assert not [a for a in bare.additions if a.part.carried_by == door]
    assert {j.part: j.grasp for j in report_of(bare).joints}[door] == "none"
    carved = run(asset, BASE.with_front(door, HandleChoice("hole")))
    assert [c.part.id for c in carved.fittings.changes.carved] == [door]


def test_a_grip_has_the_sizes_and_the_profile_that_are_chosen_for_its_front(asset):
    drawer = moving_bodies(run(asset, BASE))["prismatic"]
    shapes = {}
    for name, choice in {
        "usual": HandleChoice("groove"),
        "small": HandleChoice("groove", length=0.06, width=0.02, depth=0.004),
        "sharp": HandleChoice("groove", length=0.06, width=0.02, depth=0.004, profile="sharp"),
    }.items():
        (made,) = run(asset, BASE.with_front(drawer, choice)).fittings.changes.carved
        shapes[name] = made
    assert shapes["small"].size == pytest.approx([0.06, 0.02, 0.004])
    assert (shapes["usual"].size > shapes["small"].size).all()
    assert (shapes["small"].profile, shapes["sharp"].profile) == ("rounded", "sharp")


def test_a_handle_that_finds_no_room_is_told_with_what_took_its_place():
    sideboard = load_asset(Path(__file__).parents[2] / "samples" / "sideboard.glb")
    base = Settings(MotionSource.RULE)
    said = {}
    for count in (1, 2):
        result = run(sideboard, base.with_front("door_1", HandleChoice("bail", count)))
        said[count] = [s.why for s in result.fittings.refusals if s.part == "door_1"]
        styles = {style for name, style in added(result).items() if name.startswith("handle")}
        assert styles == {"bail"} if not said[count] else any(f"it got `{style}`" in said[count][0] for style in styles)
    assert not said[1]
    assert "`bail` finds no room" in said[2][0]


@pytest.mark.slow
def test_rejected_additions_are_left_out_and_the_rest_stays(asset):
    chosen = BASE.with_compartment(0, CompartmentChoice(shelves=2))
    full = run(asset, chosen)
    for name in added(full):
        without = run(asset, chosen.with_addition(name, accepted=False))
        assert added(full).keys() - added(without).keys() == {name}
        assert name not in {v.name for link in without.object.links for v in link.visuals}
        assert chosen.with_addition(name, accepted=False).with_addition(name, accepted=True) == chosen


def test_compartments_get_what_is_chosen_for_each(asset):
    plain = run(asset, BASE)
    found, _ = compartments_of(plain.before_panels)
    behind = next(k for k, c in enumerate(found) if c.behind)
    result = run(asset, BASE.with_compartment(behind, CompartmentChoice(shelves=2, thickness=0.01)))
    shelves = [a.part for a in result.additions if a.part.label is PartLabel.SHELF]
    assert [round(float(p.box.size[2]), 4) for p in shelves] == [0.01, 0.01]
    beyond = run(asset, BASE.with_compartment(len(found), CompartmentChoice(shelves=1)))
    assert any(f"compartment {len(found) + 1}" in s.part for s in beyond.fittings.refusals)


def test_corrected_labels_change_what_is_built_and_say_who_said_so(asset):
    blind = asset.without_annotation()
    door = next(p.id for p in blind.parts if p.label is PartLabel.DOOR)
    base = Settings(MotionSource.RULE)
    assert door in {m.moving for m in run(blind, base).report.installed}
    result = run(blind, base.with_label(door, PartLabel.MISC))
    assert door not in {m.moving for m in result.report.installed}
    assert {p.id: p.labelled_by for p in report_of(result).parts}[door] == "user"
    with pytest.raises(OptionError, match="no_one"):
        run(blind, base.with_label("no_one", PartLabel.DOOR))


def test_a_chosen_opening_is_no_wider_than_what_is_free(asset):
    door = moving_bodies(run(asset, BASE))["revolute"]
    made = run(asset, BASE.with_joint(door, JointChoice(opening=radians(170), mechanism=MechanismClass.F)))
    joint = made.object.joint_of.get(door)
    assert joint is None or joint.limits.upper <= radians(170)


def test_what_is_shown_of_settings_is_what_was_changed() -> None:
    assert repr(Settings()) == "Settings()"
    assert repr(Settings(trim=False)) == "Settings(trim=False)"
    long = Settings(trim=False).with_addition("top_panel", accepted=False)
    assert repr(long) == "Settings(trim=False, additions=AdditionConfig(rejected=frozenset({'top_panel'})))"
    longer = long.with_addition("back_panel", accepted=False)
    assert repr(longer) == "Settings(trim=False, additions=...)"


def test_settings_are_written_as_pydantic_writes_them_without_its_schema(monkeypatch: pytest.MonkeyPatch) -> None:
    lasso = Lasso((0.0, -2.0, 1.0), ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)))
    chosen = Settings(
        weights=Path("a/b.onnx"), base=BaseKind.FIXED, motions={"d": MotionChoice(Moves.TURNS, Side.LEFT)}
    )
    chosen = chosen.with_label("a", PartLabel.DOOR).with_joint("d", JointChoice(MechanismClass.C, scale=1.5))
    chosen = chosen.with_front("a", HandleChoice("none")).with_compartment(3, CompartmentChoice(2, inset=0.01))
    chosen = chosen.with_addition("top", accepted=False).with_motion("e", FIXED)
    chosen = chosen.with_regrouping(Regrouping(Regroup.CUT, ("x",), lasso))
    for made in (Settings(), chosen, replace(chosen, additions=NO_ADDITIONS)):
        expected = {"schema": SCHEMA, **_adapter().dump_python(made, mode="json")}
        monkeypatch.setattr("grafu.pipeline.settings._adapter", None)
        assert json.dumps(made.to_json()) == json.dumps(expected)
        monkeypatch.undo()
