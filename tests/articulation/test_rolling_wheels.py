"""A chest on casters stays where it is: its wheels stand on flats, and friction grows with what they carry."""

from dataclasses import replace
from math import pi

import mujoco
import numpy as np
import pytest

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.articulation.collision_shapes import corners_of
from grafu.articulation.counterbalance import GRAVITY
from grafu.articulation.physics import PhysicsConfig, PhysicsModel, physics_of
from grafu.articulation.rolling_wheels import RollingConfig
from grafu.export.files import write_files
from grafu.export.formats import export
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Points, Vec3, vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.solids import ConvexSolid
from grafu.vocabulary import JointType, PartLabel

RADIUS, SIDES = 0.05, 24
PLACES = [(x, y) for x in (-0.35, 0.35) for y in (-0.15, 0.15)]


def link(name: str, mesh: TriangleMesh, label: PartLabel = PartLabel.UNKNOWN) -> Link:
    return Link(name, (Visual(name, (Surface(mesh),), label=label),))


def block(low: tuple[float, float, float], high: tuple[float, float, float]) -> TriangleMesh:
    return TriangleMesh.box_mesh(Box(vec3(*low), vec3(*high)))


def wheel(middle: Vec3) -> TriangleMesh:
    """A prism about x that stands on a corner."""
    angles = 2 * pi * np.arange(SIDES) / SIDES
    ring = np.column_stack([np.zeros(SIDES), RADIUS * np.sin(angles), -RADIUS * np.cos(angles)])
    points: Points = np.vstack([ring + vec3(-0.012, 0.0, 0.0), ring + vec3(0.012, 0.0, 0.0)]) + middle
    solid = ConvexSolid.around(points)
    assert solid is not None
    return TriangleMesh(solid.vertices, solid.faces)


def cart(legs: bool = False) -> ArticulatedObject:
    """A chest with a drawer on four casters; with `legs` it stands on a plinth, and the wheels only touch the floor."""
    case = [block((-0.4, -0.2, 0.13), (0.4, 0.2, 0.4)), *([block((-0.2, -0.2, 0.0), (0.2, 0.2, 0.13))] if legs else ())]
    links = [link("case", merge_meshes(case))]
    links.append(link("drawer", block((-0.38, -0.24, 0.42), (0.38, -0.2, 0.6)), PartLabel.DRAWER))
    slide = Axis(vec3(0.0, 0.0, 0.5), vec3(0.0, -1.0, 0.0))
    joints = [Joint("slide", JointType.PRISMATIC, "case", "drawer", slide, JointLimits(0.0, 0.3))]
    endless = JointLimits(0.0, 2 * pi)
    for k, (x, y) in enumerate(PLACES):
        middle = vec3(x, y, RADIUS)
        links.append(link(f"fork_{k}", block((x - 0.02, y - 0.02, 0.105), (x + 0.02, y + 0.02, 0.128))))
        links.append(link(f"wheel_{k}", wheel(middle)))
        up, across = Axis(middle, vec3(0.0, 0.0, 1.0)), Axis(middle, vec3(1.0, 0.0, 0.0))
        joints.append(Joint(f"swivel_{k}", JointType.CONTINUOUS, "case", f"fork_{k}", up, endless))
        joints.append(Joint(f"roll_{k}", JointType.CONTINUOUS, f"fork_{k}", f"wheel_{k}", across, endless))
    return ArticulatedObject("cart", "case", tuple(links), tuple(joints))


def turned(made: ArticulatedObject, angle: float) -> ArticulatedObject:
    """The same with wheels whose corners are turned about their axles."""
    c, s = np.cos(angle), np.sin(angle)
    R = np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    links = []
    for one in made.links:
        if one.id.startswith("wheel"):
            middle = one.mesh.box.center
            one = link(one.id, TriangleMesh((one.mesh.vertices - middle) @ R.T + middle, one.mesh.faces))
        links.append(one)
    return replace(made, links=tuple(links))


def lowest(physics: PhysicsModel, name: str) -> Points:
    points = np.vstack([corners_of(shape) for shape in physics.shapes[name]])
    return points[points[:, 2] < points[:, 2].min() + 1e-6]


def test_friction_of_a_wheel_and_its_swivel_grows_by_a_part_of_what_the_wheel_carries():
    made = cart()
    config, without = PhysicsConfig(), PhysicsConfig(rolling=RollingConfig(resistance=1e-9))
    loaded, plain = physics_of(made, config), physics_of(made, without)
    load = GRAVITY * sum(held.mass for held in loaded.masses.values()) / 4
    for k in range(4):
        for name in (f"roll_{k}", f"swivel_{k}"):
            more = loaded.dynamics[name].friction - plain.dynamics[name].friction
            assert more == pytest.approx(config.rolling.resistance * load * RADIUS, rel=0.03)
            assert loaded.dynamics[name].effort > 5 * loaded.dynamics[name].friction
    assert loaded.dynamics["slide"] == plain.dynamics["slide"]


def test_wheels_of_a_piece_that_stands_on_its_own_feet_turn_easily():
    loaded = physics_of(cart(legs=True))
    plain = physics_of(cart(legs=True), PhysicsConfig(rolling=RollingConfig(resistance=1e-9)))
    assert loaded.dynamics["roll_0"].friction == pytest.approx(plain.dynamics["roll_0"].friction)
    assert loaded.dynamics["roll_0"].friction < 0.1


@pytest.mark.parametrize("angle", [0.0, pi / SIDES, 0.04])
def test_a_wheel_stands_on_a_flat_however_its_corners_lie(angle):
    flat = lowest(physics_of(turned(cart(), angle)), "wheel_0")
    assert float(np.ptp(flat[:, 1])) > 0.006
    assert flat[:, 1].min() < PLACES[0][1] - 0.002
    assert flat[:, 1].max() > PLACES[0][1] + 0.002


@pytest.mark.parametrize(("kind", "file"), [("urdf", "model.urdf"), ("mjcf", "model.xml")])
def test_the_piece_stays_where_it_is_at_rest_and_while_its_drawer_is_pulled(kind, file, tmp_path):
    write_files(export(cart(), [kind]), tmp_path / "out")
    spec = mujoco.MjSpec.from_file(str(tmp_path / "out" / file))
    spec.worldbody.first_body().add_freejoint()
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[5, 5, 0.1], friction=[0.5, 0.005, 0.0001])
    model = spec.compile()
    data = mujoco.MjData(model)
    wheels = [model.joint(f"roll_{k}").qposadr[0] for k in range(4)]

    mujoco.mj_step(model, data, 1000)
    assert np.abs(data.qpos[wheels]).max() < 0.01

    slide = model.joint("slide").qposadr[0]
    data.xfrc_applied[model.body("drawer").id, 1] = -12.0
    for _ in range(1000):
        mujoco.mj_step(model, data)
        if data.qpos[slide] > 0.2:
            break
    assert data.qpos[slide] > 0.2
    assert RADIUS * np.abs(data.qpos[wheels]).max() < 0.002


def test_a_config_refuses_what_is_no_fraction():
    with pytest.raises(ValueError, match="resistance"):
        RollingConfig(resistance=2.0)
