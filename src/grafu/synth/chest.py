"""Chests: a box whose lid turns about its back edge."""

from dataclasses import dataclass, replace
from math import radians
from typing import final

from grafu.asset.part import Asset
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.synth.assembly import Motion, Piece, assemble
from grafu.synth.carcass import case_pieces
from grafu.synth.case import Case
from grafu.synth.construction import Top
from grafu.synth.finish import PLAIN, Finish, surface_of
from grafu.synth.shapes import board
from grafu.vocabulary import JointType, PartLabel

LOW_BOX = Case(width=1.0, height=0.45, depth=0.5, top=Top("none"))


@final
@dataclass(frozen=True, slots=True)
class Chest:
    """A chest, metres: a box that a front board and a lid close.

    The lid lies `seat` above the box and juts out by `overhang` at the front and the sides.
    """

    name: str = "chest"
    box: Case = LOW_BOX
    lid: float = 0.02
    seat: float = 0.001
    overhang: float = 0.015
    opening: float = radians(95)
    finish: Finish = PLAIN


def make_chest(spec: Chest) -> Asset:
    """Returns the chest with its lid's true joint; a top that the box had is left away."""
    box = replace(spec.box, top=Top("none"))
    x, y, o = box.width / 2, box.depth / 2, spec.overhang
    front = board((box.panel - x, -y, box.floor + box.panel), (x - box.panel, box.panel - y, box.height))
    low = box.height + spec.seat
    lid = board((-x - o, -y - o, low), (x + o, y, low + spec.lid))
    pin = Axis(vec3(0.0, y, low), vec3(-1.0, 0.0, 0.0))
    pieces = [
        *case_pieces(box, spec.finish, -y),
        Piece(PartLabel.SIDE_PANEL, "front_panel", (surface_of(front, spec.finish.case),)),
        Piece(
            PartLabel.DOOR,
            "lid",
            (surface_of(lid, spec.finish.front),),
            Motion(JointType.REVOLUTE, pin, spec.opening),
        ),
    ]
    return assemble(spec.name, pieces)
