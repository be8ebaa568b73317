"""The forecast of `grafu inspect` agrees with what a run plans, and is silent of nothing."""

import pytest

from grafu.asset.part import Asset
from grafu.pipeline.forecast import forecast
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.synth.samples import TIDY
from grafu.templates.gallery import builtin_gallery


@pytest.fixture(scope="module", params=["overlay pair", "drawers with panels between"])
def piece(request: pytest.FixtureRequest) -> Asset:
    return TIDY[request.param]()


def test_it_names_what_a_run_plans_and_reads_no_joints_of_the_input(piece: Asset) -> None:
    expected = forecast(piece)
    made = functionalize(piece, MotionSource.AUTO, builtin_gallery())

    assert [(motion.part, motion.type) for motion in expected.motions] == [
        (request.moving, request.type) for request in made.plan.joints
    ]
    assert expected == forecast(piece.without_annotation())
    assert expected.source == made.source


def test_each_motion_has_its_confidence_and_the_decisions_in_words(piece: Asset) -> None:
    motions = forecast(piece).motions
    assert motions
    for motion in motions:
        assert motion.confidence is None or 0.0 < motion.confidence <= 1.0
        assert (motion.confidence is None) == (not motion.decided)
        assert all("%" in words for words in motion.decided)


def test_a_door_that_cannot_move_is_named_with_the_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    from dataclasses import replace

    from grafu.pipeline import forecast as module
    from grafu.refusal import Reason, Refusal

    planned = module._planned

    def refusing(*arguments: object) -> object:
        plan, completion = planned(*arguments)  # type: ignore[arg-type]
        first, *rest = plan.joints
        return replace(plan, joints=tuple(rest), refused=(Refusal(first.moving, Reason.NO_ROOM, "narrow"),)), completion

    monkeypatch.setattr(module, "_planned", refusing)
    found = forecast(TIDY["overlay pair"]())
    (static,) = found.static
    assert (static.reason, static.why) == (str(Reason.NO_ROOM), "narrow")
    assert static.part not in {motion.part for motion in found.motions}
