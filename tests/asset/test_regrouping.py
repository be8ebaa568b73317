"""Parts that are joined and split by hand: no face is lost, names of parts follow, and what cannot be is an error."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.asset.part import AnnotatedJoint, Annotation, Asset, Part, PartSource
from grafu.asset.regrouping import Regroup, Regrouping, regrouped
from grafu.errors import OptionError
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.pipeline.settings import Settings, settings_from_json
from grafu.vocabulary import JointType, PartLabel

AXIS = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0))


def cube(x: float, side: float = 0.2) -> TriangleMesh:
    return TriangleMesh.box_mesh(Box(vec3(x, 0.0, 0.0), vec3(x + side, side, side)))


def part(name, *meshes, label=PartLabel.MISC, by="name", on=None) -> Part:
    return Part(name, label, tuple(map(Surface, meshes)), PartSource("", name), by, on)


def joint(name) -> AnnotatedJoint:
    return AnnotatedJoint(name, JointType.REVOLUTE, AXIS, 0.0, 1.0)


DOOR = part("door", merge_meshes([cube(0.0, 0.3), cube(1.0)]), cube(2.0), label=PartLabel.DOOR)
HANDLE = part("handle", cube(3.0), label=PartLabel.HANDLE, on="flap")
FLAP = part("flap", cube(4.0), label=PartLabel.DOOR)
PARTS = (DOOR, HANDLE, FLAP, part("door_2", cube(5.0)))
ASSET = Asset("made", "", "made", PARTS, annotation=Annotation(PARTS, (joint("door"), joint("flap"))))


def join(*names) -> Regrouping:
    return Regrouping(Regroup.JOIN, names)


def split(name) -> Regrouping:
    return Regrouping(Regroup.SPLIT, (name,))


def corners(asset) -> np.ndarray:
    found = np.concatenate([one.mesh.triangles.reshape(-1, 9) for one in asset.parts])
    return found[np.lexsort(found.T)]


def test_what_is_joined_is_one_part_and_what_rode_on_it_rides_on_that():
    made = regrouped(ASSET, [join("door", "flap")])
    assert [one.id for one in made.parts] == ["door", "handle", "door_2"]
    assert made.part("handle").carried_by == "door"
    assert made.part("door").label is PartLabel.DOOR
    assert made.annotation is not None
    assert [one.part for one in made.annotation.joints] == ["door"]
    assert made.notes == ("flap joined to door by hand",)


def test_a_part_that_is_joined_with_what_carries_it_rides_on_nothing():
    made = regrouped(ASSET, [join("handle", "flap")])
    assert made.part("handle").carried_by is None


def test_shells_get_ids_of_their_own_and_the_largest_stays_what_it_was():
    made = regrouped(ASSET, [split("door")])
    assert [one.id for one in made.parts] == ["door", "door_3", "door_4", "handle", "flap", "door_2"]
    assert made.part("door").box.size[0] == pytest.approx(0.3)
    assert [made.part(name).label for name in ("door", "door_3")] == [PartLabel.DOOR, PartLabel.UNKNOWN]
    assert made.annotation is not None
    assert [one.id for one in made.annotation.parts] == [one.id for one in made.parts]
    assert [one.part for one in made.annotation.joints] == ["door", "flap"]


def test_what_is_left_of_a_part_stays_what_it_was_taken_for_where_the_input_states_no_category():
    parts = (replace(DOOR, label=PartLabel.UNKNOWN, labelled_by="none"), HANDLE, FLAP)
    nameless = replace(ASSET, parts=parts, annotation=None)
    made = regrouped(nameless, [replace(split("door"), category=PartLabel.DRAWER)])
    labels = {one.id: (one.label, one.labelled_by) for one in made.parts}
    assert labels["door"] == (PartLabel.DRAWER, "prediction")
    assert labels["door_2"] == (PartLabel.UNKNOWN, "none")
    stated = regrouped(ASSET, [replace(split("door"), category=PartLabel.DRAWER)])
    assert (stated.part("door").label, stated.part("door").labelled_by) == (PartLabel.DOOR, "name")


@given(st.permutations(["handle", "flap", "door_2"]), st.booleans())
def test_no_face_is_lost_and_what_is_split_can_be_joined_again(others, is_split):
    made = regrouped(ASSET, [*([split("door")] if is_split else []), join("door", *others)])
    np.testing.assert_array_equal(corners(made), corners(ASSET))
    again = regrouped(ASSET, [split("door"), join("door", "door_3", "door_4")])
    np.testing.assert_array_equal(corners(again), corners(ASSET))
    assert [one.id for one in again.parts] == [one.id for one in ASSET.parts]


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (join("door", "flop"), r"has no flop.*flap"),
        (split("nothing"), "has no nothing"),
        (split("flap"), "one connected"),
    ],
)
def test_what_cannot_be_is_told_in_one_line(change, told):
    with pytest.raises(OptionError, match=told):
        regrouped(ASSET, [change])


def test_what_is_joined_ends_for_what_follows():
    with pytest.raises(OptionError, match="has no flap"):
        regrouped(ASSET, [join("door", "flap"), join("handle", "flap")])


@pytest.mark.parametrize(("do", "parts"), [("join", ("a",)), ("join", ("a", "a")), ("split", ("a", "b"))])
def test_a_change_checks_itself(do, parts):
    with pytest.raises(ValueError, match="part"):
        Regrouping(Regroup(do), parts)


def test_settings_hold_the_changes_in_order_and_forget_what_was_chosen_of_parts_that_end():
    chosen = Settings().with_label("flap", PartLabel.MISC).with_label("door", PartLabel.DRAWER)
    made = chosen.with_regrouping(split("door")).with_regrouping(join("door", "flap"))
    assert made.labels == {"door": PartLabel.DRAWER}
    assert settings_from_json(made.to_json()) == made
    assert made.to_json()["regrouped"] == [
        {"do": "split", "parts": ["door"], "lasso": None, "category": None},
        {"do": "join", "parts": ["door", "flap"], "lasso": None, "category": None},
    ]


@pytest.mark.parametrize(
    "stated", [{"do": "melt", "parts": ["a"]}, {"do": "join", "parts": ["a"]}, {"do": "split", "parts": ["a"], "at": 1}]
)
def test_a_damaged_change_is_refused(stated):
    with pytest.raises(OptionError, match="setting `regrouped"):
        settings_from_json({"schema": "grafu.settings/1", "regrouped": [stated]})
