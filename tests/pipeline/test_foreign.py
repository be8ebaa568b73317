"""Other systems' predictions as motion sources: what is recognised, what is built from it, and what is refused."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from grafu.additions.config import NO_ADDITIONS
from grafu.asset.foreign.attach import attach_motions
from grafu.asset.load import load_asset
from grafu.asset.options import Limits
from grafu.errors import AssetTooLarge, OptionError, UnreadableAsset
from grafu.export.files import ExportFiles, write_files
from grafu.export.particulate import export_particulate
from grafu.export.singapo import export_singapo
from grafu.export.urdf import export_urdf
from grafu.pipeline.foreign import prediction_for, read_foreign
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource, SourceOption
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.report import report_of
from grafu.pipeline.settings import Settings
from grafu.synth.truth.clashes import articulated_of
from grafu.templates.gallery import builtin_gallery
from predictions import cabinet, require_same_joints
from small_assets import load_annotated, urdf_text, write_pnm, write_urdf

CABINET = cabinet()
FILES = {
    "particulate": export_particulate(articulated_of(CABINET)),
    "singapo": export_singapo(articulated_of(CABINET)),
    "urdf": export_urdf(articulated_of(CABINET)),
}
PLAIN = PipelineConfig(Settings(additions=NO_ADDITIONS))


@pytest.mark.parametrize("kind", FILES)
def test_each_kind_is_told_by_its_content(kind: str, tmp_path: Path) -> None:
    write_files(FILES[kind], tmp_path / "run")

    assert read_foreign(tmp_path / "run").source == kind
    for name in ("eval/pred.npz", "object.json", "model.urdf"):
        if (tmp_path / "run" / name).is_file():
            assert read_foreign(tmp_path / "run" / name).source == kind


@pytest.mark.parametrize("kind", FILES)
def test_the_same_is_built_as_from_the_annotation(kind: str, tmp_path: Path) -> None:
    write_files(FILES[kind], tmp_path / "run")
    stated = functionalize(CABINET, MotionSource.ANNOTATION, builtin_gallery(), PLAIN)
    found = functionalize(CABINET, read_foreign(tmp_path / "run"), builtin_gallery(), PLAIN)

    assert found.source == kind
    assert found.completion.source == kind
    report = report_of(found)
    assert report.motion.source == kind
    assert {joint.motion_source for joint in report.joints} == {kind}
    assert any(note.startswith(f"motions from {kind}: 3 joints; frame: ") for note in report.input.notes)
    assert "match" in report.timings
    for mine, true in zip(report.joints, report_of(stated).joints, strict=True):
        assert (mine.part, mine.type, mine.mount, mine.template) == (true.part, true.type, true.mount, true.template)
        np.testing.assert_allclose(
            [*mine.axis, *mine.origin, mine.upper], [*true.axis, *true.origin, true.upper], atol=1e-4
        )


def test_a_foreign_source_wants_its_motions_attached(tmp_path: Path) -> None:
    with pytest.raises(OptionError, match="motions of singapo must be attached first: sketch has none"):
        functionalize(CABINET, MotionSource.SINGAPO, builtin_gallery(), PLAIN)
    write_files(FILES["singapo"], tmp_path / "run")
    attached = attach_motions(CABINET, read_foreign(tmp_path / "run"))

    assert functionalize(attached, MotionSource.SINGAPO, builtin_gallery(), PLAIN).source is MotionSource.SINGAPO


def test_particulates_urdf_is_its_by_the_names_of_its_joints(tmp_path: Path) -> None:
    plain = urdf_text()
    for old, new in (("door_joint", "joint_0_1"), ("drawer_joint", "joint_0_2")):
        plain = plain.replace(old, new)
    write_urdf(tmp_path / "theirs", plain)

    assert read_foreign(tmp_path / "theirs").source == "particulate"
    assert read_foreign(tmp_path / "theirs", "urdf").source == "urdf"
    write_urdf(tmp_path / "others")
    assert read_foreign(tmp_path / "others").source == "urdf"
    assert read_foreign(tmp_path / "others", "particulate").source == "particulate"


def test_a_robot_description_fits_the_same_model_read_otherwise(tmp_path: Path) -> None:
    asset = load_annotated(write_pnm(tmp_path / "pnm"))
    write_urdf(tmp_path / "robot")
    found = attach_motions(asset, read_foreign(tmp_path / "robot"))
    truth = replace(asset, joints=tuple(replace(j, upper=1.5) if j.upper > 1.5 else j for j in asset.joints))

    require_same_joints(found, truth, tolerance=1e-6)
    robot = load_annotated(tmp_path / "robot")
    again = attach_motions(robot, read_foreign(tmp_path / "pnm"))
    require_same_joints(again, replace(robot, joints=_wider(again, tmp_path)), tolerance=1e-6)


def test_what_is_read_without_its_joints_takes_those_of_a_robot_description(tmp_path: Path) -> None:
    """Each body's pieces are parts of their own there: the largest gets the joint, the others ride on it."""
    asset = load_asset(write_pnm(tmp_path / "pnm"))
    found = attach_motions(asset, read_foreign(write_urdf(tmp_path / "robot")))

    assert {joint.part for joint in found.joints} == {"cabinet_door_surface_7", "drawer_front_9"}
    carriers = tuple(found.part(handle).carried_by for handle in ("handle_8", "handle_11"))
    assert carriers == tuple(j.part for j in found.joints)


def _wider(again, tmp_path: Path):  # type: ignore[no-untyped-def]
    """Returns the joints that the URDF states, doors opening as far as the other file states."""
    by_part = {joint.part: joint for joint in again.joints}
    return tuple(replace(j, upper=by_part[j.part].upper) for j in load_annotated(tmp_path / "robot").joints)


@pytest.mark.parametrize("source", ["particulate", "singapo", "grafu-pred", "urdf"])
def test_what_is_not_there_or_of_another_kind_is_refused_in_one_line(source: str, tmp_path: Path) -> None:
    write_files(ExportFiles({"notes.txt": b"nothing", "graph.json": b"{}", "bad.json": b"{"}), tmp_path / "run")
    for path, why in (
        (tmp_path / "nowhere", "does not exist: expected"),
        (tmp_path / "run", "is no prediction that is read: expected"),
        (tmp_path / "run" / "notes.txt", "is no prediction that is read: expected"),
        (tmp_path / "run" / "graph.json", "is no prediction that is read: expected"),
        (tmp_path / "run" / "bad.json", "is not JSON: expected"),
    ):
        with pytest.raises(UnreadableAsset, match=why) as error:
            read_foreign(path, source)  # type: ignore[arg-type]
        assert "\n" not in str(error.value)
    other = "singapo" if source != "singapo" else "particulate"
    write_files(FILES[other], tmp_path / "other")
    if {source, other} != {"urdf", "particulate"}:
        with pytest.raises(UnreadableAsset, match=f"is of the kind {other}, not {source}: expected"):
            read_foreign(tmp_path / "other", source)  # type: ignore[arg-type]


def test_a_folder_may_hold_an_entry_for_each_input(tmp_path: Path) -> None:
    for name in ("one", "two"):
        write_files(FILES["singapo"], tmp_path / name)
    (tmp_path / "three.json").write_bytes((tmp_path / "one" / "object.json").read_bytes())
    choice = SourceOption(MotionSource.SINGAPO, tmp_path)

    assert prediction_for(choice, "two", alone=False).path == str(tmp_path / "two" / "object.json")
    assert prediction_for(choice, "three").path == str(tmp_path / "three.json")
    single = SourceOption(MotionSource.SINGAPO, tmp_path / "one")
    assert prediction_for(single, "cabinet").path == str(tmp_path / "one" / "object.json")
    with pytest.raises(UnreadableAsset, match=r"holds nothing for four: for several inputs .*/four is expected"):
        prediction_for(choice, "four", alone=False)


def test_an_entry_that_leads_out_of_its_folder_is_not_read(tmp_path: Path) -> None:
    write_files(FILES["urdf"], tmp_path / "elsewhere")
    (tmp_path / "given").mkdir()
    (tmp_path / "given" / "cabinet.urdf").symlink_to(tmp_path / "elsewhere" / "model.urdf")

    with pytest.raises(UnreadableAsset, match="leads out of"):
        prediction_for(SourceOption(MotionSource.URDF, tmp_path / "given"), "cabinet")


def test_a_choice_names_its_file_or_has_none() -> None:
    with pytest.raises(OptionError, match="motions of urdf are read from a file, which must be named: urdf:FILE"):
        SourceOption(MotionSource.URDF)
    with pytest.raises(OptionError, match="the motion source rule reads no file"):
        SourceOption(MotionSource.RULE, Path("x"))


@pytest.mark.parametrize(("kind", "limit"), [("particulate", "lines"), ("singapo", "values"), ("urdf", "values")])
def test_limits_hold_for_predictions_too(kind: str, limit: str, tmp_path: Path) -> None:
    write_files(FILES[kind], tmp_path / "run")
    for name, most in ((limit, 3), ("bytes", 99)):
        with pytest.raises(AssetTooLarge, match=rf"at most .* are read; .* --limit {name}="):
            read_foreign(tmp_path / "run", limits=Limits().with_limit(name, most))
    file = tmp_path / "run" / {"particulate": "eval/pred.npz", "singapo": "object.json", "urdf": "model.urdf"}[kind]
    with pytest.raises(AssetTooLarge, match="--limit bytes="):
        read_foreign(file, limits=Limits().with_limit("bytes", 99))


def test_limits_hold_for_a_predicted_graph_too(tmp_path: Path) -> None:
    path = tmp_path / "m_pred.json"
    path.write_text('{"nodes": {"a": {"slot": 0}, "b": {"slot": 1}}, "edges": []}')
    with pytest.raises(AssetTooLarge, match="--limit values=7"):
        read_foreign(path, limits=Limits().with_limit("values", 5))


def test_a_robot_of_more_parts_than_are_read_is_refused(tmp_path: Path) -> None:
    with pytest.raises(AssetTooLarge, match="parts: at most 3 are read"):
        read_foreign(write_urdf(tmp_path / "robot"), limits=Limits().with_limit("parts", 3))
