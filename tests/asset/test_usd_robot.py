from math import degrees

import numpy as np
import pytest

from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.errors import UnreadableAsset
from grafu.export.files import write_files
from grafu.synth.truth.clashes import articulated_of
from grafu.vocabulary import PartLabel
from predictions import cabinet
from robot_models import assert_same_robot
from small_assets import AS_IT_IS, DRAWER, HINGE, Y_UP, load_annotated, write_urdf
from usd_robots import (
    BASE,
    DOOR_JOINT,
    DOOR_LINK,
    DRAWER_JOINT,
    DRAWER_LINK,
    add_mesh,
    joined,
    write_usd_robot,
)

pytest.importorskip("pxr")
from pxr import Gf, Sdf, UsdGeom, UsdPhysics


def body0_and_body1_changed(stage):
    for path in (DOOR_JOINT, DRAWER_JOINT):
        joint = UsdPhysics.Joint(stage.GetPrimAtPath(path))
        for first, second in (
            (joint.GetBody0Rel(), joint.GetBody1Rel()),
            (joint.GetLocalPos0Attr(), joint.GetLocalPos1Attr()),
        ):
            if first.GetName().startswith("physics:body"):
                ends = first.GetTargets(), second.GetTargets()
                first.SetTargets(ends[1]), second.SetTargets(ends[0])
            else:
                ends = first.Get(), second.Get()
                first.Set(ends[1]), second.Set(ends[0])
        low, high = (joint.GetPrim().GetAttribute(f"physics:{side}Limit") for side in ("lower", "upper"))
        ends = low.Get(), high.Get()
        low.Set(-ends[1]), high.Set(-ends[0])
    root = UsdPhysics.FixedJoint.Define(stage, "/cabinet/joints/root")
    joined(root, BASE, "", np.zeros(3), np.zeros(3), (1, 0, 0), np.array([1.0, 0, 0]))


def as_freedoms(stage):
    """Joints of no special kind, all freedoms of which are locked but one."""
    for path, free, low, high in ((DOOR_JOINT, "rotZ", 0.0, degrees(1.5)), (DRAWER_JOINT, "transX", 0.0, 0.3)):
        prim = stage.GetPrimAtPath(path)
        prim.SetTypeName("PhysicsJoint")
        for name in ("transX", "transY", "transZ", "rotX", "rotY", "rotZ"):
            limit = UsdPhysics.LimitAPI.Apply(prim, name)
            limit.CreateLowAttr(low if name == free else 1.0)
            limit.CreateHighAttr(high if name == free else -1.0)


def below_scaled_prims(stage):
    """Links twice as large as they are written, in a piece half as large; joints state positions in the links' own."""
    UsdGeom.Xformable(stage.GetPrimAtPath("/cabinet")).AddScaleOp().Set(Gf.Vec3f(0.5))
    for path in (BASE, DOOR_LINK, DRAWER_LINK):
        link = UsdGeom.Xformable(stage.GetPrimAtPath(path))
        translate = link.GetOrderedXformOps()[0]
        translate.Set(translate.Get() * 2)
        link.AddScaleOp().Set(Gf.Vec3f(2.0))


@pytest.mark.parametrize(
    ("matrix", "metres", "up", "change"),
    [
        (AS_IT_IS, 1.0, "Z", lambda stage: None),
        (100 * Y_UP, 0.01, "Y", lambda stage: None),
        (AS_IT_IS, 1.0, "Z", body0_and_body1_changed),
        (AS_IT_IS, 1.0, "Z", as_freedoms),
        (AS_IT_IS, 1.0, "Z", below_scaled_prims),
    ],
    ids=["metres", "centimetres, Y up", "the moving body is body0", "joints of no special kind", "scaled"],
)
def test_a_cabinet_is_the_same_as_in_urdf(tmp_path, matrix, metres, up, change):
    asset = load_annotated(write_usd_robot(tmp_path, matrix, metres, up, change))
    assert asset.kind == "usd"
    assert asset.notes == ()
    assert_same_robot(asset, load_annotated(write_urdf(tmp_path / "urdf")))


def test_limits_count_from_where_a_joint_is_drawn(tmp_path):
    def opened(stage):
        door, drawer = (UsdGeom.Xformable(stage.GetPrimAtPath(path)) for path in (DOOR_LINK, DRAWER_LINK))
        door.AddRotateZOp().Set(-30.0)  # it opens about -Z
        drawer.GetOrderedXformOps()[0].Set(Gf.Vec3d(0.0, -0.1, 0.0))

    asset = load_annotated(write_usd_robot(tmp_path, change=opened))
    door, drawer = sorted(asset.joints, key=lambda joint: joint.type.value, reverse=True)
    assert (door.lower, door.upper) == pytest.approx((-np.pi / 6, 1.5 - np.pi / 6), abs=1e-5)
    assert (drawer.lower, drawer.upper) == pytest.approx((-0.1, 0.2), abs=1e-6)
    assert asset.part("door_link").box.size[1] > 0.4  # it stands open
    side = asset.part("vertical_side_panel_1").box.low  # the hinge is on its outer face, as far in front as a leaf
    np.testing.assert_allclose(door.axis.point[:2], side[:2] - [0.0, 0.02], atol=1e-6)


def test_without_limits_a_joint_is_not_limited(tmp_path):
    def freed(stage):
        for path in (DOOR_JOINT, DRAWER_JOINT):
            stage.GetPrimAtPath(path).GetAttribute("physics:upperLimit").Set(float("inf"))

    assert [joint.limited for joint in load_annotated(write_usd_robot(tmp_path, change=freed)).joints] == [False, False]


@pytest.mark.parametrize("by", ["grafu", "PhysX"])
def test_joints_follow_others_by_either_schema(tmp_path, by):
    def coupled(stage):
        prim = stage.GetPrimAtPath(DRAWER_JOINT)
        if by == "grafu":
            prim.CreateRelationship("grafu:leader").SetTargets([DOOR_JOINT])
            prim.CreateAttribute("grafu:multiplier", Sdf.ValueTypeNames.Double).Set(0.2)
            prim.CreateAttribute("grafu:offset", Sdf.ValueTypeNames.Double).Set(0.05)
            return
        prim.AddAppliedSchema("PhysxMimicJointAPI:rotX")
        prim.CreateRelationship("physxMimicJoint:rotX:referenceJoint").SetTargets([DOOR_JOINT])
        prim.CreateAttribute("physxMimicJoint:rotX:referenceJointAxis", Sdf.ValueTypeNames.Token).Set("rotZ")
        for key, value in (("gearing", -0.2 * np.pi / 180), ("offset", -0.05)):
            prim.CreateAttribute(f"physxMimicJoint:rotX:{key}", Sdf.ValueTypeNames.Float).Set(value)

    asset = load_annotated(write_usd_robot(tmp_path, change=coupled))
    coupling = next(joint for joint in asset.joints if joint.type.value == "prismatic").coupling
    assert coupling.leader == "door_link"
    assert (coupling.multiplier, coupling.offset) == pytest.approx((0.2, 0.05), abs=1e-6)


def test_what_is_fixed_to_a_link_moves_with_it(tmp_path):
    def handle_is_a_link(stage):
        stage.RemovePrim(f"{DRAWER_LINK}/visuals/handle_11")
        link = UsdGeom.Xform.Define(stage, "/cabinet/pull_link")
        UsdPhysics.RigidBodyAPI.Apply(link.GetPrim())
        add_mesh(stage, "/cabinet/pull_link/visuals/mesh_0", "handle-11")
        fixed = UsdPhysics.FixedJoint.Define(stage, "/cabinet/joints/pull_joint")
        joined(fixed, f"{DRAWER_LINK}/visuals", "/cabinet/pull_link", np.zeros(3), np.zeros(3), (1, 0, 0), np.eye(3)[0])

    asset = load_annotated(write_usd_robot(tmp_path, change=handle_is_a_link))
    handle = next(p for p in asset.parts if p.source.link == "pull_link")
    assert (handle.label, handle.carried_by) == (PartLabel.HANDLE, "drawer_link")


def test_what_closes_a_loop_is_left_out_with_a_note(tmp_path):
    def braced(stage):
        brace = UsdPhysics.RevoluteJoint.Define(stage, "/cabinet/a_first/brace")
        joined(brace, DRAWER_LINK, DOOR_LINK, np.zeros(3), np.zeros(3), (0, 0, 1), np.array([0.0, 0, 1]))
        brace.CreateExcludeFromArticulationAttr(True)

    asset = load_annotated(write_usd_robot(tmp_path, change=braced))
    assert asset.notes == ("joint brace closes a loop and is left out",)
    assert_same_robot(asset, load_annotated(write_urdf(tmp_path / "urdf")))


def test_collision_shapes_are_left_out_where_a_body_has_others(tmp_path):
    def with_shapes(stage):
        add_mesh(stage, f"{DOOR_LINK}/collisions/mesh_0", "cabinet_door_surface-7", at=np.array(HINGE[0]))
        stage.RemovePrim(f"{DRAWER_LINK}/visuals")
        add_mesh(stage, f"{DRAWER_LINK}/collisions/mesh_0", "drawer_front-9")

    asset = load_annotated(write_usd_robot(tmp_path, change=with_shapes))
    assert len(asset.part("door_link").surfaces) == 1
    assert len(asset.part("drawer_link").surfaces) == 1  # it has no other


@pytest.mark.parametrize("off", ["joints", "bodies"])
def test_what_is_switched_off_moves_nothing(tmp_path, off):
    def switched_off(stage):
        if off == "joints":
            for path in (DOOR_JOINT, DRAWER_JOINT):
                UsdPhysics.Joint(stage.GetPrimAtPath(path)).CreateJointEnabledAttr(False)
        else:
            for path in (BASE, DOOR_LINK, DRAWER_LINK):
                UsdPhysics.RigidBodyAPI(stage.GetPrimAtPath(path)).CreateRigidBodyEnabledAttr(False)

    asset = load_asset(write_usd_robot(tmp_path, change=switched_off))
    assert asset.annotation is None
    assert asset.kind == "mesh file"


def test_parts_are_the_same_whatever_the_joints_state(tmp_path):
    def fixed(stage):
        stage.GetPrimAtPath(DOOR_JOINT).SetTypeName("PhysicsFixedJoint")

    known, less = load_asset(write_usd_robot(tmp_path / "a")), load_asset(write_usd_robot(tmp_path / "b", change=fixed))
    assert {p.id: p.label for p in known.parts} == {p.id: p.label for p in less.parts}


def test_the_shapes_of_a_link_are_one_part_unless_parts_are_those_of_the_input(tmp_path):
    def nameless(stage):
        stage.RemovePrim(DRAWER_LINK)
        UsdPhysics.RigidBodyAPI.Apply(UsdGeom.Xform.Define(stage, "/cabinet/link_2").GetPrim())
        for k, name in enumerate(DRAWER):
            add_mesh(stage, f"/cabinet/link_2/visuals/mesh_{k}/shape", name)
        UsdPhysics.Joint(stage.GetPrimAtPath(DRAWER_JOINT)).GetBody1Rel().SetTargets(["/cabinet/link_2"])

    path = write_usd_robot(tmp_path, change=nameless)
    whole, apart = load_asset(path), load_asset(path, LoadOptions(parts="input"))
    links = [[part.source.link for part in asset.parts] for asset in (whole, apart)]
    assert [of.count("link_2") for of in links] == [1, len(DRAWER)]


@pytest.mark.parametrize("value", [float("nan"), 1e300])
def test_frames_beyond_all_furniture_are_refused_in_one_line(tmp_path, value):
    def broken(stage):
        UsdGeom.Xformable(stage.GetPrimAtPath("/cabinet")).AddTranslateOp().Set(Gf.Vec3d(value, 0, 0))

    with pytest.raises(UnreadableAsset, match=r"numbers|poses") as error:
        load_asset(write_usd_robot(tmp_path, change=broken))
    assert "\n" not in str(error.value)


def test_what_is_written_is_read_back_with_its_joints(tmp_path):
    from grafu.export.usd.exporter import export_usd

    stated = articulated_of(cabinet())
    write_files(export_usd(stated), tmp_path, overwrite=True)
    asset = load_annotated(tmp_path / "model.usdc")
    of = {joint.child: joint for joint in stated.joints if joint.kind.moves}
    assert {joint.part for joint in asset.joints} == set(of)
    for joint in asset.joints:
        assert joint.upper == pytest.approx(of[joint.part].limits.upper, abs=1e-5)
        np.testing.assert_allclose(joint.axis.direction, of[joint.part].axis.direction, atol=1e-6)
