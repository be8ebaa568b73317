"""What may be added to furniture beside hinges and rails, and how it looks. It adds nothing."""

from collections.abc import Mapping
from dataclasses import field, replace
from typing import final

from grafu.additions.carcass.config import CarcassConfig
from grafu.additions.compartment.config import SolidBodyConfig
from grafu.additions.door_frame.config import DoorFrameConfig
from grafu.additions.drawer_box.config import DrawerBoxConfig
from grafu.additions.grip.config import GripConfig
from grafu.additions.handle.config import HandleChoice, HandleConfig
from grafu.additions.handle.grasp_config import GraspConfig
from grafu.additions.interior.config import InteriorConfig
from grafu.additions.interior.request import NOTHING, PREDICTED, CompartmentChoice, InteriorRequest
from grafu.additions.statics import Statics
from grafu.additions.top.config import TopConfig
from grafu.dataclass import dataclass
from grafu.visible import ShortRepr


@final
@dataclass(frozen=True)
class AdditionConfig(ShortRepr):
    """Each of None is not added.

    A front that cannot be grasped gets a handle, and where none fits a recessed grip; without `handles`, a grip at
    once.
    """

    statics: Statics = Statics.BOTH
    """Whether the completed graph, the geometry or both decide what is missing."""
    top: TopConfig | None = field(default_factory=TopConfig)
    replaces_top: bool = False
    """Whether an added top takes the place of one that is there."""
    solid_bodies: SolidBodyConfig | None = field(default_factory=SolidBodyConfig)
    """How compartments are cut into what is solid right behind doors and drawers."""
    door_frame: DoorFrameConfig | None = field(default_factory=DoorFrameConfig)
    """The frame of a door of a building that is drawn alone."""
    drawer_boxes: DrawerBoxConfig | None = field(default_factory=DrawerBoxConfig)
    carcass: CarcassConfig | None = None
    handles: HandleConfig | None = field(default_factory=HandleConfig)
    grips: GripConfig | None = field(default_factory=GripConfig)
    interior: InteriorRequest = PREDICTED
    interior_sizes: InteriorConfig = InteriorConfig()
    grasp: GraspConfig = GraspConfig()
    """What counts as room for fingers: such fronts need nothing."""
    fronts: Mapping[str, HandleChoice] = field(default_factory=dict)
    """By the id of a door or drawer, what it is grasped by instead."""
    compartments: Mapping[int, CompartmentChoice] = field(default_factory=dict)
    """By number, what a compartment gets instead."""
    rejected: frozenset[str] = frozenset()
    """Ids of added parts that are left out again."""

    @property
    def of_body(self) -> "AdditionConfig":
        """What of it is decided before joints are built; all else is nothing."""
        bare = replace(self, handles=None, grips=None, grasp=GraspConfig(), fronts={})
        return replace(bare, interior=NOTHING, interior_sizes=InteriorConfig(), compartments={})


NO_ADDITIONS = AdditionConfig(
    statics=Statics.GEOMETRY,
    top=None,
    solid_bodies=None,
    door_frame=None,
    drawer_boxes=None,
    handles=None,
    grips=None,
    interior=NOTHING,
)
"""Motions alone."""
