"""A top where one is there already: it takes its place in object, graph and report, or it is said why not."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from grafu.additions.top.config import TopConfig
from grafu.asset.load import load_asset
from grafu.asset.part import Asset
from grafu.pipeline.functionalize import Functionalized, functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.report import report_of
from grafu.pipeline.settings import Settings, settings_from_json
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case, Top
from grafu.synth.fronts.layout import Door
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel

SAMPLES = Path(__file__).parents[2] / "samples"


def replacing(source: MotionSource, **top) -> Settings:
    base = Settings(source)
    return replace(base, additions=replace(base.additions, top=TopConfig(**top), replaces_top=True))


def run(asset: Asset, chosen: Settings) -> Functionalized:
    again = settings_from_json(json.loads(json.dumps(chosen.to_json())))
    return functionalize(asset, again.motion, builtin_gallery(), PipelineConfig(again))


def tops(result: Functionalized) -> dict[str, float]:
    """The tops that were added, by id, with their thickness."""
    found = [a.part for a in result.additions if a.part.label is PartLabel.TOP_PANEL]
    return {part.id: float(part.box.size[2]) for part in found}


@pytest.mark.parametrize("source", [MotionSource.ANNOTATION, MotionSource.RULE])
def test_the_new_top_stands_for_the_old_one_everywhere(source):
    asset = make_cabinet(Cabinet("made", Case(0.6, 0.8), Door()))
    old = next(p for p in asset.parts if p.label is PartLabel.TOP_PANEL)
    plain, result = run(asset, Settings(source)), run(asset, replacing(source, thickness=0.05, shape="rounded"))
    report = report_of(result)
    ((new, thickness),) = tops(result).items()
    names = {v.name for link in result.object.links for v in link.visuals}
    nodes = {node.id for node in result.completion.completed.nodes}
    assert not tops(plain)
    assert thickness == pytest.approx(0.05, abs=1e-4)
    assert new != old.id
    assert new in names & nodes
    assert old.id not in names | nodes
    assert {p.id: p.link for p in report.parts}[old.id] == ""
    assert [a.why for a in report.added if a.part == new] == ["it was chosen"]
    assert not [missing for missing in report.deficiencies if missing.kind == "top panel"]
    assert [j.part for j in report.joints] == [j.part for j in report_of(plain).joints]
    assert all(joint.collision_share == 0 for joint in report.joints)


def test_what_hung_on_the_old_top_hangs_on_the_new_one():
    asset = make_cabinet(Cabinet("made", Case(0.6, 0.8), Door("top")))
    old = next(p.id for p in asset.parts if p.label is PartLabel.TOP_PANEL)
    parents = {h.child: h.parent for h in run(asset, Settings(MotionSource.ANNOTATION)).completion.completed.hinges}
    result = run(asset, replacing(MotionSource.ANNOTATION))
    (new,) = tops(result)
    expected = {child: new if parent == old else parent for child, parent in parents.items()}
    assert {h.child: h.parent for h in result.completion.completed.hinges} == expected


def test_a_missing_top_is_added_as_ever():
    asset = make_cabinet(Cabinet("made", Case(0.6, 0.8, top=Top("none")), Door()))
    plain, result = (run(asset, s) for s in (Settings(MotionSource.RULE), replacing(MotionSource.RULE)))
    assert tops(plain) == tops(result) != {}
    assert not result.removed


def test_a_top_of_another_name_is_not_taken_away_and_it_is_said_what_would_help():
    asset = make_cabinet(Cabinet("made", Case(0.6, 0.8), Door()))
    old = next(p.id for p in asset.parts if p.label is PartLabel.TOP_PANEL)
    result = run(asset, replacing(MotionSource.ANNOTATION).with_label(old, PartLabel.MISC))
    assert not tops(result)
    assert old in {v.name for v in result.object.link(result.object.root).visuals}
    (why,) = [s.detail for s in report_of(result).skipped if s.request == "top panel"]
    assert "correct the category" in why


def test_a_rejected_new_top_leaves_the_old_one():
    asset = make_cabinet(Cabinet("made", Case(0.6, 0.8), Door()))
    chosen = replacing(MotionSource.ANNOTATION)
    (new,) = tops(run(asset, chosen))
    result = run(asset, chosen.with_addition(new, accepted=False))
    assert not tops(result)
    assert not result.removed


@pytest.mark.parametrize("sample", ["dresser", "kitchen_base"])
def test_tops_of_samples_are_replaced_and_every_joint_stands(sample):
    asset = load_asset(SAMPLES / f"{sample}.glb")
    result = run(asset, replacing(MotionSource.RULE, front=0.03))
    if not result.removed:
        assert [s.why for s in result.body.refusals if s.part == "top panel"] or tops(result)
        return
    assert {p.id for p in asset.parts if p.label is PartLabel.TOP_PANEL} >= result.removed
    assert {m.moving for m in result.report.installed} == {p.id for p in result.asset.parts if p.label.is_movable}
