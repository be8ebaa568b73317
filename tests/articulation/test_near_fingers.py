"""Rays that ask for the room of fingers meet what lies near alone, and find what they would find among all surfaces."""

import numpy as np
import pytest

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.articulation.finger_fit import Facing
from grafu.articulation.grasp_search import GraspHint, with_grasps
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.geometry.transform import from_rotation, rotation_matrix
from grafu.vocabulary import JointType, PartLabel

UP = vec3(0.0, 0.0, 1.0)


def among_boards(seed: int) -> ArticulatedObject:
    """A drawer that stands askew, with a bar, among boards that lie anywhere around it."""
    rng = np.random.default_rng(seed)
    T = from_rotation(rotation_matrix(UP, float(rng.uniform(-0.7, 0.7))), rng.normal(size=3))

    def board(center: np.ndarray, size: np.ndarray) -> TriangleMesh:
        return TriangleMesh.box_mesh(Box.from_center(center, size / 2)).transformed(T)

    front = board(vec3(0.0, 0.0, 0.3), vec3(0.5, 0.02, 0.2))
    bar = board(vec3(0.0, -0.02 - float(rng.uniform(0.015, 0.04)), 0.3), vec3(0.16, 0.01, 0.01))
    others = [board(rng.uniform(-0.1, 0.1, 3) + vec3(0.0, -0.03, 0.3), rng.uniform(0.005, 0.06, 3)) for _ in range(8)]
    body = tuple(Visual(f"board_{k}", (Surface(mesh),)) for k, mesh in enumerate(others))
    handle = Visual("grip", (Surface(bar),), label=PartLabel.HANDLE)
    drawer = Link("drawer", (Visual("front", (Surface(front),), label=PartLabel.DRAWER), handle))
    axis = Axis(T[:3, 3], T[:3, :3] @ vec3(0.0, -1.0, 0.0))
    joint = Joint("j", JointType.PRISMATIC, "body", "drawer", axis, JointLimits(0.0, 0.4))
    return ArticulatedObject("o", "body", (Link("body", body), drawer), (joint,))


@pytest.mark.parametrize("kind", ["handle", "edge", "itself"])
def test_grasps_are_those_among_all_surfaces(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    objects = [among_boards(seed) for seed in range(12)]
    hints = {"drawer": GraspHint(kind, "" if kind == "itself" else "grip")}  # type: ignore[arg-type]
    prepared: list[int] = []
    near = Facing.near

    def counted(self: Facing, box: Box) -> RayCaster:
        prepared.append(1)
        return near(self, box)

    monkeypatch.setattr(Facing, "near", counted)
    found = [with_grasps(one, hints).grasps for one in objects]
    monkeypatch.setattr(Facing, "near", lambda self, _: self.caster)

    assert prepared
    assert found == [with_grasps(one, hints).grasps for one in objects]
    assert len({grasp.depth for [grasp] in found}) > 2
