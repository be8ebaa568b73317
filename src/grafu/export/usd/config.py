"""What goes into a USD file. It imports nothing of OpenUSD."""

from dataclasses import field
from typing import final

from grafu.articulation.physics import PhysicsConfig
from grafu.dataclass import dataclass
from grafu.export.shading import CREASE_ANGLE


@final
@dataclass(frozen=True, slots=True)
class UsdConfig:
    """What goes into a USD file.

    `physx` adds what only PhysX reads (Isaac Sim, Omniverse): dry friction, greatest velocity and armature of joints;
    others ignore it. `armature` is a fraction of the inertia (or mass) that a joint moves.
    `static_friction`, `dynamic_friction` and `restitution` are those of all collision shapes: lacquered wood.
    """

    physics: PhysicsConfig = field(default_factory=PhysicsConfig)
    crease_angle: float = CREASE_ANGLE
    physx: bool = True
    armature: float = 0.01
    static_friction: float = 0.5
    dynamic_friction: float = 0.4
    restitution: float = 0.1

    def __post_init__(self) -> None:
        if not self.armature >= 0:
            raise ValueError(f"`UsdConfig.armature` must not be negative: got {self.armature}")
        if not (self.static_friction >= self.dynamic_friction >= 0 and 0 <= self.restitution <= 1):
            found = f"{self.static_friction}, {self.dynamic_friction} and {self.restitution}"
            raise ValueError(f"friction must be static >= dynamic >= 0, and restitution within 0..1: got {found}")
