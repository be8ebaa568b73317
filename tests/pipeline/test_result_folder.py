"""Folders of results read back, whole and broken: every refusal is one line that states what to do."""

import json
import re
import shutil
from pathlib import Path

import pytest

from grafu.asset.load import load_asset
from grafu.cli.main import main
from grafu.errors import FunctionalizationError
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.result_folder import read_result
from grafu.templates.gallery import builtin_gallery
from small_assets import write_glb
from spoiled_files import DAMAGED, SPOILS


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("run")
    source = write_glb(folder / "cabinet.glb")
    arguments = ["--motion", "rule", "--height", "1.1", "--formats", "glb", "--no-page", "--out", str(folder / "out")]
    assert main(["functionalize", str(source), *arguments]) == 0
    return folder


@pytest.fixture
def result(run, tmp_path) -> Path:
    return Path(shutil.copytree(run / "out" / "cabinet", tmp_path / "cabinet"))


def edit(path: Path, **changes) -> None:
    path.write_text(json.dumps(json.loads(path.read_text()) | changes))


def again(read):
    asset = load_asset(read.source, read.settings.reading)
    return functionalize(asset, read.settings.motion, builtin_gallery(), PipelineConfig(read.settings)).object


def shape(made):
    joints = sorted((j.id, j.child, j.type, round(j.limits.upper, 4)) for j in made.joints)
    return joints, sorted(visual.name for link in made.links for visual in link.visuals)


def test_a_result_is_read_with_what_gives_it_again(result, run):
    read = read_result(result)
    assert read.source == run / "cabinet.glb"
    assert not read.fixed
    assert {joint.child for joint in read.object.moving_joints} == {joint.part for joint in read.report.joints}
    assert read.report.joints
    assert shape(again(read)) == shape(read.object)


def test_without_settings_the_input_is_read_as_it_was(result):
    (result / "settings.json").unlink()
    read = read_result(result)
    assert read.settings.motion is MotionSource.RULE
    made = again(read)
    assert shape(made) == shape(read.object)
    high = [made.link(made.root).mesh.box.size[2], read.object.link(read.object.root).mesh.box.size[2]]
    assert high[0] == pytest.approx(high[1], rel=1e-4)


def test_the_kept_source_goes_before_the_named_one(result):
    shutil.copy(write_glb(result / "x.glb"), result / "source.glb")
    assert read_result(result).source == result / "source.glb"


def test_a_relative_input_is_found_from_above_the_results(result, tmp_path):
    report = json.loads((result / "report.json").read_text())
    edit(result / "report.json", input=report["input"] | {"path": "models/cabinet.glb"})
    assert read_result(result).source is None
    (tmp_path / "models").mkdir()
    write_glb(tmp_path / "models" / "cabinet.glb")
    assert read_result(result).source == tmp_path / "models" / "cabinet.glb"


def test_without_its_input_it_is_shown_and_says_why_it_cannot_be_changed(result):
    report = json.loads((result / "report.json").read_text())
    edit(result / "report.json", input=report["input"] | {"path": "/nowhere/cabinet.glb"})
    read = read_result(result)
    assert read.object.joints
    assert "its input is gone" in read.fixed
    assert "\n" not in read.fixed


def test_foreign_motions_cannot_be_changed(result):
    edit(result / "report.json", motion={"source": "particulate"})
    (result / "settings.json").unlink()
    assert "its motions came from particulate" in read_result(result).fixed


def test_a_folder_of_many_says_which_to_choose(result):
    shutil.copytree(result, result.parent / "wardrobe")
    with pytest.raises(FunctionalizationError, match=r"holds 2 results: choose one .*cabinet, wardrobe"):
        read_result(result.parent)


def break_glb(folder):
    (folder / "model.glb").write_bytes(b"glTF broken")


def swap_glb(folder):
    edit(folder / "report.json", joints=[])


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (shutil.rmtree, "is none"),
        (lambda f: (f / "model.glb").unlink(), "has no model.glb: run again with --formats glb"),
        (lambda f: (f / "report.json").unlink(), "has no report.json"),
        (lambda f: (f / "report.json").write_text("{"), "is no report of grafu"),
        (lambda f: edit(f / "report.json", schema="grafu.report/9"), "is no report of grafu"),
        (lambda f: (f / "report.json").write_bytes(b"\xff\xfe"), "is no report of grafu"),
        (break_glb, "model.glb"),
        (swap_glb, "of different runs"),
        (lambda f: (f / "settings.json").write_text("["), "expected settings of the form grafu.settings/1"),
        (lambda f: edit(f / "settings.json", schema="grafu.settings/9"), "grafu.settings/1"),
        (lambda f: edit(f / "settings.json", hinges="x"), "there is no setting `hinges`"),
    ],
)
def test_what_is_broken_is_one_line(result, spoil, words):
    spoil(result)
    with pytest.raises(FunctionalizationError) as caught:
        read_result(result)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["report.json", "settings.json", "model.glb"])
@pytest.mark.parametrize("words", SPOILS)
def test_what_is_no_plain_file_of_the_folder_is_not_opened(result, name, words):
    SPOILS[words](result / name)
    with pytest.raises(FunctionalizationError) as caught:
        read_result(result)
    said = {"model.glb": f"{words}|has no model.glb|outside|MiB", "report.json": f"{words}|has no report.json"}
    assert re.search(said.get(name, words), str(caught.value))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["report.json", "settings.json"])
@pytest.mark.parametrize("held", DAMAGED)
def test_what_is_damaged_is_one_line(result, name, held):
    (result / name).write_bytes(DAMAGED[held])
    with pytest.raises(FunctionalizationError, match="grafu") as caught:
        read_result(result)
    assert "\n" not in str(caught.value)


def test_a_result_in_a_linked_folder_is_read(result, tmp_path):
    (tmp_path / "link").symlink_to(result)
    assert read_result(tmp_path / "link").report.joints


def test_a_path_that_is_no_folder_is_one_line(result):
    with pytest.raises(FunctionalizationError, match="is none"):
        read_result(result / "report.json")
