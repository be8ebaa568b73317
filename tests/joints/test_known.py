"""What was worked out in one scene is found in another exactly where all that was read of it is the same."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grafu.articulation.articulated_object import Visual, VisualRole
from grafu.asset.part import Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.blocks import LARGE
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.joints.hinge.neighbours import neighbours_of
from grafu.joints.known import change_between, worked_out
from grafu.joints.limits import in_the_way
from grafu.processes.cache import NO_CACHE, Cache
from grafu.scene.reads import Noted, Noting, Read
from grafu.scene.scene import JointMotion, MovingBody, Scene
from grafu.scene.shapes import MOST_USES, Shapes
from grafu.vocabulary import JointType, PartLabel

SIDE = 0.1
STILL, MOVING = ("board", "side", "top"), ("door", "flap")


def cube(at) -> TriangleMesh:
    low = np.asarray(at, dtype=float)
    return TriangleMesh.box_mesh(Box(low, low + SIDE))


def part(name, at) -> Part:
    return Part(name, PartLabel.MISC, (Surface(cube(at)),), PartSource("", name))


def visual(name, at) -> Visual:
    return Visual(name, (Surface(cube(at)),), VisualRole.HARDWARE, PartLabel.MISC)


def motion(upper) -> JointMotion:
    return JointMotion(Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0)), JointType.REVOLUTE, upper)


def scene_of(places, uppers, hardware) -> Scene:
    names = [*STILL, "leaf", *MOVING]
    return Scene(
        {name: part(name, at) for name, at in zip(names, places, strict=True)},
        {name: MovingBody(name, (name,)) for name in ("leaf", *MOVING)},
        2.0,
        tuple((owner, visual(f"{owner or 'still'}_{k}", at)) for k, (owner, at) in enumerate(hardware)),
        {name: motion(upper) for name, upper in zip(MOVING, uppers, strict=True)},
    )


PLACE = st.tuples(*[st.sampled_from((0.0, 0.15, 0.3, 0.9))] * 3)
UPPER = st.sampled_from((0.2, 1.5))
HARDWARE = st.lists(st.tuples(st.sampled_from(("", "door", "flap")), PLACE), max_size=3)
SCENES = st.builds(
    scene_of, st.tuples(*[PLACE] * 3, st.just((0.0, 0.0, 0.0)), *[PLACE] * 2), st.tuples(UPPER, UPPER), HARDWARE
)
QUESTIONS = ("still", "mesh", "near", "bodies", "beside", "strikes", "named", "motion", "every part", "boards")


def asked(scene: Scene, questions) -> list:
    """Asks a scene some questions, each about a place, in the ways in which joints do."""
    found: list = []
    for question, at in questions:
        box, mesh = Box(np.asarray(at), np.asarray(at) + SIDE), cube(at)
        if question == "still":
            found.append([o.id for o in in_the_way(scene.still_obstacles.without(("top",)), box)])
        elif question == "mesh":
            found.append(scene.static_mesh_near(box, 0.05).vertices.tolist())
        elif question == "near":
            found.append(scene.is_near_static(mesh, 0.02, ("board", "side")))
        elif question == "bodies":
            met = in_the_way(scene.other_bodies("leaf"), box)
            found.append(sorted(o.id for o in met if o.collider.intersects(type(o.collider)(mesh))))
        elif question == "beside":
            found.append(scene.is_another_beside("leaf", box))
        elif question == "strikes":
            found.append(sorted(n.id for n in neighbours_of("leaf", scene, 1e-3) if n.runs_into(mesh)))
        elif question == "named":
            found.append(scene.parts["door"].mesh.box.low.tolist())
        elif question == "motion":
            found.append(scene.joint_motions["flap"].upper)
        elif question == "every part":
            found.append([one.mesh.box.low.tolist() for one in scene.parts.values()])
        else:
            found.append([one.id for one in scene.static_parts_near(box)])
    return found


@settings(max_examples=60, deadline=None)
@given(SCENES, SCENES, st.lists(st.tuples(st.sampled_from(QUESTIONS), PLACE), min_size=1, max_size=5))
def test_what_is_found_is_what_would_be_worked_out(one, other, questions):
    cache = Cache(50)
    for scene in (one, other, one):
        found = worked_out("answer", lambda noted: asked(noted, questions), "leaf", scene, cache, tuple(questions))
        assert found == asked(scene, questions)


PLAIN = scene_of(
    [(0.3, 0.0, 0.0), (0.9, 0.9, 0.9), (0.0, 0.0, 0.3), (0.0, 0.0, 0.0), (0.9, 0.0, 0.0), (0.0, 0.9, 0.0)],
    (0.2, 0.2),
    [("", (0.9, 0.9, 0.0))],
)
FAR = {
    "a part": PLAIN.replaced([part("side", (0.9, 0.9, 0.95))]),
    "hardware": replace(PLAIN, hardware=(("", visual("still_0", (0.95, 0.9, 0.0))),)),
    "a path": replace(PLAIN, joint_motions={**PLAIN.joint_motions, "flap": motion(0.3)}),
}
NEAR = {
    "a part": PLAIN.replaced([part("board", (0.25, 0.0, 0.0))]),
    "hardware": replace(PLAIN, hardware=(*PLAIN.hardware, ("", visual("still_1", (0.3, 0.0, 0.05))))),
    "another extent": replace(PLAIN, extent=3.0),
    "what it is": PLAIN.replaced([part("leaf", (0.0, 0.0, 0.05))]),
}


def made(scene, cache) -> int:
    before = cache.made.get("answer", 0)
    questions = (("still", (0.3, 0.0, 0.0)), ("strikes", (0.3, 0.0, 0.0)))
    worked_out("answer", lambda noted: asked(noted, questions), "leaf", scene, cache)
    return cache.made.get("answer", 0) - before


@pytest.mark.parametrize("what", FAR)
def test_what_lies_far_from_all_that_was_read_changes_nothing(what):
    cache = Cache(50)
    assert (made(PLAIN, cache), made(FAR[what], cache)) == (1, 0)


@pytest.mark.parametrize("what", NEAR)
def test_what_lies_near_is_worked_out_again_and_found_when_it_is_undone(what):
    cache = Cache(50)
    assert (made(PLAIN, cache), made(NEAR[what], cache), made(PLAIN, cache)) == (1, 1, 0)


def test_without_a_cache_nothing_is_noted():
    kinds = [worked_out("kind", lambda scene: type(scene.parts), "leaf", PLAIN, c) for c in (NO_CACHE, Cache(2))]
    assert kinds == [dict, Noted]


def test_who_reads_the_first_name_reads_that_and_who_goes_on_reads_all():
    noted = Noted(Read.PARTS, {"a": 1, "b": 2})
    with Noting() as reads:
        assert next(iter(noted)) == "a"
        assert noted["b"] == 2
        assert len(noted) == 2
    assert reads.counted == {Read.PARTS}
    assert (reads.names(Read.PARTS), reads.whole) == (("b",), set())
    with Noting() as reads:
        assert list(noted) == ["a", "b"]
    assert reads.whole == {Read.PARTS}


def test_shapes_live_on_until_they_are_large_or_many():
    shapes, meshes, axes = Shapes(), [cube((0.0, 0.0, 0.0)), cube((0.5, 0.0, 0.0))], np.eye(3)
    merged, body = shapes.as_one(meshes), shapes.body(meshes[0], 1e-3, axes)
    many = merge_meshes([cube((0.01 * k, 0.0, 0.0)) for k in range(LARGE // 12 + 1)])
    large = shapes.body(many, 1e-3, axes)
    shapes.tidy()
    assert shapes.as_one(meshes) is merged
    assert shapes.body(meshes[0], 1e-3, axes) is body
    assert shapes.body(many, 1e-3, axes) is not large
    for _ in range(MOST_USES):
        shapes.tidy()
    assert shapes.as_one(meshes) is not merged
    np.testing.assert_array_equal(shapes.as_one(meshes).vertices, merged.vertices)


def test_a_change_leads_from_one_scene_to_the_other():
    after = PLAIN.replaced([part("board", (0.5, 0.0, 0.0))]).with_joint(
        "leaf", motion(0.7), [visual("moves", (0.1, 0.0, 0.0))], [visual("stands", (0.2, 0.0, 0.0))]
    )
    change = change_between(PLAIN, after)
    assert set(change.parts) == {"board"}
    again = change.of(PLAIN)
    assert (again.parts, again.hardware, again.joint_motions) == (after.parts, after.hardware, after.joint_motions)
    elsewhere = change.of(FAR["a part"])
    assert elsewhere.parts["side"] == FAR["a part"].parts["side"]
    assert elsewhere.parts["board"] == after.parts["board"]


def test_a_joint_changes_the_box_of_its_own_body_alone() -> None:
    before = {name: PLAIN.body_box(name) for name in ("leaf", *MOVING)}
    after = PLAIN.with_joint(
        "leaf", motion(0.7), [visual("moves", (1.5, 0.0, 0.0))], [visual("stands", (0.2, 0.0, 0.0))]
    )

    assert after.body_box("leaf") == before["leaf"].union(cube((1.5, 0.0, 0.0)).box)
    for name in MOVING:
        assert after.body_box(name) is before[name]
    door = PLAIN.replaced([part("door", (0.5, 0.0, 0.0))])
    assert door.body_box("door") == cube((0.5, 0.0, 0.0)).box


EVERY_BODY = [("bodies", (x, 0.0, 0.0)) for x in (0.0, 0.3, 0.5, 0.9, 1.5)]
EVERY_BODY += [(kind, at) for kind in ("beside", "still") for _, at in EVERY_BODY[:5]]


@settings(max_examples=60, deadline=None)
@given(SCENES, st.lists(st.tuples(st.sampled_from(("leaf", *MOVING, *STILL)), PLACE), min_size=1, max_size=3))
def test_a_changed_scene_finds_what_one_made_anew_finds(scene, changes):
    for number, (name, at) in enumerate(changes):
        asked(scene, EVERY_BODY)  # now it knows all that it keeps
        if name in STILL or number % 2:
            scene = scene.replaced([part(name, at)])
        else:
            scene = scene.with_joint(name, motion(0.7), [visual(f"moves {number}", at)], [visual("stands", at)])
    anew = Scene(scene.parts, scene.moving_bodies, scene.extent, scene.hardware, scene.joint_motions, scene.behind)
    assert asked(scene, EVERY_BODY) == asked(anew, EVERY_BODY)
    assert (scene.floor, scene.metre, scene.moving_ids) == (anew.floor, anew.metre, anew.moving_ids)


def test_what_stays_is_prepared_once_for_all_scenes() -> None:
    others, still = PLAIN.other_bodies("leaf"), PLAIN.static_obstacles
    after = PLAIN.with_joint("leaf", motion(0.7), [visual("moves", (1.5, 0.0, 0.0))], [])
    assert [one is other for one, other in zip(others, after.other_bodies("leaf"), strict=True)] == [True, True]
    assert [o is known for o, known in zip(after.static_obstacles, still, strict=True)] == [True] * len(STILL)
    moved = after.replaced([part("door", (0.5, 0.0, 0.0)), part("top", (0.0, 0.5, 0.0))])
    met = {o.id: o.collider.box for o in (*moved.other_bodies("leaf"), *moved.static_obstacles)}
    assert (met["door"], met["top"]) == (cube((0.5, 0.0, 0.0)).box, cube((0.0, 0.5, 0.0)).box)
    assert moved.other_bodies("leaf")[1] is others[1]
