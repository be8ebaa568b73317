"""The springs that carry lids and flaps, as MuJoCo has them: a tendon between a site on either body of the joint.

A tendon pulls the two bodies towards each other and nothing else, so that a piece keeps its weight; it is not shown.
"""

import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping
from typing import Final, final

from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.articulation.counterbalance import Counterbalance
from grafu.articulation.physics import PhysicsModel
from grafu.export.names import number, numbers
from grafu.geometry.arrays import Vec3

SPRING_CLASS: Final = "counterbalance"


@final
class MjcfSprings:
    """The springs of one object; `names` are what its joints are called."""

    def __init__(self, articulated: ArticulatedObject, physics: PhysicsModel, names: Mapping[str, str]) -> None:
        held = [joint for joint in articulated.moving_joints if joint.limits.range > 0]
        springs = {joint.id: physics.dynamics[joint.id].counterbalance for joint in held}
        self._springs = [(joint, spring) for joint in held if (spring := springs[joint.id]) is not None]
        self._origins, self._names = physics.origins, names

    def add_sites(self, body: ET.Element, link: str) -> None:
        """Adds to the body of a link the points at which springs hold it."""
        for joint, spring in self._springs:
            for end, place in self._ends(joint, spring):
                if end == link:
                    at = numbers(place - self._origins[link])
                    ET.SubElement(body, "site", {"class": SPRING_CLASS, "name": self._site(joint, end), "pos": at})

    def add_tendons(self, model: ET.Element) -> None:
        """Adds a tendon for each spring."""
        if not self._springs:
            return
        element = ET.SubElement(model, "tendon")
        for joint, spring in self._springs:
            attributes = {"class": SPRING_CLASS, "name": f"{self._names[joint.id]}_counterbalance"}
            tendon = ET.SubElement(element, "spatial", attributes | {"stiffness": number(spring.stiffness)})
            for end, _ in self._ends(joint, spring):
                ET.SubElement(tendon, "site", site=self._site(joint, end))

    def _ends(self, joint: Joint, spring: Counterbalance) -> Iterable[tuple[str, Vec3]]:
        return (joint.parent, spring.anchor), (joint.child, spring.center)

    def _site(self, joint: Joint, end: str) -> str:
        return f"{self._names[joint.id]}_{'anchor' if end == joint.parent else 'held'}"


def add_spring_defaults(top: ET.Element, group: str) -> None:
    """Adds the class of such sites and tendons: in a group that is not shown, of zero free length."""
    made = ET.SubElement(top, "default", {"class": SPRING_CLASS})
    ET.SubElement(made, "site", group=group, size="0.005")
    ET.SubElement(made, "tendon", group=group, springlength="0")
