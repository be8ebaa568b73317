"""A door on concealed hinges: GLB and pages show its true path, simulators get one revolute joint."""

import mujoco
import numpy as np
import pytest
from glb_reader import Glb
from gltf_validation import issues_of

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.kinematics import link_origins
from grafu.export.files import write_files
from grafu.export.formats import export
from grafu.export.glb import export_glb
from grafu.render.gallery import concealed_as_articulated
from grafu.templates.gallery import builtin_gallery


@pytest.fixture(scope="module")
def hinge() -> ArticulatedObject:
    return concealed_as_articulated(builtin_gallery().concealed[0])


def test_the_glb_turns_and_shifts_the_door_and_turns_the_links(hinge, tmp_path):
    data = export_glb(hinge)["model.glb"]
    file = Glb.parse(data)
    nodes, animation = file.tables["nodes"], file.tables["animations"][0]
    channels = {(nodes[c["target"]["node"]]["name"], c["target"]["path"]): c["sampler"] for c in animation["channels"]}
    turned, shifted = (
        file.array(animation["samplers"][channels["dynamic_link", path]]["output"]).astype(float)
        for path in ("rotation", "translation")
    )
    (joint,) = hinge.joints
    origin = link_origins(hinge)["dynamic"]

    assert set(channels) == {
        ("dynamic_link", "rotation"),
        ("dynamic_link", "translation"),
        ("hinge_cup_nose", "rotation"),
        ("hinge_cup_link_0", "rotation"),
        ("hinge_cup_link_1", "rotation"),
    }
    for (_, y, _, w), (x, up, out) in zip(turned, shifted, strict=True):
        value = abs(2 * np.arctan2(y, w))
        assert np.allclose(origin + joint.slip.shift(value), [x, -out, up], atol=1e-5)
    issues = issues_of(data, tmp_path)
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]


def test_simulators_get_one_revolute_joint(hinge, tmp_path):
    write_files(export(hinge, ["urdf", "mjcf"]), tmp_path / "out")
    for name in ("model.urdf", "model.xml"):
        model = mujoco.MjModel.from_xml_path(str(tmp_path / "out" / name))
        assert (model.njnt, model.jnt_type[0]) == (1, mujoco.mjtJoint.mjJNT_HINGE)
        assert model.jnt_range[0, 1] == pytest.approx(hinge.joints[0].limits.upper)
