"""The verdict on synthetic furniture: green means that every door and drawer works, and each fault takes that away.

Faults are put into reports of furniture that works, in any number and mixture, and into the furniture itself.
"""

from collections.abc import Callable
from dataclasses import fields, replace
from functools import cache

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.additions.config import NO_ADDITIONS
from grafu.asset.part import Asset
from grafu.joints.motion_choice import FIXED, MotionChoice, Moves, Side
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.report import report_of
from grafu.pipeline.report_schema import ClearanceRecord, GuessRecord, JointRecord, Report, SkippedRecord
from grafu.pipeline.settings import Settings
from grafu.pipeline.triage import Level, joint_states
from grafu.pipeline.verdict import VerdictConfig, verdict_of
from grafu.pipeline.words import Colour, FaultKind
from grafu.refusal import Reason
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door, Drawer, Stack
from grafu.synth.samples import KINDS
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType, PartLabel

DEFAULT = VerdictConfig()

GALLERY = builtin_gallery()
LAYOUTS = (Door(), Stack((Drawer(), Door()), (1.0, 3.0)), Stack((Drawer(), Drawer(), Drawer()), (1.0, 1.0, 1.0)))
BAD = Callable[[Report, JointRecord, float], Report]


def cabinet(layout: int) -> Asset:
    return make_cabinet(Cabinet("made", Case(0.5, 0.9), LAYOUTS[layout]))


def reported(asset: Asset, source: MotionSource = MotionSource.ANNOTATION, **config) -> Report:
    chosen = PipelineConfig(Settings(additions=NO_ADDITIONS, **config))
    return report_of(functionalize(asset, source, GALLERY, chosen))


@cache
def sound(layout: int) -> Report:
    return reported(cabinet(layout))


def with_joint(report: Report, part: str, **changes) -> Report:
    joints = (joint.with_changes(**changes) if joint.part == part else joint for joint in report.joints)
    return report.with_changes(joints=tuple(joints))


def without_joint(report: Report, part: str) -> Report:
    """The part stands with the body, as it does where no one moves it."""
    parts = tuple(p.with_changes(link="body") if p.link == part else p for p in report.parts)
    joints = tuple(joint for joint in report.joints if joint.part != part)
    return report.with_changes(joints=joints, parts=parts)


def skipped(report: Report, joint: JointRecord, size: float) -> Report:
    reasons = [reason for reason in Reason if reason is not Reason.REJECTED]
    skip = SkippedRecord(request=joint.part, reason=reasons[int(size * (len(reasons) - 1))], detail="")
    left = without_joint(report, joint.part)
    return left.with_changes(skipped=(*left.skipped, skip))


def guessed(report: Report, joint: JointRecord, size: float) -> Report:
    score = (1 - size) * DEFAULT.least_confidence - 1e-6
    guess = GuessRecord(
        part=joint.part, question="slide", choice="front", score=max(score, 0.0), runner_up="", runner_up_score=0.0
    )
    return report.with_changes(guesses=(*report.guesses, guess))


def carved(report: Report, joint: JointRecord, size: float) -> Report:
    ratio = DEFAULT.most_carved + (1 - DEFAULT.most_carved) * size
    half = 1 - (1 - ratio) ** 0.5  # two cuts that are less each, and too much together
    cut = ClearanceRecord(part="side_panel_left", kind="carved", amount=0.1, share=half, surface_share=half, why="")
    return with_joint(report, joint.part, clearances=(*joint.clearances, cut, cut))


def short(report: Report, joint: JointRecord, size: float) -> Report:
    assert joint.wanted is not None
    opening = (1 - size) * DEFAULT.least_opening * joint.wanted * 0.999
    return with_joint(report, joint.part, opening=opening, upper=opening)


FAULTS: dict[str, tuple[BAD, set[FaultKind]]] = {
    "collides": (lambda r, j, s: with_joint(r, j.part, collision_share=s), {FaultKind.COLLIDES}),
    "loose": (lambda r, j, s: with_joint(r, j.part, largest_gap=0.0051 * max(r.size or ()) + s), {FaultKind.LOOSE}),
    "short": (short, {FaultKind.RESTRICTED, FaultKind.SHUT}),
    "silent": (lambda r, j, _: without_joint(r, j.part), {FaultKind.NO_JOINT}),
    "skipped": (skipped, {FaultKind.NO_JOINT}),
    "guessed": (guessed, {FaultKind.GUESSED}),
    "no grasp": (lambda r, j, _: with_joint(r, j.part, grasp="none"), {FaultKind.NO_GRASP}),
    "carved": (carved, {FaultKind.CARVED}),
}
SIZES = st.floats(0.001, 1.0)


@pytest.mark.parametrize("layout", range(len(LAYOUTS)))
def test_furniture_that_works_is_green(layout):
    verdict = verdict_of(sound(layout))

    assert (verdict.colour, verdict.lines) == (Colour.GREEN, ())
    assert verdict.sentence.startswith("Everything works: ")


@pytest.mark.parametrize("name", FAULTS)
@given(data=st.data(), size=SIZES)
def test_each_fault_is_a_line_of_its_part_with_its_colour(name, data, size):
    report = sound(data.draw(st.integers(0, 2)))
    joint = data.draw(st.sampled_from(report.joints))
    make, kinds = FAULTS[name]
    verdict = verdict_of(make(report, joint, size))
    [line] = verdict.lines

    assert line.kind in kinds
    assert line.part == (joint.part if name != "carved" else "side_panel_left")
    assert verdict.colour is line.colour is line.kind.colour is not Colour.GREEN
    assert line.part in verdict.sentence
    assert line.why


@given(data=st.data())
def test_green_means_that_every_front_opens_and_nothing_collides(data):
    """Whatever is put into a report: where the verdict is green, each door and drawer has a joint that works."""
    report = before = sound(data.draw(st.integers(0, 2)))
    for name in data.draw(st.lists(st.sampled_from(sorted(FAULTS)), max_size=4)):
        if report.joints:
            joint = data.draw(st.sampled_from(report.joints))
            report = FAULTS[name][0](report, joint, data.draw(SIZES))
    verdict = verdict_of(report)
    fronts = {part.id for part in report.parts if part.category.is_movable}
    works = {
        joint.part
        for joint in report.joints
        if joint.collision_share == 0 and joint.opening >= DEFAULT.least_opening * (joint.wanted or 0.0) > 0
    }

    assert (verdict.colour is Colour.GREEN) == (report == before)
    if verdict.colour is Colour.GREEN:
        assert fronts <= works
    if not fronts <= works | {line.part for line in verdict.lines if line.kind is FaultKind.RESTRICTED}:
        assert verdict.colour is Colour.RED


@given(data=st.data())
def test_the_list_of_joints_has_the_colours_of_the_verdict(data):
    report = sound(1)
    for name in data.draw(st.lists(st.sampled_from(sorted(FAULTS)), max_size=3)):
        if report.joints:
            report = FAULTS[name][0](report, data.draw(st.sampled_from(report.joints)), data.draw(SIZES))
    levels = {state.part: state.level for state in joint_states(report)}
    worst = {Level.OK: Colour.GREEN, Level.WARNING: Colour.YELLOW, Level.ERROR: Colour.RED}
    of_joints = [line for line in verdict_of(report).lines if line.kind is not FaultKind.CARVED]

    for part, level in levels.items():
        colours = {line.colour for line in of_joints if line.part == part} or {Colour.GREEN}
        assert worst[level] is (Colour.RED if Colour.RED in colours else min(colours))


def test_a_part_that_somebody_stopped_is_no_fault():
    asset = cabinet(1)
    door = next(joint.part for joint in sound(1).joints if joint.type is JointType.REVOLUTE)
    verdict = verdict_of(reported(asset, motions={door: FIXED}))

    assert (verdict.colour, verdict.lines) == (Colour.GREEN, ())
    assert verdict.sentence.startswith("Everything works: 1 drawer;")


@pytest.mark.parametrize("reason", [Reason.CARRIES, Reason.UNLIKELY])
def test_a_guess_that_stays_static_is_one_yellow_line_with_the_option_that_moves_it(reason):
    report = sound(0)
    (door,) = (part for part in report.parts if part.category.is_movable)
    parts = (*report.parts, door.with_changes(id="frame", category=PartLabel.MISC, link="body"))
    guess = GuessRecord(
        part="frame", question="label", choice="misc", score=0.0, runner_up="drawer", runner_up_score=0.9
    )
    skip = SkippedRecord(request="frame", reason=reason, detail="it is taken for a drawer (90%), but it stays")
    moves = {**report.moves, "frame": ("--move frame=slide",)}
    verdict = verdict_of(report.with_changes(parts=parts, guesses=(guess,), skipped=(skip,), moves=moves))
    [line] = verdict.lines

    assert (verdict.colour, line.kind, line.option) == (Colour.YELLOW, FaultKind.NOT_BUILT, "--move frame=slide")
    assert line.why == skip.detail


def test_where_all_was_stopped_nothing_moves_as_asked_and_where_nothing_could_is_yellow():
    asset = cabinet(0)
    stopped = verdict_of(reported(asset, motions={joint.part: FIXED for joint in asset.joints}))
    board = replace(asset, joints=(), parts=tuple(p for p in asset.parts if p.id.startswith("side")))
    nothing = verdict_of(reported(board))

    assert (stopped.colour, stopped.sentence) == (Colour.GREEN, "Nothing moves: the user fixed all parts.")
    assert (nothing.colour, [line.kind for line in nothing.lines]) == (Colour.YELLOW, [FaultKind.NOTHING_MOVES])


@pytest.mark.parametrize("layout", [0, 1])
def test_a_front_that_the_source_left_fixed_is_red_and_the_option_that_moves_it_does(layout):
    """The input states a joint for none of its doors and drawers, and its own joints are asked for."""
    asset = replace(cabinet(layout), joints=())
    report = reported(asset)
    verdict = verdict_of(report)

    assert verdict.colour is Colour.RED
    assert {line.part for line in verdict.lines} == {joint.part for joint in sound(layout).joints}
    motions = {}
    for line in verdict.lines:
        part, _, motion = line.option.removeprefix("--move ").rpartition("=")
        motions[part] = MotionChoice(Moves.SLIDES) if motion == "slides" else MotionChoice(Moves.TURNS, Side(motion))
    assert motions.keys() == {line.part for line in verdict.lines}
    assert verdict_of(reported(asset, motions=motions)).colour is Colour.GREEN


def test_a_joint_that_collides_is_red_whatever_else_is_said():
    """Doors that are sunk into the case, and nothing may be trimmed."""
    report = reported(KINDS["doors into the case"](), trim=False)
    bad = {joint.part for joint in report.joints if joint.collision_share > 0}
    bad |= {skip.request for skip in report.skipped}
    verdict = verdict_of(report)

    assert bad
    assert verdict.colour is Colour.RED
    assert {line.part for line in verdict.lines if line.colour is Colour.RED} == bad


def test_the_report_holds_its_verdict_and_its_thresholds():
    report = sound(0)

    assert report.verdict == verdict_of(report)
    assert report.to_json()["verdict"]["least_confidence"] == DEFAULT.least_confidence
    assert Report.read(report.to_json()) == report


def test_a_report_of_an_earlier_version_is_read_and_judged():
    old = sound(1).to_json()
    for name in ("verdict", "size", "guesses", "moves"):
        old.pop(name)
    for joint in old["joints"]:
        joint.pop("wanted")
    read = Report.read(old)

    assert verdict_of(read).colour is Colour.GREEN
    assert verdict_of(with_joint(read, read.joints[0].part, restricted=True)).colour is Colour.YELLOW


def test_a_part_that_is_hardly_told_from_a_drawer_is_a_guess_until_somebody_says_what_it_is():
    report = sound(0)
    guess = GuessRecord(
        part="top_panel", question="label", choice="shelf", score=0.6, runner_up="drawer", runner_up_score=0.3
    )
    [line] = verdict_of(report.with_changes(guesses=(guess,))).lines

    assert (line.kind, line.part) == (FaultKind.GUESSED, "top_panel")
    assert "confidence 60 %, below 80 %; drawer: 30 %" in line.why
    sure = guess.with_changes(score=DEFAULT.least_confidence)
    assert verdict_of(report.with_changes(guesses=(sure,))).colour is Colour.GREEN


def test_the_option_beside_a_guessed_side_is_the_next_likeliest():
    """A flap that turns about its bottom, or else about its right side: its top is hardly an answer."""
    report = sound(0)
    door = next(joint.part for joint in report.joints if joint.type == "revolute")
    guess = GuessRecord(
        part=door, question="border", choice="bottom", score=0.6, runner_up="right", runner_up_score=0.2
    )
    [line] = verdict_of(report.with_changes(guesses=(guess,))).lines
    assert (line.part, line.option) == (door, f"--move {door}=right")
    [line] = verdict_of(report.with_changes(guesses=(guess,), moves={})).lines
    assert line.option == ""


LENGTHS = ("tallest", "smallest")


@pytest.mark.parametrize("name", [field.name for field in fields(VerdictConfig) if field.name not in LENGTHS])
def test_a_threshold_of_faults_is_a_fraction(name):
    with pytest.raises(ValueError, match=f"`VerdictConfig.{name}` must be between 0 and 1"):
        VerdictConfig(**{name: 1.2})


@pytest.mark.parametrize("name", LENGTHS)
def test_a_size_is_above_nothing(name):
    with pytest.raises(ValueError, match=f"`VerdictConfig.{name}`"):
        VerdictConfig(**{name: 0.0})


@pytest.mark.parametrize("size", [(0.6, 0.5, 72.0), (0.0006, 0.0005, 0.00072)])
def test_a_size_that_no_furniture_has_is_to_be_checked(size):
    report = sound(0)
    assert verdict_of(report.with_changes(size=(3.0, 0.6, DEFAULT.tallest))).lines == ()
    made = verdict_of(report.with_changes(size=size))
    [line] = [line for line in made.lines if line.option == "--height"]
    assert made.colour is not Colour.GREEN
    assert (line.colour, line.part) == (Colour.YELLOW, "")
    assert f"it is {size[2]:.4g} m high" in line.why


def test_with_other_thresholds_the_verdict_is_another():
    report = sound(0)
    guess = GuessRecord(
        part="top_panel", question="label", choice="shelf", score=0.9, runner_up="drawer", runner_up_score=0.1
    )
    report = report.with_changes(guesses=(guess,))
    strict = verdict_of(report, VerdictConfig(least_confidence=0.95))

    assert verdict_of(report).colour is Colour.GREEN
    assert [line.kind for line in strict.lines] == [FaultKind.GUESSED]
    assert "confidence 90 %, below 95 %" in strict.lines[0].why
    assert strict.least_confidence == 0.95


@pytest.mark.parametrize(
    ("note", "is_green"),
    [
        ("mesh door.stl is missing and was left out", False),
        ("textured_objs/new-2.obj is missing and was left out", False),
        ("texture oak.png is missing and was left out", True),
        ("shape <plane> is not read and was left out", True),
    ],
)
def test_a_mesh_that_could_not_be_read_is_something_to_look_at(note, is_green):
    report = sound(0)
    read = report.input.with_changes(notes=(note,))
    verdict = verdict_of(report.with_changes(input=read))
    assert (verdict.colour is Colour.GREEN) is is_green
    assert [line.why for line in verdict.lines] == ([] if is_green else [note])


def test_what_the_budget_did_not_hold_is_something_to_look_at():
    verdict = verdict_of(sound(0).with_changes(notes=("no interiors: the budget was used up",)))

    assert (verdict.colour, [line.kind for line in verdict.lines]) == (Colour.YELLOW, [FaultKind.NOTED])
    assert verdict.sentence == "Works, but check the whole (note)."


def test_a_door_that_slides_is_called_a_sliding_door_and_a_hinge_that_was_left_out_is_no_fault():
    report = sound(0)
    joint = next(joint for joint in report.joints if joint.type is JointType.REVOLUTE)
    tried = with_joint(report, joint.part, left_out=("pivot would reach below the floor",))
    slid = with_joint(tried, joint.part, type=JointType.PRISMATIC)

    assert verdict_of(tried).colour is Colour.GREEN
    assert "1 sliding door" in verdict_of(slid).sentence
