"""What `functionalize` states when it is done: short, and what a person would ask next."""

from dataclasses import replace
from pathlib import Path

import pytest
from obj_inputs import CABINET, write_cabinet

from grafu.cli.job import Failed, Job, JobOptions, Succeeded, run_job
from grafu.cli.summary import print_results
from grafu.pipeline.report_schema import SkippedRecord
from grafu.refusal import Reason


@pytest.fixture(scope="module")
def topless(tmp_path_factory: pytest.TempPathFactory) -> Succeeded:
    folder = tmp_path_factory.mktemp("run")
    boxes = {name: box for name, box in CABINET.items() if name != "top_panel"}
    result = run_job(Job(write_cabinet(folder, boxes=boxes), "cabinet", JobOptions(folder / "out", formats=("urdf",))))
    assert isinstance(result, Succeeded)
    return result


def test_one_result_names_what_was_added_what_was_guessed_and_its_page(
    topless: Succeeded, capsys: pytest.CaptureFixture[str]
) -> None:
    print_results([topless])
    said = capsys.readouterr().out

    assert "green: Everything works: 1 door and 1 drawer; nothing collides, nothing comes loose." in said
    assert "added: 2 hinges, 2 rails, 1 top panel and 1 handle\n" in said
    assert "guessed: scale 1 m per unit: metres make a storage of plausible size, confidence " in said
    assert f"look at {topless.job.folder / 'report.html'}" in said


def test_joints_that_the_input_states_and_nobody_read_are_told(
    topless: Succeeded, capsys: pytest.CaptureFixture[str]
) -> None:
    print_results([topless])
    print_results([topless] * 2)
    assert "states" not in capsys.readouterr().out

    motion = topless.report.motion.with_changes(stated_joints=2, unused_joints=2)
    stating = replace(topless, report=topless.report.with_changes(motion=motion))
    print_results([stating])
    assert "the input states 2 joints; --motion annotation builds them" in capsys.readouterr().out
    print_results([stating, topless])
    assert "1 input states 2 joints; --motion annotation builds such" in capsys.readouterr().out


def test_what_happened_to_the_input_is_told_but_not_without_end(
    topless: Succeeded, capsys: pytest.CaptureFixture[str]
) -> None:
    notes = ("body was cut into 2 fronts and the rest (--parts auto)", *(f"note {k}" for k in range(6)))
    read = topless.report.input.with_changes(notes=notes)
    print_results([replace(topless, report=topless.report.with_changes(input=read))])
    said = capsys.readouterr().out

    assert f"input: {notes[0]}\n" in said
    assert "input: note 3\ninput: 2 more notes (report.json)\n" in said


def test_what_was_skipped_for_one_reason_is_told_once(topless: Succeeded, capsys: pytest.CaptureFixture[str]) -> None:
    skipped = tuple(SkippedRecord(request=f"part_{k}", reason=Reason.NO_ROOM, detail="narrow") for k in range(3))
    print_results([replace(topless, report=topless.report.with_changes(skipped=skipped))])
    said = capsys.readouterr().out

    assert said.count("narrow") == 1
    assert "part_1 and part_2" in said


def test_a_part_that_the_user_fixed_is_listed_and_is_no_fault(
    topless: Succeeded, capsys: pytest.CaptureFixture[str]
) -> None:
    skip = SkippedRecord(request="door_9", reason=Reason.REJECTED, detail="it was decided")
    stopped = replace(topless, report=topless.report.with_changes(skipped=(skip,)))
    print_results([stopped])
    row = next(line for line in capsys.readouterr().out.splitlines() if "door_9" in line)
    assert row.split() == ["door_9", "fixed", "by", "the", "user"]

    print_results([stopped] * 25)
    said = capsys.readouterr().out
    assert "door_9" not in said
    assert "0 skipped in 25 inputs" in said


def test_of_many_inputs_only_those_to_look_at_have_a_row(
    topless: Succeeded, capsys: pytest.CaptureFixture[str]
) -> None:
    bad = Failed(Job(Path("bad.glb"), "bad", topless.job.options), "it is empty", users_fault=True)
    print_results([topless] * 25 + [bad])
    said = capsys.readouterr().out

    assert "FAILED: it is empty" in said
    assert "cabinet" not in said
    assert "25 inputs: 25 green; 1 of 26 inputs failed" in said
