"""No page contradicts itself or another: report.json, both pages, the terminal and the list of joints say the same."""

from pathlib import Path

import pytest
from made_models import page_of
from page_reader import PageReader

from grafu.cli.job import Job, JobOptions, Succeeded
from grafu.cli.summary import print_results
from grafu.pipeline.report_schema import NOT_ADDED, SkippedRecord
from grafu.pipeline.triage import Level, joint_states
from grafu.pipeline.verdict import verdict_of
from grafu.pipeline.words import Colour, FaultKind
from grafu.refusal import Asked, Reason
from grafu.viewer.report_tables import not_built_table
from grafu.viewer.run_table import RunEntry, functionalized_run

PRAISE = ("Everything works", "Nothing was skipped", "all else that was asked for was built")


def page_with(made, **changes):
    return PageReader(page_of(type(made)(made.result, made.report.with_changes(**changes))))


def text_of(read):
    return " ".join(read.texts.values())


def colliding(made):
    first, *rest = made.report.joints
    return {"joints": (first.with_changes(collision_share=0.76), *rest)}


def silent(made):
    """The first moving body stands with the body, and no one states why."""
    first, *rest = made.report.joints
    parts = (p.with_changes(link="body") if p.link == first.part else p for p in made.report.parts)
    return {"joints": tuple(rest), "parts": tuple(parts)}


def shut(made):
    first, *rest = made.report.joints
    return {"joints": (first.with_changes(opening=0.0, upper=0.0), *rest)}


@pytest.mark.parametrize("fault", [colliding, silent, shut])
def test_where_a_part_does_not_work_no_page_praises(made, fault):
    said = text_of(page_with(made, **fault(made)))

    assert not any(praise in said for praise in PRAISE if praise != PRAISE[2] or fault is silent)
    assert "Does not work: " in said


@pytest.mark.parametrize("fault", [colliding, silent, shut, lambda made: {}])
def test_all_places_show_one_colour_and_the_same_line(made, fault, capsys, tmp_path):
    report = made.report.with_changes(**fault(made))
    verdict = verdict_of(report)
    page = page_with(made, **fault(made))
    [row] = functionalized_run("Run", [RunEntry("made", report)]).tables[0].rows
    print_results([Succeeded(Job(Path("made.glb"), "made", JobOptions(tmp_path)), report, 1.0)])
    terminal = capsys.readouterr().out
    levels = {state.level for state in joint_states(report)}

    lights = [found["class"] for found in page.all("span") if "light" in (found.get("class") or "").split()]
    assert lights == [f"light {verdict.colour}"]
    assert verdict.sentence in text_of(page)
    assert row.cells[1] == verdict.colour
    assert f"{verdict.colour}: {verdict.sentence}" in terminal
    assert (Level.ERROR in levels) is (verdict.colour is Colour.RED)


def test_a_front_that_is_static_has_the_line_that_moves_it_on_the_page_and_in_the_terminal(made, capsys, tmp_path):
    part = made.report.joints[0].part
    changes = {**silent(made), "moves": {part: (f"--move {part}=left", f"--move {part}=fixed")}}
    read = page_with(made, **changes)
    report = made.report.with_changes(**changes)
    print_results([Succeeded(Job(Path("made.glb"), "made", JobOptions(tmp_path)), report, 1.0)])

    assert f"--move {part}=left" in [button["data-copy"] for button in read.all("button", class_="copy")]
    assert f"  {part} no joint (--move {part}=left)" in capsys.readouterr().out
    assert "Everything" not in text_of(read)


def test_hinges_that_were_added_are_not_said_to_be_nothing(made):
    read = page_with(made, added=())
    said = text_of(read)

    assert "Added: 2 hinges and 2 rails." in said
    assert "Nothing was added" not in said
    assert "2 hinges and 2 rails." in read.texts.values()  # over the table, counted as at the top


def test_the_verdict_is_escaped(made):
    attack = "<img src=x onerror='window.hurt=1'>"
    skip = SkippedRecord(request=attack, reason=NOT_ADDED, detail=attack)
    read = page_with(made, skipped=(skip,))

    assert verdict_of(made.report.with_changes(skipped=(skip,))).lines[0].kind is FaultKind.NOT_BUILT
    assert [image for image in read.all("img") if "onerror" in image] == []


def test_why_something_was_not_added_stands_in_a_sentence(made):
    skip = SkippedRecord(request="door", reason=NOT_ADDED, detail="no edge", what=Asked.GRASP, cause=Reason.TOO_SMALL)
    rows = not_built_table(made.report.with_changes(skipped=(skip,)))
    assert Reason.TOO_SMALL.sentence in rows
    assert "no edge" in rows


def test_of_a_run_the_red_come_before_the_yellow_before_the_green(made):
    first, *rest = made.report.joints
    yellow = made.report.with_changes(joints=tuple(joint.with_changes(grasp="none") for joint in made.report.joints))
    slightly = {"joints": (first.with_changes(collision_share=0.02), *rest)}
    entries = [RunEntry("green", made.report), RunEntry("yellow", yellow)]
    entries += [RunEntry("red", made.report.with_changes(**slightly)), RunEntry("failed", None, "no mesh")]
    run = functionalized_run("Run", entries)

    assert [row.cells[1] for row in run.tables[0].worst_first] == ["failed", "red", "yellow", "green"]
    assert [row.cells[0] for row in run.tables[0].worst_first] == ["failed", "red", "yellow", "green"]
