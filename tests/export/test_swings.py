"""Hardware that turns on its own pin: shown in GLB, pictures and pages, left out for simulators."""

from dataclasses import replace

import lids_and_flaps
import mujoco
import numpy as np
import pytest
from glb_reader import Glb
from gltf_validation import issues_of
from small_cabinet import board

from grafu.articulation.articulated_object import ArticulatedObject, Visual, VisualRole
from grafu.articulation.swing import Swing
from grafu.export.files import write_files
from grafu.export.formats import export
from grafu.export.glb import export_glb
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.transform import transform_points
from grafu.render.picture import posed_visuals

PIN = Axis(vec3(0.5, 0.1, 0.4), vec3(1.0, 0.0, 0.0))
SWING = Swing("lid", PIN, np.linspace(0.0, 1.7, 9), -0.4 * np.linspace(0.0, 1.3, 9) ** 2)


def with_bar(on: str) -> ArticulatedObject:
    """The chest with a bar that turns against one of its links as the lid opens."""
    chest = lids_and_flaps.chest()
    surfaces = (Surface(board(0.49, 0.08, 0.38, 0.51, 0.12, 0.55), lids_and_flaps.OAK),)
    bar = Visual("hinge_lid_bar", surfaces, VisualRole.HARDWARE, swing=SWING)
    links = tuple(replace(link, visuals=(*link.visuals, bar)) if link.id == on else link for link in chest.links)
    return replace(chest, links=links)


def expected(made: ArticulatedObject, on: str, value: float) -> np.ndarray:
    T = made.joints[0].motion(value) if on == "lid" else np.eye(4)
    (bar,) = [visual for visual in made.link(on).visuals if visual.swing]
    return transform_points(T @ SWING.motion(value), bar.mesh.vertices)


@pytest.mark.parametrize("on", ["body", "lid"])
def test_a_picture_shows_it_turned(on):
    made = with_bar(on)
    (bar,) = [visual for visual in posed_visuals(made, {"lid": 1.2}) if visual.name == "hinge_lid_bar"]

    assert np.allclose(bar.mesh.vertices, expected(made, on, 1.2))


@pytest.mark.parametrize("on", ["body", "lid"])
def test_the_glb_turns_it_with_the_joint(on, tmp_path):
    made = with_bar(on)
    data = export_glb(made)["model.glb"]
    file = Glb.parse(data)
    nodes, animation = file.tables["nodes"], file.tables["animations"][0]
    (channel,) = [c for c in animation["channels"] if nodes[c["target"]["node"]]["name"] == "hinge_lid_bar"]
    sampler = animation["samplers"][channel["sampler"]]
    (lid,) = [c for c in animation["channels"] if nodes[c["target"]["node"]]["name"] == "lid_link"]
    (x, y, z, w) = file.array(sampler["output"]).astype(float).T
    opened = 2 * np.arctan2(
        -file.array(animation["samplers"][lid["sampler"]]["output"])[:, 0],
        file.array(animation["samplers"][lid["sampler"]]["output"])[:, 3],
    )

    assert channel["target"]["path"] == "rotation"
    assert sampler["input"] == animation["samplers"][lid["sampler"]]["input"]
    assert np.allclose(2 * np.arctan2(x, w), SWING.angles_at(opened.astype(float)), atol=1e-5)
    assert np.allclose([y, z], 0.0)
    assert np.allclose(file.triangles("hinge_lid_bar"), made.link(on).visuals[-1].mesh.triangles, atol=1e-6)
    stands = file.world_offsets()[nodes.index(file.node("hinge_lid_bar"))]
    assert PIN.distance_to(vec3(stands[0], -stands[2], stands[1])) == pytest.approx(0.0, abs=1e-9)
    issues = issues_of(data, tmp_path)
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]


@pytest.mark.parametrize("on", ["body", "lid"])
def test_simulators_get_neither_a_body_nor_a_shape_of_it(on, tmp_path):
    files = export(with_bar(on), ["urdf", "mjcf", "singapo"])

    write_files(files, tmp_path / "out")
    assert not any(b"hinge_lid_bar" in files[name] for name in files.names)
    for name in ("model.urdf", "model.xml"):
        assert mujoco.MjModel.from_xml_path(str(tmp_path / "out" / name)).njnt == 1
