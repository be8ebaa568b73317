"""Which joint moves when: one joint from rest to full, and the cycle that opens and closes everything.

A joint moves only while the joints named in its `after` are fully open: doors first, then the drawers behind them.
"""

from collections.abc import Mapping
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.articulation.kinematics import moved_poses, with_coupled
from grafu.dataclass import dataclass
from grafu.errors import ArticulationError
from grafu.geometry.arrays import ArrayValue, Mat4, Scalars, frozen_array

JointValues = dict[str, float]


@final
@dataclass(frozen=True, eq=False, slots=True)
class JointTrack(ArrayValue):
    """The values (radians or metres) that one joint passes through at increasing `times` (seconds)."""

    joint: str
    times: Scalars
    values: Scalars

    def __post_init__(self) -> None:
        times, values = frozen_array(self.times), frozen_array(self.values)
        if len(times) != len(values) or not np.all(np.diff(times) > 0):
            raise ValueError(f"`JointTrack` needs increasing times, one per value: got {len(times)} and {len(values)}")
        object.__setattr__(self, "times", times)
        object.__setattr__(self, "values", values)


def opening_stages(articulated: ArticulatedObject) -> tuple[tuple[str, ...], ...]:
    """Returns the moving joints in the order in which they may open; those of one stage open together.

    Raises:
        ArticulationError: if an `after` names a joint that is not there, or two joints wait for one another.
    """
    joints = {joint.id: joint for joint in articulated.moving_joints}
    unknown = sorted({other for joint in joints.values() for other in joint.after} - set(joints))
    if unknown:
        raise ArticulationError(f"`after` must name moving joints of `{articulated.name}`: got {unknown}")
    waiting = {joint.id: set(articulated.leader_of(joint).after) for joint in joints.values()}
    stages: list[tuple[str, ...]] = []
    opened: set[str] = set()
    while len(opened) < len(waiting):
        free = tuple(joint for joint, after in waiting.items() if joint not in opened and after <= opened)
        if not free:
            raise ArticulationError(f"joints must not wait for one another: {sorted(set(waiting) - opened)} do")
        stages.append(free)
        opened.update(free)
    return tuple(stages)


def values_before(articulated: ArticulatedObject, joint_id: str) -> JointValues:
    """Returns the values in which a joint may start: every joint it waits for fully open, all others at rest.

    Raises:
        ArticulationError: if the joint is not a moving joint, or waits for others and the order cannot be kept.
    """
    joint = _moving_joint(articulated, joint_id)
    leader = articulated.leader_of(joint)
    if leader.after:  # few wait for others, and who does not can start
        opening_stages(articulated)
    joints = {joint.id: joint for joint in articulated.moving_joints}
    values = {joint.id: joint.limits.lower for joint in articulated.free_joints}
    queue = list(leader.after)
    while queue:
        other = articulated.leader_of(joints[queue.pop()])
        values[other.id] = other.limits.upper
        queue += other.after
    return with_coupled(articulated, values)


def rest_to_full(
    articulated: ArticulatedObject, joint_id: str, count: int = 50, crowding: float = 1.0
) -> list[JointValues]:
    """Returns `count` frames of all joint values in which one moving joint goes from rest to full.

    They are evenly spaced, or closer to one another near rest where `crowding` is above 1 (see `ratios_of_range`).

    Joints that it waits for (`after`) are fully open throughout; all others rest. What is coupled moves together: where
    the joint follows another, that one goes from rest to full. The default is the paper's number of poses.
    """
    leader = articulated.leader_of(_moving_joint(articulated, joint_id))
    before = values_before(articulated, joint_id)
    start = {joint.id: before[joint.id] for joint in articulated.free_joints}
    steps = leader.limits.lower + leader.limits.range * ratios_of_range(count, crowding)
    return [with_coupled(articulated, {**start, leader.id: float(value)}) for value in steps]


def moved_to_full(articulated: ArticulatedObject, joint_id: str, count: int) -> list[dict[str, Mat4]]:
    """Returns the poses of what moves (`moved_poses`) in the frames of `rest_to_full`, for as little as one joint."""
    leader = articulated.leader_of(_moving_joint(articulated, joint_id))
    start = {name: value for name, value in values_before(articulated, joint_id).items() if value != 0.0}
    free = {name: value for name, value in start.items() if name not in articulated.couplings}
    steps = leader.limits.lower + leader.limits.range * ratios_of_range(count, 1.0)
    return [moved_poses(articulated, {**free, leader.id: float(value)}) for value in steps]


def ratios_of_range(count: int, crowding: float = 1.0) -> Scalars:
    """Returns `count` ratios (0 to 1) of the range, from rest to full: even steps to the power of `crowding`."""
    return np.linspace(0.0, 1.0, count) ** crowding


def all_open(articulated: ArticulatedObject) -> JointValues:
    """Returns every free joint at its upper limit, and the coupled ones where that puts them."""
    return with_coupled(articulated, {joint.id: joint.limits.upper for joint in articulated.free_joints})


def cycle_tracks(
    articulated: ArticulatedObject, stage_seconds: float = 1.5, pause: float = 0.5, steps: int = 16
) -> tuple[JointTrack, ...]:
    """Returns one track per moving joint: closed, open in order, a pause, closed again in reverse order.

    Each stage takes `stage_seconds` with a soft start and stop, sampled at `steps` + 1 keys. All tracks span the whole
    cycle, which starts at 0 s; `pause` must be positive.
    """
    stages = opening_stages(articulated)
    whole = 2 * len(stages) * stage_seconds + pause
    joints = {joint.id: joint for joint in articulated.moving_joints}
    tracks: list[JointTrack] = []
    for index, stage in enumerate(stages):
        times, ratios = _cycle_keys(index * stage_seconds, stage_seconds, whole, steps)
        tracks += [JointTrack(name, times, _scaled(joints[name], _ratios(joints, name, ratios))) for name in stage]
    return tuple(tracks)


def opening_tracks(
    articulated: ArticulatedObject, joint_id: str, seconds: float = 1.5, steps: int = 16
) -> tuple[JointTrack, ...]:
    """Returns the tracks of one joint that opens from rest to full, and of those that are coupled with it.

    It has a soft start and stop, sampled at `steps` + 1 keys from 0 s. Joints that it waits for do not move.

    Raises:
        ArticulationError: if the joint is not a moving joint.
    """
    leader = articulated.leader_of(_moving_joint(articulated, joint_id))
    joints = {joint.id: joint for joint in articulated.moving_joints}
    ramp = np.linspace(0.0, 1.0, steps + 1)
    ratios = ramp * ramp * (3.0 - 2.0 * ramp)
    return tuple(
        JointTrack(name, seconds * ramp, _scaled(joint, _ratios(joints, name, ratios)))
        for name, joint in joints.items()
        if articulated.leader_of(joint) is leader
    )


def values_at(tracks: tuple[JointTrack, ...], time: float) -> JointValues:
    """Returns the value of each track's joint at a time in seconds, interpolated linearly."""
    return {track.joint: float(np.interp(time, track.times, track.values)) for track in tracks}


def cycle_frames(articulated: ArticulatedObject, count: int) -> list[Mapping[str, float]]:
    """Returns `count` frames of all joint values, evenly spaced over the closed-open-closed cycle."""
    tracks = cycle_tracks(articulated)
    end = max((float(track.times[-1]) for track in tracks), default=0.0)
    return [values_at(tracks, float(time)) for time in np.linspace(0.0, end, count)]


def _moving_joint(articulated: ArticulatedObject, joint_id: str) -> Joint:
    for joint in articulated.moving_joints:
        if joint.id == joint_id:
            return joint
    known = [joint.id for joint in articulated.moving_joints]
    raise ArticulationError(f"`{joint_id}` is not a moving joint of `{articulated.name}`: it has {known}")


def _cycle_keys(start: float, seconds: float, whole: float, steps: int) -> tuple[Scalars, Scalars]:
    """Returns key times and fractions of opening: mirrored in time about the middle of the whole."""
    ramp = np.linspace(0.0, 1.0, steps + 1)
    times, ratios = start + seconds * ramp, ramp * ramp * (3.0 - 2.0 * ramp)
    if start > 0:
        times, ratios = np.concatenate([[0.0], times]), np.concatenate([[0.0], ratios])
    return np.concatenate([times, whole - times[::-1]]), np.concatenate([ratios, ratios[::-1]])


def _ratios(joints: Mapping[str, Joint], name: str, ratios: Scalars) -> Scalars:
    """Returns the fractions of its range that a joint passes; one that closes as its leader opens is at the rest.

    `ratios` are those of the joint that moves by itself.
    """
    coupling = joints[name].coupling
    if coupling is None:
        return ratios
    led = _ratios(joints, coupling.leader, ratios)
    return led if coupling.multiplier > 0 else 1.0 - led


def _scaled(joint: Joint, ratios: Scalars) -> Scalars:
    return joint.limits.lower + joint.limits.range * ratios
