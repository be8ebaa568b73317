"""What goes into a USD file. It imports nothing of OpenUSD."""

from dataclasses import dataclass, field
from typing import final

from grafu.articulation.physics import PhysicsConfig
from grafu.export.shading import CREASE_ANGLE


@final
@dataclass(frozen=True, slots=True)
class UsdConfig:
    """What goes into a USD file.

    `physx` adds what only PhysX reads (Isaac Sim, Omniverse): dry friction, greatest velocity and armature of joints;
    others ignore it. `armature` is a fraction of the inertia (or mass) that a joint moves.
    """

    physics: PhysicsConfig = field(default_factory=PhysicsConfig)
    crease_angle: float = CREASE_ANGLE
    physx: bool = True
    armature: float = 0.01

    def __post_init__(self) -> None:
        if not self.armature >= 0:
            raise ValueError(f"`UsdConfig.armature` must not be negative: got {self.armature}")
