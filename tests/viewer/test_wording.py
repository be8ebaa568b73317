"""Reports in words."""

import pytest

from grafu.additions.step import DeficiencyKind
from grafu.pipeline.certainty import certainty_words
from grafu.pipeline.report_changes import AddedRecord
from grafu.pipeline.report_schema import NOT_ADDED, AxisRecord, DeficiencyRecord, SkippedRecord
from grafu.pipeline.words import counted, listed
from grafu.refusal import Reason
from grafu.viewer.wording import (
    added,
    axis_words,
    direction_words,
    facts,
    moved_words,
    remaining_deficiencies,
    unused_joints,
)
from grafu.vocabulary import JointType, PartLabel


def test_the_facts_say_what_moves_was_missing_and_was_added(made):
    said = facts(made.report)

    assert said.startswith("1 part on hinges and 1 on rails move.")
    assert "Missing in the input: hardware for 2 parts" in said
    assert said.endswith("Added: 2 hinges, 2 rails and 1 handle.")


@pytest.mark.parametrize(
    ("unused", "words"),
    [
        (0, ""),
        (1, "states 1 joint; --motion annotation builds it"),
        (2, "states 2 joints; --motion annotation builds them"),
    ],
)
def test_stated_joints_that_nobody_read_are_said(made, unused, words):
    motion = made.report.motion.with_changes(stated_joints=2, unused_joints=unused)
    assert unused_joints(made.report.with_changes(motion=motion)) == words


def test_a_report_of_nothing_says_so(made):
    empty = made.report.with_changes(joints=(), added=(), skipped=(), deficiencies=())

    assert facts(empty) == "Nothing moves. Nothing was missing in the input. Nothing was added."


def test_the_boards_of_a_drawers_box_are_one_box(made):
    board = AddedRecord(part="a", category=PartLabel.MISC, why="", style="drawer box", link="drawer")
    boards = tuple(board.with_changes(part=name) for name in "abcd")
    top = AddedRecord(part="top", category=PartLabel.TOP_PANEL, why="", style="rectangle", link="body")

    report = made.report.with_changes(joints=(), added=(*boards, top))
    assert added(report) == ["1 top panel", "1 drawer box"]


def test_what_was_built_is_no_longer_lacking(made):
    lacks = tuple(
        DeficiencyRecord(kind=kind, part=made.report.joints[0].part, detail="") for kind in (DeficiencyKind.HINGE,)
    )
    top = DeficiencyRecord(kind=DeficiencyKind.TOP, part="", detail="")
    report = made.report.with_changes(deficiencies=(*lacks, top), added=())

    assert remaining_deficiencies(report) == (top,)
    assert remaining_deficiencies(report.with_changes(joints=())) == (*lacks, top)


def test_what_was_stopped_is_told_apart_and_lacks_nothing(made):
    door = made.report.joints[0].part
    lack = DeficiencyRecord(kind=DeficiencyKind.HINGE, part=door, detail="")
    skips = {reason: SkippedRecord(request=door, reason=reason, detail="") for reason in (*Reason, NOT_ADDED)}
    changes = {"joints": made.report.joints[1:], "deficiencies": (lack,)}

    def said(reason):
        return made.report.with_changes(**changes, skipped=(skips[reason],))

    assert facts(said(Reason.REJECTED)).endswith(f"Fixed by the user: {door}.")
    assert remaining_deficiencies(said(Reason.REJECTED)) == ()
    assert "Fixed by" not in facts(said(Reason.BLOCKED))
    assert remaining_deficiencies(said(Reason.BLOCKED)) == (lack,)


def test_counts_and_lists_are_words():
    assert (counted(1, "hinge"), counted(3, "shelf"), counted(2, "rail")) == ("1 hinge", "3 shelves", "2 rails")
    assert counted(2, "drawer box") == "2 drawer boxes"
    assert (listed([]), listed(["a"]), listed(["a", "b", "c"])) == ("", "a", "a, b and c")


@pytest.mark.parametrize(
    ("direction", "said"),
    [((0.0, 0.0, 1.0), "+Z"), ((0.0, -1.0, 0.0), "−Y"), ((0.6, 0.0, 0.8), "(0.60, 0.00, 0.80)")],
)
def test_directions_have_names(direction, said):
    assert direction_words(direction) == said


def test_an_axis_says_where_it_lies(made):
    axis = AxisRecord(origin=(-0.25, 0.1, 5.0), direction=(0.0, 0.0, 1.0))
    joint = next(j for j in made.report.joints if j.type is JointType.REVOLUTE)
    moved = joint.with_changes(
        initial_axis=axis, rectified_axis=AxisRecord(origin=(-0.22, 0.14, 7.0), direction=(0.0, 0.0, 1.0))
    )

    assert axis_words(axis, JointType.REVOLUTE) == "+Z at x −25.0, y 10.0 cm"
    assert axis_words(axis, JointType.PRISMATIC) == "along +Z"
    assert moved_words(moved) == "5.0 cm"


def test_decisions_are_said_as_sides(made):
    completion = made.result.completion
    words = {joint.part: certainty_words(completion, joint.part) for joint in made.report.joints}

    assert any(line.startswith("hinge side ") for lines in words.values() for line in lines)
    assert any(line.startswith("slides to the front") for lines in words.values() for line in lines)
