"""What a user states of how a part moves is built, whoever completed the graph; what is rejected is static."""

import json
from dataclasses import replace
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from grafu.asset.load import load_asset
from grafu.asset.part import Asset
from grafu.cli.part_options import part_move
from grafu.errors import OptionError
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.transform import from_rotation, rotation_matrix, transform_points
from grafu.graph.serialize import completion_from_json, completion_to_json
from grafu.joints.motion_choice import (
    DIRECTIONS,
    FIXED,
    MotionChoice,
    Moves,
    Side,
    axis_of_motion,
    choice_in_words,
    motion_as_choice,
)
from grafu.joints.plan import JointChoice
from grafu.pipeline.functionalize import Functionalized, functionalize
from grafu.pipeline.motion_choices import REJECTED, motions_of
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.report import report_of
from grafu.pipeline.settings import Settings, settings_from_json
from grafu.pipeline.triage import Level, joint_states
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door, Drawer, Stack
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import MOTION_WORDS, JointType, PartLabel

SOURCES = [MotionSource.ANNOTATION, MotionSource.RULE]
SAMPLES = Path(__file__).parents[2] / "samples"


def made_cabinet() -> Asset:
    return make_cabinet(Cabinet("made", Case(0.5, 0.9), Stack((Drawer(), Door()), (1.0, 3.0))))


@pytest.fixture(scope="module")
def asset() -> Asset:
    return made_cabinet()


def named(asset: Asset, label: PartLabel) -> str:
    return next(p.id for p in asset.parts if p.label is label)


def run(asset: Asset, chosen: Settings) -> Functionalized:
    again = settings_from_json(json.loads(json.dumps(chosen.to_json())))
    result = functionalize(asset, again.motion, builtin_gallery(), PipelineConfig(again))
    report_of(result)
    return result


def opened(result: Functionalized, part: str) -> np.ndarray:
    """How far the middle of an open part lies from where it is closed."""
    joint = result.object.joint_of[part]
    middle = result.asset.part(part).box.center
    return transform_points(joint.motion(joint.limits.upper), middle[None])[0] - middle


@pytest.mark.parametrize("source", SOURCES)
def test_what_is_rejected_is_static_with_all_that_sits_on_it(asset, source):
    door = named(asset, PartLabel.DOOR)
    attached = {p.id for p in asset.parts if p.carried_by == door}
    result = run(asset, Settings(source).with_motion(door, FIXED))
    report = report_of(result)
    assert door not in result.object.joint_of
    assert {door, *attached} <= {v.name for v in result.object.link(result.object.root).visuals}
    assert [(s.reason, s.detail) for s in report.skipped if s.request == door] == [("rejected", REJECTED)]
    assert {s.part: s.level for s in joint_states(report)}[door] is Level.OK
    assert [r.why for r in result.completion.refused if r.part == door] == [REJECTED]
    assert door not in {h.child for h in result.completion.completed.hinges}


@pytest.mark.parametrize(("source", "side"), list(product(SOURCES, [Side.LEFT, Side.RIGHT, Side.TOP, Side.BOTTOM])))
def test_a_door_turns_about_the_border_that_is_stated(asset, source, side):
    door = named(asset, PartLabel.DOOR)
    result = run(asset, Settings(source).with_motion(door, MotionChoice(Moves.TURNS, side)))
    (made,) = [m for m in result.report.installed if m.moving == door]
    box = result.asset.part(door).box
    towards = DIRECTIONS[side]
    off = made.axis.closest_point(box.center) - box.center
    assert made.source == "user"
    assert motions_of(result.object)[door] == MotionChoice(Moves.TURNS, side)
    assert float(off @ towards) == pytest.approx(float(np.abs(towards) @ box.half), abs=0.03)
    assert opened(result, door)[1] < -0.05
    (edge,) = [h for h in result.completion.completed.hinges if h.child == door]
    assert result.asset.part(edge.parent).label.is_support
    attached = {p.id for p in asset.parts if p.carried_by == door}
    assert attached <= {v.name for v in result.object.link(door).visuals}


@pytest.mark.parametrize("source", SOURCES)
def test_a_drawer_that_was_taken_for_a_door_slides_on_rails(asset, source):
    drawer = named(asset, PartLabel.DRAWER)
    mistaken = replace(asset, joints=tuple(j for j in asset.joints if j.part != drawer))
    mistaken = mistaken.with_labels({drawer: PartLabel.DOOR})
    result = run(mistaken, Settings(source).with_motion(drawer, MotionChoice(Moves.SLIDES)))
    (made,) = [m for m in result.report.installed if m.moving == drawer]
    assert (made.type, made.source) == (JointType.PRISMATIC, "user")
    assert result.completion.completed.node(drawer).label is PartLabel.DRAWER
    assert {p.id: p.labelled_by for p in report_of(result).parts}[drawer] == "user"
    assert opened(result, drawer)[1] < -0.1
    assert {r.axis for r in result.completion.completed.rails if r.child == drawer} == {2}


@pytest.mark.parametrize("source", SOURCES)
def test_a_front_that_slides_along_the_case_has_an_edge_and_no_refusal(asset, source):
    door = named(asset, PartLabel.DOOR)
    result = run(asset, Settings(source).with_motion(door, MotionChoice(Moves.SLIDES, Side.RIGHT)))
    completion = result.completion
    (edge,) = completion.completed.slides
    assert (edge.child, edge.axis) == (door, 1)
    assert completion.completed.node(edge.parent).label.is_support
    assert door not in {refusal.part for refusal in completion.refused}
    assert completion.decision(door, "slide").choice == "1"
    assert result.object.joint_of[door].axis.direction[0] == pytest.approx(1.0)
    assert completion_from_json(completion_to_json(completion)) == completion


@pytest.mark.parametrize("source", SOURCES)
def test_a_part_that_nobody_takes_for_a_door_becomes_one_with_the_handle_on_it(asset, source):
    door = named(asset, PartLabel.DOOR)
    handle = next(p.id for p in asset.parts if p.carried_by == door)
    blind = asset.without_annotation().with_labels({door: PartLabel.MISC})
    assert door not in run(blind, Settings(source)).object.joint_of
    result = run(blind, Settings(source).with_motion(door, MotionChoice(Moves.TURNS, Side.LEFT)))
    assert opened(result, door)[1] < -0.05
    assert handle in {v.name for v in result.object.link(door).visuals}


def test_what_is_stated_of_all_parts_holds_where_one_rode_on_the_other(asset):
    door = named(asset, PartLabel.DOOR)
    part = next(p.id for p in asset.parts if p.carried_by == door)
    chosen = Settings(MotionSource.ANNOTATION).with_motion(part, MotionChoice(Moves.SLIDES))
    result = run(asset, chosen)
    assert part not in {v.name for v in result.object.link(door).visuals}


def test_choices_for_the_joint_hold_on_a_stated_motion(asset):
    door = named(asset, PartLabel.DOOR)
    chosen = Settings(MotionSource.RULE).with_motion(door, MotionChoice(Moves.TURNS, Side.RIGHT))
    result = run(asset, chosen.with_joint(door, JointChoice(count=3, opening=1.0)))
    (made,) = [m for m in result.report.installed if m.moving == door]
    assert (made.count, made.opening) == (3, pytest.approx(1.0))


@pytest.mark.parametrize(
    ("part", "choice", "labels", "words"),
    [
        ("no_one", FIXED, {}, "has no no_one"),
        (PartLabel.DOOR, MotionChoice(Moves.TURNS, Side.FRONT), {}, "front is a broad face"),
        (PartLabel.DOOR, MotionChoice(Moves.TURNS, Side.LEFT), PartLabel.MISC, "must not be misc"),
    ],
)
def test_a_motion_that_cannot_be_is_refused_in_one_line(asset, part, choice, labels, words):
    name = part if part == "no_one" else named(asset, part)
    chosen = Settings(MotionSource.RULE, labels={name: labels} if labels else {}).with_motion(name, choice)
    with pytest.raises(OptionError, match=words) as error:
        run(asset, chosen)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    "given_values", [{"moves": "turns"}, {"moves": "fixed", "side": "left"}, {"moves": "slides", "inwards": True}]
)
def test_a_motion_that_contradicts_itself_is_no_setting(given_values):
    with pytest.raises(OptionError, match=r"`motions\.door` is wrong"):
        settings_from_json({"schema": "grafu.settings/1", "motions": {"door": given_values}})


def test_settings_of_earlier_versions_may_spell_fixed_in_the_old_way():
    old = settings_from_json({"schema": "grafu.settings/1", "motions": {"door": {"moves": "not"}}})

    assert old.motions["door"] == FIXED
    with pytest.raises(OptionError, match="use fixed"):
        choice_in_words("not")


def test_a_choice_of_none_is_forgotten():
    base = Settings(MotionSource.RULE)
    assert base.with_motion("door", FIXED).with_motion("door", None) == base


def _turned_door(angle):
    flat = made_cabinet()
    door = flat.part(named(flat, PartLabel.DOOR))
    T = from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), angle), vec3(0.0, 0.0, 0.0))
    return flat, door, T, replace(door, surfaces=tuple(surface.transformed(T) for surface in door.surfaces))


@given(st.floats(-3.1, 3.1), st.sampled_from([Side.TOP, Side.BOTTOM]), st.booleans())
@example(0.0, Side.TOP, False)
@example(np.pi / 2, Side.BOTTOM, True)
@settings(max_examples=25, deadline=None)
def test_an_axis_follows_a_part_that_stands_turned(angle, side, inwards):
    # a part turned by a hair counts as straight: see the next test
    assume(abs(np.remainder(angle + np.pi / 4, np.pi / 2) - np.pi / 4) > 2e-3 or angle in {0.0, np.pi / 2})
    flat, door, T, turned = _turned_door(angle)
    choice = MotionChoice(Moves.TURNS, side, inwards)
    expected = axis_of_motion(door, choice, flat.box).transformed(T)
    found = axis_of_motion(turned, choice, flat.box)  # its middle lies on the axis of the turn
    assert found.direction == pytest.approx(expected.direction, abs=1e-6)
    assert found.distance_to(expected.point) < 1e-6


@pytest.mark.parametrize("inwards", [False, True])
@pytest.mark.parametrize("side", [Side.LEFT, Side.RIGHT, Side.TOP, Side.BOTTOM])
@pytest.mark.parametrize("angle", [0.0, 0.3, -0.7])
def test_a_motion_is_read_back_from_its_axis(angle, side, inwards):
    flat, _, _, door = _turned_door(angle)
    choice = MotionChoice(Moves.TURNS, side, inwards)
    axis = axis_of_motion(door, choice, flat.box)
    assert motion_as_choice(door.mesh, JointType.REVOLUTE, axis, flat.box) == choice
    assert motion_as_choice(door.mesh, JointType.REVOLUTE, replace(axis, direction=-axis.direction), flat.box) == (
        MotionChoice(Moves.TURNS, side, not inwards)
    )


@pytest.mark.parametrize("side", [Side.LEFT, Side.RIGHT, Side.FRONT, Side.BACK])
def test_a_slide_is_read_back_from_its_axis(side):
    flat, _, _, door = _turned_door(0.0)
    choice = MotionChoice(Moves.SLIDES, side)
    axis = axis_of_motion(door, choice, flat.box)
    assert motion_as_choice(door.mesh, JointType.PRISMATIC, axis, flat.box) == choice


def test_a_board_that_turns_in_its_own_plane_turns_about_no_border():
    flat, _, _, door = _turned_door(0.0)
    across = Axis(door.box.center, vec3(0.0, 1.0, 0.0))
    assert motion_as_choice(door.mesh, JointType.REVOLUTE, across, flat.box) is None


@given(st.floats(-1e-4, 1e-4), st.sampled_from([Side.TOP, Side.BOTTOM]))
@settings(max_examples=10, deadline=None)
def test_a_part_turned_by_a_hair_has_the_axis_of_a_straight_one(angle, side):
    flat, door, _, turned = _turned_door(angle)
    choice = MotionChoice(Moves.TURNS, side)
    straight, found = axis_of_motion(door, choice, flat.box), axis_of_motion(turned, choice, flat.box)
    assert found.direction == pytest.approx(straight.direction, abs=1e-12)
    assert found.distance_to(straight.point) < 1e-4


@pytest.mark.parametrize("sample", ["sideboard", "wardrobe"])
def test_a_door_of_a_sample_can_be_rejected_and_hung_anew(sample):
    asset = load_asset(SAMPLES / f"{sample}.glb")
    door = next(p.id for p in asset.parts if p.label is PartLabel.DOOR)
    base = Settings(MotionSource.RULE)
    assert door not in run(asset, base.with_motion(door, FIXED)).object.joint_of
    again = run(asset, base.with_motion(door, MotionChoice(Moves.TURNS, Side.RIGHT)))
    assert opened(again, door)[1] < -0.05


@pytest.mark.parametrize(
    ("word", "choice"),
    [
        ("lift", MotionChoice(Moves.TURNS, Side.TOP)),
        ("drop", MotionChoice(Moves.TURNS, Side.BOTTOM)),
        ("left", MotionChoice(Moves.TURNS, Side.LEFT)),
        ("front", MotionChoice(Moves.TURNS, Side.FRONT)),
        ("back", MotionChoice(Moves.TURNS, Side.BACK)),
        ("pull", MotionChoice(Moves.SLIDES)),
        ("slide-left", MotionChoice(Moves.SLIDES, Side.LEFT)),
        ("slide-right", MotionChoice(Moves.SLIDES, Side.RIGHT)),
        ("slide-up", MotionChoice(Moves.SLIDES, Side.TOP)),
        ("fold-left", MotionChoice(Moves.FOLDS, Side.LEFT)),
        ("fold-up", MotionChoice(Moves.FOLDS, Side.TOP)),
        ("tilt", MotionChoice(Moves.TILTS, Side.BOTTOM)),
        ("lift-parallel", MotionChoice(Moves.LIFTS, Side.TOP)),
        ("fold-right", MotionChoice(Moves.FOLDS, Side.RIGHT)),
        ("fixed", FIXED),
    ],
)
def test_words_state_motions(word, choice):
    assert choice_in_words(word) == choice


def test_the_command_offers_every_word_and_no_other():
    assert [part_move(f"door={word}") for word in MOTION_WORDS] == [("door", word) for word in MOTION_WORDS]
    assert all(choice_in_words(word) for word in MOTION_WORDS)
    with pytest.raises(OptionError, match="fold-right, fold-up, fixed: got 'slide-down'"):
        choice_in_words("slide-down")
