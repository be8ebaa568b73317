"""What truly carries doors and drawers: hand-made cases, tidy and not."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.articulation.articulated_object import Coupling
from grafu.asset.edit import mirrored
from grafu.asset.part import Asset
from grafu.graph.edges import Hinge, Slide, Turn
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import direction_to_code
from grafu.synth.appliances.appliance import Appliance, make_appliance
from grafu.synth.cabinets.folding import FoldingDoors, make_folding_doors
from grafu.synth.cabinets.sliding import SlidingDoors, make_sliding_doors
from grafu.synth.noise.distortion import ajar, stretched
from grafu.synth.noise.edits import with_shifted
from grafu.synth.noise.segmentation import in_pieces, with_box_apart, with_joined
from grafu.synth.tables.extending import ExtendingTable, make_extending_table
from grafu.synth.truth.true_graph import carriers, true_graph
from grafu.vocabulary import PartLabel
from sketches import Sketched, board, door, drawer, handle, sketch

CASE = (
    board("left", PartLabel.SIDE_PANEL, (-0.4, -0.25, 0.0), (-0.38, 0.25, 0.8)),
    board("right", PartLabel.SIDE_PANEL, (0.38, -0.25, 0.0), (0.4, 0.25, 0.8)),
    board("bottom", PartLabel.BOTTOM_PANEL, (-0.38, -0.25, 0.0), (0.38, 0.25, 0.02)),
    board("top", PartLabel.TOP_PANEL, (-0.38, -0.25, 0.78), (0.38, 0.25, 0.8)),
    board("back", PartLabel.BACK_PANEL, (-0.38, 0.24, 0.02), (0.38, 0.25, 0.78)),
)
PAIR = (
    door("door_l", (-0.4, -0.269, 0.0), (-0.002, -0.251, 0.8), "left"),
    door("door_r", (0.002, -0.269, 0.0), (0.4, -0.251, 0.8), "right"),
)


def mounts(graph: FunctionalGraph) -> dict[str, set[str]]:
    found: dict[str, set[str]] = {}
    for edge in (*graph.hinges, *graph.rails):
        found.setdefault(edge.child, set()).add(edge.parent)
    return found


@pytest.fixture(scope="module")
def cabinet() -> Asset:
    return sketch(*CASE, *PAIR, handle("grip", "door_l", (-0.05, -0.29, 0.4)))


def test_a_pair_hangs_on_the_two_sides_and_a_handle_on_its_door(cabinet: Asset) -> None:
    graph = true_graph(cabinet, 8)

    assert mounts(graph) == {"door_l": {"left"}, "door_r": {"right"}}
    assert [(e.parent, e.child) for e in graph.attachments] == [("door_l", "grip")]
    assert carriers(graph) == {"left", "right", "door_l"}
    assert all(node.points is not None and len(node.points.points) == 8 for node in graph.nodes)


def test_an_inset_pair_in_a_face_frame_hangs_on_its_stiles() -> None:
    stiles = (
        board("stile_l", PartLabel.BAR, (-0.4, -0.27, 0.0), (-0.36, -0.25, 0.8)),
        board("stile_r", PartLabel.BAR, (0.36, -0.27, 0.0), (0.4, -0.25, 0.8)),
        board("rail_t", PartLabel.BAR, (-0.36, -0.27, 0.76), (0.36, -0.25, 0.8)),
        board("rail_b", PartLabel.BAR, (-0.36, -0.27, 0.0), (0.36, -0.25, 0.04)),
    )
    inset = (
        door("door_l", (-0.358, -0.27, 0.042), (-0.001, -0.252, 0.758), "left"),
        door("door_r", (0.001, -0.27, 0.042), (0.358, -0.252, 0.758), "right"),
    )
    bars = sketch(*CASE, *stiles, *inset)
    assert mounts(true_graph(bars, 1)) == {"door_l": {"stile_l"}, "door_r": {"stile_r"}}

    frame = with_joined(bars, ("stile_l", "stile_r", "rail_t", "rail_b"), PartLabel.FACE_FRAME, "frame")
    assert mounts(true_graph(frame, 1)) == {"door_l": {"frame"}, "door_r": {"frame"}}

    [left, _, _, _] = [p.id for p in in_pieces(frame, "frame", PartLabel.BAR).parts if "piece" in p.id]
    assert mounts(true_graph(in_pieces(frame, "frame", PartLabel.BAR), 1))["door_l"] == {left}


def test_an_edge_sheet_does_not_carry_what_its_panel_carries(cabinet: Asset) -> None:
    sheet = board("edge", PartLabel.BAR, (-0.4, -0.25, 0.0), (-0.38, -0.25, 0.8))

    graph = true_graph(replace(cabinet, parts=(*cabinet.parts, sketch(sheet).parts[0])), 1)

    assert mounts(graph)["door_l"] == {"left"}


def test_drawers_run_between_what_stands_beside_them() -> None:
    asset = sketch(
        *CASE,
        board("divider", PartLabel.DIVIDER, (-0.01, -0.25, 0.02), (0.01, 0.24, 0.78)),
        drawer("drawer_l", (-0.365, -0.25, 0.1), (-0.025, 0.2, 0.3)),
        drawer("drawer_r", (0.025, -0.25, 0.1), (0.365, 0.2, 0.3)),
    )

    assert mounts(true_graph(asset, 1)) == {"drawer_l": {"left", "divider"}, "drawer_r": {"divider", "right"}}


def table(*more: Sketched) -> Asset:
    legs = [
        board(f"leg_{k}", PartLabel.LEG, (x, y, 0.0), (x + 0.05, y + 0.05, 0.7))
        for k, (x, y) in enumerate(((-0.5, -0.3), (0.45, -0.3), (-0.5, 0.25), (0.45, 0.25)))
    ]
    top = board("table_top", PartLabel.TOP_PANEL, (-0.55, -0.35, 0.7), (0.55, 0.35, 0.72))
    return sketch(*legs, top, drawer("drawer", (-0.42, -0.3, 0.6), (0.42, 0.2, 0.69)), *more)


def test_a_drawer_in_a_table_runs_on_its_side_aprons() -> None:
    aprons = (
        board("apron_l", PartLabel.SIDE_PANEL, (-0.49, -0.25, 0.58), (-0.47, 0.25, 0.7)),
        board("apron_r", PartLabel.SIDE_PANEL, (0.47, -0.25, 0.58), (0.49, 0.25, 0.7)),
    )

    assert mounts(true_graph(table(*aprons), 1)) == {"drawer": {"apron_l", "apron_r"}}


def test_a_drawer_with_nothing_beside_it_hangs_from_what_is_above() -> None:
    legless = table()
    parts = tuple(p for p in legless.parts if p.label is not PartLabel.LEG)

    assert mounts(true_graph(replace(legless, parts=parts), 1)) == {"drawer": {"table_top"}}


def test_runners_and_a_drawer_s_own_boards_carry_nothing() -> None:
    asset = sketch(
        *CASE,
        drawer("drawer", (-0.365, -0.25, 0.1), (0.365, 0.2, 0.3)),
        board("runner", PartLabel.MISC, (-0.379, -0.2, 0.2), (-0.367, 0.2, 0.22)),
    )

    assert mounts(true_graph(asset, 1)) == {"drawer": {"left", "right"}}
    assert mounts(true_graph(with_box_apart(asset, "drawer"), 1)) == {"drawer": {"left", "right"}}


def test_a_door_that_floats_or_stands_ajar_keeps_its_mount_and_codes(cabinet: Asset) -> None:
    tidy = {h.child: (h.border, h.sign) for h in true_graph(cabinet, 1).hinges}
    for noisy in (with_shifted(cabinet, "door_l", np.array([0.0, -0.008, 0.0])), ajar(cabinet, "door_l", 0.2)):
        graph = true_graph(noisy, 1)
        assert mounts(graph)["door_l"] == {"left"}
        assert {h.child: (h.border, h.sign) for h in graph.hinges} == tidy


def test_codes_follow_a_mirror_image_and_outlast_stretching(cabinet: Asset) -> None:
    tidy = {h.child: (h.border, h.sign) for h in true_graph(cabinet, 1).hinges}
    wide = stretched(cabinet, np.array([1.2, 0.9, 0.8]))
    image = mirrored(cabinet)

    assert {h.child: (h.border, h.sign) for h in true_graph(wide, 1).hinges} == tidy
    turned = {h.child: (h.border, h.sign) for h in true_graph(image, 1).hinges}
    assert turned == {"door_l": tidy["door_r"], "door_r": tidy["door_l"]}


def test_a_sliding_door_runs_on_what_lies_along_its_lower_or_upper_edge() -> None:
    asset = make_sliding_doors(SlidingDoors(leaves=3))
    slides = true_graph(asset, 1).slides

    assert {(edge.parent, edge.child, edge.axis) for edge in slides} == {
        ("bottom_panel", joint.part, direction_to_code(joint.axis.direction)) for joint in asset.joints
    }


def test_a_folding_leaf_hangs_on_the_other_and_follows_it() -> None:
    graph = true_graph(make_folding_doors(FoldingDoors(side="right")), 1)
    mounts = {hinge.child: (hinge.parent, hinge.coupling) for hinge in graph.hinges}

    assert mounts == {"door_1": ("door_2", Coupling("door_2", 2.0)), "door_2": ("side_panel_right", None)}
    assert len({hinge.sign for hinge in graph.hinges}) == 2
    assert "door_2" in carriers(graph)


def test_what_moves_in_an_appliance_has_an_edge_of_its_kind() -> None:
    spec = Appliance("microwave", "microwave", racks=0, knobs=1, buttons=1, width=0.5, height=0.3, depth=0.4)
    edges = {edge.child: edge for edge in true_graph(make_appliance(spec), 1).motions}

    assert edges["turntable"] == Turn("body", "turntable", 5)
    assert edges["knob"] == Turn("panel", "knob", 2)
    assert edges["button"] == Slide("panel", "button", 3)
    assert isinstance(edges["door"], Hinge)


def test_the_halves_of_a_table_run_on_its_frame_and_one_follows() -> None:
    first, second = true_graph(make_extending_table(ExtendingTable()), 1).slides

    assert (first.axis, second.axis) == (0, 1)
    assert second.coupling == Coupling(first.child)
    assert {first.parent[:5], second.parent[:5]} == {"apron"}
