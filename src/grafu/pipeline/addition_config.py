"""What may be added to furniture beside hinges and rails, and how it looks. It adds nothing."""

from dataclasses import dataclass, field
from typing import final

from grafu.realization.carcass.config import CarcassConfig
from grafu.realization.drawer_box.config import DrawerBoxConfig
from grafu.realization.grip.config import GripConfig
from grafu.realization.handle.config import GraspConfig, HandleConfig
from grafu.realization.interior.config import InteriorConfig
from grafu.realization.interior.request import NOTHING, PREDICTED, InteriorRequest
from grafu.realization.top.config import TopConfig


@final
@dataclass(frozen=True)
class AdditionConfig:
    """Each of None is not added.

    A front that nobody can grasp gets a handle, and where none fits a recessed grip; without `handles`, a grip at once.
    """

    top: TopConfig | None = field(default_factory=TopConfig)
    drawer_boxes: DrawerBoxConfig | None = field(default_factory=DrawerBoxConfig)
    carcass: CarcassConfig | None = None
    handles: HandleConfig | None = field(default_factory=HandleConfig)
    grips: GripConfig | None = field(default_factory=GripConfig)
    interior: InteriorRequest = PREDICTED
    interior_sizes: InteriorConfig = InteriorConfig()
    grasp: GraspConfig = GraspConfig()
    """What counts as room for fingers: such fronts need nothing."""


NO_ADDITIONS = AdditionConfig(top=None, drawer_boxes=None, handles=None, grips=None, interior=NOTHING)
"""Motions alone."""
