"""The parts as they stand: static body, moving bodies, installed hardware, and their colliders.

A scene is never changed: replacing a part or adding hardware returns a new scene, which shares whatever was worked out
on the meshes that stayed the same.
"""

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import field, replace
from functools import cached_property, partial
from typing import Concatenate, ParamSpec, TypeVar, cast, final

from grafu.articulation.articulated_object import Visual
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat3
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh, mesh_near
from grafu.geometry.swept_body import SweptBody
from grafu.scene.moving_body import JointMotion as JointMotion
from grafu.scene.moving_body import MovingBody as MovingBody
from grafu.scene.obstacles import Entry, Obstacle, Obstacles, entry_of
from grafu.scene.reads import Read, note_box, note_whole, plain, with_items
from grafu.scene.scale import floor_under, metre_on
from grafu.scene.shapes import Shapes

P = ParamSpec("P")
T = TypeVar("T")


@final
@dataclass(frozen=True, eq=False)
class Scene:
    """All parts in their rest pose.

    `hardware` holds installed visuals by the id of the moving body, or "" for static; `joint_motions` holds what is
    known of the moving bodies' motions. What is `behind` is met by hardware alone, and only while all is closed.
    """

    parts: Mapping[str, Part]
    moving_bodies: Mapping[str, MovingBody]
    extent: float
    hardware: tuple[tuple[str, Visual], ...] = ()
    joint_motions: Mapping[str, JointMotion] = field(default_factory=dict)
    behind: tuple[Part, ...] = ()
    _shapes: Shapes = field(default_factory=Shapes, repr=False)
    _path_boxes: dict[str, tuple[Box, JointMotion, Box]] = field(default_factory=dict, repr=False)
    _known: dict[tuple[object, ...], object] = field(default_factory=dict, repr=False, init=False)

    def once(self, find: "Callable[Concatenate[Scene, P], T]", *args: P.args, **more: P.kwargs) -> T:
        """Returns what `find` finds in this scene: worked out once, whoever asks. All arguments must be hashable."""
        key = (find, args, tuple(more.items()))
        if key not in self._known:
            self._known[key] = find(self, *args, **more)
        return cast(T, self._known[key])

    @cached_property
    def metre(self) -> float:
        """How long one metre of real furniture is in this scene; see `metre_on`."""
        return metre_on(self.extent)

    @cached_property
    def floor(self) -> float:
        """The height of the floor, metres; see `floor_under`."""
        return floor_under(part.mesh for part in plain(self.parts).values())

    @cached_property
    def moving_ids(self) -> frozenset[str]:
        """The ids of all parts that move."""
        return frozenset(member for moving in plain(self.moving_bodies).values() for member in moving.members)

    @property
    def static_parts(self) -> tuple[Part, ...]:
        """The parts that stay where they are."""
        note_whole(Read.STILL)
        return self.still_parts

    @cached_property
    def still_parts(self) -> tuple[Part, ...]:
        """The same, not noted as read; see `grafu.scene.reads`."""
        return tuple(part for part in plain(self.parts).values() if part.id not in self.moving_ids)

    def static_parts_near(self, box: Box) -> list[Part]:
        """Returns the parts that stay where they are and whose boxes meet a box."""
        note_box(Read.STILL, box)
        return [part for part in self.still_parts if len(part.mesh.faces) and part.box.overlaps(box)]

    @cached_property
    def static_obstacles(self) -> Obstacles:
        """One obstacle per static part, at rest."""
        return Obstacles(entry_of(Read.STILL, part.id, part.mesh) for part in self.still_parts if len(part.mesh.faces))

    @cached_property
    def obstacles_behind(self) -> tuple[Obstacle, ...]:
        """One obstacle per part that hardware must clear while all is closed, and that nothing else meets."""
        return tuple(Obstacle(part.id, MeshCollider(part.mesh)) for part in self.behind if len(part.mesh.faces))

    @cached_property
    def static_hardware(self) -> Obstacles:
        """One obstacle per installed static piece of hardware; what turns on its own pin is none."""
        rigid = (visual for owner, visual in self.hardware if not owner and visual.swing is None)
        return Obstacles(entry_of(Read.HARDWARE, visual.name, visual.mesh) for visual in rigid)

    @cached_property
    def still_obstacles(self) -> Obstacles:
        """All that is static: the parts, then the hardware."""
        return self.static_obstacles.joined(self.static_hardware)

    def static_obstacles_of(self, parts: Collection[str]) -> Obstacles:
        """Returns the obstacles of some static parts alone; of all, where none are named."""
        return self.static_obstacles.only(parts) if parts else self.static_obstacles

    def hardware_obstacles(self, moving_id: str) -> tuple[Obstacle, ...]:
        """Returns one obstacle per piece of hardware that a moving body carries, at rest: the same whoever asks."""
        return self.once(_hardware_obstacles, moving_id)

    def body_obstacles(self, moving_id: str) -> tuple[Obstacle, ...]:
        """Returns one obstacle per part of a moving body, then per piece of hardware that it carries, at rest."""
        return self.once(_body_obstacles, moving_id)

    def moving_mesh(self, moving_id: str) -> TriangleMesh:
        """Returns the moving body with all that rides on it, without hardware, as one mesh."""
        return self._shapes.as_one([self.parts[member].mesh for member in self.moving_bodies[moving_id].members])

    def equipped_mesh(self, moving_id: str) -> TriangleMesh:
        """Returns the moving body with all that rides on it and the hardware that it carries so far, as one mesh."""
        note_box(Read.BODIES, self.body_box(moving_id))
        bare = self._shapes.as_one([part.mesh for part in self.body_parts(moving_id)])
        hardware = [visual.mesh for visual in self.body_hardware(moving_id) if visual.swing is None]
        return self._shapes.as_one([bare, *hardware]) if hardware else bare

    def body_parts(self, moving_id: str) -> tuple[Part, ...]:
        """Returns what moves as one; that is not noted as read, see `grafu.scene.reads`."""
        return tuple(plain(self.parts)[member] for member in plain(self.moving_bodies)[moving_id].members)

    def body_hardware(self, moving_id: str) -> tuple[Visual, ...]:
        """Returns the hardware installed on a moving body; that is not noted as read."""
        return self._hardware_by_owner.get(moving_id, ())

    def body_box(self, moving_id: str) -> Box:
        """Returns the box around a moving body and its hardware at rest; that is not noted as read."""
        return self.once(_body_box_of, moving_id)

    def path_box(self, moving_id: str, joint_motion: JointMotion, find: Callable[[Box], Box]) -> Box:
        """Returns the box around a moving body's whole path, not noted as read.

        `find` works it out of the body's box at rest: once, as long as that and the motion stay.
        """
        known, box = self._path_boxes.get(moving_id), self.body_box(moving_id)
        if known is None or known[1] is not joint_motion or not (known[0] is box or known[0] == box):
            known = self._path_boxes[moving_id] = (box, joint_motion, find(box))
        return known[2]

    def swept_body(self, moving_id: str, depth: float, axes: Mat3) -> SweptBody:
        """Returns the moving body as a body that tells a touch from a penetration deeper than `depth` metres."""
        return self._shapes.body(self.moving_mesh(moving_id), depth, axes)

    def others_than(self, moving_id: str) -> tuple[str, ...]:
        """Returns the ids of the other moving bodies, not noted as read."""
        return tuple(other for other in plain(self.moving_bodies) if other != moving_id)

    def is_another_beside(self, moving_id: str, box: Box) -> bool:
        """Whether the box around another moving body, at rest with its hardware, meets a box."""
        note_box(Read.BOXES, box)
        return self.other_bodies(moving_id).meets(box)

    def other_bodies(self, moving_id: str) -> Obstacles:
        """Returns the other moving bodies as obstacles, at rest, with the hardware that they carry."""
        return self.once(_other_bodies_of, moving_id)

    @cached_property
    def all_bodies(self) -> Obstacles:
        """All moving bodies as obstacles, at rest, with the hardware that they carry: listed once for all who ask."""
        return Obstacles(_body_entry(self, name) for name in plain(self.moving_bodies))

    def is_near_static(self, mesh: TriangleMesh, within: float, of: Collection[str] = ()) -> bool:
        """Whether a mesh comes within so many metres of a static part (`of`: of one of these)."""
        collider = MeshCollider(mesh)
        return any(collider.is_within(within, o.collider) for o in self.static_obstacles_of(of).near(mesh.box, within))

    def hardware_of(self, moving_id: str) -> tuple[Visual, ...]:
        """Returns the hardware installed on a moving body."""
        if moving_id in plain(self.moving_bodies):
            note_box(Read.BODIES, self.body_box(moving_id))
        return self.body_hardware(moving_id)

    @cached_property
    def _hardware_by_owner(self) -> dict[str, tuple[Visual, ...]]:
        found: dict[str, list[Visual]] = {}
        for owner, visual in self.hardware:
            found.setdefault(owner, []).append(visual)
        return {owner: tuple(visuals) for owner, visuals in found.items()}

    def afresh(self, *kept: Callable[..., object]) -> "Scene":
        """Returns the same scene without what was worked out on its meshes, but for what the functions `kept` found."""
        made = self.sharing(Shapes())
        made._known.update({key: value for key, value in self._known.items() if key[0] in kept})
        return made

    def sharing(self, shapes: Shapes) -> "Scene":
        """Returns the same scene, which shares with others what is worked out on meshes."""
        return replace(self, _shapes=shapes, _path_boxes={})

    def replaced(self, parts: Iterable[Part]) -> "Scene":
        """Returns the scene with some parts in a new shape."""
        new = {part.id: part for part in parts}
        made = replace(self, parts=with_items(self.parts, new))
        changed = (m.id for m in plain(self.moving_bodies).values() if not new.keys().isdisjoint(m.members))
        _keep_bodies(made, self, tuple(changed))
        return made

    def with_parts(self, parts: Iterable[Part]) -> "Scene":
        """Returns the scene with some more parts; those that ride on a moving body move with it."""
        new = {part.id: part for part in parts}
        riding = [(part.carried_by, part.id) for part in new.values() if part.carried_by in self.moving_bodies]
        return replace(self, parts={**self.parts, **new}).with_attached((m, p) for m, p in riding if m is not None)

    def with_attached(self, pairs: Iterable[tuple[str, str]]) -> "Scene":
        """Returns the scene in which more parts move with moving bodies: of each pair the body, then the part."""
        moving_bodies = dict(self.moving_bodies)
        for moving_id, part_id in pairs:
            moving_bodies[moving_id] = replace(moving := moving_bodies[moving_id], members=(*moving.members, part_id))
        return replace(self, moving_bodies=moving_bodies)

    def without_parts(self, gone: Collection[str]) -> "Scene":
        """Returns the scene without some parts that are static or ride on moving bodies."""
        if not gone:
            return self
        moving_bodies = {
            name: MovingBody(moving.id, tuple(m for m in moving.members if m not in gone))
            for name, moving in self.moving_bodies.items()
        }
        return replace(self, parts={k: p for k, p in self.parts.items() if k not in gone}, moving_bodies=moving_bodies)

    def with_joint(
        self, moving_id: str, joint_motion: JointMotion, dynamic: Iterable[Visual], static: Iterable[Visual]
    ) -> "Scene":
        """Returns the scene with a path and more hardware of a moving body, and of the static one; other boxes stay."""
        added = [(moving_id, v) for v in dynamic] + [("", v) for v in static]
        motions = with_items(self.joint_motions, {moving_id: joint_motion})
        made = replace(self, hardware=(*self.hardware, *added), joint_motions=motions)
        _keep_parts(made, self)
        _keep_bodies(made, self, [moving_id])
        return made

    def static_mesh_near(self, box: Box, margin: float, of: Collection[str] = ()) -> TriangleMesh:
        """Returns the static triangles (`of`: of these parts alone) whose own boxes come within `margin` of a box."""
        reach = box.grown(margin)
        note_box(Read.STILL, reach)
        parts = (part for part in self.still_parts if not of or part.id in of)
        return mesh_near((part.mesh for part in parts), reach)


def _hardware_obstacles(scene: Scene, moving_id: str) -> tuple[Obstacle, ...]:
    rigid = (visual for visual in scene.hardware_of(moving_id) if visual.swing is None)
    return tuple(Obstacle(visual.name, MeshCollider(visual.mesh)) for visual in rigid)


def _body_obstacles(scene: Scene, moving_id: str) -> tuple[Obstacle, ...]:
    parts = (scene.parts[member] for member in scene.moving_bodies[moving_id].members)
    own = (Obstacle(part.id, MeshCollider(part.mesh)) for part in parts if len(part.mesh.faces))
    return (*own, *scene.hardware_obstacles(moving_id))


def _equipped_obstacle(scene: Scene, moving_id: str) -> Obstacle:
    return Obstacle(moving_id, MeshCollider(scene.equipped_mesh(moving_id)))


def _body_box_of(scene: Scene, moving_id: str) -> Box:
    rigid = (visual.mesh for visual in scene.body_hardware(moving_id) if visual.swing is None)
    meshes = [*(part.mesh for part in scene.body_parts(moving_id)), *rigid]
    return scene._shapes.box_around([mesh for mesh in meshes if len(mesh.faces)] or meshes)


def _body_entry(scene: Scene, moving_id: str) -> Entry:
    prepare = partial(scene.once, _equipped_obstacle, moving_id)
    return Entry(Read.BODIES, moving_id, scene.body_box(moving_id), prepare)


def _other_bodies_of(scene: Scene, moving_id: str) -> Obstacles:
    return scene.all_bodies.without((moving_id,))


def _keep_bodies(scene: Scene, before: Scene, changed: Collection[str]) -> None:
    """Gives a scene what another knows of the moving bodies, but for those that are not the same in both."""
    gone = {(name,) for name in changed}  # the arguments of `Scene.once`
    boxes = {key: box for key, box in before._known.items() if key[0] is _body_box_of and key[1] not in gone}
    scene._known.update(boxes)
    if "all_bodies" in before.__dict__:
        changed_entries = [_body_entry(scene, name) for name in changed]
        scene.__dict__["all_bodies"] = before.all_bodies.with_entries(changed_entries)


_OF_PARTS = ("metre", "floor", "moving_ids", "still_parts", "static_obstacles", "obstacles_behind")


def _keep_parts(scene: Scene, before: Scene) -> None:
    """Gives a scene what another with the same parts and moving bodies knows of the parts."""
    scene.__dict__.update({name: before.__dict__[name] for name in _OF_PARTS if name in before.__dict__})
