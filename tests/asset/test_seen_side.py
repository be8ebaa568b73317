from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.frame import front_is_assumed, settle_frame, whole_box
from grafu.asset.options import LoadOptions
from grafu.asset.part import Part
from grafu.asset.reading import Convention, Reading
from grafu.asset.seen_side import most_shown_side
from grafu.asset.standing import vector
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.vocabulary import PartLabel
from small_scenes import box

URDF = Convention("URDF", up="+Z")
FRONTS = ("-Y", "+Y", "-X", "+X")


def nameless_cabinet(front: str) -> tuple[Part, ...]:
    """Returns the parts of a cabinet without names whose front is this direction of the input, Z up.

    A hook at its back keeps the handles from being the only parts that stand out of it.
    """
    cabinet = make_cabinet(Cabinet()).parts
    rear = float(whole_box(cabinet).high[1])
    hook = box("hook", (0.0, rear, 0.5), (0.02, rear + 0.02, 0.52))
    f = vector(front)
    T = np.eye(4)
    T[:3, :3] = np.column_stack([np.cross(-f, [0.0, 0.0, 1.0]), -f, [0.0, 0.0, 1.0]])
    return tuple(
        Part(f"Cube.{k}", PartLabel.UNKNOWN, tuple(s.transformed(T) for s in part.surfaces), part.source, "none")
        for k, part in enumerate((*cabinet, hook))
    )


@pytest.mark.parametrize("front", FRONTS)
def test_the_front_of_nameless_parts_is_the_side_that_shows_most_of_them(front):
    parts = nameless_cabinet(front)
    frame = settle_frame(Reading("urdf", parts, URDF), LoadOptions())
    assert frame.front == front
    assert frame.assumed[1] == f"front is {front}: most parts, and steps between them, are seen there"


def test_a_format_that_states_a_front_is_overruled_by_a_clear_one_alone():
    parts = nameless_cabinet("-Y")
    stated = Reading("glb", parts, replace(URDF, front="+X"))
    assert settle_frame(stated, LoadOptions()).front == "-Y"
    # two plates in front and two behind, which are less alike
    sides = [box(f"{k}", low, high) for k, (low, high) in enumerate(BOX)]
    assert most_shown_side(sides, whole_box(tuple(sides)), "+Z", is_stated=False) == "-Y"
    assert most_shown_side(sides, whole_box(tuple(sides)), "+Z", is_stated=True) is None


BOX = (
    ((-0.5, -0.5, 0.0), (0.5, 0.4, 1.0)),
    ((-0.5, -0.52, 0.0), (0.0, -0.5, 1.0)),
    ((0.0, -0.53, 0.0), (0.5, -0.5, 1.0)),
    ((-0.5, 0.4, 0.0), (0.22, 0.42, 1.0)),
    ((0.22, 0.4, 0.0), (0.5, 0.41, 1.0)),
)


def test_what_a_format_alone_states_of_the_front_is_no_evidence():
    alike = tuple(box(f"p{k}", (-0.5, -0.5, 0.3 * k), (0.5, 0.5, 0.3 * k + 0.02)) for k in range(4))
    labelled = tuple(replace(p, label=PartLabel.DOOR) if p.id == "door" else p for p in (*alike, box("door", *DOOR)))
    stated = replace(URDF, front="-Y")
    for parts, kind, is_assumed in (
        (alike, "glb", True),
        (alike, "partnet-mobility", False),
        (labelled, "glb", False),
        (nameless_cabinet("-Y"), "glb", False),
    ):
        frame = settle_frame(Reading(kind, parts, stated), LoadOptions())
        assert (frame.front, front_is_assumed(frame)) == ("-Y", is_assumed)
    chosen = settle_frame(Reading("glb", alike, stated), LoadOptions(front="+X"))
    assert (chosen.front, front_is_assumed(chosen)) == ("+X", False)


DOOR = ((-0.5, -0.52, 0.0), (0.5, -0.5, 0.9))


@pytest.mark.parametrize("kind", ["partnet-mobility", "hssd"])
def test_models_of_data_sets_face_as_these_state(kind):
    parts = nameless_cabinet("-X")
    assert settle_frame(Reading(kind, parts, replace(URDF, front="+Y")), LoadOptions()).front == "+Y"


def test_a_description_in_the_form_of_a_data_set_that_states_no_front_is_looked_at():
    parts = nameless_cabinet("-X")
    assert settle_frame(Reading("partnet-mobility", parts, URDF), LoadOptions()).front == "-X"


def test_where_all_sides_look_alike_nothing_is_told():
    plates = [box(f"p{k}", (-0.5, -0.5, 0.3 * k), (0.5, 0.5, 0.3 * k + 0.02)) for k in range(4)]
    assert most_shown_side(plates, whole_box(tuple(plates)), "+Z", is_stated=False) is None
