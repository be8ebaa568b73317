"""What the input states of its joints is not read unless asked for: taken out of the files, all stays the same."""

import os
import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from grafu.asset.edit import scaled
from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.asset.part import Asset
from grafu.export.files import write_files
from grafu.export.urdf import export_urdf
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.report import report_of
from grafu.synth.samples import KINDS
from grafu.synth.truth.clashes import articulated_of
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel
from hssd_models import hssd_model
from small_assets import Y_UP, urdf_text, write_glb, write_grouped_obj, write_pnm, write_urdf
from unjointed import (
    agree,
    as_glb,
    loaded_in_metres,
    told,
    with_fixed_joints,
    with_merged_bodies,
    without_joints,
)

MODELS = Path(os.environ.get("GRAFU_MODELS") or Path(__file__).parents[3] / "shared" / "models")
FOLDERS = [p for s in ("pnm", "pnm2", "doors") for p in sorted((MODELS / s).glob("*")) if p.is_dir()]
URDFS = sorted(
    [*MODELS.glob("articraft/*/[!m]*.urdf"), *MODELS.glob("wild/*/*.urdf"), *MODELS.glob("other/*/urdf/*.urdf")]
)
PARTNET = [p for p in FOLDERS if (p / "mobility_v2.json").is_file()]
WAYS = [with_fixed_joints, without_joints, with_merged_bodies]

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning:trimesh")


def built(asset: Asset, source: MotionSource = MotionSource.AUTO):
    """Returns what is built of an asset, and what is said of it, whatever its joints were."""
    made = functionalize(asset, source, builtin_gallery(), PipelineConfig())
    return made.object.joints, made.report.installed, made.report.skipped, made.completion.completed.edges


@pytest.mark.parametrize("way", WAYS)
def test_a_folder_without_its_joints_reads_the_same(tmp_path: Path, way) -> None:
    folder = write_pnm(tmp_path / "full")
    full = load_asset(folder)

    assert len(full.stated_joints) == 2
    agree(full, load_asset(way(folder, tmp_path / "bare")))


@pytest.mark.parametrize("kind", ["fixed", "floating", "planar", "continuous"])
def test_a_urdf_whose_joints_are_of_other_kinds_reads_the_same(tmp_path: Path, kind: str) -> None:
    text = re.sub(r'type="\w+"', f'type="{kind}"', urdf_text())
    full, bare = load_asset(write_urdf(tmp_path / "full")), load_asset(write_urdf(tmp_path / "bare", text))

    assert len(full.stated_joints) == 2
    agree(full, bare)


def test_where_a_urdf_has_its_axes_and_limits_changes_nothing(tmp_path: Path) -> None:
    other = urdf_text().replace('xyz="0 0 -1"', 'xyz="1 0 0"').replace('upper="0.3"', 'upper="-9"')
    agree(load_asset(write_urdf(tmp_path / "full")), load_asset(write_urdf(tmp_path / "bare", other)))


@settings(max_examples=6, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(kind=st.sampled_from(sorted(KINDS)))
def test_made_furniture_reads_the_same_with_every_joint_fixed(tmp_path: Path, kind: str) -> None:
    folder, fixed = tmp_path / "urdf", tmp_path / "fixed"
    for place in (folder, fixed):
        shutil.rmtree(place, ignore_errors=True)
    made = KINDS[kind]()
    write_files(export_urdf(articulated_of(made)), folder)
    full, bare = load_asset(folder / "model.urdf"), load_asset(with_fixed_joints(folder / "model.urdf", fixed))

    assert len(full.stated_joints) == len(made.joints) > 0
    agree(full, bare)


@settings(max_examples=6, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(kind=st.sampled_from(sorted(KINDS)), meshes=st.integers(1, 3))
def test_a_made_hssd_model_reads_the_same_without_its_articulations(tmp_path: Path, kind: str, meshes: int) -> None:
    model = hssd_model(KINDS[kind](), meshes)
    full = load_asset(model.save(tmp_path / "full"))
    model.articulations = None
    shutil.rmtree(tmp_path / "bare", ignore_errors=True)
    bare = load_asset(model.save(tmp_path / "bare"))

    assert full.stated_joints
    assert not bare.stated_joints
    agree(full, bare)


def test_sweet_homes_openings_read_the_same_without_their_hinges(tmp_path: Path) -> None:
    names = {"cabinet_door_surface-7": "sweethome3d_opening_on_hinge_1_door", "shelf-6": "sweethome3d_hinge_1_pin"}
    full = load_asset(write_grouped_obj(tmp_path / "c.obj", 100 * Y_UP, names))
    text = (tmp_path / "c.obj").read_text()
    (tmp_path / "c.obj").write_text(re.sub(r"(g sweethome3d_hinge_1_pin\n(?:v .*\n)*)(?:f .*\n)*", r"\1", text))

    assert len(full.stated_joints) == 1
    agree(full, load_asset(tmp_path / "c.obj"))
    assert full.part("sweethome3d_opening_on_hinge_1_door").label is PartLabel.DOOR


def test_a_plain_glb_and_a_folder_with_joints_are_the_same_furniture(tmp_path: Path) -> None:
    folder, glb = loaded_in_metres(write_pnm(tmp_path / "full")), loaded_in_metres(write_glb(tmp_path / "full.glb"))
    ours, theirs = ({p.id: p for p in asset.parts} for asset in (folder, glb))

    assert ours.keys() == theirs.keys()
    for name, part in ours.items():
        assert (part.label, part.labelled_by) == (theirs[name].label, theirs[name].labelled_by)
        np.testing.assert_allclose(part.box.low, theirs[name].box.low, atol=1e-6)
        np.testing.assert_allclose(part.box.high, theirs[name].box.high, atol=1e-6)


def test_a_front_that_is_static_in_the_file_is_a_drawer_like_any_other(tmp_path: Path) -> None:
    folder = with_fixed_joints(write_pnm(tmp_path / "full"), tmp_path / "bare")
    assert load_asset(folder).part("drawer_front_9").label is PartLabel.DRAWER
    assert load_asset(tmp_path / "full").part("drawer_front_9").label is PartLabel.DRAWER


@pytest.mark.parametrize(
    ("source", "labels", "parts"),
    [
        (MotionSource.AUTO, "input", "input"),
        (MotionSource.AUTO, "none", "loose"),
        (MotionSource.RULE, "input", "loose"),
        (MotionSource.RULE, "none", "input"),
    ],
)
def test_what_is_built_is_the_same(tmp_path: Path, source: MotionSource, labels: str, parts: str) -> None:
    folder = write_pnm(tmp_path / "full")
    bare = with_fixed_joints(folder, tmp_path / "bare")
    options = LoadOptions(labels=labels, parts=parts)
    first, second = (built(load_asset(p, options), source) for p in (folder, bare))

    assert first == second


def test_the_annotation_is_kept_apart_and_moves_with_the_asset(tmp_path: Path) -> None:
    asset = load_asset(write_pnm(tmp_path / "full"))
    stated = asset.as_annotated()

    assert [joint.part for joint in stated.joints] == ["cabinet_door_0", "drawer_1"]
    assert asset.stated_joints == stated.stated_joints == stated.joints
    assert stated.annotation is None
    assert asset.without_annotation().stated_joints == ()
    assert told(stated.part("handle_8"))[5] == "cabinet_door_0"
    twice = scaled(asset, 2.0).as_annotated()
    assert twice.joints == scaled(stated, 2.0).joints
    np.testing.assert_array_equal(twice.box.high, scaled(stated, 2.0).box.high)


def test_parts_and_annotation_share_what_they_have_in_common(tmp_path: Path) -> None:
    asset = load_asset(write_pnm(tmp_path / "full"))
    ours = {id(s.mesh) for part in asset.parts for s in part.surfaces}
    assert ours == {id(s.mesh) for part in asset.as_annotated().parts for s in part.surfaces}


def test_a_run_says_how_many_stated_joints_no_one_read(tmp_path: Path) -> None:
    asset = load_asset(write_pnm(tmp_path / "full"))
    said = {
        source: report_of(functionalize(asset, source, builtin_gallery())).motion
        for source in (MotionSource.ANNOTATION, MotionSource.RULE)
    }
    assert [(m.stated_joints, m.unused_joints) for m in said.values()] == [(2, 0), (2, 2)]
    none = report_of(functionalize(asset.without_annotation(), MotionSource.RULE, builtin_gallery())).motion
    assert (none.stated_joints, none.unused_joints) == (0, 0)


@pytest.mark.parametrize("folder", FOLDERS[::3], ids=lambda p: p.name)
def test_real_folders_without_joints_or_bodies_read_the_same(folder: Path, tmp_path: Path) -> None:
    full = load_asset(folder)
    assert full.stated_joints
    for change in WAYS if folder in PARTNET else WAYS[:1]:  # the others have no list of links
        agree(full, load_asset(change(folder, tmp_path / change.__name__)))


@pytest.mark.parametrize("path", URDFS[::3], ids=lambda p: p.stem)
def test_real_urdfs_with_fixed_joints_read_the_same(path: Path, tmp_path: Path) -> None:
    above = path.parent.parent if path.parent.name == "urdf" else path.parent  # where its meshes are
    full = load_asset(path)
    assert full.stated_joints
    other = with_fixed_joints(above, tmp_path / "bare") / path.relative_to(above)
    agree(full, load_asset(other))


@pytest.mark.parametrize("folder", [p for p in PARTNET if p.parent.name != "doors"][::4], ids=lambda p: p.name)
def test_real_folders_read_as_their_plain_glb_does(folder: Path, tmp_path: Path) -> None:
    full, plain = loaded_in_metres(folder), loaded_in_metres(as_glb(folder, tmp_path / "plain.glb"))

    assert {p.id: p.label for p in full.parts} == {p.id: p.label for p in plain.parts}
    for part in full.parts:
        np.testing.assert_allclose(part.box.low, plain.part(part.id).box.low, atol=1e-5)
        np.testing.assert_allclose(part.box.high, plain.part(part.id).box.high, atol=1e-5)


@pytest.mark.parametrize("folder", [p for p in PARTNET if p.name in ("45001", "44781", "22692")], ids=lambda p: p.name)
def test_what_is_built_of_real_folders_is_the_same(folder: Path, tmp_path: Path) -> None:
    first, second = (built(load_asset(p)) for p in (folder, with_fixed_joints(folder, tmp_path / "bare")))
    assert first == second
