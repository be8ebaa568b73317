"""A folding door that the user states, in the formats and on the page: one value moves both leaves."""

import json
import re
import xml.etree.ElementTree as ET
from dataclasses import replace

import mujoco
import pytest
from glb_reader import Glb

import grafu
from grafu.joints.motion_choice import MotionChoice, Moves, Side
from grafu.pipeline.settings import settings_from_json
from grafu.synth.cabinets.folding import FoldingDoors, make_folding_doors
from grafu.synth.case.case import Case


@pytest.fixture(scope="module")
def out(tmp_path_factory):
    """The folder of results of a small cabinet whose two leaves fold to the left."""
    made = make_folding_doors(FoldingDoors(case=Case(0.8, 0.7, 0.4)))
    doors = (replace(p, carried_by=None) if p.id.startswith("door") else p for p in made.parts)
    asset = replace(made, parts=tuple(doors), joints=())
    folder = tmp_path_factory.mktemp("folding") / "out"
    grafu.functionalize(asset, motion="rule", motions={"door_1": "fold-left"}).save(
        folder, formats=("glb", "urdf", "mjcf")
    )
    return folder


def test_urdf_states_that_the_inner_leaf_follows(out):
    mimic = ET.parse(out / "model.urdf").getroot().find("joint[@name='door_2_joint']/mimic")
    assert (mimic.get("joint"), float(mimic.get("multiplier"))) == ("door_1_joint", 2.0)


def test_mjcf_has_an_equality(out):
    assert mujoco.MjModel.from_xml_path(str(out / "model.xml")).neq == 1


def test_the_animation_moves_both_leaves(out):
    file = Glb.parse((out / "model.glb").read_bytes())
    assert len(file.tables["animations"][0]["channels"]) == 2


def test_the_page_has_one_slider(out):
    assert re.findall(r'data-joint="(\d+)"', (out / "report.html").read_text()) == ["0"]


def test_the_settings_state_the_fold_and_are_read_back(out):
    settings = settings_from_json(json.loads((out / "settings.json").read_text()))
    assert settings.motions == {"door_1": MotionChoice(Moves.FOLDS, Side.LEFT)}
