from dataclasses import replace
from io import BytesIO
from pathlib import Path
from zipfile import ZIP_STORED, ZipFile

import lids_and_flaps
import numpy as np
import pytest
import trimesh
from small_cabinet import board, make_cabinet, painted_cube, png
from test_swings import with_bar

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.articulation.catch_kind import CatchKind
from grafu.articulation.grasp_search import GraspHint, with_grasps
from grafu.articulation.kinematics import link_origins, link_poses
from grafu.articulation.mass import mass_of_link
from grafu.articulation.physics import physics_of
from grafu.export.files import ExportFiles, write_files
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import from_rotation, invert, rotation_matrix, transform_points, translation
from grafu.joints.catches import with_catches
from grafu.synth.generate import make_specimen
from grafu.synth.truth.clashes import articulated_of
from grafu.vocabulary import JointType

pytest.importorskip("pxr", reason="usd-core is not installed: pip install 'grafu[usd]'")
from pxr import Usd, UsdGeom, UsdPhysics, UsdSemantics, UsdShade, UsdValidation

from grafu.export.usd.config import UsdConfig
from grafu.export.usd.exporter import export_usd, export_usdz
from grafu.export.usd.stage import build_stage


def opened(files: ExportFiles, folder: Path) -> Usd.Stage:
    write_files(files, folder)
    return Usd.Stage.Open(str(folder / next(n for n in files.names if n.startswith("model."))))


def require_valid(stage: Usd.Stage) -> None:
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    found = UsdValidation.ValidationContext(validators).Validate(stage)
    assert len(validators) > 10
    assert [(error.GetName(), error.GetMessage()) for error in found] == []


def parsed(stage: Usd.Stage) -> dict:
    load = getattr(UsdPhysics, "UsdPhysicsLoadStageFromPrimRange", None)  # the older name is deprecated by now
    if load is None:
        return UsdPhysics.LoadUsdPhysicsFromRange(stage, ["/"])
    return load(stage, ["/"])


@pytest.fixture(scope="module", params=["cabinet", 0, 1, 2])
def made(request, tmp_path_factory) -> tuple[ArticulatedObject, Usd.Stage]:
    number = request.param
    furniture = make_cabinet() if number == "cabinet" else articulated_of(make_specimen(11, number).whole)
    return furniture, opened(export_usd(furniture), tmp_path_factory.mktemp("usd") / "made")


@pytest.fixture(scope="module")
def stage(tmp_path_factory) -> Usd.Stage:
    return opened(export_usd(make_cabinet()), tmp_path_factory.mktemp("usd") / "cabinet")


def placed(prim: Usd.Prim) -> np.ndarray:
    return np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(Usd.TimeCode.Default())).T


def turned(quaternion) -> np.ndarray:
    x, y, z = quaternion.GetImaginary()
    w = quaternion.GetReal()
    K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + 2 * w * K + 2 * K @ K


def motion(joint: UsdPhysics.Joint, value: float) -> np.ndarray:
    """Returns the motion between a joint's two frames, by what the scene states alone."""
    if joint.GetPrim().IsA(UsdPhysics.RevoluteJoint):
        axis = np.eye(3)["XYZ".index(UsdPhysics.RevoluteJoint(joint).GetAxisAttr().Get())]
        return from_rotation(rotation_matrix(axis, value))
    axis = np.eye(3)["XYZ".index(UsdPhysics.PrismaticJoint(joint).GetAxisAttr().Get())]
    return translation(axis * value)


def poses_in(stage: Usd.Stage, furniture: ArticulatedObject, values: dict[str, float]) -> dict[str, np.ndarray]:
    top = stage.GetDefaultPrim().GetPath()
    poses = {furniture.root: placed(stage.GetPrimAtPath(top.AppendChild(furniture.root)))}
    for link in furniture.links_from_root[1:]:
        joint = furniture.joint_of[link.id]
        prim = UsdPhysics.Joint(stage.GetPrimAtPath(top.AppendPath(f"joints/{joint.id}")))
        sides = [
            from_rotation(turned(rotation.Get()), np.array(position.Get(), dtype=float))
            for position, rotation in (
                (prim.GetLocalPos0Attr(), prim.GetLocalRot0Attr()),
                (prim.GetLocalPos1Attr(), prim.GetLocalRot1Attr()),
            )
        ]
        assert prim.GetBody0Rel().GetTargets() == [top.AppendChild(joint.parent)]
        assert prim.GetBody1Rel().GetTargets() == [top.AppendChild(joint.child)]
        poses[link.id] = poses[joint.parent] @ sides[0] @ motion(prim, values[joint.id]) @ invert(sides[1])
    return poses


@pytest.mark.parametrize("ratio", [0.0, 0.37, 1.0])
def test_links_stand_where_the_kinematics_say(made, ratio):
    furniture, stage = made
    values = {joint.id: joint.limits.lower + ratio * joint.limits.range for joint in furniture.joints}
    found, expected, origins = (
        poses_in(stage, furniture, values),
        link_poses(furniture, values),
        link_origins(furniture),
    )
    assert furniture.moving_joints
    for link in furniture.links:
        assert np.allclose(found[link.id], expected[link.id] @ translation(origins[link.id]), atol=1e-6), link.id


def test_at_rest_prims_and_joints_agree(made):
    furniture, stage = made
    found = poses_in(stage, furniture, {joint.id: 0.0 for joint in furniture.joints})
    for link in furniture.links:
        prim = stage.GetPrimAtPath(stage.GetDefaultPrim().GetPath().AppendChild(link.id))
        assert np.allclose(placed(prim), found[link.id], atol=1e-6)


@pytest.mark.parametrize(
    "direction", [(1, 0, 0), (-1, 0, 0), (0, 0, -1), (0.6, -0.8, 0), (-0.5, 0.5, -0.7071067811865476)]
)
def test_any_axis_reads_back(cabinet, direction, tmp_path):
    axis = Axis(vec3(0.1, 0.2, 0.3), np.array(direction, dtype=float) / np.linalg.norm(direction))
    odd = replace(cabinet, joints=(replace(cabinet.joints[0], axis=axis), cabinet.joints[1]))
    stage = opened(export_usd(odd), tmp_path / "odd")
    values = {"door_1_hinge": 1.1, "drawer_1_rail": 0.2}
    origins, expected = link_origins(odd), link_poses(odd, values)
    for link, pose in poses_in(stage, odd, values).items():
        assert np.allclose(pose, expected[link] @ translation(origins[link]), atol=1e-6)


def test_masses_read_back(made):
    furniture, stage = made
    for link in furniture.links:
        prim, mass = stage.GetPrimAtPath(stage.GetDefaultPrim().GetPath().AppendChild(link.id)), mass_of_link(link)
        told = UsdPhysics.MassAPI(prim)
        R = turned(told.GetPrincipalAxesAttr().Get())
        center = np.array(told.GetCenterOfMassAttr().Get(), dtype=float)
        assert told.GetMassAttr().Get() == pytest.approx(mass.mass)
        assert np.allclose(transform_points(placed(prim), center[None])[0], mass.center, atol=1e-6)
        inertia = R @ np.diag(np.array(told.GetDiagonalInertiaAttr().Get(), dtype=float)) @ R.T
        assert np.allclose(inertia, mass.inertia, rtol=1e-5, atol=1e-6 * np.abs(mass.inertia).max())


def test_openusd_parses_the_physics_that_was_meant(made):
    furniture, stage = made
    found = {kind.name if hasattr(kind, "name") else str(kind): value for kind, value in parsed(stage).items()}
    kinds = [joint.type for joint in furniture.joints]
    shapes = sum(map(len, physics_of(furniture).shapes.values()))

    def count(word: str) -> int:
        return sum(len(paths) for kind, (paths, _) in found.items() if word in kind)

    assert all(one.isValid for _, descriptors in found.values() for one in descriptors)
    assert (count("RevoluteJoint"), count("PrismaticJoint")) == tuple(
        map(kinds.count, (JointType.REVOLUTE, JointType.PRISMATIC))
    )
    bodies = count("RigidBody") - count("RigidBodyMaterial")
    assert (count("Articulation"), bodies, count("FixedJoint")) == (1, len(furniture.links), 1)
    assert count("RigidBodyMaterial") == 1
    assert count("Shape") == shapes


def test_the_validators_of_openusd_find_nothing(made):
    require_valid(made[1])


def test_limits_are_degrees_or_metres_and_drives_only_damp(stage, cabinet):
    hinge = UsdPhysics.RevoluteJoint(stage.GetPrimAtPath("/cabinet/joints/door_1_hinge"))
    rail = UsdPhysics.PrismaticJoint(stage.GetPrimAtPath("/cabinet/joints/drawer_1_rail"))
    for joint, instance, factor in ((hinge, "angular", np.pi / 180), (rail, "linear", 1.0)):
        own = next(j for j in cabinet.joints if j.id == joint.GetPrim().GetName())
        dynamics, drive = physics_of(cabinet).dynamics[own.id], UsdPhysics.DriveAPI(joint.GetPrim(), instance)
        limits = [joint.GetLowerLimitAttr().Get() * factor, joint.GetUpperLimitAttr().Get() * factor]
        assert np.allclose(limits, [own.limits.lower, own.limits.upper], rtol=1e-6)
        assert drive.GetDampingAttr().Get() == pytest.approx(dynamics.damping * factor)
        assert (drive.GetStiffnessAttr().Get(), drive.GetMaxForceAttr().Get()) == (0.0, pytest.approx(dynamics.effort))
        friction = joint.GetPrim().GetAttribute(f"physxJointAxis:{instance}:staticFrictionEffort").Get()
        assert friction == pytest.approx(dynamics.friction)
    assert [str(p) for p in rail.GetPrim().GetRelationship("grafu:after").GetTargets()] == [str(hinge.GetPath())]


def test_the_drive_of_a_heavy_lid_is_a_spring_that_balances_it_at_rest(tmp_path):
    chest = lids_and_flaps.chest()
    stage, spring = (
        opened(export_usd(chest), tmp_path / "chest"),
        physics_of(chest).dynamics["lid"].counterbalance.spring,
    )
    prim = stage.GetPrimAtPath("/made/joints/lid")
    drive = UsdPhysics.DriveAPI(prim, "angular")

    torque = drive.GetStiffnessAttr().Get() * drive.GetTargetPositionAttr().Get()

    assert torque == pytest.approx(spring.stiffness * spring.target, rel=1e-5)
    assert drive.GetTargetPositionAttr().Get() > 45
    assert prim.GetAttribute("physxJointAxis:angular:staticFrictionEffort").Get() == pytest.approx(spring.friction)
    require_valid(stage)


def test_a_catch_is_stated_on_its_joint_for_whoever_applies_it(cabinet, tmp_path):
    caught = with_catches(cabinet, CatchKind.SELF_CLOSING)
    stage, catch = opened(export_usd(caught), tmp_path / "caught"), physics_of(caught).dynamics["drawer_1_rail"].catch
    prim = stage.GetPrimAtPath("/cabinet/joints/drawer_1_rail")

    assert prim.GetAttribute("grafu:catch:kind").Get() == "self-closing"
    found = [prim.GetAttribute(f"grafu:catch:{name}").Get() for name in ("effort", "reach", "fade")]
    assert found == [catch.effort, catch.reach, catch.fade]
    assert UsdPhysics.DriveAPI(prim, "linear").GetStiffnessAttr().Get() == 0.0
    require_valid(stage)


def test_hardware_that_turns_on_its_own_pin_is_left_out(tmp_path):
    stage = opened(export_usd(with_bar("lid")), tmp_path / "swings")

    assert not any("hinge_lid_bar" in str(prim.GetPath()) for prim in stage.Traverse())


def test_the_scene_says_its_units_and_its_one_prim(stage):
    assert (UsdGeom.GetStageMetersPerUnit(stage), UsdPhysics.GetStageKilogramsPerUnit(stage)) == (1.0, 1.0)
    assert UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z
    assert stage.GetDefaultPrim().GetPath() == "/cabinet"
    assert stage.GetDefaultPrim().HasAPI(UsdPhysics.ArticulationRootAPI)


def test_it_stays_where_it_is_placed_in_another_scene(cabinet, tmp_path):
    write_files(export_usd(cabinet), tmp_path / "out")
    room = Usd.Stage.CreateInMemory()
    there = UsdGeom.Xform.Define(room, "/room/cabinet")
    there.GetPrim().GetReferences().AddReference(str(tmp_path / "out" / "model.usdc"))
    there.AddTranslateOp().Set((3.0, 2.0, 0.0))
    base = UsdPhysics.Joint(room.GetPrimAtPath("/room/cabinet/joints/root_fixed"))
    assert base.GetBody0Rel().GetTargets() == ["/room/cabinet"]
    assert base.GetBody1Rel().GetTargets() == ["/room/cabinet/body"]
    ((_, joints),) = (value for kind, value in parsed(room).items() if "FixedJoint" in str(kind))
    assert np.allclose(joints[0].localPose0Position, (3.0, 2.0, 0.0))  # in the world, where the cabinet now stands


def test_what_collides_is_apart_from_what_is_seen(made):
    _, stage = made
    for prim in stage.Traverse():
        if not prim.IsA(UsdGeom.Gprim):
            continue
        purpose = UsdGeom.Imageable(prim).ComputePurpose()
        assert (purpose == UsdGeom.Tokens.guide) == prim.HasAPI(UsdPhysics.CollisionAPI), prim.GetPath()
        if prim.HasAPI(UsdPhysics.CollisionAPI) and prim.IsA(UsdGeom.Mesh):
            assert UsdPhysics.MeshCollisionAPI(prim).GetApproximationAttr().Get() == UsdPhysics.Tokens.convexHull


@pytest.mark.parametrize("kind", ["visuals", "collisions"])
def test_shapes_stand_where_they_should(made, kind):
    furniture, stage = made
    shapes = physics_of(furniture).shapes
    for link in furniture.links:
        prim = stage.GetPrimAtPath(stage.GetDefaultPrim().GetPath().AppendPath(f"{link.id}/{kind}"))
        cache = UsdGeom.BBoxCache(Usd.TimeCode.Default(), [UsdGeom.Tokens.default_, UsdGeom.Tokens.guide])
        found = cache.ComputeWorldBound(prim).ComputeAlignedRange()
        held = [s.mesh.vertices if hasattr(s, "mesh") else s.corners() for s in shapes[link.id]]
        points = link.mesh.vertices if kind == "visuals" else np.vstack(held or [np.zeros((0, 3))])
        if len(points):
            assert np.allclose([found.GetMin(), found.GetMax()], [points.min(axis=0), points.max(axis=0)], atol=1e-5)


def test_looks_and_images_are_there(stage, cabinet, tmp_path):
    files = export_usd(cabinet)
    mesh = stage.GetPrimAtPath("/cabinet/body/visuals/side_left")
    material = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()[0]
    image = UsdShade.Shader(stage.GetPrimAtPath(material.GetPath().AppendChild("color")))
    assert material.GetPath() == "/cabinet/Looks/oak"
    assert files[image.GetInput("file").Get().path.removeprefix("./")] == png((160, 110, 60))
    st = UsdGeom.PrimvarsAPI(mesh).GetPrimvar("st").Get()
    assert np.allclose(st, cabinet.link("body").visuals[0].surfaces[0].uv, atol=1e-6)
    glass = UsdShade.Shader(stage.GetPrimAtPath("/cabinet/Looks/glass/surface"))
    assert glass.GetInput("opacity").Get() == pytest.approx(0.3)


def test_every_image_of_a_material_is_used(tmp_path):
    slots = ("base_color", "metallic_roughness", "normal", "occlusion", "emissive")
    images = {f"{slot}_texture": Texture(slot, png((k, 0, 0)), "image/png") for k, slot in enumerate(slots)}
    look = Material("all", emissive=(1.0, 1.0, 1.0), alpha_mode="MASK", **images)
    files = export_usd(painted_cube(material=look, uv=np.zeros((8, 2))))
    require_valid(opened(files, tmp_path / "cube"))
    assert len(files.names) == 6


def test_colours_of_vertices_are_shown(tmp_path):
    colors = np.tile(np.array([255, 0, 51, 255], np.uint8), (8, 1))
    stage = opened(
        export_usd(painted_cube(material=Material("m", (1.0, 1.0, 1.0, 1.0)), colors=colors)), tmp_path / "a"
    )
    require_valid(stage)
    shown = UsdGeom.PrimvarsAPI(stage.GetPrimAtPath("/cube/body/visuals/cube")).GetPrimvar("displayColor").Get()
    assert np.allclose(shown, np.tile([1.0, 0.0, 0.2], (8, 1)))


def test_points_that_no_face_uses_are_left_out_with_their_colours(tmp_path):
    colors = np.tile(np.arange(8, dtype=np.uint8)[:, None], (1, 4))
    whole = painted_cube(material=Material("m", (1.0, 1.0, 1.0, 1.0)), colors=colors)
    cube = whole.link("body").visuals[0]
    half = replace(cube.surfaces[0], mesh=TriangleMesh(cube.surfaces[0].mesh.vertices, cube.surfaces[0].mesh.faces[:2]))
    cut = replace(whole, links=(replace(whole.links[0], visuals=(replace(cube, surfaces=(half,)),)),))
    stage = opened(export_usd(cut), tmp_path / "a")  # a prim lives as long as its stage
    prim = stage.GetPrimAtPath("/cube/body/visuals/cube")
    used = np.unique(half.mesh.faces)
    mesh = UsdGeom.Mesh(prim)
    assert sorted(set(mesh.GetFaceVertexIndicesAttr().Get())) == list(range(len(used))) == [0, 1, 2, 3]
    assert len(mesh.GetPointsAttr().Get()) == len(used)
    shown = UsdGeom.PrimvarsAPI(prim).GetPrimvar("displayColor").Get()
    np.testing.assert_allclose(np.array(shown)[:, 0], used / 255.0, atol=1e-6)


ODD_NAMES = ["a<&>\"'", "tür 1", "world", "1/b", "1_b", "Looks", "joints", "Door", "door"]


def test_odd_names_become_names_of_prims(tmp_path):
    cube = board(0, 0, 0, 1, 1, 1)
    links = [Link(n, (Visual(n, (Surface(cube, Material(n)),)),)) for n in ODD_NAMES]
    axis = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0))
    joints = tuple(Joint(n, JointType.REVOLUTE, "body", n, axis, JointLimits(0.0, 1.0)) for n in ODD_NAMES)
    stage = opened(export_usd(ArticulatedObject("2 tür", "body", (Link("body", ()), *links), joints)), tmp_path / "odd")
    require_valid(stage)
    shown = [prim.GetDisplayName() or prim.GetName() for prim in stage.GetPrimAtPath("/_2_t_r").GetChildren()]
    assert shown == ["Looks", "body", *ODD_NAMES, "joints"]


def test_a_joint_without_range_is_fixed(cabinet, tmp_path):
    door = replace(cabinet.joints[0], limits=JointLimits(0.0, 0.0))
    stage = opened(export_usd(replace(cabinet, joints=(door, cabinet.joints[1]))), tmp_path / "stuck")
    assert stage.GetPrimAtPath("/cabinet/joints/door_1_hinge").IsA(UsdPhysics.FixedJoint)
    require_valid(stage)


def test_sheets_and_lines_do_no_harm(sheet, tmp_path):
    require_valid(opened(export_usd(painted_cube(mesh=sheet)), tmp_path / "sheet"))


def test_a_usdz_holds_the_same_and_is_laid_out_as_it_must_be(cabinet, tmp_path):
    packed, loose = export_usdz(cabinet), export_usd(cabinet)
    with ZipFile(BytesIO(packed["model.usdz"])) as archive:
        entries = archive.infolist()
        assert {entry.filename: archive.read(entry) for entry in entries} == dict(loose.contents)
    data = packed["model.usdz"]
    starts = [e.header_offset + 30 + sum(np.frombuffer(data, "<u2", 2, e.header_offset + 26)) for e in entries]
    assert [start % 64 for start in starts] == [0] * len(entries)
    assert {entry.compress_type for entry in entries} == {ZIP_STORED}
    require_valid(opened(packed, tmp_path / "cabinet"))


@pytest.mark.parametrize("write", [export_usd, export_usdz])
def test_the_same_object_gives_the_same_bytes(write, cabinet):
    assert write(cabinet) == write(make_cabinet())


def test_physx_can_be_left_out(cabinet, tmp_path):
    stage = opened(export_usd(cabinet, UsdConfig(physx=False)), tmp_path / "plain")
    assert not any("physx" in name for prim in stage.Traverse() for name in prim.GetPropertyNames())


def test_a_wrong_config_is_refused():
    with pytest.raises(ValueError, match=r"`UsdConfig.armature` must not be negative"):
        UsdConfig(armature=-1.0)


def test_a_joint_without_limits_states_none(cabinet, tmp_path):
    (joint, *others) = cabinet.joints
    turning = replace(joint, type=JointType.CONTINUOUS, limits=JointLimits(0.0, 2 * np.pi))
    stage = opened(export_usd(replace(cabinet, joints=(turning, *others))), tmp_path / "turning")
    path = stage.GetDefaultPrim().GetPath().AppendPath(f"joints/{joint.id}")
    made = UsdPhysics.RevoluteJoint(stage.GetPrimAtPath(path))
    assert made
    assert not made.GetUpperLimitAttr().HasAuthoredValue()
    assert not made.GetLowerLimitAttr().HasAuthoredValue()


def test_collision_hulls_have_normals_and_all_shapes_a_physics_material():
    hull = trimesh_cylinder()
    made = ArticulatedObject("o", "body", (Link("body", (Visual("leg", (Surface(hull),)),)),))
    stage, _ = build_stage(made, UsdConfig(static_friction=0.7, dynamic_friction=0.6, restitution=0.2))
    collisions = stage.GetPrimAtPath("/o/body/collisions")
    mesh = UsdGeom.Mesh(collisions.GetChild("collision_0"))
    bound, _ = UsdShade.MaterialBindingAPI(mesh.GetPrim()).ComputeBoundMaterial("physics")
    friction = UsdPhysics.MaterialAPI(bound.GetPrim())

    assert mesh.GetNormalsInterpolation() == "uniform"
    points, normals = (np.array(attr.Get()) for attr in (mesh.GetPointsAttr(), mesh.GetNormalsAttr()))
    faces = np.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)
    outwards = points[faces].mean(axis=1) - points.mean(axis=0)
    assert np.allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-5)
    assert (np.einsum("ij,ij->i", outwards, normals) > 0).all()
    assert friction.GetStaticFrictionAttr().Get() == pytest.approx(0.7)
    assert friction.GetDynamicFrictionAttr().Get() == pytest.approx(0.6)
    assert friction.GetRestitutionAttr().Get() == pytest.approx(0.2)


def trimesh_cylinder() -> TriangleMesh:
    return TriangleMesh.from_trimesh(trimesh.creation.cylinder(0.03, 0.7, sections=16))


@pytest.mark.parametrize("wrong", [{"static_friction": 0.1}, {"restitution": 1.5}, {"dynamic_friction": -0.1}])
def test_impossible_contacts_are_refused(wrong):
    with pytest.raises(ValueError, match="friction"):
        UsdConfig(**wrong)


def test_links_and_parts_have_semantic_labels(cabinet):
    stage, _ = build_stage(cabinet, UsdConfig())

    def labels(path: str) -> list[str]:
        return list(stage.GetPrimAtPath(path).GetAttribute("semantics:labels:class").Get() or [])

    assert labels("/cabinet/door_1") == labels("/cabinet/door_1/visuals/door_1") == ["door"]
    assert labels("/cabinet/drawer_1") == ["drawer"]
    assert labels("/cabinet/body") == []


def test_grasps_are_prims_in_their_links():
    made = with_grasps(make_cabinet(), {"door_1": GraspHint("handle")})
    (grasp,) = made.grasps
    stage, _ = build_stage(made, UsdConfig())
    prim = stage.GetPrimAtPath("/cabinet/door_1/grasps/handle_1_grasp")
    T = np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(0)).T

    assert np.allclose(T, grasp.T_object_grasp, atol=1e-6)
    assert prim.GetAttribute("grafu:grasp:width").Get() == grasp.width
    assert prim.GetAttribute("grafu:grasp:kind").Get() == "handle"


def test_the_whole_is_labelled_in_two_taxonomies(stage):
    top = stage.GetDefaultPrim()
    labels = {name: UsdSemantics.LabelsAPI(top, name).GetLabelsAttr().Get()[0] for name in ("class", "wikidata_qcode")}
    assert labels == {"class": "furniture", "wikidata_qcode": "Q14745"}
