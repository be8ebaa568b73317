"""The one door between input coordinates and the object frame: decides up, front, scale and place, and states why.

Object frame: metres, Z up, front -Y, standing on z = 0, centred in x and y. Up and front are found from labelled boxes
(`standing`); no joint is asked. A piece that stands askew in its file is turned about its vertical.
"""

from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.cad_names import are_of_cad
from grafu.asset.closed_side import faces_across, side_of_door
from grafu.asset.fronts_above import has_fronts_above
from grafu.asset.labels import label_of
from grafu.asset.lying_windows import lies_as_a_window
from grafu.asset.open_side import open_side
from grafu.asset.options import LoadOptions
from grafu.asset.part import ROBOTS, Frame, Part
from grafu.asset.reading import Placing, Reading
from grafu.asset.resting import stands_on_another_side
from grafu.asset.scale import Estimate, ScaleConfig, estimate_scale, is_normalised, likely_unit
from grafu.asset.seen_side import lies_on_its_front, most_shown_side
from grafu.asset.standing import HeadingConfig, UpVotes, decide_front, front_votes, up_votes, vector
from grafu.asset.standing_out import side_with_handles
from grafu.dataclass import dataclass
from grafu.errors import AssetError
from grafu.geometry.arrays import Mat4
from grafu.geometry.box import Box
from grafu.geometry.mesh import heading_of
from grafu.geometry.transform import from_rotation, rotation_matrix

_USUAL_FRONT = {"+Y": "+Z", "-Y": "+Z", "+Z": "-Y", "-Z": "-Y", "+X": "+Z", "-X": "+Z"}

_BY_HABIT = "assumed, as all sides look alike; --front changes it"
_BY_FORMAT = "where nothing shows another; --front changes it"
_BY_HANDLES = "small parts stand out there alone, as handles do"

_DATA_SETS = ("partnet-mobility", "hssd", "release")  # their models face one way


@final
@dataclass(frozen=True)
class _Choice:
    """A decision and what it rests on, in words."""

    value: str
    why: str


def settle_frame(
    reading: Reading, options: LoadOptions, file: Frame | None = None, before: Frame | None = None
) -> Frame:
    """Returns how the reading's coordinates become the object frame; what the user states wins.

    Of one piece of a file, `file` is the frame that the file has as a whole: up and scale are the same for all pieces.
    `before` is the frame that the reading had before it was cut: what was found then stands as it stood.

    Raises:
        AssetError: if the user's front lies on the axis that is up, or the object has no height.
    """
    whole = whole_box(reading.parts)
    if before is not None:
        up = _Choice(before.up, before.assumed[0].split(": ", 1)[1])
    else:
        up = _up(reading, options, whole) if file is None else _Choice(file.up, "as in the whole file")
    front = _front(reading, options, whole, up.value)
    rotation = np.stack([np.cross(-vector(front.value), vector(up.value)), -vector(front.value), vector(up.value)])
    if file is None:
        scale, size_words = _scale(reading, options, whole, "XYZ".index(up.value[1]))
    else:
        scale, size_words = file.scale, file.assumed[-1]
    T = _placed(scale, rotation, whole)
    said = (f"up is {up.value}: {up.why}", f"front is {front.value}: {front.why}", size_words)
    return Frame(T, up.value, front.value, scale, said)


def straightened(
    reading: Reading, options: LoadOptions, config: HeadingConfig = HeadingConfig()
) -> tuple[Reading, Mat4]:
    """Returns the reading turned about its vertical so that its walls lie along the axes, and the turn (4x4).

    Walls that are askew by less than a degree stay so, and so does what has no common direction: a round table.
    """
    whole = whole_box(reading.parts)
    up = vector(_up(reading, options, whole).value)
    level = np.eye(3)[int(np.argmin(np.abs(up)))]
    upright = np.stack([level, np.cross(up, level), up])
    meshes = sorted((part.mesh for part in reading.parts), key=lambda mesh: -mesh.area)
    angle = heading_of(meshes, upright, config.most)
    is_one = len(meshes) > 1 and abs(heading_of(meshes[1:], upright, config.most) - angle) > config.alike
    if not angle or is_one:
        return reading, np.eye(4)
    T = from_rotation(rotation_matrix(up, -angle))
    place = Placing(Frame(T, "+Z", "-Y", 1.0))
    annotation = reading.annotation and place.annotation(reading.annotation)
    return replace(reading, parts=place.moved(reading.parts), annotation=annotation), T


def turned_before(frame: Frame, T: Mat4) -> Frame:
    """Returns the frame of what was turned by T before it; the words state by how much."""
    if np.array_equal(T, np.eye(4)):
        return frame
    degrees = np.degrees(np.arccos(np.clip((np.trace(T[:3, :3]) - 1.0) / 2.0, -1.0, 1.0)))
    words = f"the piece stands askew by {degrees:.0f} degrees in its file: from most of its upright area"
    up, front, *rest = frame.assumed
    return replace(frame, input_to_output=frame.input_to_output @ T, assumed=(up, f"{front}; {words}", *rest))


def front_is_assumed(frame: Frame) -> bool:
    """Whether nothing showed which side is the front, and at most the format of the file states it."""
    return any(_BY_HABIT in words or _BY_FORMAT in words for words in frame.assumed)


def whole_box(parts: tuple[Part, ...]) -> Box:
    """Returns the box around all parts."""
    return Box.enclosing(part.box for part in parts)


def _placed(scale: float, rotation: np.ndarray, whole: Box) -> Mat4:
    linear = scale * rotation
    turned = whole.corners() @ linear.T
    low, high = turned.min(axis=0), turned.max(axis=0)
    return from_rotation(linear, -np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]]))


def _up(reading: Reading, options: LoadOptions, whole: Box) -> _Choice:
    convention = reading.convention
    if options.up is not None:
        return _Choice(options.up, "stated by the user")
    votes = up_votes([part for part in reading.parts if _is_named(part)], whole)
    if convention.up is not None:
        other = votes.against(convention.up)
        if other is not None:
            sure = _sure(votes.confidence(other))
            return _Choice(
                other, f"panels, doors and legs stand so, against {convention.up} of {convention.origin}{sure}"
            )
        return _by_rest(reading, votes, _Choice(convention.up, f"stated by {convention.origin}"), whole)
    if options.front is not None and options.front[1] == convention.usual_up[1]:
        other = "+Z" if convention.usual_up == "+Y" else "+Y"
        return _Choice(votes.best or other, "left over by the user's front")
    if votes.best is not None and (votes.best[1] != "X" or votes.against(convention.usual_up) == votes.best):
        sure = _sure(votes.confidence(votes.best))  # files have Y or Z up: for X nothing may speak against it
        return _Choice(votes.best, f"from the places and thin sides of labelled panels and legs{sure}")
    other = "+Z" if convention.usual_up == "+Y" else "+Y"
    if votes.stands_instead(other, convention.usual_up):
        against = f"against {convention.usual_up}, {convention.origin}"
        return _Choice(other, f"doors and panels would lie flat otherwise, {against}; --up changes it")
    if are_of_cad(reading.parts):
        of_cad = _Choice("+Z", "usual for CAD programs, which name bodies so; --up changes it")
        return _by_rest(reading, votes, of_cad, whole)
    usual = _Choice(convention.usual_up, f"assumed by {convention.origin}; --up changes it")
    return _by_rest(reading, votes, usual, whole)


def _is_named(part: Part) -> bool:
    """Whether no shape alone gave a part its label: how the piece stands was known then."""
    return part.labelled_by != "shape" or label_of(part.source.name) is part.label


def _by_rest(reading: Reading, votes: UpVotes, usual: _Choice, whole: Box) -> _Choice:
    """Returns the direction that is up by the format, or what the shape tells where labels do not speak for that."""
    if votes.lying.any() or votes.tells_sense or (votes.standing.any() and votes.stands_along(usual.value)):
        return usual
    against, by_habit = f"against {usual.value} of {reading.convention.origin}", "+Z" if usual.value == "+Y" else "+Y"
    if reading.convention.up is None and lies_as_a_window(reading.parts, whole, usual.value):
        return _Choice(by_habit, f"it would be a window that lies on its face, {against}")
    other = stands_on_another_side(reading.parts, usual.value, by_habit)
    is_window = other is not None and lies_as_a_window(reading.parts, whole, other)  # a round one rests on little
    if other is not None and not is_window and votes.stands_along(other):
        return _Choice(other, f"what the piece rests on tells, {against}")
    is_stated = reading.convention.up is not None
    if not is_stated and has_fronts_above(reading.parts, usual.value, by_habit):
        return _Choice(by_habit, f"doors and drawers with handles would face up or down, {against}")
    if lies_on_its_front(reading.parts, whole, usual.value, is_stated):
        return _Choice(by_habit, f"it would lie on what shows the most parts, {against}")
    return usual


def _front(reading: Reading, options: LoadOptions, whole: Box, up: str) -> _Choice:
    if options.front is not None:
        if options.front[1] == up[1]:
            raise AssetError(f"--front {options.front} lies on the axis that is up ({up}); state --up as well")
        return _Choice(options.front, "stated by the user")
    convention = reading.convention
    stated = convention.front if convention.front is not None and convention.front[1] != up[1] else None
    votes = front_votes(_telling(reading), whole, up)
    faces_one_way = stated is not None and reading.kind in _DATA_SETS
    is_known = any(votes.values()) or faces_one_way
    if not is_known:
        held = side_with_handles(reading.parts, whole, up)
        shown = held or most_shown_side(reading.parts, whole, up, stated is not None)
        is_known = shown is not None
        if shown is not None and shown != stated:
            return _Choice(shown, _BY_HANDLES if held else "most parts, and steps between them, are seen there")
        usual = None if reading.kind in ROBOTS else stated or _USUAL_FRONT[up]
        if usual is not None and (opened := open_side(reading.parts, whole, up, usual)) is not None:
            return _Choice(opened, "its compartments open to that side, and boards close its ends")
        if reading.fronts_face is not None and stated is None and reading.fronts_face[1] != up[1]:
            return _Choice(reading.fronts_face, "what was cut out of a mesh as a front faces there")
    usual = "+X" if reading.kind in ROBOTS and up[1] != "X" else _USUAL_FRONT[up]
    if reading.kind in ROBOTS and stated is None and not any(votes.values()):
        door = side_of_door(reading.parts, whole, up)
        if door is not None:
            return _Choice(door, "a body of its own closes this side alone, as a door does")
    if faces_across(usual, whole, up):
        usual = _USUAL_FRONT[up]
    front, why = decide_front(votes, stated, usual)
    sure = _sure(votes[front] / max(sum(votes.values()), 1e-9))
    reasons = {
        "geometry": f"doors, drawers, handles or the back panel face or open there{sure}",
        "convention": f"stated by {convention.origin}{'' if is_known else f', {_BY_FORMAT}'}",
        "habit": _BY_HABIT,
    }
    return _Choice(front, reasons[why])


def _telling(reading: Reading) -> tuple[Part, ...]:
    """Returns the parts that show where the front is: not those that are drawers by a box alone behind a front.

    That front and others were cut out of a mesh and face one way.
    """
    if reading.fronts_face is None:
        return reading.parts
    return tuple(part for part in reading.parts if not part.label.is_movable or _is_named(part))


def _sure(ratio: float) -> str:
    """Returns the confidence of a decision, in words: the fraction of what tells that tells the same."""
    return f", confidence {_percent(ratio)}"


def _percent(ratio: float) -> str:
    return f"{ratio:.0%}".replace("%", " %")


def _scale(reading: Reading, options: LoadOptions, whole: Box, up: int) -> tuple[float, str]:
    height = float(whole.size[up])
    if options.height is not None:
        if height <= 0:
            raise AssetError(
                f"--height {options.height} cannot be met: the object has no extent along its vertical axis"
            )
        return options.height / height, f"scale {options.height / height:.6g} m per unit: the user states the height"
    if options.scale is not None:
        return options.scale, f"scale {options.scale:.6g} m per unit: stated by the user"
    estimate = estimate_scale(reading.parts, whole, up, reading.furniture)
    unit = reading.convention.unit
    size, believed = float(whole.size.max()), ScaleConfig()
    if unit is not None and believed.is_believed(unit, size, estimate):
        return unit, f"scale {unit:g} m per unit: stated by {reading.convention.origin}"
    if not reading.convention.normalised and not is_normalised(reading.parts, whole):
        common = likely_unit(size, estimate)
        if common is not None:
            sure = _sure(min(common[1] / estimate.scale, estimate.scale / common[1]))
            why = f"{common[0]} make a {estimate.kind} of plausible size{sure}; --scale changes it"
            return common[1], f"scale {common[1]:g} m per unit: {why}"
    return estimate.scale, _estimated(estimate, height)


def _estimated(estimate: Estimate, height: float) -> str:
    basis = ", ".join(estimate.measures[:4])
    metres = f"{height * estimate.scale:.2f} m high"
    made = f"estimated for a {estimate.kind} piece from {basis}, within {_percent(estimate.spread)}"
    return f"scale {estimate.scale:.6g} m per unit ({metres}): {made}; --height changes it"
