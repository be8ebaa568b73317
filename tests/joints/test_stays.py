"""Stays on lids and flaps: where there is room, both halves point at one another, and nothing is cut into."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.asset.part import Asset
from grafu.export.files import write_files
from grafu.export.formats import export
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.swept_body import SweptBody
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.realize import Realized, realize
from grafu.joints.stays import with_stays
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.render.picture import posed_visuals
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door, Pair
from judging import GALLERY, made_kind

FLAP = Cabinet(case=Case(0.9, 0.4, 0.36), layout=Door("top"))


def asset_of(kind: str) -> Asset:
    return made_kind("chest with a lid") if kind == "lid" else make_cabinet(FLAP)


def built(asset: Asset) -> Realized:
    return realize(plan_from_annotation(asset), asset, GALLERY)


@pytest.fixture(scope="module", params=["lid", "flap"])
def held(request) -> ArticulatedObject:
    result = with_stays(built(asset_of(request.param)))
    (outcome,) = result.report.installed
    assert outcome.stays == 2
    return result.object


def stays(made: ArticulatedObject, *ends: str) -> list[str]:
    return sorted(v.name for link in made.links for v in link.visuals if v.name.rpartition("stay_")[2][2:] in ends)


def test_each_has_a_tube_and_a_rod_with_their_brackets(held):
    leaf = held.joints[0].child
    on_case = [v.name for v in held.link(held.root).visuals if "_stay_" in v.name]
    on_leaf = [v.name for v in held.link(leaf).visuals if "_stay_" in v.name]

    names = [f"support_{leaf}_stay_{k}" for k in (0, 1)]
    assert sorted(on_case) == sorted(f"{name}_{end}" for name in names for end in ("bracket", "tube"))
    assert sorted(on_leaf) == sorted(f"{name}_{end}" for name in names for end in ("lid_bracket", "rod"))


def test_tube_and_rod_are_one_line_and_slide_in_one_another(held):
    (joint,) = held.joints
    for value in np.linspace(0.0, joint.limits.upper, 13):
        shown = {visual.name: visual for visual in posed_visuals(held, {joint.id: float(value)})}
        for tube, rod in zip(stays(held, "tube"), stays(held, "rod"), strict=True):
            points = [shown[name].mesh.vertices for name in (tube, rod)]
            line = _axis_of(points[0])
            off = np.linalg.norm(np.cross(points[1] - points[0].mean(axis=0), line), axis=1)
            assert off.max() < 0.012  # no eye of the rod is further off the tube's own line
            along = [(p @ line).min() for p in points], [(p @ line).max() for p in points]
            assert max(along[0]) < min(along[1])  # they overlap along the line


def _axis_of(points: np.ndarray) -> np.ndarray:
    return np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[2][0]


def test_nothing_is_cut_into_on_the_way(held):
    (joint,) = held.joints
    depth = 0.0008
    others = [v for link in held.links for v in link.visuals if "_stay_" not in v.name]
    moving = {v.name for v in held.link(joint.child).visuals}
    for value in np.linspace(0.0, joint.limits.upper, 21):
        T = joint.motion(float(value))
        for visual in (v for link in held.links for v in link.visuals if "_stay_" in v.name):
            own = T if visual.name in moving else np.eye(4)
            body = SweptBody(visual.mesh, depth)
            body.place(own if visual.swing is None else own @ visual.swing.motion(float(value)))
            for other in others:
                collider = MeshCollider(other.mesh)
                collider.place(T if other.name in moving else np.eye(4))
                assert not body.penetrates(collider), (visual.name, other.name, value)


def test_brackets_touch_case_and_leaf(held):
    leaf = held.joints[0].child
    for ends, link in (("bracket", held.root), ("lid_bracket", leaf)):
        for name in stays(held, ends):
            visual = next(v for v in held.link(link).visuals if v.name == name)
            parts = [MeshCollider(v.mesh) for v in held.link(link).visuals if "_stay_" not in v.name]
            assert min(MeshCollider(visual.mesh).distance(part) for part in parts) < 1e-4, name


def test_simulators_get_the_brackets_alone(held, tmp_path):
    files = export(held, ["urdf", "mjcf"])
    write_files(files, tmp_path / "out")

    text = files["model.urdf"].decode()
    assert text.count("_lid_bracket") > 0
    assert "_tube" not in text
    assert "_rod" not in text
    assert mujoco.MjModel.from_xml_path(str(tmp_path / "out" / "model.xml")).njnt == 1


def test_a_door_gets_none():
    result = with_stays(built(make_cabinet(Cabinet(layout=Pair()))))

    assert all(outcome.stays == 0 for outcome in result.report.installed)
    assert not any("_stay_" in v.name for link in result.object.links for v in link.visuals)


def test_a_flap_that_falls_open_gets_none():
    result = with_stays(built(make_cabinet(replace(FLAP, layout=Door("bottom")))))

    assert not any("_stay_" in v.name for link in result.object.links for v in link.visuals)


def test_where_there_is_no_room_they_are_left_out():
    realized = built(asset_of("lid"))
    (root,) = [link for link in realized.object.links if link.id == realized.object.root]
    box = Box.enclosing(visual.mesh.box for visual in root.visuals)
    filling = TriangleMesh.box_mesh(Box(box.low + 0.03, vec3(*(box.high - 0.03).tolist())))
    goods = replace(root.visuals[0], name="goods", surfaces=(replace(root.visuals[0].surfaces[0], mesh=filling),))
    bare = replace(goods, surfaces=(type(goods.surfaces[0])(filling, goods.surfaces[0].material),))
    links = tuple(replace(li, visuals=(*li.visuals, bare)) if li is root else li for li in realized.object.links)
    result = with_stays(replace(realized, object=replace(realized.object, links=links)))

    assert [outcome.stays for outcome in result.report.installed] == [0]


@pytest.mark.parametrize(("wanted", "count"), [(True, 2), (False, 0)])
def test_the_settings_leave_them_out(wanted, count):
    done = functionalize(asset_of("lid"), MotionSource.ANNOTATION, GALLERY, PipelineConfig(Settings(stays=wanted)))

    assert [outcome.stays for outcome in done.report.installed] == [count]
