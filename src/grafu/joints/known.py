"""What was worked out for one moving body, found again where all that was read of the scene is the same.

A joint is built in a scene of many parts and reads what comes near its path. It is found again in another scene in
which that is the same, whatever changed elsewhere. Its result holds for the scene that it is found in: what was done is
kept as a change of any scene. Without a cache nothing is noted, and all is worked out.
"""

from collections.abc import Callable, Mapping
from dataclasses import field, replace
from typing import Any, Final, Generic, TypeVar, cast, final

import numpy as np

from grafu.articulation.articulated_object import Visual
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.joints.hinge.neighbours import path_box_of
from grafu.processes.cache import Cache, content_key
from grafu.scene.reads import Noted, Noting, Read, Reads, plain
from grafu.scene.scene import JointMotion, MovingBody, Scene

T = TypeVar("T")
MOST_KNOWN: Final = 6
"""Results of one moving body that are kept, each of other surroundings: undo and redo find theirs."""


@final
@dataclass(frozen=True)
class SceneChange:
    """What building a joint does to a scene: parts in a new shape, bodies with new members, hardware and a motion."""

    parts: Mapping[str, Part]
    moving_bodies: Mapping[str, MovingBody]
    hardware: tuple[tuple[str, Visual], ...]
    joint_motions: Mapping[str, JointMotion]

    def of(self, scene: Scene) -> Scene:
        """Returns a scene with the change."""
        return replace(
            scene,
            parts={**scene.parts, **self.parts},
            moving_bodies={**scene.moving_bodies, **self.moving_bodies},
            hardware=(*scene.hardware, *self.hardware),
            joint_motions={**scene.joint_motions, **self.joint_motions},
        )


def change_between(before: Scene, after: Scene) -> SceneChange:
    """Returns what leads from one scene to another that was made of it by building a joint."""
    parts, bodies, motions = plain(after.parts), plain(after.moving_bodies), plain(after.joint_motions)
    old_parts, old_bodies, old_motions = plain(before.parts), plain(before.moving_bodies), plain(before.joint_motions)
    return SceneChange(
        {name: part for name, part in parts.items() if part is not old_parts[name]},
        {name: body for name, body in bodies.items() if body is not old_bodies[name]},
        after.hardware[len(before.hardware) :],
        {name: motion for name, motion in motions.items() if motion is not old_motions.get(name)},
    )


@final
@dataclass(frozen=True)
class _Result(Generic[T]):
    """What was worked out, what was read meanwhile, and the key of what that was."""

    value: T
    reads: Reads
    seen: bytes


@final
@dataclass
class _Results(Generic[T]):
    """The last results of one moving body; not a value."""

    kept: list[_Result[T]] = field(default_factory=list)

    def found(self, scene: Scene) -> _Result[T] | None:
        """Returns the result that holds in a scene, None where there is none."""
        return next((one for one in self.kept if seen(one.reads, scene) == one.seen), None)

    def keep(self, result: _Result[T]) -> None:
        """Keeps a result as the first; the oldest goes."""
        self.kept = [result, *(one for one in self.kept if one is not result)][:MOST_KNOWN]


def worked_out(name: str, work: Callable[[Scene], T], moving: str, scene: Scene, cache: Cache, *given: object) -> T:
    """Returns what `work` finds about a moving body in a scene, or what it found where it read the same.

    Args:
        name: what the results are kept under.
        work: what works it out; besides the scene it must depend on nothing but what is given.
        moving: the id of the moving body.
        scene: the scene.
        cache: what keeps results.
        given: all else that the result depends on.
    """
    if not cache.keeps:
        return work(scene)
    whole = (scene.extent, scene.floor, scene.behind)
    own = (scene.moving_bodies[moving], scene.body_parts(moving), scene.body_hardware(moving))
    results = cast(_Results[T], cache.value(f"known {name}", lambda *_: _Results[Any](), *given, whole, own))
    result = results.found(scene)
    if result is None:
        cache.count(name)
        with Noting() as reads:
            value = work(_noted(scene))
        result = _Result(value, reads, seen(reads, scene))
    results.keep(result)
    return result.value


def _noted(scene: Scene) -> Scene:
    """Returns the same scene, in which what is read by name is noted."""
    return replace(
        scene,
        parts=Noted(Read.PARTS, scene.parts),
        moving_bodies=Noted(Read.MEMBERS, scene.moving_bodies),
        joint_motions=Noted(Read.MOTIONS, scene.joint_motions),
    )


def seen(reads: Reads, scene: Scene) -> bytes:
    """Returns the key of what a scene holds of all that was read: equal where reading finds the same.

    The order of static parts counts; that of hardware and of moving bodies changes no result.
    """
    still = [part for part in scene.still_parts if len(part.mesh.faces)]
    rigid = [visual for owner, visual in scene.hardware if not owner and visual.swing is None]
    rigid.sort(key=lambda visual: visual.name)
    bodies = sorted(scene.moving_bodies)
    pieces = [(name, piece) for name in bodies for piece in _rigid_pieces(name, scene)]
    around = [scene.body_box(name) for name in bodies]
    moving = [name for name in bodies if name in scene.joint_motions]
    paths = [path_box_of(name, scene, scene.joint_motions[name]) for name in moving]
    return content_key((
        _met(reads, Read.STILL, still, [part.box for part in still]),
        _met(reads, Read.HARDWARE, rigid, [visual.mesh.box for visual in rigid]),
        _met(reads, Read.BODIES, pieces, [piece.mesh.box for _, piece in pieces]),
        _met(reads, Read.BOXES, list(zip(bodies, around, strict=True)), around),
        tuple((_body(name, scene), scene.joint_motions[name]) for name in _met(reads, Read.PATHS, moving, paths)),
        _named(reads, Read.PARTS, scene.parts),
        _named(reads, Read.MEMBERS, scene.moving_bodies),
        _named(reads, Read.MOTIONS, scene.joint_motions),
    ))  # fmt: skip


def _rigid_pieces(name: str, scene: Scene) -> list[Part | Visual]:
    """Returns what of a moving body has faces, and its hardware, without what turns on its own pin."""
    rigid = (visual for visual in scene.body_hardware(name) if visual.swing is None)
    pieces: list[Part | Visual] = [*scene.body_parts(name), *rigid]
    return [piece for piece in pieces if len(piece.mesh.faces)]


def _body(name: str, scene: Scene) -> tuple[object, ...]:
    return name, scene.body_parts(name), scene.body_hardware(name)


def _met(reads: Reads, kind: Read, things: list[T], boxes: list[Box]) -> tuple[T, ...]:
    """Returns those things of a kind that were read, in order."""
    lows, highs = np.reshape([b.low for b in boxes], (-1, 3)), np.reshape([b.high for b in boxes], (-1, 3))
    return tuple(things[k] for k in np.flatnonzero(reads.met(kind, lows, highs)))


def _named(reads: Reads, kind: Read, mapping: Mapping[str, T]) -> tuple[int, tuple[tuple[str, T | None], ...]]:
    """Returns the length of a mapping, if it was counted, and what was read of it by name, or all of it in order."""
    names = mapping if kind in reads.whole else reads.names(kind)
    count = len(mapping) if kind in reads.counted else 0
    return count, tuple((name, mapping.get(name)) for name in names)
