import pytest

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.articulation.collision_shapes import CollisionShape, collision_shapes
from grafu.articulation.open_together import met_at_rest, open_together
from grafu.errors import ArticulationError
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import JointType

TO_THE_LEFT, TO_THE_RIGHT = vec3(0.0, 0.0, -1.0), vec3(0.0, 0.0, 1.0)


def leaf(name: str, left: float, right: float) -> Link:
    mesh = TriangleMesh.box_mesh(Box(vec3(left, -0.02, 0.0), vec3(right, 0.0, 0.8)))
    return Link(name, (Visual(name, (Surface(mesh),)),))


def two_doors(gap: float, upper: float, after: tuple[str, ...] = ()) -> ArticulatedObject:
    """Two doors hinged on one post between them, `gap` metres wide: past 90 degrees they come near one another."""
    half = gap / 2
    doors = (leaf("a", -half - 0.4, -half), leaf("b", half, half + 0.4))
    axes = (Axis(vec3(-half, -0.02, 0.0), TO_THE_RIGHT), Axis(vec3(half, -0.02, 0.0), TO_THE_LEFT))
    joints = tuple(
        Joint(f"{door.id}_hinge", JointType.REVOLUTE, "body", door.id, axis, JointLimits(0.0, upper), waits)
        for door, axis, waits in zip(doors, axes, (after, ()), strict=True)
    )
    return ArticulatedObject("doors", "body", (Link("body", ()), *doors), joints)


def opened(furniture: ArticulatedObject) -> dict[str, float]:
    return open_together(furniture, shapes_of(furniture))


def shapes_of(furniture: ArticulatedObject) -> dict[str, tuple[CollisionShape, ...]]:
    return {link.id: collision_shapes(link) for link in furniture.links}


def test_what_has_room_opens_fully():
    assert opened(two_doors(0.1, 1.5)) == {"a_hinge": 1.5, "b_hinge": 1.5}


def test_who_comes_later_gives_way():
    found = opened(two_doors(0.1, 2.0))
    assert found["a_hinge"] == 2.0
    assert 0.5 < found["b_hinge"] < 2.0


def test_who_waits_comes_later():
    found = opened(two_doors(0.1, 2.0, after=("b_hinge",)))
    assert found["b_hinge"] == 2.0
    assert 0.5 < found["a_hinge"] < 2.0


def test_without_shapes_nothing_is_in_the_way():
    furniture = two_doors(0.1, 2.0)
    assert open_together(furniture, {}) == {"a_hinge": 2.0, "b_hinge": 2.0}


def test_what_meets_at_rest_is_named_and_does_not_hinder():
    furniture = two_doors(0.1, 1.5)
    shapes = shapes_of(furniture)
    shapes["b"] = shapes["a"]
    assert met_at_rest(furniture, shapes_of(furniture)) == ()
    assert met_at_rest(furniture, shapes) == (("a", "b"),)
    assert set(open_together(furniture, shapes).values()) == {1.5}


def test_joints_that_wait_for_one_another_are_refused():
    a, b = two_doors(0.1, 1.0).joints
    waiting = tuple(
        Joint(j.id, j.type, j.parent, j.child, j.axis, j.limits, (other.id,)) for j, other in ((a, b), (b, a))
    )
    furniture = two_doors(0.1, 1.0)
    circular = ArticulatedObject(furniture.name, "body", furniture.links, waiting)
    with pytest.raises(ArticulationError, match="must not wait"):
        open_together(circular, {"a": (), "b": ()})
