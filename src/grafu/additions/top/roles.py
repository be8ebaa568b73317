"""What stands, what turns, what slides, each as it is when closed: the three things that a top means something else to.

It asks the plan, and the labels where the plan is silent.
"""

from collections.abc import Iterable, Sequence
from functools import cached_property
from typing import final

import numpy as np

from grafu.additions.closed_scene import closed_part
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.joints.plan import JointRequest
from grafu.scene.scale import floor_under
from grafu.shapes import Float
from grafu.vocabulary import PartLabel

COVERING_LABELS = (PartLabel.TOP_PANEL, PartLabel.SHELF)  # these cover whatever moves them


@final
@dataclass(frozen=True, eq=False)
class Closed:
    """A moving part with all that rides on it but handles, closed.

    `request` is None where only its label states that it moves.
    """

    id: str
    bodies: tuple[TriangleMesh, ...]
    slides: bool
    request: JointRequest | None = None

    @cached_property
    def mesh(self) -> TriangleMesh:
        """All of it as one mesh."""
        return merge_meshes(self.bodies)


@final
@dataclass(frozen=True, eq=False)
class Roles:
    """The parts of one piece of furniture by role; handles have none."""

    still: tuple[Part, ...]
    turning: tuple[Closed, ...]
    sliding: tuple[Closed, ...]

    @property
    def moving(self) -> tuple[Closed, ...]:
        """All that moves."""
        return (*self.turning, *self.sliding)

    @cached_property
    def box(self) -> Box:
        """The box around what stands (around everything, where nothing does)."""
        meshes = [p.mesh for p in self.still] or [m.mesh for m in self.moving]
        return Box.enclosing(mesh.box for mesh in meshes)

    @cached_property
    def floor(self) -> float:
        """The height of the floor, metres."""
        return floor_under([*(p.mesh for p in self.still), *(mesh for m in self.moving for mesh in m.bodies)])


def roles_of(parts: Sequence[Part], joints: Iterable[JointRequest], upright: float) -> Roles | None:
    """Returns the parts by role, moving bodies closed; None where nothing but handles has a face.

    What slides in a direction whose upright part is at least `upright` (ratio) covers what is below it.
    """
    known = {part.id: part for part in parts if len(part.mesh.faces)}
    asked = {joint.moving: joint for joint in joints if joint.moving in known}
    carried = {part for joint in asked.values() for part in joint.attached} - asked.keys()
    moving_bodies = [_closed(joint, known, upright) for joint in asked.values()]
    rest = [p for p in known.values() if p.id not in asked and p.id not in carried and p.carried_by is None]
    moving_bodies += [_labelled(p) for p in rest if p.label.is_movable]
    still = tuple(p for p in rest if not p.label.is_movable and p.label is not PartLabel.HANDLE)
    turning = tuple(m for m in moving_bodies if not m.slides)
    return Roles(still, turning, tuple(m for m in moving_bodies if m.slides)) if still or moving_bodies else None


def triangles_of(meshes: Iterable[TriangleMesh]) -> Float[np.ndarray, "n 3 3"]:
    """Returns all triangles of some meshes."""
    found = [mesh.triangles for mesh in meshes]
    return np.concatenate(found) if found else np.zeros((0, 3, 3))


def _labelled(part: Part) -> Closed:
    return Closed(part.id, (part.mesh,), part.label is PartLabel.DRAWER)


def _closed(joint: JointRequest, known: dict[str, Part], upright: float) -> Closed:
    """Returns what a joint moves, moved back to where it is closed."""
    members = [known[m] for m in (joint.moving, *joint.attached) if m in known]
    own = [p for p in members if p.id == joint.moving or p.label is not PartLabel.HANDLE]
    bodies = [closed_part(p, joint).mesh for p in own]
    level = abs(float(joint.axis.direction[2])) < upright
    covers = any(p.label in COVERING_LABELS for p in members)
    slides = joint.kind.slides and level and not covers
    return Closed(joint.moving, tuple(bodies), slides, joint)
