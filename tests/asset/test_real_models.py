"""Real furniture, where it is at hand: set GRAFU_MODELS, or have it beside the repository."""

import json
import os
import shutil
from pathlib import Path

import numpy as np
import pytest

from grafu.asset.options import LoadOptions
from grafu.vocabulary import JointType, PartLabel
from small_assets import load_annotated

MODELS = Path(os.environ.get("GRAFU_MODELS") or Path(__file__).parents[3] / "shared" / "models")
PNM = sorted((MODELS / "pnm").glob("*")) if (MODELS / "pnm").is_dir() else []
OTHER = MODELS / "other"

pytestmark = pytest.mark.skipif(not PNM, reason="the development models are not at hand")


@pytest.mark.parametrize("folder", PNM, ids=lambda p: p.name)
def test_every_annotated_hinge_and_slider_yields_a_joint(folder):
    asset = load_annotated(folder)
    links = json.loads((folder / "mobility_v2.json").read_text())
    moving = [link["joint"] for link in links if link["joint"] in ("hinge", "slider")]
    kinds = [joint.type for joint in asset.joints]
    assert (kinds.count(JointType.REVOLUTE), kinds.count(JointType.PRISMATIC)) == (
        moving.count("hinge"),
        moving.count("slider"),
    )
    assert {j.part for j in asset.joints} == {p.id for p in asset.parts if p.label.is_movable}


@pytest.mark.parametrize("folder", PNM[::4], ids=lambda p: p.name)
def test_objects_stand_centred_at_furniture_size(folder):
    box = load_annotated(folder).box
    np.testing.assert_allclose([*box.center[:2], box.low[2]], 0.0, atol=1e-9)
    assert 0.3 < box.size.max() < 3.0
    assert 0.3 < box.size[2] < 2.5


@pytest.mark.parametrize("folder", PNM[1::4], ids=lambda p: p.name)
def test_the_urdf_alone_reads_as_the_json_does(folder, tmp_path):
    for name in ("mobility.urdf", "semantics.txt", "meta.json", "textured_objs"):
        copy = shutil.copytree if (folder / name).is_dir() else shutil.copyfile
        copy(folder / name, tmp_path / name)  # links out of the folder are not followed
    full, alone = load_annotated(folder), load_annotated(tmp_path)
    assert [(p.id, p.label, p.carried_by) for p in full.parts] == [(p.id, p.label, p.carried_by) for p in alone.parts]
    np.testing.assert_allclose(alone.frame.input_to_output, full.frame.input_to_output, atol=1e-6)
    for a, b in zip(full.joints, alone.joints, strict=True):
        np.testing.assert_allclose(b.axis.direction, a.axis.direction, atol=1e-6)
        assert (b.lower, b.upper) == (pytest.approx(a.lower), pytest.approx(a.upper))


def test_handles_ride_on_what_they_open():
    asset = load_annotated(MODELS / "pnm" / "44781")
    riding = [p.carried_by for p in asset.parts if p.label is PartLabel.HANDLE]
    assert len(riding) == 3
    assert set(riding) == {j.part for j in asset.joints}


@pytest.mark.parametrize(
    ("name", "types", "front"),
    [
        ("sektion_cabinet", {"revolute": 2, "prismatic": 2}, "+X"),
        ("calvin_table_A", {"prismatic": 2}, "-Y"),
        ("sink_cabinet_sweethome3d", {"revolute": 2}, "+Z"),
    ],
)
def test_the_other_models_give_the_joints_that_they_state(name, types, front):
    asset = load_annotated(OTHER / name)
    kinds = [j.type.value for j in asset.joints]
    assert {kind: kinds.count(kind) for kind in kinds} == types
    assert asset.frame.front == front
    assert 0.5 < asset.box.size[2] < 1.3


@pytest.mark.parametrize("folder", PNM[2::6], ids=lambda p: p.name)
def test_masking_labels_keeps_parts_joints_and_front(folder):
    full, masked = load_annotated(folder), load_annotated(folder, LoadOptions(labels="none"))
    assert [p.id for p in full.parts] == [p.id for p in masked.parts]
    assert [j.part for j in full.joints] == [j.part for j in masked.joints]
    assert full.frame.front == masked.frame.front
