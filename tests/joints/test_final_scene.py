"""The scene that realization hands on: what stands and moves in the end, and how far."""

import numpy as np

from grafu.scene.front import front_of
from grafu.scene.scene import Scene
from judging import realized, realized_kind
from small_scenes import DOOR, SIDE, box, hinged, scene


def test_the_final_scene_says_how_every_joint_opens() -> None:
    result = realized_kind("drawers behind a pair")
    final = result.scene
    assert set(final.moving_bodies) == set(final.joint_motions) == {joint.child for joint in result.object.joints}
    for joint in result.object.joints:
        joint_motion = final.joint_motions[joint.child]
        assert joint_motion.is_built
        assert (joint_motion.type, joint_motion.upper, joint_motion.axis) == (
            joint.type,
            joint.limits.upper,
            joint.axis,
        )


def test_the_final_scene_holds_the_parts_as_they_are_built_and_all_hardware() -> None:
    result = realized_kind("inset door into the side")
    built = {v.name: v.mesh for link in result.object.links for v in link.visuals}
    final = result.scene
    for part in final.parts.values():
        np.testing.assert_array_equal(built[part.id].vertices, part.mesh.vertices)
    assert set(built) == {*final.parts, *(visual.name for _, visual in final.hardware)}


def test_what_got_no_joint_is_static_in_the_final_scene() -> None:
    far = box("door_far", (3.0, -0.02, 0.0), (3.4, 0.0, 0.6))
    joints = (hinged(), hinged("door_far", axis=hinged().axis.through(np.array([3.0, 0.0, 0.0]))))
    result = realized(scene(DOOR, SIDE, far, joints=joints))
    assert {skip.part for skip in result.report.skipped} == {"door_far"}
    assert set(result.scene.moving_bodies) == {"door"}
    assert "door_far" in {part.id for part in result.scene.static_parts}


def test_what_is_found_in_a_scene_is_found_once_and_anew_where_the_scene_changed() -> None:
    final = realized(scene(DOOR, SIDE, joints=(hinged(),))).scene
    asked: list[int] = []

    def doubled(of: Scene, number: int) -> int:
        asked.append(number)
        return 2 * number + len(of.parts)

    assert [final.once(doubled, n) for n in (1, 1, 3)] == [4, 4, 8]
    assert asked == [1, 3]
    grown = final.with_parts([box("far", (3.0, -0.02, 0.0), (3.4, 0.0, 0.6))])
    assert grown.once(doubled, 1) == 5
    assert front_of(final, "door") is front_of(final, "door")
    assert front_of(grown, "door") is not front_of(final, "door")
