import xml.etree.ElementTree as ET
from dataclasses import replace
from io import BytesIO

import mujoco
import numpy as np
import pytest
from mjcf_reading import at_keyframe, compiled, drawn_vertices, files_named, pose_of, posed, run, values_at
from PIL import Image
from small_cabinet import board, make_cabinet, painted_cube, png

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.articulation.kinematics import link_origins, link_poses
from grafu.articulation.mass import mass_of_link
from grafu.articulation.physics import physics_of
from grafu.export.formats import export
from grafu.export.mjcf import MjcfConfig, export_mjcf
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import from_rotation, transform_points
from grafu.synth.generate import make_specimen
from grafu.synth.truth.clashes import articulated_of
from grafu.vocabulary import JointType


def specimen(number: int) -> ArticulatedObject:
    return articulated_of(make_specimen(11, number).whole)


@pytest.fixture(scope="module")
def model(tmp_path_factory) -> mujoco.MjModel:
    return compiled(export_mjcf(make_cabinet()), tmp_path_factory.mktemp("mjcf") / "cabinet")


@pytest.fixture(scope="module", params=[0, 1, 2])
def made(request, tmp_path_factory) -> tuple[ArticulatedObject, mujoco.MjModel]:
    furniture = specimen(request.param)
    return furniture, compiled(export_mjcf(furniture), tmp_path_factory.mktemp("mjcf") / "made")


def require_poses(articulated: ArticulatedObject, model: mujoco.MjModel, values: dict[str, float]) -> None:
    data, expected, origins = posed(model, values), link_poses(articulated, values), link_origins(articulated)
    for link in articulated.links:
        T_link_rest = from_rotation(np.eye(3), origins[link.id])
        assert np.allclose(pose_of(data, link.id), expected[link.id] @ T_link_rest, atol=1e-6), link.id


def test_joints_read_back(model, cabinet):
    for joint in cabinet.joints:
        made, resistance = model.joint(joint.id), physics_of(cabinet).dynamics[joint.id]
        kind = mujoco.mjtJoint.mjJNT_HINGE if joint.type is JointType.REVOLUTE else mujoco.mjtJoint.mjJNT_SLIDE
        assert made.type[0] == kind
        assert model.body(model.body(joint.child).parentid[0]).name == joint.parent
        assert made.limited[0]
        assert np.allclose(made.range, [joint.limits.lower, joint.limits.upper])
        assert np.allclose(made.axis, joint.axis.direction)
        place = posed(model, {}).joint(joint.id).xanchor
        assert joint.type is JointType.PRISMATIC or joint.axis.distance_to(place) < 1e-9
        assert made.damping[0] == pytest.approx(resistance.damping)
        assert made.frictionloss[0] == pytest.approx(resistance.friction_with_spring)
        assert np.allclose(model.jnt_actfrcrange[made.id], [-resistance.effort, resistance.effort])
        assert 0 < made.armature[0] <= 0.01 * resistance.damping


def test_masses_read_back(made):
    furniture, model = made
    data = posed(model, {})
    for link in furniture.links:
        mass, body = mass_of_link(link), model.body(link.id)
        R = data.body(link.id).ximat.reshape(3, 3)
        assert body.mass[0] == pytest.approx(mass.mass)
        assert np.allclose(data.body(link.id).xipos, mass.center, atol=1e-6)
        assert np.allclose(R @ np.diag(body.inertia) @ R.T, mass.inertia, rtol=1e-6, atol=1e-9 * mass.mass)


@pytest.mark.parametrize("ratio", [0.0, 0.31, 1.0])
def test_links_stand_where_the_kinematics_say(made, ratio):
    furniture, model = made
    assert furniture.moving_joints
    require_poses(furniture, model, values_at(furniture, ratio))


@pytest.mark.parametrize("ratio", [0.0, 0.5])
def test_what_is_seen_stands_where_the_kinematics_say(model, cabinet, ratio):
    values = values_at(cabinet, ratio)
    data, poses = posed(model, values), link_poses(cabinet, values)
    for link in cabinet.links:
        for visual in link.visuals:
            names = [n for n in (visual.name, f"{visual.name}_2") if visual.name == "door_1" or n == visual.name]
            found = np.vstack([drawn_vertices(model, data, name) for name in names])
            wanted = transform_points(poses[link.id], visual.mesh.vertices)
            assert np.allclose(
                [found.min(axis=0), found.max(axis=0)], [wanted.min(axis=0), wanted.max(axis=0)], atol=1e-6
            )


def test_visual_and_collision_geoms_are_apart(model, cabinet):
    seen = [k for k in range(model.ngeom) if model.geom_group[k] == 2]
    solid = [k for k in range(model.ngeom) if model.geom_group[k] == 3]
    shapes = physics_of(cabinet).shapes

    assert sorted([*seen, *solid]) == list(range(model.ngeom))
    assert not model.geom_contype[seen].any()
    assert not model.geom_conaffinity[seen].any()
    assert model.geom_contype[solid].all()
    assert len(solid) == sum(map(len, shapes.values()))


def test_collision_shapes_are_those_of_the_urdf(made):
    furniture, model = made
    data = posed(model, {})
    for link, shapes in physics_of(furniture).shapes.items():
        for place, shape in enumerate(shapes):
            geom = data.geom(f"{link}_collision_{place}")
            kind = model.geom(geom.id).type[0]
            if kind == mujoco.mjtGeom.mjGEOM_BOX:
                half = model.geom(geom.id).size
                signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T
                corners = (signs * half) @ geom.xmat.reshape(3, 3).T + geom.xpos
                wanted = shape.corners()
            else:
                corners, wanted = drawn_vertices(model, data, geom.name), shape.vertices
            assert np.allclose(np.sort(corners, axis=0), np.sort(wanted, axis=0), atol=1e-6)


def test_what_a_joint_holds_does_not_collide_with_its_parent(model, cabinet):
    pairs = {tuple(sorted(divmod(int(s), 1 << 16))) for s in model.exclude_signature}
    assert pairs == {tuple(sorted((model.body(j.parent).id, model.body(j.child).id))) for j in cabinet.joints}


def test_closed_it_rests(made):
    _, model = made
    data = at_keyframe(model, "closed")
    run(model, data, 2.0)
    assert np.abs(data.qpos).max() < 1e-3


def test_the_open_pose_is_open(model, cabinet):
    data = at_keyframe(model, "open")
    for joint in cabinet.joints:
        assert data.joint(joint.id).qpos[0] == pytest.approx(joint.limits.upper)


def test_a_door_pushed_open_reaches_its_limit_and_stops(model):
    data, door = at_keyframe(model, "closed"), model.joint("door_1_hinge")
    data.qfrc_applied[door.dofadr] = 0.5 * model.jnt_actfrcrange[door.id, 1]
    run(model, data, 3.0)
    assert data.joint("door_1_hinge").qpos[0] == pytest.approx(door.range[1], abs=0.02)
    assert abs(data.joint("door_1_hinge").qvel[0]) < 1e-2


def test_a_closed_door_stops_the_drawer_behind_it(model):
    data, drawer = at_keyframe(model, "closed"), model.joint("drawer_1_rail")
    data.qfrc_applied[drawer.dofadr] = 5.0
    run(model, data, 0.5)
    assert data.joint("drawer_1_rail").qpos[0] < 0.06


def test_what_must_open_first_is_said(cabinet):
    text = ET.fromstring(export_mjcf(cabinet)["model.xml"]).find("custom/text")
    assert (text.get("name"), text.get("data")) == ("drawer_1_rail_after", "door_1_hinge")


@pytest.mark.parametrize("direction", [vec3(1.0, 0.0, 0.0), vec3(-1.0, 0.0, 0.0)])
def test_a_flap_hung_below_or_above_stays_closed(cabinet, direction, tmp_path):
    height = 0.0 if direction[0] > 0 else 0.8
    flap = hung(cabinet.link("door_1"), Axis(vec3(0.0, -0.2, height), direction))
    model = compiled(export_mjcf(flap), tmp_path / "flap")
    data = at_keyframe(model, "closed")
    run(model, data, 2.0)
    assert abs(data.qpos[0]) < 0.01


def test_servos_open_and_hold(cabinet, tmp_path):
    model = compiled(export_mjcf(cabinet, MjcfConfig(actuators=True)), tmp_path / "cabinet")
    data = at_keyframe(model, "closed")
    data.ctrl[model.actuator("door_1_hinge").id] = 1.0
    run(model, data, 4.0)
    assert data.joint("door_1_hinge").qpos[0] == pytest.approx(1.0, abs=0.05)
    assert np.allclose(at_keyframe(model, "open").ctrl, [j.limits.upper for j in cabinet.joints])


def test_without_keyframes_and_joints_it_compiles_too(tmp_path):
    still = compiled(export_mjcf(painted_cube()), tmp_path / "cube")
    bare = compiled(export_mjcf(make_cabinet(), MjcfConfig(keyframes=False)), tmp_path / "cabinet")
    assert (still.njnt, still.nkey, bare.nkey) == (0, 0, 0)


def test_a_joint_without_range_is_welded(cabinet, tmp_path):
    stuck = replace(cabinet, joints=(replace(cabinet.joints[0], limits=JointLimits(0.0, 0.0)), cabinet.joints[1]))
    stuck = replace(stuck, joints=(stuck.joints[0], replace(stuck.joints[1], after=())))
    model = compiled(export_mjcf(stuck), tmp_path / "stuck")
    assert [model.joint(k).name for k in range(model.njnt)] == ["drawer_1_rail"]


def hung(moving: Link, axis: Axis, kind: JointType = JointType.REVOLUTE) -> ArticulatedObject:
    joint = Joint("lid", kind, "body", moving.id, axis, JointLimits(0.0, 1.5))
    return ArticulatedObject("made", "body", (Link("body", ()), moving), (joint,))


def test_a_fixed_joint_is_no_joint(cabinet, tmp_path):
    axis = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0))
    fixed = hung(cabinet.link("door_1"), axis, JointType.FIXED)
    model = compiled(export_mjcf(fixed), tmp_path / "fixed")
    assert (model.njnt, model.nbody) == (0, 3)


QUAD = TriangleMesh(np.array([[0.0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]]), np.array([[0, 1, 2], [0, 2, 3]]))
TRIANGLE = TriangleMesh(QUAD.vertices[:3], np.array([[0, 1, 2]]))
LINE = TriangleMesh(np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]]), np.array([[0, 1, 2], [1, 2, 3]]))


@pytest.mark.parametrize(("mesh", "geoms"), [(QUAD, 1), (TRIANGLE, 1), (LINE, 0)], ids=["sheet", "triangle", "line"])
@pytest.mark.parametrize("beside", [False, True])
def test_meshes_that_mujoco_refuses_are_mended_or_left_out(mesh, geoms, beside, tmp_path):
    odd = Surface(
        mesh, Material("odd"), uv=mesh.vertices[:, [0, 2]], colors=np.full((len(mesh.vertices), 4), 9, np.uint8)
    )
    solid = (Surface(board(0, 0, 0, 1, 1, 1), Material("solid")),) if beside else ()
    visual = Visual("sheet", (*solid, odd))
    model = compiled(export_mjcf(ArticulatedObject("odd", "body", (Link("body", (visual,)),))), tmp_path / "odd")
    seen = [k for k in range(model.ngeom) if model.geom_group[k] == 2]
    assert len(seen) == geoms + len(solid)


def test_a_triangle_keeps_its_place_and_area(tmp_path):
    model = compiled(export_mjcf(painted_cube(mesh=TRIANGLE, uv=TRIANGLE.vertices[:, [0, 2]])), tmp_path / "triangle")
    vertices = drawn_vertices(model, posed(model, {}), "cube")
    assert np.allclose(np.sort(vertices[np.argsort(vertices @ [1, 2, 3])][[0, -1]]), [[0, 0, 0], [0, 1, 1]], atol=1e-6)
    assert model.mesh("cube_2").facenum[0] == 3


def test_looks_and_images_are_there(model, cabinet):
    wood = model.material("oak")
    assert model.material("glass").rgba[3] == pytest.approx(0.3)
    assert model.geom("side_left").matid[0] == wood.id
    assert model.mesh("side_left").texcoordadr[0] >= 0
    texture = model.tex_data[: 4 * 4 * 3].reshape(4, 4, 3)
    assert np.all(texture == (160, 110, 60))


def test_colours_are_as_screens_take_them(tmp_path):
    grey = painted_cube(material=Material("grey", (0.214, 0.214, 0.214, 1.0)), colors=np.full((8, 4), 255, np.uint8))
    model = compiled(export_mjcf(grey), tmp_path / "grey")
    assert np.allclose(model.material("grey").rgba, [0.5, 0.5, 0.5, 1.0], atol=2e-3)


def test_colours_of_vertices_become_their_mean(tmp_path):
    colors = np.repeat(np.array([[255, 0, 0, 255], [0, 0, 0, 255]], np.uint8), 4, axis=0)
    model = compiled(
        export_mjcf(painted_cube(material=Material("paint", (1.0, 1.0, 1.0, 1.0)), colors=colors)), tmp_path / "a"
    )
    assert model.material("paint").rgba[0] == pytest.approx(0.735, abs=2e-3)


def jpeg() -> bytes:
    stream = BytesIO()
    Image.new("L", (8, 4), 100).save(stream, "JPEG")
    return stream.getvalue()


@pytest.mark.parametrize(
    ("data", "mime", "count"),
    [
        (jpeg(), "image/jpeg", 1),
        (png((9, 9, 9)), "image/png", 1),
        (jpeg(), "image/png", 1),
        (b"no image", "image/png", 0),
    ],
)
def test_any_image_comes_as_png_or_not_at_all(data, mime, count, tmp_path):
    look = Material("m", base_color_texture=Texture("paper", data, mime))
    files = export_mjcf(painted_cube(material=look, uv=np.zeros((8, 2))))
    model = compiled(files, tmp_path / "cube")
    assert model.ntex == count
    assert [files[n][:4] for n in files.names if "textures/" in n] == [b"\x89PNG"] * count


def test_it_holds_exactly_the_files_that_it_names(made):
    files = export_mjcf(made[0])
    assert files_named(files) == set(files.names) - {"model.xml"}


def test_it_shares_the_meshes_of_the_urdf(cabinet):
    both = export(cabinet, ["urdf", "mjcf"])
    alone = [set(export(cabinet, [name]).names) for name in ("urdf", "mjcf")]
    assert alone[1] - alone[0] == {"model.xml", "meshes/door_1_2.obj", "meshes/door_1_3.obj"}  # wood and glass apart
    assert set(both.names) == alone[0] | alone[1]


ODD_NAMES = ["a<&>\"'", "tür 1", "world", "a/b", "x\x01y", "x\x02y", "Door", "door"]


def test_odd_names_stay_and_stay_apart(tmp_path):
    links = [Link("body", ())] + [
        Link(name, (Visual(name, (Surface(board(k, 0, 0, k + 0.5, 1, 1), Material(name)),)),))
        for k, name in enumerate(ODD_NAMES)
    ]
    axis = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0))
    joints = tuple(Joint(n, JointType.REVOLUTE, "body", n, axis, JointLimits(0.0, 1.0)) for n in ODD_NAMES)
    odd = ArticulatedObject("a<&>\x01ü", "body", tuple(links), joints)
    model = compiled(export_mjcf(odd), tmp_path / "odd")
    names = ["a<&>\"'", "tür 1", "a/b", "Door", "door"]
    assert all(model.joint(name).name == name == model.body(name).name == model.material(name).name for name in names)
    assert [model.joint(k).name for k in (2, 4, 5)] == ["world", "x_y", "x_y_2"]
    assert model.body("world_2").id > 0


@pytest.mark.parametrize("scale", [0.1, 10.0])
def test_it_works_at_any_scale(cabinet, scale, tmp_path):
    other = scaled(cabinet, scale)
    model = compiled(export_mjcf(other), tmp_path / "scaled")
    require_poses(other, model, values_at(other, 0.7))
    data = at_keyframe(model, "closed")
    run(model, data, 2.0)
    assert np.abs(data.qpos).max() < 1e-3 * max(scale, 1.0)


def scaled(articulated: ArticulatedObject, scale: float) -> ArticulatedObject:
    T = np.diag([scale, scale, scale, 1.0])

    def joint(old: Joint) -> Joint:
        factor = scale if old.type is JointType.PRISMATIC else 1.0
        limits = JointLimits(old.limits.lower * factor, old.limits.upper * factor)
        return replace(old, axis=Axis(old.axis.point * scale, old.axis.direction), limits=limits)

    def visual(old: Visual) -> Visual:
        return replace(old, surfaces=tuple(surface.transformed(T) for surface in old.surfaces))

    links = tuple(Link(link.id, tuple(map(visual, link.visuals))) for link in articulated.links)
    return replace(articulated, links=links, joints=tuple(map(joint, articulated.joints)))


def test_the_same_object_gives_the_same_bytes(cabinet):
    assert export_mjcf(cabinet) == export_mjcf(make_cabinet())


@pytest.mark.parametrize("changes", [{"armature": -0.1}, {"servo_error": 0.0}])
def test_a_wrong_config_is_refused(changes):
    with pytest.raises(ValueError, match="`armature` must not be negative"):
        MjcfConfig(**changes)
