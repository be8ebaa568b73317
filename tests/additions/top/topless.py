"""Cabinets of boards with and without tops, where it can be said beforehand what must come out."""

from math import radians

from grafu.asset.part import Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.joints.plan import JointRequest
from grafu.vocabulary import JointType, PartLabel

Point = tuple[float, float, float]
W, D, H, T = 0.8, 0.5, 0.8, 0.018


def board(name: str, low: Point, high: Point, label: PartLabel = PartLabel.UNKNOWN) -> Part:
    return merged(name, (low, high), label=label)


def merged(name: str, *spans: tuple[Point, Point], label: PartLabel = PartLabel.UNKNOWN) -> Part:
    meshes = [TriangleMesh.box_mesh(Box(vec3(*low), vec3(*high))) for low, high in spans]
    return Part(name, label, (Surface(merge_meshes(meshes)),), PartSource(name), "none")


def carcass(width: float = W, depth: float = D, height: float = H, x: float = 0.0) -> list[Part]:
    """Sides, back, bottom, and a door as still front: open at the top."""
    a, b, y = x - width / 2, x + width / 2, depth / 2
    return [
        board(f"side_left_{x}", (a, -y, 0.0), (a + T, y, height)),
        board(f"side_right_{x}", (b - T, -y, 0.0), (b, y, height)),
        board(f"back_{x}", (a + T, y - T, 0.0), (b - T, y, height)),
        board(f"bottom_{x}", (a + T, -y, 0.1), (b - T, y - T, 0.1 + T)),
    ]


def front(height: float = H, name: str = "door") -> Part:
    return board(name, (-W / 2, -D / 2 - T, 0.1), (W / 2, -D / 2, height), PartLabel.DOOR)


def swing(name: str = "door") -> JointRequest:
    axis = Axis(vec3(-W / 2, -D / 2, 0.0), vec3(0.0, 0.0, -1.0))
    return JointRequest(name, JointType.REVOLUTE, axis, "test", radians(90))


def lift(name: str = "door", height: float = H) -> JointRequest:
    axis = Axis(vec3(0.0, -D / 2, height), vec3(-1.0, 0.0, 0.0))
    return JointRequest(name, JointType.REVOLUTE, axis, "test", radians(90))


def slide(name: str = "drawer") -> JointRequest:
    return JointRequest(name, JointType.PRISMATIC, Axis(vec3(0.0, 0.0, 0.5), vec3(0.0, -1.0, 0.0)), "test", 0.3)


def drawer(height: float = H - 0.01, solid: bool = False) -> Part:
    """A drawer of 0.15 m with a front, four walls and a bottom, or as a block, in the carcass."""
    a, b, y0, y1, low = -W / 2 + T + 0.012, W / 2 - T - 0.012, -D / 2, D / 2 - 0.05, height - 0.15
    if solid:
        return merged("drawer", ((a, y0, low), (b, y1, height)), label=PartLabel.DRAWER)
    t = 0.012
    return merged(
        "drawer",
        ((-W / 2, y0 - T, low), (W / 2, y0, height)),
        ((a, y0, low), (b, y1, low + t)),
        ((a, y0, low), (a + t, y1, height)),
        ((b - t, y0, low), (b, y1, height)),
        ((a, y1 - t, low), (b, y1, height)),
        label=PartLabel.DRAWER,
    )


def top(low: float = H, thickness: float = 0.03, label: PartLabel = PartLabel.UNKNOWN) -> Part:
    return board("lid", (-W / 2 - 0.01, -D / 2 - 0.03, low), (W / 2 + 0.01, D / 2, low + thickness), label)


def holed_top(part: float) -> Part:
    """A worktop with a hole that takes this fraction of each side in its middle."""
    x, y, a, b = W / 2, D / 2, part * W / 2, part * D / 2
    spans = [((-x, -y), (x, -b)), ((-x, b), (x, y)), ((-x, -b), (-a, b)), ((a, -b), (x, b))]
    return merged("worktop", *(((p[0], p[1], H), (q[0], q[1], H + 0.03)) for p, q in spans))


def basin(rim: float = H) -> Part:
    x, y, low, t = 0.25, 0.16, rim - 0.15, 0.003
    return merged(
        "basin",
        ((-x, -y, low), (x, y, low + t)),
        ((-x, -y, low), (-x + t, y, rim)),
        ((x - t, -y, low), (x, y, rim)),
        ((-x, -y, low), (x, -y + t, rim)),
        ((-x, y - t, low), (x, y, rim)),
    )
