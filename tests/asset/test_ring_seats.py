"""The seat of a toilet is a ring that is named a seat; seats of chairs are closed, and rings of other names stay."""

from dataclasses import replace

import numpy as np
import pytest
import shapely
import trimesh

from grafu.asset.labels import label_of
from grafu.asset.part import Part, PartSource
from grafu.asset.ring_seats import with_ring_seats
from grafu.geometry.appearance import Surface
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import PartLabel


def plate(name: str, hole: float, thick: float = 0.02, shift: float = 0.0) -> Part:
    outline = shapely.Point(0, 0).buffer(0.2)
    if hole:
        outline = outline.difference(shapely.Point(0, shift).buffer(hole))
    made = trimesh.creation.extrude_polygon(outline, thick)
    mesh = TriangleMesh(np.asarray(made.vertices, float), np.asarray(made.faces, int))
    return Part(name, label_of(name), (Surface(mesh),), PartSource(name), "none")


def label(part: Part) -> PartLabel:
    (found,) = with_ring_seats((part,))
    return found.label


@pytest.mark.parametrize("name", ["seat-11", "toilet_seat", "Seat.001"])
def test_a_ring_that_is_named_a_seat_is_hinged(name):
    assert label(plate(name, 0.12, shift=0.02)) is PartLabel.DOOR


@pytest.mark.parametrize(
    "part",
    [
        plate("seat-11", 0.0),
        plate("seat-11", 0.02),
        plate("seat_frame", 0.12),
        plate("ring-11", 0.12),
        plate("seat-11", 0.12, thick=0.3),
        plate("seat-11", 0.195),
    ],
    ids=["the seat of a chair", "a small hole in it", "a frame", "no seat", "a tube", "a hoop"],
)
def test_others_stay_as_they_are(part):
    assert label(part) is part.label


def test_what_the_user_labels_stays():
    assert label(replace(plate("seat-11", 0.12), label=PartLabel.MISC, labelled_by="user")) is PartLabel.MISC
