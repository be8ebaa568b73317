"""Joints in Blender: an empty with limits and one property that opens it, a driver on the link, keys, muting.

Everything here takes Blender's own objects; they are identified by their custom properties (`layout`).
"""

import json
from typing import Any

import numpy as np

from grafu.articulation.articulated_object import Coupling, Joint, JointLimits
from grafu.articulation.swing import Swing
from grafu.export.blend.layout import (
    AFTER,
    CHILD,
    ID,
    KIND,
    LEADER,
    LOWER,
    MULTIPLIER,
    OFFSET,
    OPEN,
    PARENT,
    TYPE,
    UPPER,
    Key,
    Kind,
)
from grafu.geometry.arrays import Scalars, Vec3

Empty = Any
"""A `bpy.types.Object`; Blender's own types are made when it runs."""
_PATH = f'["{OPEN}"]'
_OPENING = "lower_value + (upper_value - lower_value) * clamp(open_value)"


def describe_joint(empty: Empty, joint: Joint) -> None:
    """Writes what a joint is into the properties of its empty; a fixed joint has no `open`."""
    empty[KIND], empty[ID], empty[TYPE] = Kind.JOINT.value, joint.id, joint.type.value
    empty[PARENT], empty[CHILD], empty[AFTER] = joint.parent, joint.child, json.dumps(list(joint.after))
    empty[LOWER], empty[UPPER] = float(joint.limits.lower), float(joint.limits.upper)
    if joint.kind.moves:
        for name in (LOWER, UPPER):
            about = f"The joint's {name} limit"
            empty.id_properties_ui(name).update(min=0.0, subtype=joint.kind.word("blender"), description=about)
        empty[OPEN] = 0.0
        about = "How far the joint is open: 0 closed, 1 at its limit"
        empty.id_properties_ui(OPEN).update(min=0.0, max=1.0, default=0.0, subtype="FACTOR", description=about)
        empty.property_overridable_library_set(_PATH, True)  # it opens where the file is linked, too


def couple_joint(empty: Empty, leader: Empty, coupling: Coupling) -> None:
    """Lets the empty of a coupled joint follow its leader's, its limits too: both go through their ranges in step.

    One that closes as its leader opens (a negative multiplier) turns in the opposite direction.
    """
    empty[LEADER], empty[MULTIPLIER], empty[OFFSET] = coupling.leader, coupling.multiplier, coupling.offset
    at_limits = ", ".join(f"{name}_value * {coupling.multiplier!r} + {coupling.offset!r}" for name in (LOWER, UPPER))
    ratio = "clamp(open_value)" if coupling.multiplier > 0 else "1.0 - clamp(open_value)"
    for name, expression in ((LOWER, f"min({at_limits})"), (UPPER, f"max({at_limits})"), (OPEN, ratio)):
        driver = empty.driver_add(f'["{name}"]').driver
        driver.type = "SCRIPTED"
        for read in (LOWER, UPPER, OPEN):
            _read(driver, leader, read)
        driver.expression = expression


def turn_to_axis(empty: Empty, direction: Vec3) -> None:
    """Turns an empty so that its local Z is a direction (unit vector, its parent's frame)."""
    empty.rotation_mode = "QUATERNION"
    empty.rotation_quaternion = _from_up(np.asarray(direction, dtype=np.float64))


def drive_link(link: Empty, empty: Empty, joint: Joint) -> None:
    """Lets a joint's empty drive its link's: turned about, or shifted along, the axis by what `open` stands for.

    The link's own axes stay parallel to the object frame at rest, whatever direction the joint's empty has.
    """
    direction = [float(v) for v in joint.axis.direction]
    if joint.kind.turns:
        link.rotation_mode = "AXIS_ANGLE"
        link.rotation_axis_angle = (0.0, *direction)
        _drive(link, ("rotation_axis_angle", 0), empty, joint.kind.turn)
    for index in np.flatnonzero(joint.kind.shift * joint.axis.direction):
        _drive(link, ("location", int(index)), empty, joint.kind.shift * direction[index])
    if joint.slip is not None and not joint.kind.shift:
        for index in np.flatnonzero(np.abs(joint.slip.shifts).max(axis=0)):
            table = joint.slip.values, joint.slip.shifts[:, index]
            _drive_by_table(link, ("location", int(index)), empty, table)


def drive_swing(made: Empty, swing: Swing, empty: Empty, origin: Vec3) -> None:
    """Lets a joint's empty drive a piece that turns on its own pin, which stands at `origin` in its link's frame.

    The curve of the driver is the table of angles by the joint's value: no Python runs.
    """
    made.location = [float(v) for v in origin]
    made.rotation_mode = "AXIS_ANGLE"
    made.rotation_axis_angle = (0.0, *(float(v) for v in swing.axis.direction))
    _drive_by_table(made, ("rotation_axis_angle", 0), empty, (swing.values, swing.angles))


def key_joint(empty: Empty, keys: tuple[Key, ...]) -> None:
    """Writes keys (frames, fractions of the opening) for `open`, soft at both ends of every move."""
    for frame, ratio in keys:
        empty[OPEN] = ratio
        empty.keyframe_insert(_PATH, frame=frame)
    empty[OPEN] = keys[0][1]
    for curve in open_curves(empty):
        for point in curve.keyframe_points:
            point.interpolation = "BEZIER"
            point.handle_left_type = point.handle_right_type = "AUTO_CLAMPED"  # never beyond a key, flat at the ends
        curve.update()


def set_open(empty: Empty, ratio: float) -> None:
    """Opens a joint to a fraction of its range (0 closed, 1 at its limit); an animation undoes it at the next frame.

    Raises:
        ValueError: if the empty is no moving joint's, or that of one that follows another, or the fraction is not in
            0..1.
    """
    _require_moving(empty)
    if not 0.0 <= ratio <= 1.0:
        raise ValueError(f"`ratio` must be in 0..1: got {ratio}")
    empty[OPEN] = float(ratio)
    empty.update_tag()


def set_limits(empty: Empty, limits: JointLimits) -> None:
    """Gives a joint other limits (radians or metres).

    Raises:
        ValueError: if the empty is no moving joint's, or that of one that follows another.
    """
    _require_moving(empty)
    empty[LOWER], empty[UPPER] = float(limits.lower), float(limits.upper)
    empty.update_tag()


def mute_joint(empty: Empty, mute: bool = True) -> None:
    """Mutes the animation of a joint, so that `open` is free, or lets it run again."""
    for curve in open_curves(empty):
        curve.mute = mute


def open_curves(empty: Empty) -> list[Any]:
    """Returns the F-curves that animate `open`: at most one, unless the user added more."""
    data = empty.animation_data
    if data is None or data.action is None:
        return []
    return [curve for curve in _curves(data) if curve.data_path == _PATH]


def _require_moving(empty: Empty) -> None:
    if empty.get(KIND) != Kind.JOINT or OPEN not in empty:
        raise ValueError(f"`empty` must be a moving joint's: got `{empty.name}`")
    if LEADER in empty:
        raise ValueError(
            f"`empty` must be that of a joint that moves by itself: `{empty.name}` follows {empty[LEADER]}"
        )


def _curves(data: Any) -> list[Any]:
    """Returns the F-curves of an animation; Blender 5.0 keeps them in layers, older ones in the action itself."""
    if hasattr(data.action, "fcurves"):
        return list(data.action.fcurves)
    strips = [strip for layer in data.action.layers for strip in layer.strips]
    bags = [strip.channelbag(data.action_slot) for strip in strips if data.action_slot is not None]
    return [curve for bag in bags if bag is not None for curve in bag.fcurves]


def _drive(link: Empty, channel: tuple[str, int], empty: Empty, factor: float) -> None:
    driver = link.driver_add(*channel).driver
    _read_opening(driver, empty)
    driver.expression = _OPENING if factor == 1.0 else f"({_OPENING}) * {factor!r}"


def _drive_by_table(made: Empty, channel: tuple[str, int], empty: Empty, table: tuple[Scalars, Scalars]) -> None:
    """Lets a joint's value drive a channel through the curve of its driver: `table` has values, and what they give."""
    curve = made.driver_add(*channel)
    for modifier in list(curve.modifiers):
        curve.modifiers.remove(modifier)
    for value, given in zip(*table, strict=True):
        curve.keyframe_points.insert(float(value), float(given)).interpolation = "LINEAR"
    _read_opening(curve.driver, empty)


def _read_opening(driver: Any, empty: Empty) -> None:
    """Lets a driver compute the value of a joint from the properties of its empty."""
    driver.type = "SCRIPTED"
    for name in (LOWER, UPPER, OPEN):
        _read(driver, empty, name)
    driver.expression = _OPENING


def _read(driver: Any, empty: Empty, name: str) -> None:
    """Lets a driver read a property of an empty, as `<name>_value`."""
    variable = driver.variables.new()
    variable.name = f"{name}_value"
    variable.type = "SINGLE_PROP"
    variable.targets[0].id = empty
    variable.targets[0].data_path = f'["{name}"]'


def _from_up(direction: np.ndarray) -> tuple[float, float, float, float]:
    """Returns the quaternion (wxyz) of the shortest turn from +Z to a unit vector; about X where they are opposite.

    It is written out: the Python of Blender, where this runs, has numpy but no scipy.
    """
    w, x, y = 1.0 + direction[2], -direction[1], direction[0]
    length = float(np.sqrt(w * w + x * x + y * y))
    if length < 1e-6:
        return (0.0, 1.0, 0.0, 0.0)
    return (float(w / length), float(x / length), float(y / length), 0.0)
