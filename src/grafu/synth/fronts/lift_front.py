"""Flaps that arms lift upright, with their true motions: arms that turn on the case, a flap that turns back on them."""

from collections.abc import Iterator
from math import atan2, cos, radians, sin
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import from_rotation, rotation_matrix, translation
from grafu.graph.edges import Hinge
from grafu.synth.fronts.gliding import Lift
from grafu.synth.fronts.handles import gripped_side, handle_pieces, held_along
from grafu.synth.fronts.layout import Cell
from grafu.synth.fronts.leaf_relief import LeafShape
from grafu.synth.fronts.leaves import leaf_surfaces
from grafu.synth.fronts.setting import Setting, front_rect, inner_span
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, plank, solid
from grafu.synth.pieces.shapes import board, rod
from grafu.vocabulary import PartLabel

ARM = (0.006, 0.018)  # metres: how thick and wide an arm is
HOUSING = (0.008, 0.05)  # metres: how far the housing on a wall stands out, and how far it reaches around the pivot
BRACKET = (0.006, 0.03)  # metres: how thick a bracket on the flap is, and how high
BEHIND = 0.02  # metres between the flap's inner face and its pivots
CLEAR = 0.001  # metres between housings, arms and brackets
ROD = (0.006, 0.5)  # metres and fraction of an arm's length: the radius of the rod that joins the arms, where it is
CLEAR_OF = 0.012  # metres between an arm's middle line and the edge of what is above the opening, when it is up
LEAST = radians(25)  # above the horizontal: arms that end lower hardly lift a flap
ROOM = 0.01  # metres between a housing and what is behind and above it


@final
@dataclass(frozen=True, slots=True)
class _Arms:
    """Where the arms run: the pivots on the case and on the flap, (y, z), the level range between them; metres.

    They turn by up to `upper`, radians.
    """

    on_case: tuple[float, float]
    on_flap: tuple[float, float]
    span: tuple[float, float]
    upper: float

    @property
    def length(self) -> float:
        """How long an arm is from pivot to pivot."""
        return float(np.hypot(self.on_flap[0] - self.on_case[0], self.on_flap[1] - self.on_case[1]))

    def at(self, x: float, pivot: tuple[float, float]) -> Vec3:
        """Returns a pivot at this x."""
        return vec3(x, *pivot)

    def axis(self, pivot: tuple[float, float], sense: float) -> Axis:
        """Returns the level line through the middle of a pair of pivots."""
        return Axis(self.at(sum(self.span) / 2, pivot), vec3(sense, 0.0, 0.0))


def lift_pieces(cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    """Yields the arms with the flap on them, and the housings that hold them.

    Raises:
        ValueError: if the case has no room for the arms.
    """
    lift = cell.leaf
    assert isinstance(lift, Lift)
    arms = _arms(lift, cell, setting)
    on_case = PieceMotion(Hinge.joint_type, arms.axis(arms.on_case, -1.0), arms.upper)
    flap = _flap(lift, arms, cell, setting)
    meshes = [_arm(arms, x) for x in (arms.span[0], arms.span[1] - ARM[0])]
    if lift.rod:
        (y0, z0), (y1, z1) = arms.on_case, arms.on_flap
        middle = y0 + ROD[1] * (y1 - y0), z0 + ROD[1] * (z1 - z0)
        meshes.append(rod(arms.at(arms.span[0], middle), arms.at(arms.span[1], middle), ROD[0], 8))
    made = solid(PartLabel.MISC, "lift_arms", setting.finish.metal, meshes)
    yield PieceDraft(made.label, made.stem, made.surfaces, on_case, (flap,))
    yield from _housings(arms, cell, setting)


def _arms(lift: Lift, cell: Cell, setting: Setting) -> _Arms:
    o, stand = cell.opening, HOUSING[0] + CLEAR
    length = lift.rise * o.height / (2 * sin(lift.angle))
    on_flap = setting.behind + BEHIND, o.z0 + lift.start * o.height
    on_case = on_flap[0] + length * cos(lift.angle), on_flap[1] + length * sin(lift.angle)
    reach = HOUSING[1] / 2 + ROOM
    if on_case[0] + reach > setting.back or on_case[1] + reach > o.z1 or o.width < 4 * reach:
        raise ValueError(f"the arms of a lift have no room: got a pivot at {on_case[0]:.3f}, {on_case[1]:.3f} m")
    up = min(lift.angle, atan2(o.z1 - on_case[1], on_case[0] - setting.plane + CLEAR_OF) - CLEAR_OF / length)
    if up < LEAST:
        raise ValueError(f"the arms of a lift hardly lift it: got {up:.2f} rad above the horizontal")
    return _Arms(on_case, on_flap, (o.x0 + stand, o.x1 - stand), lift.angle + up)


def _arm(arms: _Arms, x: float) -> TriangleMesh:
    """Returns the bar from one pivot to the other whose lower x is this; it reaches half its width beyond both."""
    (y0, z0), (y1, z1), half = arms.on_case, arms.on_flap, ARM[1] / 2
    flat = board((0.0, -half, -half), (ARM[0], arms.length + half, half))
    turn = from_rotation(rotation_matrix(vec3(1.0, 0.0, 0.0), float(np.arctan2(z1 - z0, y1 - y0))))
    return flat.transformed(translation(arms.at(x, arms.on_case)) @ turn)


def _flap(lift: Lift, arms: _Arms, cell: Cell, setting: Setting) -> PieceDraft:
    """Returns the flap, which follows the arms, with its handle and its two brackets."""
    rect, metal = front_rect(cell, setting), setting.finish.metal
    side = gripped_side(lift.hold, "top")
    grip = lift.grip, side, held_along(lift.hold, side)
    shape = LeafShape(lift.leaf, rect, setting.front, setting.thickness, "bottom", *grip)
    handle = handle_pieces(lift.handle, lift.hold, shape, "top", metal)
    y, z = arms.on_flap
    low, high = z - BRACKET[1] / 2, z + BRACKET[1] / 2
    inner = arms.span[0] + ARM[0] + CLEAR, arms.span[1] - ARM[0] - CLEAR
    ends = ((inner[0], inner[0] + BRACKET[0]), (inner[1] - BRACKET[0], inner[1]))
    brackets = [
        plank(PartLabel.MISC, "lift_bracket", metal, ((x0, setting.behind, low), (x1, y + BRACKET[0], high)))
        for x0, x1 in ends
    ]
    follows = PieceMotion(Hinge.joint_type, arms.axis(arms.on_flap, 1.0), arms.upper, follows=1.0)
    surfaces = leaf_surfaces(shape, setting.finish)
    return PieceDraft(PartLabel.DOOR, "door", surfaces, follows, (*handle, *brackets))


def _housings(arms: _Arms, cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    """Yields a plate on either wall, beside the pivot of its arm."""
    o, half = cell.opening, HOUSING[1] / 2
    low, high = inner_span(cell, setting)
    (y, z), front = arms.on_case, setting.inner + CLEAR
    for x0, x1 in ((low, o.x0 + HOUSING[0]), (o.x1 - HOUSING[0], high)):
        span = ((x0, max(y - half, front), z - half), (x1, y + half, z + half))
        yield plank(PartLabel.MISC, "lift_housing", setting.finish.metal, span)
