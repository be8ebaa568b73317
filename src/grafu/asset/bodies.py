"""Annotated inputs: rigid bodies with visuals and joints, to parts with their joints, and to pieces without.

It reads no files and moves nothing. In an annotation, the handle visuals of a moving body become `handle` parts that
ride on it, and the rest is one door or drawer. Wheels, casters, knobs and buttons that the input lets turn are `misc`
and stay where they are; their joints are kept apart as the annotation's small joints.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import final

from grafu.articulation.articulated_object import Coupling
from grafu.articulation.motion_kind import motion_kind
from grafu.asset.body_kinds import is_lever, is_rotor, slides_in_its_plane
from grafu.asset.drafts import PartDraft
from grafu.asset.labels import is_control, is_piece, label_of
from grafu.asset.names import unique_ids, words
from grafu.asset.part import AnnotatedJoint, Annotation, Part, PartSource
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import merge_meshes
from grafu.vocabulary import JointType, PartLabel


@final
@dataclass(frozen=True)
class BodyVisual:
    """One named piece of a body, in the input's coordinates with every joint as drawn.

    `group` names the door or drawer that it is a piece of where names say so, as a scene's nodes do.
    """

    name: str
    surfaces: tuple[Surface, ...]
    link: str = ""
    file: str = ""
    group: str = ""

    @property
    def named_surfaces(self) -> tuple[Surface, ...]:
        """Its surfaces by its own name."""
        return tuple(replace(surface, name=self.name) for surface in self.surfaces)


@final
@dataclass(frozen=True)
class StatedMotion:
    """How a body moves against its parent: limits as stated, radians or input units.

    With a `coupling` it follows the joint of another body, which it names by its link.
    """

    type: JointType
    axis: Axis
    lower: float
    upper: float
    limited: bool = True
    coupling: Coupling | None = None


@final
@dataclass(frozen=True)
class Body:
    """Links that hang together rigidly; `parent` is the link of the body that carries it.

    A body with a `motion` moves so. One without is static, unless it `is_loose`: then the input states that it moves,
    but not how.
    """

    name: str
    link: str
    visuals: tuple[BodyVisual, ...]
    motion: StatedMotion | None = None
    parent: str | None = None
    is_loose: bool = False


@final
@dataclass(frozen=True)
class _Draft:
    """A part before it has an id; `carrier` is the link of the moving body that it belongs to or rides on."""

    name: str
    label: PartLabel
    labelled_by: str
    visuals: tuple[BodyVisual, ...]
    carrier: str | None = None
    motion: StatedMotion | None = None
    is_moving: bool = False


def drafts_of_visuals(visuals: Iterable[BodyVisual]) -> list[PartDraft]:
    """Returns every visual as a piece of its own, whatever body it belongs to: what a file without joints holds."""
    filled = (v for v in visuals if any(not surface.is_empty for surface in v.surfaces))
    return [
        PartDraft(v.name, v.named_surfaces, v.group and f"link {v.group}", v.group, file=v.file, link=v.link)
        for v in filled
    ]


def annotation_of_bodies(bodies: list[Body], up: int) -> Annotation | None:
    """Returns the parts and joints of the bodies, and notes on what was decided; None where nothing moves.

    Args:
        bodies: every rigid body of the input.
        up: the index of the vertical axis in the input's coordinates.
    """
    notes: list[str] = []
    by_link = {body.link: body for body in bodies}
    moving_bodies = {body.link for body in bodies if _is_moving(body, notes)}
    levers = {link for link in moving_bodies if _is_lever(by_link[link], by_link, moving_bodies)}
    moving_bodies -= levers
    if not moving_bodies:
        return None
    drafts: list[_Draft] = []
    for body in bodies:
        carrier = _carrier(body, by_link, moving_bodies)
        if body.link in moving_bodies:
            drafts += _moving(body, carrier, up)
        elif body.link in levers:
            notes.append(f"{body.name} ({body.link}) turns on what it opens: it is a small part, which moves by itself")
            drafts += [_Draft(v.name, PartLabel.HANDLE, "joint", (v,), carrier) for v in body.visuals]
        else:
            drafts += _static(body, carrier, notes)
    drafts = [d for d in drafts if any(not s.is_empty for v in d.visuals for s in v.surfaces)]
    ids = unique_ids((d.name, d.label is PartLabel.HANDLE) for d in drafts)
    moving_ids = {d.visuals[0].link: i for d, i in zip(drafts, ids, strict=True) if d.is_moving}
    body_of = {v.link: body.link for body in bodies for v in body.visuals}
    by_body = {body_of[link]: i for link, i in moving_ids.items()}
    parts = tuple(_part(d, i, by_body) for d, i in zip(drafts, ids, strict=True))
    moved = {i: d.motion for d, i in zip(drafts, ids, strict=True) if d.motion}
    moving = {link: i for link, i in by_body.items() if i in moved}
    joints = tuple(_joint(motion, i, moving) for i, motion in moved.items())
    of_body: dict[str, list[str]] = {}
    for draft, part_id in zip(drafts, ids, strict=True):
        of_body.setdefault(body_of[draft.visuals[0].link], []).append(part_id)
    small = tuple(_small_joints(bodies, moving_bodies, of_body))
    return Annotation(parts, joints, tuple(notes), small)


def _small_joints(
    bodies: list[Body], moving_bodies: set[str], of_body: dict[str, list[str]]
) -> Iterator[AnnotatedJoint]:
    """Yields the joints of the bodies that are annotated to move, but are no door or drawer, with all their parts."""
    parent_of = {body.link: body.parent for body in bodies}
    for body in bodies:
        if body.motion is None or body.link in moving_bodies or not of_body.get(body.link):
            continue
        part, *own = of_body[body.link]
        above = (other for other in bodies if body.link in _links_above(other, parent_of))
        members = (*own, *(part for other in above for part in of_body.get(other.link, ())))
        yield replace(_joint(replace(body.motion, coupling=None), part, {}), members=members)


def _links_above(body: Body, parent_of: Mapping[str, str | None]) -> set[str]:
    """Returns the links of the bodies that carry a body."""
    found: set[str] = set()
    parent = body.parent
    while parent is not None and parent not in found:
        found.add(parent)
        parent = parent_of.get(parent)
    return found


def _is_moving(body: Body, notes: list[str]) -> bool:
    if not body.visuals or (body.motion is None and not body.is_loose):
        return False
    names = [body.name, *(v.name for v in body.visuals)]
    if body.motion is None and _spoken_label(body, body.visuals) is PartLabel.UNKNOWN:
        return False
    is_small = all(is_control(n) or label_of(n) is PartLabel.HANDLE for n in names) or is_control(body.name)
    if is_small or _is_rotor(body):
        stays = "kept in place" if body.motion is None else "it is a small part, which moves by itself"
        notes.append(f"{body.name} ({body.link}) is annotated to move, but is no door or drawer: {stays}")
        return False
    return any(label_of(v.name) is not PartLabel.HANDLE for v in body.visuals) or body.parent is None


def _is_rotor(body: Body) -> bool:
    motion = body.motion
    if motion is None or motion.limited or not motion_kind(motion.type).turns:
        return False
    return is_rotor(merge_meshes([s.mesh for v in body.visuals for s in v.surfaces]).box, motion.axis)


def _is_lever(body: Body, by_link: Mapping[str, Body], moving_bodies: set[str]) -> bool:
    if body.motion is None or not motion_kind(body.motion.type).turns or body.parent not in moving_bodies:
        return False
    return is_lever(_size(body.visuals), _size(by_link[body.parent].visuals))


def _size(visuals: Iterable[BodyVisual]) -> Vec3:
    return merge_meshes([s.mesh for v in visuals for s in v.surfaces]).box.size


def _carrier(body: Body, by_link: dict[str, Body], moving_bodies: set[str]) -> str | None:
    seen = {body.link}
    parent = body.parent
    while parent is not None and parent not in seen and parent in by_link:
        if parent in moving_bodies:
            return parent
        seen.add(parent)
        parent = by_link[parent].parent
    return None


def _moving(body: Body, carrier: str | None, up: int) -> list[_Draft]:
    handles = [v for v in body.visuals if label_of(v.name) is PartLabel.HANDLE]
    rest = tuple(v for v in body.visuals if v not in handles) or body.visuals
    label, labelled_by = _moving_label(body, rest, up)
    drafts = [_Draft(body.name, label, labelled_by, rest, carrier, body.motion, is_moving=True)]
    if len(rest) + len(handles) == len(body.visuals):
        drafts += [_Draft(v.name, PartLabel.HANDLE, "name", (v,), body.link) for v in handles]
    return drafts


def _moving_label(body: Body, rest: tuple[BodyVisual, ...], up: int) -> tuple[PartLabel, str]:
    """Returns whether a moving body is a door or a drawer, and what states it: its names, or else its joint."""
    spoken = _spoken_label(body, rest)
    stated = spoken if body.motion is None else _label_of_motion(spoken, rest, body.motion, up)
    return stated, "name" if stated is spoken else "joint"


def _spoken_label(body: Body, rest: tuple[BodyVisual, ...]) -> PartLabel:
    """Returns the label that most names of a body give, of door and drawer; `unknown` where none states either."""
    names = (body.name, *(v.name for v in rest))
    spoken = Counter(label_of(name) for name in names)
    if spoken[PartLabel.DOOR] or spoken[PartLabel.DRAWER]:
        return PartLabel.DOOR if spoken[PartLabel.DOOR] > spoken[PartLabel.DRAWER] else PartLabel.DRAWER
    sliding = {"slide", "sliding"} & {word for name in names for word in words(name)}
    return PartLabel.DOOR if sliding else PartLabel.UNKNOWN


def _label_of_motion(spoken: PartLabel, rest: tuple[BodyVisual, ...], motion: StatedMotion, up: int) -> PartLabel:
    """Returns what a body is by its joint: what turns is a door, whatever it is called; names tell slides apart."""
    if motion_kind(motion.type).turns:
        return motion_kind(motion.type).label
    if spoken is not PartLabel.UNKNOWN:
        return spoken
    return PartLabel.DOOR if slides_in_its_plane(_size(rest), motion.axis.direction, up) else PartLabel.DRAWER


def _static(body: Body, carrier: str | None, notes: list[str]) -> list[_Draft]:
    drafts = []
    for visual in body.visuals:
        spoken = label = label_of(visual.name)
        if body.motion is not None and label is not PartLabel.HANDLE:
            label = PartLabel.MISC
        elif label is PartLabel.DRAWER and is_piece(visual.name):
            # A front that the annotator left in place is a blind front: it closes the carcass like a frame.
            front = "front" in visual.name.lower()
            label = PartLabel.FACE_FRAME if front else PartLabel.MISC
            notes.append(f"{visual.name} is annotated as fixed: labelled {label.value}, not drawer")
        by = "joint" if label is not spoken else "none" if label is PartLabel.UNKNOWN else "name"
        drafts.append(_Draft(visual.name, label, by, (visual,), carrier))
    return drafts


def _part(draft: _Draft, part_id: str, by_body: dict[str, str]) -> Part:
    surfaces = tuple(s for v in draft.visuals for s in v.named_surfaces)
    files = sorted({v.file for v in draft.visuals if v.file})
    source = PartSource(draft.name, ", ".join(files), draft.visuals[0].link)
    carrier = by_body.get(draft.carrier) if draft.carrier is not None else None
    return Part(part_id, draft.label, surfaces, source, draft.labelled_by, carrier)  # type: ignore[arg-type]


def _joint(motion: StatedMotion, part_id: str, moving: dict[str, str]) -> AnnotatedJoint:
    """Returns the joint of a part; `moving` are the parts with a joint, by the link of their body."""
    low, high = sorted((motion.lower, motion.upper))
    stated = motion.coupling
    coupling = replace(stated, leader=moving[stated.leader]) if stated and stated.leader in moving else None
    return AnnotatedJoint(part_id, motion.type, motion.axis, low, high, motion.limited, coupling=coupling)
