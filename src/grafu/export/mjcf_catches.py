"""The catches of doors and drawers, as MuJoCo has them: on each joint an actuator that no control input changes.

MuJoCo's springs pull harder the further a joint is open, and a catch does not. An actuator's force may be a straight
line over the joint's value, and is clipped: constant near closed, then falling to zero, and zero beyond.
"""

import xml.etree.ElementTree as ET
from collections.abc import Mapping
from typing import Final, final

from grafu.articulation.articulated_object import Joint
from grafu.articulation.physics import PhysicsModel
from grafu.export.names import number, numbers

CATCH_CLASS: Final = "catch"


@final
class MjcfCatches:
    """The catches of one object; `names` are what its joints are called."""

    def __init__(self, joints: tuple[Joint, ...], physics: PhysicsModel, names: Mapping[str, str]) -> None:
        caught = ((joint, physics.dynamics[joint.id].catch) for joint in joints if joint.limits.range > 0)
        self._catches = [(names[joint.id], catch) for joint, catch in caught if catch is not None]

    def __len__(self) -> int:
        return len(self._catches)

    def add_defaults(self, top: ET.Element, group: str) -> None:
        """Adds the class of such actuators: their control input counts for nothing."""
        if self._catches:
            made = ET.SubElement(top, "default", {"class": CATCH_CLASS})
            ET.SubElement(made, "general", group=group, gainprm="0", biastype="affine")

    def add_actuators(self, actuators: ET.Element) -> None:
        """Adds an actuator for each catch."""
        for joint, catch in self._catches:
            law = {
                "biasprm": numbers([-catch.slope * catch.end, catch.slope, 0.0]),
                "forcerange": f"{number(-catch.effort)} 0",
            }
            names = {"class": CATCH_CLASS, "name": f"{joint}_catch", "joint": joint}
            ET.SubElement(actuators, "general", names | law)
