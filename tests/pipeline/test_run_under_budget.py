"""A run under a budget: what it does not hold is left out and said, the rest is delivered; where it holds all, nothing
changes. Clocks are the tests' own.
"""

import pytest

from clocks import Clock
from grafu.asset.part import Asset
from grafu.export.formats import export
from grafu.geometry.budget import Budget, present_budget
from grafu.joints import build_all
from grafu.joints.config import TimeConfig
from grafu.pipeline.functionalize import Functionalized, functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.report import report_of
from grafu.processes.cache import content_key
from grafu.refusal import Reason
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door, Drawer, Stack
from grafu.templates.gallery import builtin_gallery

CABINET = Cabinet("made", Case(0.5, 0.9), Stack((Drawer(), Door(handle="none")), (1.0, 3.0)))
DOOR, DRAWER = (make_cabinet(CABINET).joints[k].part for k in (1, 0))


@pytest.fixture(scope="module")
def asset() -> Asset:
    return make_cabinet(CABINET)


def run(asset: Asset, budget: Budget, on_stage=lambda _: None) -> Functionalized:
    return functionalize(asset, MotionSource.ANNOTATION, builtin_gallery(), on_stage=on_stage, budget=budget)


def too_complex(found: Functionalized) -> set[str]:
    return {skip.request for skip in report_of(found).skipped if skip.reason is Reason.TOO_COMPLEX}


def test_a_budget_that_holds_all_changes_nothing(asset: Asset) -> None:
    plain = functionalize(asset, MotionSource.ANNOTATION, builtin_gallery())
    found = run(asset, Budget.lasting(1e9))
    assert content_key(found.object) == content_key(plain.object)
    assert found.notes == ()


def test_a_joint_that_exceeds_its_fraction_is_too_complex_and_the_others_are_built(
    asset: Asset, monkeypatch: pytest.MonkeyPatch
) -> None:
    clock = Clock()

    def slow_for_doors(request, *rest):
        if request.moving == DOOR:
            clock.now = present_budget().deadline
        return build(request, *rest)

    build = build_all.build_joint
    monkeypatch.setattr(build_all, "build_joint", slow_for_doors)
    found = run(asset, Budget.lasting(120.0, clock=clock))
    assert too_complex(found) == {DOOR}
    assert [joint.child for joint in found.object.joints] == [DRAWER]
    root = found.object.link(found.object.root)
    assert DOOR in {visual.name for visual in root.visuals}
    assert {"model.glb", "model.urdf"} <= set(export(found.object, ("glb", "urdf")).contents)


def test_when_time_is_up_before_joints_the_piece_is_still_delivered(asset: Asset) -> None:
    clock = Clock()

    def stop(stage: str) -> None:
        if stage == "realize":
            clock.now = 1000.0

    found = run(asset, Budget.lasting(120.0, clock=clock), stop)
    assert found.object.joints == ()
    assert {DOOR, DRAWER} <= too_complex(found)
    assert {visual.name for link in found.object.links for visual in link.visuals} >= {part.id for part in asset.parts}
    assert "model.glb" in export(found.object, ("glb",)).contents


@pytest.mark.parametrize("asks", [1.0, 40.0, 600.0, 1500.0])
def test_whenever_time_is_up_every_moving_body_is_built_or_answered_for(asset: Asset, asks: float) -> None:
    found = run(asset, Budget.lasting(asks, clock=Clock(step=1.0)))
    moving = {joint.child for joint in found.object.joints}
    assert moving | {skip.request for skip in report_of(found).skipped} >= {DOOR, DRAWER}
    assert {joint.part for joint in report_of(found).joints} == moving
    pieces = {visual.name for link in found.object.links for visual in link.visuals if visual.role == "hardware"}
    assert bool(pieces) == bool(moving)


def test_a_stage_that_is_given_up_is_noted_in_the_report(asset: Asset) -> None:
    clock = Clock()

    def stop(stage: str) -> None:
        clock.now = 1000.0 if stage == "fittings" else clock.now

    found = run(asset, Budget.lasting(120.0, clock=clock), stop)
    assert {joint.child for joint in found.object.joints} == {DOOR, DRAWER}
    assert report_of(found).notes[0].startswith("no handle, grip or shelf was looked for: it takes more time")
    assert too_complex(found) == {"handles, grips and interiors"}


def test_a_hard_joint_leaves_time_for_the_others() -> None:
    assert TimeConfig().of_joint(1) == 1.0
    assert TimeConfig().of_joint(2) == 0.5
    left = 1.0
    for k in range(100, 10, -1):  # ninety of a hundred take all that they may
        left *= 1 - TimeConfig().of_joint(k)
    assert left > 0.0
    assert TimeConfig().of_joint(100) == pytest.approx(0.08)
    assert TimeConfig().of_joint(2400) == 0.05  # of very many some are built, rather than none


def test_more_parts_than_the_network_holds_are_left_to_the_rule(asset: Asset) -> None:
    bare = asset.without_annotation()
    found = functionalize(bare, MotionSource.AUTO, builtin_gallery(), budget=Budget(room=100_000))
    report = report_of(found)
    assert found.source is MotionSource.RULE
    assert report.motion.source is MotionSource.RULE
    assert report.notes[0].startswith(
        f"motions come from the rule: the network's forward pass over {len(bare.parts)} parts"
    )
    assert {joint.child for joint in found.object.joints} == {DOOR, DRAWER}


def test_a_joint_that_took_more_than_its_fraction_is_built_in_what_the_others_left(
    asset: Asset, monkeypatch: pytest.MonkeyPatch
) -> None:
    clock, tries = Clock(), list[str]()

    def slow_at_first(request, *rest):
        tries.append(request.moving)
        if tries == [DOOR]:
            clock.now = present_budget().deadline
        return build(request, *rest)

    build = build_all.build_joint
    monkeypatch.setattr(build_all, "build_joint", slow_at_first)
    found = run(asset, Budget.lasting(120.0, clock=clock))
    assert tries == [DOOR, DRAWER, DOOR]
    assert {joint.child for joint in found.object.joints} == {DOOR, DRAWER}
    assert not too_complex(found)
