"""What sets a joint right is an option that the command takes, names the other side, and is copied by a click."""

from dataclasses import replace

import pytest
from page_reader import PageReader

from grafu.cli.part_options import part_move
from grafu.joints.motion_choice import MotionChoice, Moves, Side
from grafu.pipeline import move_options as options_of
from grafu.pipeline.motion_choices import motions_of
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.move_options import move_options


def said_of(made, part):
    return [part_move(line.removeprefix("--move ")) for line in move_options(made.result)[part]]


def test_every_joint_has_its_lines_and_the_command_takes_them(made):
    assert {joint.part for joint in made.report.joints} == set(made.report.moves)
    for joint in made.report.joints:
        assert said_of(made, joint.part)[-1] == (joint.part, "fixed")


def test_a_door_turns_about_the_other_side_instead(made):
    motions = motions_of(made.result.object)
    door = next(part for part, motion in motions.items() if motion.moves is Moves.TURNS)
    other = {Side.LEFT: "right", Side.RIGHT: "left"}[motions[door].side]

    assert said_of(made, door)[0] == (door, other)


@pytest.mark.parametrize(
    ("motion", "ways"),
    [
        (MotionChoice(Moves.TURNS, Side.TOP), ["bottom", "fixed"]),
        (MotionChoice(Moves.TURNS, Side.BACK), ["fixed"]),  # no motion that `--move` knows
        (MotionChoice(Moves.SLIDES, Side.LEFT), ["fixed"]),
        (None, ["fixed"]),
    ],
)
def test_the_way_follows_the_motion(made, monkeypatch, motion, ways):
    first = made.report.joints[0].part
    monkeypatch.setattr(options_of, "motions_of", lambda _: {first: motion} if motion else {})

    assert [way for _, way in said_of(made, first)] == ways


def test_motions_of_another_system_have_none(made):
    assert move_options(replace(made.result, source=MotionSource.SINGAPO)) == {}


def test_the_page_holds_them(page, made):
    lines = [line for joint in made.report.joints for line in made.report.moves[joint.part]]

    assert [button["data-copy"] for button in PageReader(page).all("button", class_="copy")] == lines


def test_a_click_copies_a_line(browser, page_file):
    browser.open(page_file)
    browser.run(
        "Object.defineProperty(navigator, 'clipboard', {value: {writeText: async (text) => { window.told = text; }}})"
    )
    line = browser.run("(document.querySelector('.copy').click(), document.querySelector('.copy').textContent)")
    browser.wait_for("document.querySelector('.copy[data-copied]') !== null")

    assert line.startswith("--move ")
    assert browser.run("window.told") == line
