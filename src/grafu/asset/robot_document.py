"""A robot described in another format, written as URDF elements: what MJCF, SDF and OpenUSD share. It reads no files.

Readers state each link and each visual by its pose in the world with every joint at zero; links, joints, materials and
shapes are then read as those of a URDF. Where a reader has surfaces and no files, it states them in the world.
"""

from collections.abc import Iterable, Mapping
from dataclasses import field
from pathlib import Path
from typing import Any, final

import numpy as np
from lxml import etree

from grafu.asset.bodies import annotation_of_bodies, drafts_of_visuals
from grafu.asset.drafts import parts_of_drafts
from grafu.asset.link_groups import with_links_as_groups
from grafu.asset.options import Division
from grafu.asset.part import AssetKind
from grafu.asset.reading import Convention, Reading
from grafu.asset.resources import ModelFiles
from grafu.asset.urdf import bodies_of_robot
from grafu.asset.urdf_shapes import MADE
from grafu.dataclass import dataclass
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Mat4
from grafu.geometry.transform import invert, roll_pitch_yaw

_LARGEST = 1e12  # metres: products with the sizes of meshes stay finite


@final
@dataclass(frozen=True)
class RobotJoint:
    """A joint between two links, named by a URDF's word for its type; its frame is that of its child link.

    Without `limits` (radians or metres, the drawn pose is 0) it is not limited. `mimic` is another joint's name with
    multiplier and offset.
    """

    name: str
    type: str
    parent: str
    child: str
    axis: Iterable[float] = (0.0, 0.0, 1.0)
    limits: tuple[float, float] | None = None
    mimic: tuple[str, float, float] | None = None


@final
@dataclass
class RobotDocument:
    """The elements while they are gathered. Not a value."""

    path: Path
    notes: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._robot: Any = etree.Element("robot")
        self._links: dict[str, tuple[Any, Mat4]] = {}
        self._made: list[tuple[Surface, ...]] = []

    def add_link(self, name: str, T_world_link: Mat4) -> None:
        """Adds a link; its pose is the frame of the joint above it."""
        self._links[name] = etree.SubElement(self._robot, "link", name=name), self._finite(T_world_link)

    def add_visual(
        self,
        link: str,
        name: str,
        T_world_visual: Mat4,
        shape: tuple[str, Mapping[str, str]],
        color: Iterable[float] | None = None,
        texture: str = "",
    ) -> None:
        """Adds a visual to a link that was added.

        Args:
            link: the link.
            name: its name.
            T_world_visual: its pose.
            shape: the element that a URDF has for it (`box`) and its attributes.
            color: red, green, blue and opacity, 0..1; None leaves a mesh its own materials.
            texture: an image's name as the model states it.
        """
        element, T_world_link = self._links[link]
        visual = etree.SubElement(element, "visual", name=name)
        self._add_origin(visual, invert(T_world_link) @ self._finite(T_world_visual))
        tag, attributes = shape
        etree.SubElement(etree.SubElement(visual, "geometry"), tag, dict(attributes))
        if color is None and not texture:
            return
        material = etree.SubElement(visual, "material")
        etree.SubElement(material, "color", rgba=spaced((1.0, 1.0, 1.0, 1.0) if color is None else color))
        if texture:
            etree.SubElement(material, "texture", filename=texture)

    def add_surfaces(self, link: str, name: str, surfaces: tuple[Surface, ...]) -> None:
        """Adds a visual to a link that was added: surfaces in the coordinates of the world."""
        self.add_visual(link, name, np.eye(4), (MADE, {"number": str(len(self._made))}))
        self._made.append(surfaces)

    def add_joint(self, joint: RobotJoint) -> None:
        """Adds a joint between links that were added.

        Raises:
            UnreadableAsset: if one of them was not.
        """
        for end in (joint.parent, joint.child):
            if end not in self._links:
                raise UnreadableAsset(f"{self.path}: joint {joint.name!r} names {end!r}, which is not there; add it")
        element = etree.SubElement(self._robot, "joint", name=joint.name, type=joint.type)
        etree.SubElement(element, "parent", link=joint.parent)
        etree.SubElement(element, "child", link=joint.child)
        self._add_origin(element, invert(self._links[joint.parent][1]) @ self._links[joint.child][1])
        etree.SubElement(element, "axis", xyz=spaced(joint.axis))
        if joint.limits is not None:
            lower, upper = joint.limits
            etree.SubElement(element, "limit", lower=repr(float(lower)), upper=repr(float(upper)))
        if joint.mimic is not None:
            leader, multiplier, offset = joint.mimic
            about = {"joint": leader, "multiplier": repr(float(multiplier)), "offset": repr(float(offset))}
            etree.SubElement(element, "mimic", about)

    def reading(self, kind: AssetKind, convention: Convention, files: ModelFiles, division: Division) -> Reading:
        """Returns the model in the coordinates of the link that was added first; what hangs on no joint stands on it.

        Raises:
            UnreadableAsset: if the joints do not form a tree, or no shape could be read.
            AssetTooLarge: if it has more of something than the limits allow.
        """
        moved = {joint.find("child").get("link") for joint in self._robot.findall("joint")}
        world, *others = self._links
        for link in others:
            if link not in moved:
                self.add_joint(RobotJoint(f"{link} stands", "fixed", world, link))
        found = bodies_of_robot(self._robot, self.path, files, made=self._made)
        parts = parts_of_drafts(drafts_of_visuals(with_links_as_groups(found.visuals, found.base, division)))
        up = "XYZ".index(convention.up[1]) if convention.up else 2
        annotation = annotation_of_bodies(list(found.bodies), up)
        return Reading(kind, parts, convention, annotation, notes=tuple(dict.fromkeys((*self.notes, *found.notes))))

    def _add_origin(self, element: Any, T: Mat4) -> None:
        etree.SubElement(element, "origin", xyz=spaced(T[:3, 3]), rpy=spaced(roll_pitch_yaw(T[:3, :3])))

    def _finite(self, T: Mat4) -> Mat4:
        if not np.abs(T).max() < _LARGEST:
            raise UnreadableAsset(f"{self.path} holds poses that no furniture has: expected finite numbers in metres")
        return T


def spaced(values: Iterable[float]) -> str:
    """Returns numbers as an attribute holds them, exact."""
    return " ".join(repr(float(value)) for value in values)
