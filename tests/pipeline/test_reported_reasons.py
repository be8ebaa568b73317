"""Why something was not made reaches the report, the lines that the extension shows, and readers of older reports."""

import json
from dataclasses import replace

import pytest

from grafu.additions.config import AdditionConfig
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.report import report_of, skipped_record
from grafu.pipeline.report_schema import NOT_ADDED, Report, SkippedRecord
from grafu.pipeline.settings import Settings
from grafu.pipeline.triage import left_out
from grafu.refusal import Asked, Reason, Refusal
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door
from grafu.templates.gallery import builtin_gallery


@pytest.fixture(scope="module")
def report() -> Report:
    """A cabinet that gets more shelves than it has room for, and one in a compartment that there is not."""
    from grafu.additions.interior.request import CompartmentChoice, parse_interior

    asset = make_cabinet(Cabinet("made", Case(0.6, 0.8), Door("left")))
    additions = replace(
        AdditionConfig(),
        interior=parse_interior("shelves=20"),
        compartments={99: CompartmentChoice(shelves=1)},
    )
    config = PipelineConfig(Settings(additions=additions))
    return report_of(functionalize(asset, MotionSource.ANNOTATION, builtin_gallery(), config))


def test_what_was_not_added_says_why(report):
    told = {skip.request: (skip.what, skip.cause, skip.reason) for skip in report.skipped}
    assert told["shelf of compartment 1"] == (Asked.INTERIOR, Reason.FEWER, NOT_ADDED)
    assert told["interior of compartment 100"] == (Asked.INTERIOR, Reason.NO_COMPARTMENT, NOT_ADDED)


def test_the_report_reads_itself(report):
    text = json.dumps(report.to_json())
    assert Report.read_json(text).skipped == report.skipped
    assert '"cause": "fewer"' in text


def test_what_was_left_out_is_told_in_a_sentence_and_with_what_was_found(report):
    lines = left_out(report)
    assert len(lines) == 2
    assert any(line.startswith(f"shelf of compartment 1: {Reason.FEWER.sentence} there is room for") for line in lines)


@pytest.mark.parametrize("reason", Reason)
def test_a_joint_keeps_its_reason_and_an_addition_has_a_cause(reason):
    joint, handle = (skipped_record(Refusal("door", reason, "seen", what)) for what in (Asked.JOINT, Asked.GRASP))
    assert joint.reason is joint.cause is handle.cause is reason
    assert handle.reason == (reason if reason is Reason.TOO_COMPLEX else NOT_ADDED)
    assert handle.sentence == reason.sentence


def test_a_record_of_an_older_report_states_no_cause():
    old = SkippedRecord.read({"request": "door", "reason": "not added", "detail": "nothing to grasp it by"})
    assert (old.cause, old.what, old.sentence) == (None, None, "")
