import numpy as np
import pytest

from grafu.graph.parse import parse_graph
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.fronts.layout import CellRow, Door, Drawer
from grafu.synth.noise import edits
from grafu.synth.noise.edits import with_anchored_sheets
from grafu.vocabulary import PartLabel
from sketches import board, sketch
from sweeping import collisions

TIDY = make_cabinet(Cabinet(layout=CellRow((Door(), Drawer()))))
ADDITIVE = [edits.with_doubled_faces, edits.with_degenerate_faces, edits.with_inverted_normals]
SAME_BOX = [*ADDITIVE, edits.with_loose_faces]


def test_sheets_keep_one_side_of_each_board_the_outer_one():
    asset = edits.with_sheets(TIDY, ("side panel", "back panel"))
    left, back = asset.part("side_panel_left"), asset.part("back_panel")
    assert left.box.high[0] == left.box.low[0] == TIDY.part("side_panel_left").box.low[0]
    assert back.box.low[1] == back.box.high[1] == TIDY.part("back_panel").box.high[1]
    assert asset.part("door") == TIDY.part("door")


def test_open_backs_leave_no_face_that_looks_back():
    asset = edits.with_open_backs(TIDY)
    assert all(p.mesh.face_normals[:, 1].max() < 0.5 for p in asset.parts)
    assert not asset.part("door").mesh.is_watertight


@pytest.mark.parametrize("edit", SAME_BOX)
def test_a_defect_of_faces_leaves_boxes_and_joints_alone(edit):
    asset = edit(TIDY)
    assert all(np.allclose(p.box.low, TIDY.part(p.id).box.low) for p in asset.parts)
    assert asset.joints == TIDY.joints


def test_doubled_faces_are_twice_as_many_and_cancel():
    mesh = edits.with_doubled_faces(TIDY).part("door").mesh
    assert len(mesh.faces) == 2 * len(TIDY.part("door").mesh.faces)
    assert np.linalg.det(mesh.triangles).sum() == pytest.approx(0.0, abs=1e-12)  # six times the signed volume


def test_inverted_normals_turn_a_solid_inside_out():
    assert edits.with_inverted_normals(TIDY, ("door",)).part("door").mesh.to_trimesh().volume < 0


def test_degenerate_faces_have_no_area():
    areas = edits.with_degenerate_faces(TIDY).part("door").mesh.face_areas
    assert (areas < 1e-15).sum() == 8


def test_loose_faces_share_no_vertex():
    mesh = edits.with_loose_faces(TIDY).part("door").mesh
    assert len(mesh.vertices) == 3 * len(mesh.faces)


def test_many_shells_fill_the_same_board():
    asset = edits.with_many_shells(TIDY, 5, ("back panel",))
    back = asset.part("back_panel")
    assert len(back.surfaces) == 5
    assert np.allclose(back.box.size, TIDY.part("back_panel").box.size)
    assert back.mesh.to_trimesh().volume == pytest.approx(TIDY.part("back_panel").mesh.to_trimesh().volume)


def test_merged_parts_become_one_without_a_label():
    asset = edits.with_merged(TIDY, ("side panel", "top panel", "bottom panel", "back panel"))
    assert len(asset.parts) == len(TIDY.parts) - 4
    assert asset.part("body").label is PartLabel.UNKNOWN
    assert np.allclose(asset.box.size, TIDY.box.size)


@pytest.mark.parametrize("where", [("back panel",), ("door", "back panel"), ("handle_1", "back panel")])
def test_only_several_still_parts_can_be_merged(where):
    with pytest.raises(ValueError, match="two or more still parts"):
        edits.with_merged(TIDY, where)


def test_a_shifted_drawer_sinks_into_the_wall_with_its_joint_and_handle():
    asset = edits.with_shifted(TIDY, "drawer", np.array([0.02, 0.0, 0.0]))
    assert asset.joints[1].axis.point[0] == pytest.approx(TIDY.joints[1].axis.point[0] + 0.02)
    assert asset.part("handle_2").box.low[0] == pytest.approx(TIDY.part("handle_2").box.low[0] + 0.02)
    assert "side_panel_right" in collisions(asset, "drawer")


def test_a_swollen_part_grows_to_both_sides_and_interpenetrates():
    asset = edits.with_swollen(TIDY, "drawer", np.array([0.02, 0.0, 0.0]))
    assert asset.part("drawer").box.size[0] == pytest.approx(TIDY.part("drawer").box.size[0] + 0.04)
    assert {"side_panel_right", "divider"} <= set(collisions(asset, "drawer"))


def test_lost_labels_are_unknown_and_names_say_nothing():
    asset = edits.with_labels_lost(TIDY)
    assert {p.label for p in asset.parts} == {PartLabel.UNKNOWN}
    assert all(p.source.name.startswith("Cube.") for p in asset.parts)


def test_parts_go_with_their_attached_parts_and_joints():
    asset = edits.without_parts(TIDY, ("drawer", "top panel"))
    assert {p.id for p in TIDY.parts} - {p.id for p in asset.parts} == {"drawer", "handle_2", "top_panel"}
    assert [j.part for j in asset.joints] == ["door"]


def test_defects_can_be_combined():
    asset = TIDY
    for edit in [*SAME_BOX, edits.with_open_backs]:
        asset = edit(asset)
    assert all(len(p.mesh.faces) for p in asset.parts)


def test_at_least_one_board_is_needed():
    with pytest.raises(ValueError, match="at least 1"):
        edits.with_many_shells(TIDY, 0)


# A back inset between two sides, which ends flush with them: its outer face touches them, its inner one, too
SIDES = (
    board("left", PartLabel.SIDE_PANEL, (-0.5, -0.3, 0.0), (-0.48, 0.3, 0.8)),
    board("right", PartLabel.SIDE_PANEL, (0.48, -0.3, 0.0), (0.5, 0.3, 0.8)),
    board("bottom", PartLabel.BOTTOM_PANEL, (-0.48, -0.3, 0.0), (0.48, 0.3, 0.02)),
)
PLANTED = board("back", PartLabel.BACK_PANEL, (-0.5, 0.3, 0.0), (0.5, 0.32, 0.8))


def test_a_sheet_lies_on_the_outer_face_where_nothing_comes_loose() -> None:
    made = with_anchored_sheets(sketch(*SIDES, PLANTED), ("left",))

    box = made.part("left").box
    assert box.size[0] == 0.0
    assert box.low[0] == -0.5


def test_a_planted_back_as_a_sheet_stays_with_its_case() -> None:
    made = with_anchored_sheets(sketch(*SIDES, PLANTED), ("back",))

    assert made.part("back").box.low[1] == made.part("back").box.high[1] == 0.3
    assert len(parse_graph(made).neighbours["back"]) == 3


def test_what_would_come_loose_either_way_stays_a_board() -> None:
    post = board("post", PartLabel.BAR, (-0.01, -0.3, 0.02), (0.01, -0.28, 0.5))
    top = board("top", PartLabel.TOP_PANEL, (-0.1, -0.3, 0.5), (0.1, 0.3, 0.53))
    lamp = board("lamp", PartLabel.MISC, (-0.02, 0.0, 0.53), (0.02, 0.05, 0.6))

    made = with_anchored_sheets(sketch(*SIDES, post, top, lamp), ("top",))

    assert made.part("top").box.size[2] > 0.02
