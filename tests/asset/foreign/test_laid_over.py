"""Predictions laid over an asset: the frame is found, parts are reported by their places, joints come out as stated."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grafu.asset.foreign import agreement, matching
from grafu.asset.foreign.attach import attach_motions
from grafu.asset.foreign.frames import FrameGuess, quarter_turns
from grafu.asset.foreign.matching import match_parts
from grafu.asset.foreign.motions import ForeignJoint, ForeignMotions, ForeignPart
from grafu.asset.part import Asset, Frame
from grafu.errors import AssetError
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import rotation_matrix
from grafu.joints.make_plan import plan_from_annotation
from grafu.vocabulary import JointType, PartLabel
from predictions import cabinet, predicted, require_same_joints, reversed_joints, unlabelled, way
from sketches import board, door, drawer, handle, sketch

CABINET = cabinet()
TURNS = list(quarter_turns())
turns = st.sampled_from(TURNS)
offsets = st.tuples(*[st.floats(-5, 5).map(lambda v: round(v, 3))] * 3)


def test_there_are_24_quarter_turns() -> None:
    assert len({R.tobytes() for R in TURNS}) == 24
    assert all(np.linalg.det(R) > 0.5 for R in TURNS)
    assert [R[2, 2] for R in TURNS[:4]] == [1.0] * 4


@settings(max_examples=15)
@given(turns, st.sampled_from([0.01, 0.3, 1.0, 10.0, 1000.0]), offsets, st.booleans(), st.booleans())
def test_joints_come_back_from_any_frame(
    turn: np.ndarray, scale: float, offset: tuple[float, float, float], boxes: bool, backwards: bool
) -> None:
    foreign = predicted(CABINET, way(turn, scale, offset), boxes)
    found = attach_motions(CABINET, reversed_joints(foreign) if backwards else foreign)

    require_same_joints(found, CABINET, -1.0 if backwards else 1.0)
    assert {part.id: part.carried_by for part in found.parts} == {part.id: part.carried_by for part in CABINET.parts}


@pytest.mark.parametrize("scale", [0.0, 1e-120, 1e120, np.inf])
def test_frames_that_no_number_can_invert_are_passed_over(scale: float, monkeypatch: pytest.MonkeyPatch) -> None:
    found = matching.fitted_frames

    def with_a_useless_one(*args: Any) -> list[FrameGuess]:
        guesses = list(found(*args))
        T = np.diag([scale, scale, scale, 1.0])
        return [replace(guesses[0], T_object_foreign=T), *guesses]

    monkeypatch.setattr(matching, "fitted_frames", with_a_useless_one)

    require_same_joints(attach_motions(CABINET, predicted(CABINET, way(TURNS[5], 3.0, (1.0, 2.0, 0.5)))), CABINET)


@pytest.mark.parametrize("degrees", [12.0, 40.0, -77.0, 160.0])
def test_a_prediction_may_stand_askew(degrees: float) -> None:
    yaw = rotation_matrix(vec3(0.0, 0.0, 1.0), np.radians(degrees))
    for turn in (TURNS[0], TURNS[9]):
        found = attach_motions(CABINET, predicted(CABINET, way(turn @ yaw, 3.0, (1.0, 2.0, 0.5))))

        require_same_joints(found, CABINET)


def test_what_the_input_states_itself_is_not_read() -> None:
    foreign = predicted(CABINET, np.eye(4))
    only = replace(foreign, joints=foreign.joints[:1])
    found = attach_motions(CABINET, only)

    assert [joint.part for joint in found.joints] == ["door_left"]
    assert {joint.stated_by for joint in found.joints} == {"urdf"}
    plan = plan_from_annotation(found)
    assert [request.source for request in plan.joints] == ["urdf"]
    assert {refusal.part: refusal.why for refusal in plan.refused} == {
        "door_right": "urdf states no joint for it",
        "drawer": "urdf states no joint for it",
    }


def test_a_range_below_zero_opens_all_the_same() -> None:
    found = attach_motions(CABINET, reversed_joints(predicted(CABINET, np.eye(4))))

    assert all(joint.upper == 0.0 > joint.lower for joint in found.joints)
    for request, joint in zip(plan_from_annotation(found).joints, CABINET.joints, strict=True):
        np.testing.assert_allclose(request.axis.direction, joint.axis.direction, atol=1e-12)
        assert request.reference == pytest.approx(joint.upper)


def test_the_inputs_own_coordinates_come_before_a_turn_that_fits_as_well() -> None:
    symmetric = _two_sided()
    half_turn = way(np.diag([-1.0, -1.0, 1.0]))
    for T in (np.eye(4), half_turn):  # from the input to the object frame
        asset = replace(symmetric, frame=Frame(T, "+Z", "-Y", 1.0))
        found = attach_motions(asset, predicted(symmetric, np.linalg.inv(T)))

        require_same_joints(found, symmetric)


def test_labels_decide_between_turns_that_fit_alike() -> None:
    asset = replace(_two_sided(), frame=Frame(way(TURNS[7], 3.0), "+Z", "-Y", 1.0))
    for turn in (TURNS[0], np.diag([-1.0, -1.0, 1.0])):
        foreign = predicted(_two_sided(), way(turn, 0.4, (3.0, 1.0, 0.0)))

        require_same_joints(attach_motions(asset, foreign), _two_sided())


def test_without_labels_doors_open_to_the_front() -> None:
    asset = unlabelled(_two_sided())
    for turn in (TURNS[0], np.diag([-1.0, -1.0, 1.0])):
        found = attach_motions(asset, predicted(_two_sided(), way(turn, 0.4, (3.0, 1.0, 0.0))))

        require_same_joints(found, _two_sided())


def _two_sided() -> Asset:
    """Returns a box whose front, a door, is as large as its back."""
    return sketch(
        board("left", PartLabel.SIDE_PANEL, (-0.4, -0.2, 0.0), (-0.38, 0.2, 1.0)),
        board("right", PartLabel.SIDE_PANEL, (0.38, -0.2, 0.0), (0.4, 0.2, 1.0)),
        door("door", (-0.4, -0.22, 0.0), (0.4, -0.2, 1.0), "left"),
        board("back", PartLabel.BACK_PANEL, (-0.4, 0.2, 0.0), (0.4, 0.22, 1.0)),
    )


def test_one_predicted_part_may_be_several_of_the_assets() -> None:
    split = sketch(
        board("carcass", PartLabel.MISC, (-0.5, -0.2, 0.0), (0.5, 0.2, 1.0)),
        board("small_panel", PartLabel.UNKNOWN, (-0.5, -0.22, 0.8), (0.0, -0.2, 1.0)),
        board("large_panel", PartLabel.UNKNOWN, (-0.5, -0.22, 0.0), (0.0, -0.2, 0.8)),
        handle("handle_1", "large_panel", (-0.05, -0.24, 0.4)),
    )
    leaf = Box(vec3(-0.5, -0.22, 0.0), vec3(0.0, -0.2, 1.0)).union(split.part("handle_1").box)
    axis = Axis(vec3(-0.5, -0.22, 0.5), vec3(0.0, 0.0, -1.0))
    foreign = ForeignMotions(
        "singapo",
        "their.json",
        (
            ForeignPart("base", TriangleMesh.box_mesh(split.part("carcass").box), True),
            ForeignPart("door", TriangleMesh.box_mesh(leaf), True, PartLabel.DOOR, "base"),
        ),
        (ForeignJoint("door", JointType.REVOLUTE, axis, 0.0, 1.5),),
    )
    found = attach_motions(split, foreign)

    assert [joint.part for joint in found.joints] == ["large_panel"]
    assert {part.id: part.carried_by for part in found.parts} == {
        "carcass": None,
        "small_panel": "large_panel",
        "large_panel": None,
        "handle_1": "large_panel",
    }
    assert found.part("large_panel").label is PartLabel.DOOR
    assert found.part("large_panel").labelled_by == "prediction"


def test_a_door_carries_what_moves_with_it_though_it_is_smaller() -> None:
    asset = sketch(
        board("carcass", PartLabel.MISC, (-0.5, -0.2, 0.0), (0.5, 0.2, 1.0)),
        door("door", (-0.5, -0.22, 0.0), (0.0, -0.2, 0.4), "left"),
        board("mirror", PartLabel.MISC, (-0.5, -0.22, 0.4), (0.0, -0.2, 1.0)),
    )
    foreign = predicted(asset, np.eye(4))
    fixed = tuple(replace(p, parent="their_door") if p.name == "their_mirror" else p for p in foreign.parts)
    found = attach_motions(asset, replace(foreign, parts=fixed))

    assert [joint.part for joint in found.joints] == ["door"]
    assert found.part("mirror").carried_by == "door"


def test_what_moves_may_carry_what_moves() -> None:
    asset = sketch(
        board("carcass", PartLabel.MISC, (-0.5, -0.2, 0.0), (0.5, 0.2, 1.0)),
        drawer("drawer", (-0.5, -0.6, 0.0), (0.5, -0.2, 0.4)),
        door("lid", (-0.5, -0.62, 0.0), (0.5, -0.6, 0.4), "left"),
    )
    foreign = predicted(asset, way(TURNS[5], 2.0))
    stacked = tuple(replace(p, parent="their_drawer") if p.name == "their_lid" else p for p in foreign.parts)
    found = attach_motions(asset, replace(foreign, parts=stacked))

    require_same_joints(found, asset)
    assert found.part("lid").carried_by == "drawer"


def test_a_handle_that_nobody_moves_rides_on_what_it_touches() -> None:
    foreign = predicted(CABINET, np.eye(4), boxes=True)
    bare = replace(foreign, parts=tuple(p for p in foreign.parts if "handle" not in p.name))
    found = attach_motions(CABINET, bare)

    assert {p.id: p.carried_by for p in found.parts} == {p.id: p.carried_by for p in CABINET.parts}


def test_parts_without_a_label_are_what_their_joints_make_them() -> None:
    found = attach_motions(unlabelled(CABINET), predicted(CABINET, np.eye(4)))

    labels = {part.id: part.label for part in found.parts if part.label is not PartLabel.UNKNOWN}
    assert labels == {
        "door_left": PartLabel.DOOR,
        "door_right": PartLabel.DOOR,
        "drawer": PartLabel.DRAWER,
    }
    assert {found.part(part).labelled_by for part in labels} == {"joint"}


def test_a_door_drawn_ajar_does_not_spoil_the_others() -> None:
    foreign = predicted(CABINET, way(TURNS[3], 5.0, (1.0, 0.0, 2.0)))
    pulled = tuple(
        replace(p, mesh=p.mesh.translated(5.0 * TURNS[3] @ vec3(0.0, -0.15, 0.0))) if "drawer" in p.name else p
        for p in foreign.parts
    )
    found = attach_motions(CABINET, replace(foreign, parts=pulled))

    require_same_joints(found, CABINET, tolerance=1e-5)


def test_a_prediction_of_something_else_is_refused_in_one_line() -> None:
    other = sketch(
        board("post", PartLabel.LEG, (0.0, 0.0, 0.0), (0.05, 0.05, 2.0)),
        door("leaf", (0.05, 0.0, 0.0), (0.9, 0.02, 0.1), "left"),
    )
    with pytest.raises(
        AssetError, match=r"their.file does not fit sketch: .* is it a prediction of this object\?"
    ) as error:
        attach_motions(CABINET, predicted(other, np.eye(4)))
    assert "\n" not in str(error.value)


def test_a_joint_of_a_part_that_is_not_there_is_a_note() -> None:
    foreign = predicted(CABINET, np.eye(4))
    ghost = ForeignPart("ghost", TriangleMesh.box_mesh(Box(vec3(0.6, 0.3, 0.0), vec3(0.7, 0.4, 0.1))))
    joint = ForeignJoint("ghost", JointType.PRISMATIC, Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0)), 0.0, 0.1)
    found = attach_motions(CABINET, replace(foreign, parts=(*foreign.parts, ghost), joints=(*foreign.joints, joint)))

    require_same_joints(found, CABINET)
    assert "the joint of ghost in urdf's file fits no part" in found.notes
    assert any(
        note.startswith("motions from urdf: 3 joints; frame: the input's own coordinates") for note in found.notes
    )


def test_the_match_says_how_well_it_fits() -> None:
    match = match_parts(CABINET, predicted(CABINET, way(TURNS[2], 3.0)))

    assert match.residual < 1e-9
    assert match.overlap > 0.999
    assert match.part_of == tuple(f"their_{part.id}" for part in CABINET.parts)
    assert "laid over the whole box" in match.frame.name


@pytest.mark.parametrize(
    ("parts", "joints", "why"),
    [
        ((), (), "predicts no part"),
        (("a", "a"), (), "parts must be unique"),
        (("a",), ("b",), "there is no"),
        (("a",), ("a", "a"), "joints must be unique"),
        (("a>b", "b>a"), (), "must form a tree"),
        (("a>c",), (), "there is no"),
    ],
)
def test_a_prediction_that_contradicts_itself_is_refused(
    parts: tuple[str, ...], joints: tuple[str, ...], why: str
) -> None:
    mesh = TriangleMesh.box_mesh(Box(vec3(0.0, 0.0, 0.0), vec3(1.0, 1.0, 1.0)))
    listed = tuple(ForeignPart(p[0], mesh, parent=p[2:] or None) for p in parts)
    axis = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0))
    with pytest.raises(AssetError, match=why):
        ForeignMotions("urdf", "f", listed, tuple(ForeignJoint(j, JointType.REVOLUTE, axis) for j in joints))


def test_thousands_of_copies_of_a_part_are_not_all_compared(monkeypatch: pytest.MonkeyPatch) -> None:
    foreign = predicted(CABINET, way(TURNS[5], 3.0))
    still = next(part for part in foreign.parts if part.name == "their_shelf")
    copies = tuple(replace(still, name=f"copy_{k}") for k in range(2_000))
    compared, plain = [0], agreement._Shape.distances

    def counted(self, points, far):  # type: ignore[no-untyped-def]
        compared[0] += 1
        return plain(self, points, far)

    monkeypatch.setattr(agreement._Shape, "distances", counted)
    require_same_joints(attach_motions(CABINET, replace(foreign, parts=(*foreign.parts, *copies))), CABINET)
    assert compared[0] <= agreement.AgreementConfig().tried * len(CABINET.parts) * 30  # some thirty frames


def test_bodies_of_a_long_chain_are_those_that_carry_its_parts() -> None:
    mesh = CABINET.parts[0].mesh
    names = [f"part_{k}" for k in range(5_000)]
    parts = [ForeignPart(n, mesh, parent=above) for n, above in zip(names, [None, *names], strict=False)]
    joints = tuple(ForeignJoint(names[k], JointType.REVOLUTE, CABINET.joints[0].axis) for k in (1_000, 4_000))
    foreign = ForeignMotions("urdf", "their.file", (*parts[::-1],), joints)

    expected = {n: None if k < 1_000 else names[1_000] if k < 4_000 else names[4_000] for k, n in enumerate(names)}
    assert foreign.body_of == expected
    assert list(foreign.body_of) == names[::-1]
