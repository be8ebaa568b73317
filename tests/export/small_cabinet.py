"""A small cabinet made of boards: a door in front of a drawer, hinge and handle, materials of every kind."""

from io import BytesIO

import numpy as np
from PIL import Image

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual, VisualRole
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import JointType, PartLabel


def board(*bounds: float) -> TriangleMesh:
    x0, y0, z0, x1, y1, z1 = map(float, bounds)
    return TriangleMesh.box_mesh(Box(vec3(x0, y0, z0), vec3(x1, y1, z1)))


def png(color: tuple[int, int, int], size: int = 4) -> bytes:
    stream = BytesIO()
    Image.new("RGB", (size, size), color).save(stream, "PNG")
    return stream.getvalue()


WOOD = Material("oak", (1.0, 1.0, 1.0, 1.0), base_color_texture=Texture("oak", png((160, 110, 60)), "image/png"))
PAINT = Material("white paint", (0.9, 0.9, 0.88, 1.0), roughness=0.4)
STEEL = Material("steel", (0.6, 0.6, 0.62, 1.0), metallic=1.0, roughness=0.3, double_sided=True)
GLASS = Material("glass", (0.8, 0.9, 1.0, 0.3), alpha_mode="BLEND")


def surface(mesh: TriangleMesh, material: Material, uv: bool = False) -> Surface:
    return Surface(mesh, material, mesh.vertices[:, [0, 2]] * 2.0 if uv else None)


def part(name: str, mesh: TriangleMesh, material: Material, label: PartLabel) -> Visual:
    return Visual(name, (surface(mesh, material, uv=material is WOOD),), VisualRole.PART, label)


def carcass() -> tuple[Visual, ...]:
    return (
        part("side_left", board(-0.3, -0.2, 0, -0.282, 0.2, 0.8), WOOD, PartLabel.SIDE_PANEL),
        part("side_right", board(0.282, -0.2, 0, 0.3, 0.2, 0.8), WOOD, PartLabel.SIDE_PANEL),
        part("top", board(-0.282, -0.2, 0.782, 0.282, 0.2, 0.8), WOOD, PartLabel.TOP_PANEL),
        part("bottom", board(-0.282, -0.2, 0, 0.282, 0.2, 0.018), WOOD, PartLabel.BOTTOM_PANEL),
        part("back", board(-0.282, 0.194, 0.018, 0.282, 0.2, 0.782), PAINT, PartLabel.BACK_PANEL),
    )


def door_link() -> Link:
    glazed = Visual(
        "door_1",
        (
            surface(board(-0.3, -0.22, 0, 0.3, -0.2, 0.6), WOOD, uv=True),
            surface(board(-0.3, -0.22, 0.6, 0.3, -0.2, 0.8), GLASS),
        ),
        VisualRole.PART,
        PartLabel.DOOR,
    )
    leaf = Visual(
        "hinge_door_1_0", (surface(board(-0.305, -0.225, 0.1, -0.3, -0.2, 0.16), STEEL),), VisualRole.HARDWARE
    )
    handle = part("handle_1", board(0.24, -0.25, 0.35, 0.26, -0.22, 0.45), STEEL, PartLabel.HANDLE)
    return Link("door_1", (glazed, handle, leaf))


def drawer_link() -> Link:
    boards = {
        "front": (-0.27, -0.19, 0.1, 0.27, -0.172, 0.3),
        "left": (-0.27, -0.172, 0.1, -0.255, 0.15, 0.3),
        "right": (0.255, -0.172, 0.1, 0.27, 0.15, 0.3),
        "rear": (-0.255, 0.135, 0.1, 0.255, 0.15, 0.3),
        "floor": (-0.255, -0.172, 0.1, 0.255, 0.135, 0.11),
    }
    surfaces = tuple(surface(board(*bounds), PAINT) for bounds in boards.values())
    return Link("drawer_1", (Visual("drawer_1", surfaces, VisualRole.PART, PartLabel.DRAWER),))


def make_cabinet() -> ArticulatedObject:
    hinge = Axis(vec3(-0.3, -0.22, 0.0), vec3(0.0, 0.0, -1.0))
    slide = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0))
    joints = (
        Joint("door_1_hinge", JointType.REVOLUTE, "body", "door_1", hinge, JointLimits(0.0, 1.75)),
        Joint(
            "drawer_1_rail", JointType.PRISMATIC, "body", "drawer_1", slide, JointLimits(0.0, 0.28), ("door_1_hinge",)
        ),
    )
    return ArticulatedObject("cabinet", "body", (Link("body", carcass()), door_link(), drawer_link()), joints)


def painted_cube(**changes) -> ArticulatedObject:
    """One static cube whose only surface has the attributes given in `changes`."""
    mesh = changes.pop("mesh", board(-0.5, -0.5, 0, 0.5, 0.5, 1))
    made = Surface(mesh, **changes)
    return ArticulatedObject("cube", "body", (Link("body", (Visual("cube", (made,)),)),))


def doubled_sheet() -> TriangleMesh:
    faces = np.array([[0, 1, 2], [0, 2, 3], [2, 1, 0], [3, 2, 0], [1, 1, 2]])
    return TriangleMesh(np.array([[0.0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]]), faces)
