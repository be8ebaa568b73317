"""The pipeline as one function, and the report of its result."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from grafu.additions.config import NO_ADDITIONS, AdditionConfig
from grafu.additions.interior.request import parse_interior
from grafu.asset.part import Asset
from grafu.completion.features import FeatureConfig
from grafu.completion.rule import complete_by_rule
from grafu.completion.session import open_network
from grafu.errors import WeightsError
from grafu.graph.completion import GraphCompletion
from grafu.graph.functional_graph import FunctionalGraph
from grafu.pipeline.functionalize import Functionalized, functionalize
from grafu.pipeline.motion_methods import MOTIONS, choose_source
from grafu.pipeline.motion_source import AUTO_ORDER, MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.report import report_of
from grafu.pipeline.report_schema import Report
from grafu.pipeline.settings import Settings
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door, Drawer, Stack
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType, PartLabel

CABINET = Cabinet("made", Case(0.5, 0.9), Stack((Drawer(), Door(handle="none")), (1.0, 3.0)))


@pytest.fixture(scope="module")
def asset() -> Asset:
    return make_cabinet(CABINET)


@pytest.fixture(scope="module")
def result(asset: Asset) -> Functionalized:
    return functionalize(asset, MotionSource.ANNOTATION, builtin_gallery())


def test_every_source_but_auto_has_its_row() -> None:
    assert set(MOTIONS) == set(MotionSource) - {MotionSource.AUTO}


def test_auto_takes_the_first_that_can_answer(asset: Asset, monkeypatch: pytest.MonkeyPatch) -> None:
    assert AUTO_ORDER == (MotionSource.NETWORK, MotionSource.RULE)
    for has_weights, chosen in ((False, MotionSource.RULE), (True, MotionSource.NETWORK)):
        monkeypatch.setattr("grafu.pipeline.motion_methods.has_shipped_weights", lambda has=has_weights: has)
        assert choose_source(asset, MotionSource.AUTO) is chosen
        assert choose_source(asset, MotionSource.RULE) is MotionSource.RULE


def test_the_network_without_weights_says_so_in_one_line(
    asset: Asset, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr("grafu.pipeline.complete.open_network", lambda _: open_network(tmp_path / "none.onnx"))
    with pytest.raises(WeightsError, match=r"there are no trained weights at `.*`: use another motion source") as error:
        functionalize(asset, MotionSource.NETWORK, builtin_gallery())
    assert "\n" not in str(error.value)


def test_the_network_sees_points_and_no_annotation(asset: Asset, monkeypatch: pytest.MonkeyPatch) -> None:
    seen = []

    def complete(graph: FunctionalGraph, _: object, features: FeatureConfig, named: set[str]) -> GraphCompletion:
        seen.append(graph)
        assert features == FeatureConfig(points=64)
        return replace(complete_by_rule(graph), source="network")

    monkeypatch.setattr("grafu.pipeline.complete.complete_by_network", complete)
    network = SimpleNamespace(features=FeatureConfig(points=64))
    monkeypatch.setattr("grafu.pipeline.complete.open_network", lambda _: network)
    found = functionalize(asset, MotionSource.NETWORK, builtin_gallery())
    stripped = functionalize(asset.without_annotation(), MotionSource.NETWORK, builtin_gallery())

    assert seen[0] == seen[1]
    assert {len(node.points.points) for node in seen[0].nodes} == {64}
    assert all(node.points is None for node in found.completion.completed.nodes)
    assert found.source is MotionSource.NETWORK
    assert found.object == stripped.object
    assert (found.report.installed, found.report.skipped) == (stripped.report.installed, stripped.report.skipped)


def test_an_annotation_that_is_not_there_moves_nothing(asset: Asset) -> None:
    found = functionalize(asset.without_annotation(), MotionSource.ANNOTATION, builtin_gallery())

    assert found.object.joints == ()
    assert {skip.part for skip in found.report.skipped} == {p.id for p in asset.parts if p.label.is_movable}


def test_annotated_joints_are_built(asset: Asset, result: Functionalized) -> None:
    built = {joint.child: joint for joint in result.object.moving_joints}

    assert result.source is MotionSource.ANNOTATION
    assert set(built) == {joint.part for joint in asset.joints}
    for stated in asset.joints:
        assert built[stated.part].type is stated.type
        assert built[stated.part].axis.direction @ stated.axis.direction > 0.98


def test_the_rule_needs_no_annotation(asset: Asset) -> None:
    bare = replace(asset, joints=())
    found = functionalize(bare, MotionSource.RULE, builtin_gallery())

    assert {j.type for j in found.object.moving_joints} == {JointType.REVOLUTE, JointType.PRISMATIC}


def test_the_same_input_gives_the_same_object(asset: Asset, result: Functionalized) -> None:
    again = functionalize(asset, MotionSource.ANNOTATION, builtin_gallery())

    assert again.object == result.object


def test_the_report_tells_what_was_built(result: Functionalized) -> None:
    report = report_of(result, "name", {"load": 0.5})

    assert Report.read(report.to_json()) == report
    assert report.input.name == "name"
    assert report.timings["load"] == 0.5
    for record in report.joints:
        joint = next(j for j in result.object.joints if j.id == record.id)
        assert (record.lower, record.upper) == (joint.limits.lower, joint.limits.upper)
        assert np.allclose(record.axis, joint.axis.direction)
        assert record.mount in {part.id for part in report.parts}


def grasps(result: Functionalized) -> dict[PartLabel, str]:
    label_of = {part.id: part.label for part in result.asset.parts}
    return {label_of[joint.part]: joint.grasp for joint in report_of(result).joints}


def test_the_report_names_how_each_part_is_grasped(result: Functionalized) -> None:
    assert grasps(result) == {PartLabel.DRAWER: "handle", PartLabel.DOOR: "handle"}


def test_what_may_not_be_added_is_not(asset: Asset) -> None:
    bare = functionalize(
        asset, MotionSource.ANNOTATION, builtin_gallery(), PipelineConfig(Settings(additions=NO_ADDITIONS))
    )
    assert grasps(bare) == {PartLabel.DRAWER: "handle", PartLabel.DOOR: "none"}
    assert bare.additions == ()
    assert report_of(bare).added == ()


def test_what_was_added_is_a_part_like_any_other(result: Functionalized) -> None:
    (added,) = report_of(result).added
    door = next(part.id for part in result.asset.parts if part.label is PartLabel.DOOR)
    assert added.link == door
    assert added.category is PartLabel.HANDLE
    assert added.part in {visual.name for visual in result.object.link(door).visuals}
    assert result.completion.added == (added.part,)
    assert [edge.parent for edge in result.completion.completed.attachments if edge.child == added.part] == [door]


def test_a_grip_is_carved_where_it_is_asked_for(asset: Asset) -> None:
    config = PipelineConfig(Settings(additions=replace(AdditionConfig(), handles=None)))
    carved = functionalize(asset, MotionSource.ANNOTATION, builtin_gallery(), config)
    assert grasps(carved) == {PartLabel.DRAWER: "handle", PartLabel.DOOR: "recess"}
    (grip,) = report_of(carved).carved
    assert report_of(carved).added == ()
    assert asset.part(grip.part).label is PartLabel.DOOR
    before, after = asset.part(grip.part).mesh, carved.object.link(grip.part).visuals[0].mesh
    assert after.to_trimesh().volume < before.to_trimesh().volume


def test_interiors_are_furnished_on_request(asset: Asset) -> None:
    config = PipelineConfig(Settings(additions=replace(AdditionConfig(), interior=parse_interior("shelves=1"))))
    furnished = functionalize(asset, MotionSource.ANNOTATION, builtin_gallery(), config)
    shelves = [part for part in report_of(furnished).added if part.category is PartLabel.SHELF]
    assert [shelf.link for shelf in shelves] == [furnished.object.root]
    assert np.allclose(
        [j.upper for j in report_of(furnished).joints], [j.limits.upper for j in furnished.object.joints]
    )


def test_the_matrix_in_the_report_is_the_frames(result: Functionalized) -> None:
    assert np.array_equal(report_of(result).frame.input_to_output, result.asset.frame.input_to_output)


def test_every_part_is_in_a_link(result: Functionalized) -> None:
    link_of = {part.id: part.link for part in report_of(result).parts}
    moving = {joint.child for joint in result.object.moving_joints}

    assert set(link_of.values()) == moving | {result.object.root}
    assert all(link_of[link] == link for link in moving)
