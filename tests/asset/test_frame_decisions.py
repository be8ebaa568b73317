import math
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from grafu.asset.edit import as_static_object, yawed
from grafu.asset.frame import settle_frame, straightened, turned_before, whole_box
from grafu.asset.load import load_asset
from grafu.asset.options import DIRECTIONS, LoadOptions
from grafu.asset.part import Asset, Part
from grafu.asset.pieces import with_attached
from grafu.asset.reading import Convention, Placing, Reading
from grafu.asset.scale import estimate_scale, is_normalised, likely_unit
from grafu.asset.standing import decide_front, front_votes, up_votes, vector
from grafu.errors import AssetError
from grafu.export.files import write_files
from grafu.export.glb import export_glb
from grafu.geometry.transform import from_rotation, rotation_matrix
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.vocabulary import PartLabel
from small_scenes import box, cylinder
from strategies import cabinet_specs

UNKNOWN = Convention("nothing")


def cabinet() -> Asset:
    return make_cabinet(Cabinet())


def reading_of(asset: Asset, T: np.ndarray) -> Reading:
    parts = tuple(
        type(p)(p.id, p.label, tuple(s.transformed(T) for s in p.surfaces), p.source, p.labelled_by, p.carried_by)
        for p in asset.parts
    )
    return Reading("made", parts, UNKNOWN)


def turned(up: str, front: str) -> np.ndarray:
    """Returns the rotation from the object frame to coordinates with this up and front."""
    u, f = vector(up), vector(front)
    T = np.eye(4)
    T[:3, :3] = np.column_stack([np.cross(-f, u), -f, u])
    return T


@pytest.mark.parametrize(("up", "front"), [(u, f) for u in DIRECTIONS for f in DIRECTIONS if u[1] != f[1]])
def test_labels_tell_up_and_front_in_all_24_poses(up, front):
    frame = settle_frame(reading_of(cabinet(), turned(up, front)), LoadOptions())
    assert (frame.up, frame.front) == (up, front)
    np.testing.assert_allclose(frame.input_to_output[:3, :3] @ turned(up, front)[:3, :3] / frame.scale, np.eye(3))


@settings(max_examples=25)
@given(st.floats(1e-4, 1e4))
def test_the_estimate_answers_scale_with_its_inverse(factor):
    asset = cabinet()
    T = np.diag([factor, factor, factor, 1.0])
    plain = estimate_scale(asset.parts, asset.box, 2, None)
    other = reading_of(asset, T)
    box = type(asset.box)(asset.box.low * factor, asset.box.high * factor)
    assert estimate_scale(other.parts, box, 2, None).scale * factor == pytest.approx(plain.scale, rel=1e-9)


@pytest.mark.parametrize("turns", [1, 2, 3])
def test_the_estimate_ignores_quarter_turns(turns):
    asset = cabinet()
    other = yawed(asset, turns * math.pi / 2)
    scales = [estimate_scale(a.parts, a.box, 2, None).scale for a in (asset, other)]
    assert scales[0] == pytest.approx(scales[1], rel=1e-9)


@settings(max_examples=15)
@given(cabinet_specs)
def test_made_cabinets_are_estimated_within_a_factor_of_two(spec):
    asset = make_cabinet(spec)
    # the specs also draw what no joiner makes: one drawer as high as a wardrobe states nothing about size
    assume(all(part.box.size[2] < 0.9 for part in asset.parts if part.label is PartLabel.DRAWER))
    assert 0.5 < estimate_scale(asset.parts, asset.box, 2, None).scale < 2.0


def test_handles_in_one_object_and_a_case_called_a_side_are_measured_as_what_they_are():
    fronts = [box(f"door_{k}", (0.5 * k, 0.0, 0.1), (0.5 * k + 0.49, 0.02, 0.9), PartLabel.DOOR) for k in range(6)]
    handles = [box(f"handle_{k}", (0.5 * k + 0.4, -0.03, 0.4), (0.5 * k + 0.41, 0.0, 0.55)) for k in range(6)]
    joined = Part("handles", PartLabel.HANDLE, tuple(s for part in handles for s in part.surfaces), handles[0].source)
    case = box("wardrobe", (0.0, 0.02, 0.0), (3.0, 0.6, 1.0), PartLabel.SIDE_PANEL)
    parts = (*fronts, joined, case)
    apart = (*fronts, *(replace(part, label=PartLabel.HANDLE) for part in handles))
    found, usual = (estimate_scale(these, whole_box(parts), 2, None) for these in (parts, apart))
    assert found.measures == usual.measures  # no panel thickness of 0.58 m
    assert found.scale == pytest.approx(usual.scale)


def test_units_are_told_by_plausible_sizes():
    asset = cabinet()
    estimate = estimate_scale(asset.parts, asset.box, 2, None)
    size = asset.box.size.max()
    assert likely_unit(size, estimate) == ("metres", 1.0)
    tiny = type(estimate)(estimate.scale * 0.12, estimate.kind, estimate.measures)
    assert likely_unit(size / 0.12, tiny) is None


@pytest.mark.parametrize(("frame", "metres"), [("door_frame", 2.1), ("Türrahmen", 2.1), ("case", None)])
def test_a_door_of_a_building_has_the_height_of_one_in_any_unit(frame, metres):
    for unit in (1.0, 0.4):
        sides = [((-0.5, -0.07, 0.0), (-0.45, 0.07, 2.1)), ((0.45, -0.07, 0.0), (0.5, 0.07, 2.1))]
        boxes = [(f"{frame}_{k}", low, high) for k, (low, high) in enumerate(sides)]
        boxes.append(("door", (-0.44, -0.02, 0.01), (0.44, 0.02, 2.08)))
        parts = tuple(box(n, *(tuple(unit * x for x in corner) for corner in (a, b))) for n, a, b in boxes)
        estimate = estimate_scale(parts, whole_box(parts), 2, None)
        height = estimate.scale * unit * 2.1
        assert estimate.kind == ("door" if metres else "storage")
        assert not metres or abs(height - metres) < 0.15


@pytest.mark.parametrize(("height", "floor", "expected"), [(2.0, 0.0, False), (2.0, -1.0, True), (1.0, 0.0, True)])
def test_two_units_are_those_of_a_data_set_only_about_the_origin(height, floor, expected):
    """A wardrobe of two metres stands on its floor; what was scaled into a cube from -1 to 1 hangs about its middle."""
    parts = (box("side", (-0.4, -0.3, floor), (0.4, 0.3, floor + height)),)
    assert is_normalised(parts, whole_box(parts)) is expected


def test_a_unit_sphere_about_the_origin_is_normalised_and_a_floor_is_not():
    asset = cabinet()
    hung = reading_of(asset, turned("+Z", "-Y") - np.outer([0, 0, asset.box.center[2], 0], [0, 0, 0, 1.0])).parts
    radius = max(np.linalg.norm(p.mesh.vertices, axis=1).max() for p in hung)
    for factor, expected in ((1.02 / radius, True), (1.3 / radius, False)):
        parts = reading_of(Asset("a", "", "made", hung), np.diag([factor, factor, factor, 1.0])).parts
        assert is_normalised(parts, whole_box(parts)) is expected
    assert not is_normalised(asset.parts, asset.box)


def test_a_convention_holds_unless_nearly_all_speaks_against_it():
    assert decide_front({"+X": 0.0, "-X": 0.0, "-Y": 3.0, "+Y": 0.0}, "-Y", "-Y") == ("-Y", "convention")
    assert decide_front({"+X": 3.0, "-X": 0.0, "-Y": 0.0, "+Y": 0.5}, "-Y", "-Y") == ("+X", "geometry")
    assert decide_front({"+X": 3.0, "-X": 0.0, "-Y": 1.0, "+Y": 0.0}, "-Y", "-Y") == ("-Y", "convention")
    assert decide_front({"+X": 1.0, "-X": 1.0, "-Y": 0.0, "+Y": 0.0}, None, "-Y") == ("-Y", "habit")


def test_without_labels_nothing_is_claimed():
    asset = cabinet().with_labels({p.id: PartLabel.UNKNOWN for p in cabinet().parts})
    assert up_votes(asset.parts, asset.box).best is None
    assert not any(front_votes(asset.parts, asset.box, "+Z").values())
    frame = settle_frame(reading_of(asset, turned("+Y", "+Z")), LoadOptions())
    assert (frame.up, frame.front) == ("+Y", "+Z")
    assert any("--up changes it" in said for said in frame.assumed)


def test_a_front_on_the_upright_axis_is_refused():
    with pytest.raises(AssetError, match="axis that is up"):
        settle_frame(reading_of(cabinet(), np.eye(4)), LoadOptions(front="+Z"))


@settings(max_examples=15)
@given(cabinet_specs)
def test_handles_are_found_on_what_carries_them(spec):
    asset = make_cabinet(spec)
    stated = {p.id: p.carried_by for p in asset.parts}
    found = {p.id: p.carried_by for p in with_attached(asset.without_annotation().parts)}
    assert found == stated


def test_a_glb_that_was_written_reads_back_as_its_parts(tmp_path):
    asset = cabinet()
    write_files(export_glb(as_static_object(asset)), tmp_path / "m")
    back = load_asset(tmp_path / "m")
    assert [(p.id, p.label, p.carried_by) for p in back.parts] == [(p.id, p.label, p.carried_by) for p in asset.parts]
    for a, b in zip(asset.parts, back.parts, strict=True):
        np.testing.assert_allclose([b.box.low, b.box.high], [a.box.low, a.box.high], atol=1e-6)


@pytest.mark.parametrize("front", ["+X", "-X", "-Y", "+Y"])
def test_fronts_in_the_middle_of_the_whole_show_the_front_by_what_is_seen_of_them(front):
    # a pedestal whose fronts stand in the middle plane of the bed above it: their places tell nothing
    bed = box("bed", (-1.0, -1.0, 1.0), (1.0, 1.0, 1.1))
    case = box("case", (-0.3, 0.0, 0.0), (0.3, 0.6, 0.9))
    fronts = [box(f"drawer_{k}", (-0.28, -0.02, 0.3 * k + 0.02), (0.28, 0.0, 0.3 * k + 0.28)) for k in range(3)]
    fronts = [replace(p, label=PartLabel.DRAWER, labelled_by="name") for p in fronts]
    asset = Asset("bed", "", "made", (bed, case, *fronts))
    found = settle_frame(reading_of(asset, turned("+Z", front)), LoadOptions(up="+Z"))
    assert found.front == front


@pytest.mark.parametrize("front", ["+X", "-X", "-Y", "+Y"])
def test_a_leaf_in_the_middle_of_its_frame_faces_the_side_of_its_handle(front):
    # the handle reaches farther out than the leaf: it shifts the middle of the whole away from the leaf
    labelled = (
        (box("frame_left", (-0.28, -0.03, 0.0), (-0.22, 0.03, 0.6)), PartLabel.FACE_FRAME),
        (box("frame_right", (0.22, -0.03, 0.0), (0.28, 0.03, 0.6)), PartLabel.FACE_FRAME),
        (box("door", (-0.21, -0.02, 0.01), (0.21, 0.02, 0.59)), PartLabel.DOOR),
        (cylinder("handle", ((0.17, -0.12, 0.28), (0.17, -0.02, 0.28)), 0.025), PartLabel.HANDLE),
    )
    asset = Asset("door", "", "made", tuple(replace(p, label=label, labelled_by="name") for p, label in labelled))
    found = settle_frame(reading_of(asset, turned("+Z", front)), LoadOptions(up="+Z"))
    assert found.front == front


QUARTERS = [turned(up, front) for up in DIRECTIONS for front in DIRECTIONS if up[1] != front[1]]


@pytest.mark.parametrize("T", QUARTERS, ids=range(len(QUARTERS)))
def test_panels_doors_and_legs_overrule_a_format_that_states_another_direction(T):
    reading = replace(reading_of(cabinet(), T), convention=Convention("glTF", up="+Y", front="+Z"))
    frame = settle_frame(reading, LoadOptions())
    upright = (frame.input_to_output @ T)[:3, :3] / frame.scale
    np.testing.assert_allclose(upright[2], [0, 0, 1], atol=1e-9)
    np.testing.assert_allclose(upright[1], [0, 1, 0], atol=1e-9)


def test_a_format_is_believed_where_few_labels_speak_against_it():
    asset = cabinet()
    few = tuple(p for p in asset.parts if p.label in (PartLabel.DOOR, PartLabel.BACK_PANEL))
    lying = reading_of(replace(asset, parts=few), turned("+Z", "-Y"))
    reading = replace(lying, convention=Convention("glTF", "+Y"))
    assert settle_frame(reading, LoadOptions()).up == "+Y"


@pytest.mark.parametrize(("height", "up"), [(0.9, "+Z"), (2.38, "+Z"), (0.02, "-Z")])
def test_a_worktop_below_the_middle_of_high_units_turns_nothing_upside_down(height, up):
    """A top at the very bottom of all does."""
    units = [box(f"unit_{x}", (x, 0.0, 0.0), (x + 0.6, 0.6, 2.4)) for x in (0.0, 2.4)]
    worktop = replace(box("worktop", (0.6, 0.0, height - 0.02), (2.4, 0.6, height)), label=PartLabel.TOP_PANEL)
    assert settle_frame(Reading("made", (*units, worktop), UNKNOWN), LoadOptions()).up == up


@settings(max_examples=12, deadline=None)
@given(degrees=st.floats(-44.0, 44.0).filter(lambda angle: abs(angle) > 1.5), up=st.sampled_from(DIRECTIONS))
def test_a_piece_that_stands_askew_comes_out_along_the_axes_whatever_is_up(degrees, up):
    front = next(d for d in DIRECTIONS if d[1] != up[1])
    asset = cabinet()
    askew = from_rotation(rotation_matrix(vector(up), math.radians(degrees))) @ turned(up, front)
    reading = replace(reading_of(asset, askew), annotation=None)
    straight, T = straightened(reading, LoadOptions(up=up))
    frame = turned_before(settle_frame(straight, LoadOptions(up=up)), T)
    sizes = sorted(whole_box(place(reading, frame)).size)
    np.testing.assert_allclose(sizes, sorted(asset.box.size * frame.scale), rtol=0.01)
    assert f"askew by {abs(round(degrees)):.0f} degrees" in frame.assumed[1]


def place(reading: Reading, frame) -> tuple:
    return Placing(frame).moved(reading.parts)


def test_one_part_that_is_askew_turns_nothing_and_neither_does_a_round_table():
    asset = cabinet()
    upright = reading_of(asset, np.eye(4))
    door = next(p for p in upright.parts if p.label is PartLabel.DOOR)
    T = from_rotation(rotation_matrix(np.array([0.0, 0.0, 1.0]), math.radians(24)))
    ajar = replace(door, surfaces=tuple(s.transformed(T) for s in door.surfaces))
    post = box("post", (0.0, 0.0, 0.0), (0.02, 0.02, 1.0))
    table = cylinder("table", ((0.0, 0.0, 0.0), (0.0, 0.0, 0.7)), 0.5)
    for parts in ((ajar, post), (table,)):
        straight, turn = straightened(replace(upright, parts=parts), LoadOptions(up="+Z"))
        assert np.array_equal(turn, np.eye(4))
        assert straight.parts == parts


@pytest.mark.parametrize(
    ("factor", "unit"), [(39.37, 0.0254), (1000.0, 0.001), (100.0, 0.01), (8.0, None), (0.11, None)]
)
def test_units_that_nobody_states_and_sizes_that_belie_the_stated_unit(factor, unit):
    asset = cabinet()
    reading = replace(reading_of(asset, np.diag([factor] * 3 + [1.0])), convention=Convention("glTF", "+Z", "-Y", 1.0))
    frame = settle_frame(reading, LoadOptions())
    assert unit is None or frame.scale == pytest.approx(unit)
    assert 0.5 < frame.scale * factor < 2.0


def test_what_labels_and_sizes_decided_is_stated_with_its_confidence():
    asset = cabinet()
    frame = settle_frame(reading_of(asset, np.diag([100.0] * 3 + [1.0])), LoadOptions())
    up, front, scale = frame.assumed
    assert up.endswith("labelled panels and legs, confidence 100 %")
    assert front.endswith("face or open there, confidence 100 %")
    assert float(re.search(r"confidence (\d+) %", scale)[1]) == pytest.approx(
        100 * min(0.01 / estimate(asset, 100.0), estimate(asset, 100.0) / 0.01), abs=0.6
    )
    turned_door = [p for p in asset.parts if p.label is not PartLabel.SIDE_PANEL]
    votes = up_votes((*turned_door, box_lying_on_its_side()), asset.box)
    assert 0.5 < votes.confidence("+Z") < 1.0


def estimate(asset: Asset, factor: float) -> float:
    return estimate_scale(asset.parts, asset.box, 2, None).scale / factor


def box_lying_on_its_side():
    return replace(box("top", (-0.5, -0.3, 0.1), (0.5, -0.28, 0.9)), label=PartLabel.TOP_PANEL)


def fronted(lids: int) -> Reading:
    """A wide case whose fronts, each 0.5 x 0.9 m, are thin along Y; as many others are lids on it, thin along Z."""
    case = box("case", (0.0, 0.0, 0.0), (2.0, 0.6, 1.0))
    doors = [box(f"door_{k}", (0.5 * k, -0.02, 0.05), (0.5 * k + 0.49, 0.0, 0.95)) for k in range(4 - lids)]
    tops = [box(f"door_top_{k}", (0.5 * k, 0.0, 1.0), (0.5 * k + 0.49, 0.6, 1.02)) for k in range(lids)]
    return Reading("made", (case, *doors, *tops), Convention("OBJ"))


def test_doors_that_would_lie_flat_tell_that_z_is_up_where_the_format_states_nothing():
    frame = settle_frame(fronted(lids=0), LoadOptions())
    assert (frame.up, frame.front) == ("+Z", "-Y")
    assert "would lie flat otherwise" in frame.assumed[0]


def test_doors_both_ways_tell_nothing():
    assert settle_frame(fronted(lids=2), LoadOptions()).up == "+Y"


def test_one_door_that_would_lie_below_is_what_the_piece_would_lie_on():
    reading = fronted(lids=0)
    frame = settle_frame(replace(reading, parts=reading.parts[:2]), LoadOptions())
    assert frame.up == "+Z"
    assert "lie on what shows the most parts" in frame.assumed[0]


def test_where_labels_disagree_x_is_not_up():
    """Fillers that are called bottoms stand across X; a worktop lies across Y. Labels that agree may tell X."""
    boards = [box(f"bottom_{k}", (k, 0.0, 0.0), (k + 0.02, 0.9, 0.6)) for k in (0.0, 1.0, 2.0)]
    fillers = [replace(board, label=PartLabel.BOTTOM_PANEL) for board in boards]
    top = replace(box("top", (0.0, 0.9, 0.0), (2.1, 0.94, 0.6)), label=PartLabel.TOP_PANEL)
    assert up_votes((*fillers, top), whole_box((*fillers, top))).best == "+X"
    assert settle_frame(Reading("made", (*fillers, top), UNKNOWN), LoadOptions()).up == "+Y"


@pytest.mark.parametrize(("by", "front"), [("shape", "-Y"), ("name", "-X")])
def test_a_drawer_known_by_its_box_alone_does_not_turn_what_fronts_were_cut_out_of(by, front):
    """At the end of a row of units such a box is nearest to that end; what a name calls a drawer is believed."""
    case = replace(box("Object_1", (-1.0, -0.02, 0.0), (1.0, 0.6, 0.8)), labelled_by="none")
    drawer = replace(box("Object_2", (-1.0, 0.08, 0.1), (-0.4, 0.5, 0.4)), label=PartLabel.DRAWER, labelled_by=by)
    bars = [box(f"Object_b{k}", (x, -0.05, 0.2), (x + 0.1, -0.02, 0.22)) for k, x in enumerate((-0.75, -0.05, 0.65))]
    parts = (case, drawer, *(replace(bar, labelled_by="none") for bar in bars))
    reading = Reading("mesh file", parts, Convention("OBJ", usual_up="+Z"), fronts_face="-Y")
    assert settle_frame(reading, LoadOptions(up="+Z")).front == front


@pytest.mark.parametrize(("height", "front"), [(0.6, "-Y"), (0.2, "+Y")], ids=["a lid", "a leaf before a case"])
def test_a_lid_that_leans_to_the_back_above_all_tells_no_front(height, front):
    """A leaf that reaches as far to the back, but is beside the case, tells that it faces there."""
    case = box("case", (-0.5, -0.3, 0.0), (0.5, 0.3, 0.6))
    lid = replace(box("lid", (-0.5, 0.2, height), (0.5, 0.32, height + 0.35)), label=PartLabel.DOOR, labelled_by="name")
    asset = Asset("chest", "", "made", (case, lid))
    votes = front_votes(asset.parts, asset.box, "+Z")
    assert decide_front(votes, "-Y", "-Y")[0] == front
