"""Interiors of furniture that stands turned about Z: furnished in the frame that its walls follow, then turned back.

One frame serves the whole piece. Where most walls follow the axes, rooms askew to them are furnished as boxes along the
axes, or not at all.
"""

from collections.abc import Mapping, Sequence
from dataclasses import field, replace
from typing import final

from grafu.additions.interior.compartments import Compartment, find_compartments
from grafu.additions.interior.config import InteriorConfig
from grafu.additions.interior.furnish import Furnished, furnish
from grafu.additions.interior.request import NO_CHOICES, CompartmentChoice, InteriorKind, InteriorRequest
from grafu.additions.step import PanelHint, StepRequest, StepResult
from grafu.articulation.articulated_object import Visual
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat4, vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import heading_of
from grafu.geometry.transform import from_rotation, invert, rotation_matrix, transform_points
from grafu.scene.scene import Scene

LEAST_STRAIGHT = 0.2
"""Fraction of the upright area along a direction and across it at least: a round piece follows none."""


@final
@dataclass(frozen=True)
class InteriorChoice:
    """What all compartments get, in which sizes, and by number what single ones get instead."""

    request: InteriorRequest
    sizes: InteriorConfig = InteriorConfig()
    compartments: Mapping[int, CompartmentChoice] = field(default_factory=dict)


def add_panels(scene: Scene, request: StepRequest, choice: InteriorChoice) -> StepResult:
    """Returns the scene with shelves and dividers as chosen; predicted ones are those of the request."""
    hints = request.panels if choice.request.kind is InteriorKind.PREDICTED else ()
    wants_nothing = choice.request.kind is InteriorKind.NONE
    if (wants_nothing or (choice.request.kind is InteriorKind.PREDICTED and not hints)) and not choice.compartments:
        return StepResult(scene)
    made = furnish_scene(scene, choice.request, choice.sizes, hints, choice.compartments)
    return StepResult(
        scene.with_parts(addition.part for addition in made.additions), made.additions, refusals=made.refused
    )


def furnish_scene(
    scene: Scene,
    request: InteriorRequest,
    config: InteriorConfig = InteriorConfig(),
    hints: Sequence[PanelHint] = (),
    chosen: Mapping[int, CompartmentChoice] = NO_CHOICES,
) -> Furnished:
    """Returns shelves and dividers for all compartments of a scene whose joints are built, however it stands turned.

    `hints` are what the completed graph expects; only `predicted` requests use them. `chosen` holds by number, in the
    order of `compartments_of`, those that get something of their own.
    """
    T, straight = _straight(scene)
    if straight is scene:
        return furnish(find_compartments(scene, config), request, scene, config, hints, chosen)
    expected = [replace(h, box=Box.around(transform_points(T, h.box.corners()))) for h in hints]
    found = furnish(find_compartments(straight, config), request, straight, config, expected, chosen)
    back = invert(T)
    return replace(found, additions=tuple(replace(a, part=_part(a.part, back)) for a in found.additions))


def compartments_of(scene: Scene, config: InteriorConfig = InteriorConfig()) -> tuple[tuple[Compartment, ...], Mat4]:
    """Returns the compartments of a scene in the frame that its walls follow, and the motion back into the object's."""
    T, straight = _straight(scene)
    return find_compartments(straight, config), invert(T)


def _straight(scene: Scene) -> tuple[Mat4, Scene]:
    """Returns the turn into the frame that the walls follow, and the scene in it (itself where it stands straight)."""
    return scene.once(_straightened)


def _straightened(scene: Scene) -> tuple[Mat4, Scene]:
    angle = heading_of((part.mesh for part in scene.static_parts), least=LEAST_STRAIGHT)
    T = from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), -angle))
    return T, _turned(scene, T) if angle else scene


def _turned(scene: Scene, T: Mat4) -> Scene:
    return Scene(
        {name: _part(part, T) for name, part in scene.parts.items()},
        scene.moving_bodies,
        scene.extent,
        tuple((owner, _visual(visual, T)) for owner, visual in scene.hardware),
        {
            moving: replace(joint_motion, axis=joint_motion.kind.mapped_axis(joint_motion.axis, T))
            for moving, joint_motion in scene.joint_motions.items()
        },
    )


def _part(part: Part, T: Mat4) -> Part:
    return replace(part, surfaces=tuple(surface.transformed(T) for surface in part.surfaces))


def _visual(visual: Visual, T: Mat4) -> Visual:
    return replace(visual, surfaces=tuple(surface.transformed(T) for surface in visual.surfaces))
