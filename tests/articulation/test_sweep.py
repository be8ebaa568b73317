from dataclasses import replace

import numpy as np
import pytest

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link
from grafu.articulation.kinematics import moved_poses
from grafu.articulation.sweep import (
    all_open,
    cycle_frames,
    cycle_tracks,
    moved_to_full,
    opening_stages,
    rest_to_full,
    values_at,
    values_before,
)
from grafu.errors import ArticulationError
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.vocabulary import JointType


def joint(name: str, upper: float, after: tuple[str, ...] = (), kind: JointType = JointType.PRISMATIC) -> Joint:
    return Joint(
        name, kind, "body", f"{name}_link", Axis(np.zeros(3), vec3(0.0, -1.0, 0.0)), JointLimits(0.0, upper), after
    )


def made(*joints: Joint) -> ArticulatedObject:
    return ArticulatedObject("made", "body", (Link("body", ()), *(Link(j.child, ()) for j in joints)), joints)


BEHIND_DOORS = made(
    joint("drawer", 0.4, ("left", "right")), joint("left", 1.5), joint("right", 1.6), joint("tray", 0.2, ("drawer",))
)


def test_doors_open_before_what_is_behind_them():
    assert opening_stages(BEHIND_DOORS) == (("left", "right"), ("drawer",), ("tray",))


def test_a_fixed_joint_does_not_move():
    assert opening_stages(made(joint("a", 0.0, kind=JointType.FIXED))) == ()


def test_rest_to_full_keeps_what_is_in_front_open():
    frames = rest_to_full(BEHIND_DOORS, "drawer", 5)

    assert [f["drawer"] for f in frames] == pytest.approx([0, 0.1, 0.2, 0.3, 0.4])
    assert all((f["left"], f["right"], f["tray"]) == (1.5, 1.6, 0) for f in frames)


def test_waiting_is_transitive():
    assert values_before(BEHIND_DOORS, "tray") == {"drawer": 0.4, "left": 1.5, "right": 1.6, "tray": 0}


def test_the_cycle_never_moves_a_drawer_behind_a_closed_door():
    tracks = cycle_tracks(BEHIND_DOORS)
    end = float(tracks[0].times[-1])

    for time in np.linspace(0, end, 301):
        values = values_at(tracks, float(time))
        if values["drawer"] > 0:
            assert values["left"] == pytest.approx(1.5)
        if values["tray"] > 0:
            assert values["drawer"] == pytest.approx(0.4)


def test_the_cycle_closes_opens_and_closes():
    tracks = cycle_tracks(BEHIND_DOORS)
    end = float(tracks[0].times[-1])

    assert values_at(tracks, 0.0) == values_at(tracks, end) == dict.fromkeys(all_open(BEHIND_DOORS), 0)
    assert values_at(tracks, end / 2) == pytest.approx(all_open(BEHIND_DOORS))
    assert all(track.times[0] == 0 and track.times[-1] == end for track in tracks)


def test_cycle_frames_start_and_end_closed():
    frames = cycle_frames(BEHIND_DOORS, 9)

    assert len(frames) == 9
    assert frames[4] == pytest.approx(all_open(BEHIND_DOORS))


def test_nothing_moves_in_an_object_without_joints():
    assert cycle_tracks(made()) == ()
    assert cycle_frames(made(), 3) == [{}, {}, {}]


def test_waiting_in_a_circle_is_refused():
    with pytest.raises(ArticulationError, match=r"wait for one another.*'a', 'b'"):
        opening_stages(made(joint("a", 1.0, ("b",)), joint("b", 1.0, ("a",))))


def test_the_poses_of_what_moves_are_those_of_all_frames():
    for joint_id in ("tray", "left", "drawer"):
        frames = [moved_poses(BEHIND_DOORS, values) for values in rest_to_full(BEHIND_DOORS, joint_id, 5)]
        found = moved_to_full(BEHIND_DOORS, joint_id, 5)
        assert [list(poses) for poses in found] == [list(poses) for poses in frames]
        assert all(
            np.array_equal(T, poses[link]) for poses, at in zip(found, frames, strict=True) for link, T in at.items()
        )


def test_waiting_for_nobody_is_refused():
    with pytest.raises(ArticulationError, match="ghost"):
        rest_to_full(made(joint("a", 1.0, ("ghost",))), "a")


def test_a_joint_that_is_not_there_is_refused():
    with pytest.raises(ArticulationError, match="`lid` is not a moving joint"):
        rest_to_full(BEHIND_DOORS, "lid")


def test_a_track_needs_increasing_times():
    track = cycle_tracks(BEHIND_DOORS)[0]

    with pytest.raises(ValueError, match="increasing"):
        replace(track, times=track.times[::-1])
