"""What is drawn solid behind doors and drawers gets compartments; what is open, thin or shallow stays as it is."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest
import trimesh

import grafu
from grafu.additions.compartment.complete import cut_compartments
from grafu.additions.compartment.config import SolidBodyConfig
from grafu.additions.step import DeficiencyKind, StepRequest
from grafu.asset.edit import yawed
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.joints.make_plan import plan_from_annotation
from grafu.pipeline.additions import planned_scene
from small_scenes import box, hinged, scene, sliding

BLOCK = box("block", (-0.3, 0.0, 0.0), (0.3, 0.5, 0.7))
FRONTS = [box(f"drawer_{k}", (-0.298, -0.02, z), (0.298, 0.0, z + 0.2)) for k, z in enumerate((0.03, 0.25, 0.47))]
LEAVES = [box(name, (x, -0.02, 0.03), (x + 0.295, 0.0, 0.67)) for name, x in (("door_l", -0.298), ("door_r", 0.003))]
OUT = (0.0, -1.0, 0.0)


def open_block(part=BLOCK):
    """The block without its bottom, in two materials: no surface of it is closed."""
    faces = part.mesh.faces
    low = part.mesh.vertices[faces][:, :, 2].max(axis=1) < 1e-9
    at_front = part.mesh.vertices[faces][:, :, 1].max(axis=1) < 1e-9
    front, others = (TriangleMesh(part.mesh.vertices, faces[keep & ~low]) for keep in (at_front, ~at_front))
    return replace(part, surfaces=(Surface(front), Surface(others, Material("red", (0.8, 0.1, 0.1, 1.0)))))


def drawers(block=BLOCK, fronts=FRONTS):
    return scene(block, *fronts, joints=tuple(sliding(part.id, OUT) for part in fronts))


def doors(block=BLOCK):
    axes = (Axis(vec3(x, 0.0, 0.0), vec3(0.0, 0.0, sign)) for x, sign in ((-0.298, -1.0), (0.298, 1.0)))
    return scene(block, *LEAVES, joints=tuple(hinged(p.id, axis) for p, axis in zip(LEAVES, axes, strict=True)))


def made(asset, config: SolidBodyConfig | None = SolidBodyConfig()):
    plan = plan_from_annotation(asset)
    return cut_compartments(planned_scene(asset, plan), StepRequest(plan), config)


def depth(part, x, z, asset=None):
    """How far one sees into a part from a place before it."""
    return float(RayCaster(part.mesh).along(np.array([[x, -0.5, z]]), vec3(0.0, 1.0, 0.0))[0]) - 0.5


@pytest.mark.parametrize("block", [BLOCK, open_block()], ids=["closed", "open, in two materials"])
def test_each_drawer_gets_a_compartment_of_its_own_with_walls_as_thick_as_boards(block):
    step = made(drawers(block))

    (cut,) = step.changes.compartments
    assert sorted(cut.fronts) == [("drawer_0",), ("drawer_1",), ("drawer_2",)]
    assert [d.part for d in step.deficiencies] == ["drawer_0", "drawer_1", "drawer_2"]
    part = step.scene.parts["block"]
    assert part.box.size == pytest.approx(BLOCK.box.size)
    for z in (0.13, 0.35, 0.57):
        for x in (-0.25, 0.0, 0.25):
            assert depth(part, x, z) == pytest.approx(0.484, abs=0.003), "all but the rear wall"
    for z in (0.24, 0.46):
        assert depth(part, 0.0, z) == pytest.approx(0.0, abs=1e-6), "the wall between two drawers"
    sideways = RayCaster(part.mesh).along(np.array([[0.0, 0.25, 0.13]]), vec3(1.0, 0.0, 0.0))
    assert sideways[0] == pytest.approx(0.284, abs=0.003)
    assert part.mesh.is_watertight == block.mesh.is_watertight
    assert {s.material for s in part.surfaces} == {s.material for s in block.surfaces}


@pytest.mark.parametrize("degrees", [0, 90, 200])
def test_two_doors_side_by_side_share_one_whichever_way_they_look(degrees):
    asset = yawed(doors(), radians(degrees))
    step = made(asset)

    (cut,) = step.changes.compartments
    assert [sorted(fronts) for fronts in cut.fronts] == [["door_l", "door_r"]]
    before, after = (trimesh.Trimesh(m.vertices, m.faces).volume for m in (BLOCK.mesh, cut.part.mesh))
    assert after == pytest.approx(before - 0.564 * 0.482 * 0.622, rel=1e-3)


def test_without_a_config_it_is_only_said_what_lacks_one():
    step = made(drawers(), None)

    assert step.scene.parts["block"] is BLOCK
    assert not step.changes.compartments
    assert {d.kind for d in step.deficiencies} == {DeficiencyKind.COMPARTMENT}


CARCASS = [
    box("left", (-0.3, 0.0, 0.0), (-0.28, 0.5, 0.7)),
    box("right", (0.28, 0.0, 0.0), (0.3, 0.5, 0.7)),
    box("bottom", (-0.28, 0.0, 0.0), (0.28, 0.5, 0.02)),
    box("top", (-0.28, 0.0, 0.68), (0.28, 0.5, 0.7)),
    box("back", (-0.28, 0.48, 0.02), (0.28, 0.5, 0.68)),
]


@pytest.mark.parametrize(
    "still",
    [
        CARCASS,
        [*CARCASS, box("panel", (-0.28, 0.005, 0.02), (0.28, 0.02, 0.68))],
        [box("block", (-0.3, 0.0, 0.0), (0.3, 0.09, 0.7))],
        [box("block", (-0.3, 0.05, 0.0), (0.3, 0.5, 0.7))],
        [box("block", (-0.1, 0.0, 0.0), (0.3, 0.5, 0.7)), CARCASS[0]],
        [box("block", (-0.3, 0.2, 0.0), (0.3, 0.5, 0.7)), *CARCASS[:4]],
    ],
    ids=["an open carcass", "a panel", "a shallow block", "one far behind", "behind a part of it", "a block in a case"],
)
def test_what_is_not_solid_right_behind_a_front_stays_as_it_is(still):
    asset = scene(*still, *FRONTS, joints=tuple(sliding(part.id, OUT) for part in FRONTS))
    step = made(asset)

    assert not step.changes.compartments
    assert not step.deficiencies


def test_drawers_before_a_solid_block_work_and_the_report_states_why():
    result = grafu.functionalize(drawers(), motion="annotation", top=False)

    assert [joint.part for joint in result.report.joints] == ["drawer_0", "drawer_1", "drawer_2"]
    assert all(joint.opening > 0.25 and joint.collision_share == 0 for joint in result.report.joints)
    added = [one for one in result.report.carved if one.style == "compartment"]
    assert [one.why for one in added] == [f"it was drawn solid behind drawer_{k}" for k in range(3)]
    assert {one.part for one in added} == {"block"}
    assert {one.part for one in result.report.added if one.style == "drawer box"} != set()

    solid = grafu.functionalize(drawers(), motion="annotation", top=False, compartments=False)
    assert len(solid.report.joints) < 3
