"""A reading's parts and its annotation, mapped to the object frame. It decides nothing."""

from dataclasses import replace

import numpy as np

from grafu.asset.attached_parts import with_attached
from grafu.asset.part import AnnotatedJoint, Annotation, Frame, Part
from grafu.geometry.appearance import Surface
from grafu.vocabulary import JointType


class Placing:
    """Maps what was read by one frame; a mesh that parts and annotation share is mapped once, and shared again."""

    def __init__(self, frame: Frame) -> None:
        self._frame = frame
        self._T = np.asarray(frame.input_to_output)
        self._made: dict[tuple[int, int], tuple[Surface, Surface]] = {}  # by ids, with what they are the ids of

    def parts(self, parts: tuple[Part, ...]) -> tuple[Part, ...]:
        """Returns parts in the object frame, handles riding on what they touch where nothing says on what."""
        placed = (replace(part, surfaces=tuple(map(self._surface, part.surfaces))) for part in parts)
        return with_attached(tuple(placed))

    def annotation(self, annotation: Annotation) -> Annotation:
        """Returns an annotation in the object frame, slides in metres."""
        joints = tuple(map(self._joint, annotation.joints))
        return replace(annotation, parts=self.parts(annotation.parts), joints=joints)

    def _surface(self, surface: Surface) -> Surface:
        key = id(surface.mesh), id(surface.material)
        if key not in self._made:
            self._made[key] = surface, surface.transformed(self._T)
        return replace(self._made[key][1], name=surface.name)

    def _joint(self, joint: AnnotatedJoint) -> AnnotatedJoint:
        axis = joint.axis.transformed(self._T, rotational=joint.type is JointType.REVOLUTE)
        metres = self._frame.scale if joint.type is JointType.PRISMATIC else 1.0
        return replace(joint, axis=axis, lower=joint.lower * metres, upper=joint.upper * metres)
