"""Nothing is added for a drawer that gets no joint, no top on what has none."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.articulation.articulated_object import Link
from grafu.asset.part import Asset, Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.realize import Realized
from grafu.pipeline.additions import without_idle
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel

CASE = {
    "left": (PartLabel.SIDE_PANEL, (0, 0, 0), (0.02, 0.5, 0.5)),
    "right": (PartLabel.SIDE_PANEL, (0.58, 0, 0), (0.6, 0.5, 0.5)),
    "back": (PartLabel.BACK_PANEL, (0.02, 0.48, 0), (0.58, 0.5, 0.5)),
    "bottom": (PartLabel.BOTTOM_PANEL, (0.02, 0, 0), (0.58, 0.48, 0.02)),
}
FRONT = {"drawer": (PartLabel.DRAWER, (0.025, 0, 0.025), (0.575, 0.02, 0.3))}


def made(name, **shapes):
    parts = []
    for part_id, (label, low, high) in shapes.items():
        mesh = TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))
        parts.append(Part(part_id, label, (Surface(mesh),), PartSource(part_id), "name"))
    return Asset(name, name, "made", tuple(parts))


def result_of(asset):
    return functionalize(asset, MotionSource.RULE, builtin_gallery())


@pytest.fixture(scope="module")
def free():
    return result_of(made("chest", **CASE, **FRONT))


def test_a_front_that_runs_gets_a_box(free):
    assert {joint.child for joint in free.object.joints} == {"drawer"}
    assert {a.part.carried_by for a in free.body.additions} >= {"drawer"}


def test_the_box_of_a_front_that_got_no_joint_is_taken_back(free):
    boards = {a.part.id for a in free.body.additions if a.part.carried_by}
    root = Link(free.object.root, tuple(v for link in free.object.links for v in link.visuals))
    still = replace(free.object, links=(root,), joints=(), grasps=())
    body, realized = without_idle(free.body, Realized(still, free.report, free.fittings.scene))
    assert boards
    assert not boards & {a.part.id for a in body.additions}
    assert not boards & {p.id for p in body.scene.parts.values()}
    assert not boards & set(realized.scene.parts)
    assert {v.name for v in realized.object.links[0].visuals} == {v.name for v in root.visuals} - boards


def test_boxes_of_drawers_that_run_stay(free):
    realized = Realized(free.object, free.report, free.fittings.scene)
    assert without_idle(free.body, realized) == (free.body, realized)


def test_an_open_chest_gets_a_top_and_a_bed_none(free):
    assert [a for a in free.body.additions if a.part.label is PartLabel.TOP_PANEL]
    bed = result_of(made("captains-bed", **CASE, **FRONT))
    assert not [a for a in bed.body.additions if a.part.label is PartLabel.TOP_PANEL]


def test_a_crate_stays_open():
    assert not result_of(made("thing", **CASE)).body.additions
