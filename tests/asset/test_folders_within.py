"""Folders of models that hold links to folders: what leads out is not looked into."""

import json

import pytest

from grafu.asset.foreign.motions import ForeignMotions
from grafu.asset.load import load_asset
from grafu.errors import UnreadableAsset
from grafu.pipeline.foreign import read_foreign
from small_assets import write_glb, write_obj_folder, write_urdf


@pytest.fixture
def outside(tmp_path):
    write_urdf(tmp_path / "outside")
    (tmp_path / "model").mkdir()
    return tmp_path / "outside"


@pytest.mark.parametrize("target", ["../outside", "..", "../outside/meshes"])
def test_a_link_to_a_folder_outside_is_not_looked_into(target, outside):
    model = outside.parent / "model"
    (model / "here").symlink_to(target)
    for read in (load_asset, read_foreign):
        with pytest.raises(UnreadableAsset, match=r"holds nothing that is read|is no prediction"):
            read(model)


def test_a_link_to_a_folder_inside_is(outside):
    model = outside.parent / "model"
    (model / "real" / "deeper").mkdir(parents=True)
    write_glb(model / "real" / "deeper" / "cabinet.glb")
    (model / "near").symlink_to("real/deeper")
    assert load_asset(model).name == "model"


def test_the_folder_itself_may_be_a_link(outside):
    link = outside.parent / "named"
    link.symlink_to("outside")
    assert load_asset(link).kind == "urdf"
    assert isinstance(read_foreign(link), ForeignMotions)


def test_meshes_in_a_folder_below_are_read(tmp_path):
    write_obj_folder(tmp_path / "model" / "meshes")
    (tmp_path / "model" / "about.json").write_text(json.dumps({}))
    assert load_asset(tmp_path / "model").kind == "mesh folder"


def test_a_prediction_that_is_a_link_out_of_the_folder_that_is_named_is_not_read(outside):
    model = outside.parent / "model"
    (model / "cabinet.urdf").symlink_to("../outside/cabinet.urdf")
    with pytest.raises(UnreadableAsset, match="leads out of"):
        read_foreign(model)
    with pytest.raises(UnreadableAsset, match="no visual shape"):
        read_foreign(model / "cabinet.urdf")  # the user named it: it is read, and its meshes are sought beside the link
