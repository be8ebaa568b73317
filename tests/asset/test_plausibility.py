from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.labels import label_of
from grafu.asset.part import Part, PartSource
from grafu.asset.plausibility import (
    BODY,
    with_blind_fronts,
    with_bodies,
    with_control_panels,
    with_plausible_labels,
)
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import PartLabel


def part(name, low, high):
    mesh = TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))
    label = label_of(name)
    by = "none" if label is PartLabel.UNKNOWN else "name"
    return Part(name, label, (Surface(mesh),), PartSource(name), by)


CASE = ((0, 0, 0), (1, 0.5, 0.8))
LEAF = ((0.05, -0.02, 0.05), (0.95, 0.0, 0.75))
INSIDE = ((0.05, 0.1, 0.3), (0.95, 0.4, 0.32))


def labels(*parts):
    return {p.id: p.label for p in with_plausible_labels(parts)[0]}


@pytest.mark.parametrize("name", ["kitchenCabinetDrawer", "door"])
def test_a_door_that_holds_the_rest_is_the_body(name):
    found, notes = with_plausible_labels((part(name, *CASE), part("shelf", *INSIDE), part("leaf", *LEAF)))
    assert found[0].label is BODY
    assert len(notes) == 1
    assert name in notes[0]


def test_a_door_that_fills_its_frame_stays_a_door():
    leaf, frame = part("door", (0, 0, 0), (1, 0.04, 2)), part("frame", (-0.05, -0.02, 0), (1.05, 0.1, 2.05))
    assert labels(leaf, frame)["door"] is PartLabel.DOOR


def test_a_strip_is_no_drawer():
    strip = part("drawer", (0, 0, 0.4), (1, 0.004, 0.404))
    assert labels(part("case", *CASE), strip)["drawer"] is PartLabel.MISC


def test_a_thin_front_stays_a_drawer():
    front = part("drawer", (0.05, -0.004, 0.4), (0.95, 0.0, 0.6))
    assert labels(part("case", *CASE), front)["drawer"] is PartLabel.DRAWER


def test_a_blurred_name_is_believed_where_the_part_is_a_front():
    outside = part("drawer_sprocket", *LEAF)
    within = part("drawer_sprocket_2", *INSIDE)
    found = labels(part("corpus", *CASE), outside, within)
    assert found["drawer_sprocket"] is PartLabel.DRAWER
    assert found["drawer_sprocket_2"] is PartLabel.MISC


@pytest.mark.parametrize(("name", "expected"), [("door_aluminum", PartLabel.MISC), ("door", PartLabel.DOOR)])
def test_a_lump_on_a_leaf_is_no_door_where_its_name_is_blurred(name, expected):
    """The lockset of a building's door: it stands at the outside of all, and is thin against that."""
    leaf, lump = part("door_leaf", (0, 0, 0), (0.9, 0.05, 2)), part(name, (0.8, -0.05, 0.9), (0.86, 0.09, 1.1))
    assert labels(leaf, lump)[name] is expected


def test_a_front_that_a_containers_name_mentions_is_one():
    found = labels(part("stairs", *CASE), part("drawerstairs3", *LEAF), part("drawer_unit", *INSIDE))
    assert found["drawerstairs3"] is PartLabel.DRAWER
    assert found["drawer_unit"] is PartLabel.UNKNOWN
    assert found["stairs"] is BODY


def test_a_slide_as_large_as_a_door_may_be_anything():
    assert labels(part("case", *CASE), part("slide.002", *LEAF))["slide.002"] is PartLabel.UNKNOWN
    assert labels(part("case", *CASE), part("slide", (0, 0, 0), (0.5, 0.02, 0.02)))["slide"] is PartLabel.MISC


def test_a_block_is_no_top():
    block, board = part("cabinet_top", (0, 0, 0.4), (1, 0.5, 0.8)), part("top", (0, 0, 0.8), (1, 0.5, 0.83))
    found = labels(part("case", (0, 0, 0), (1, 0.5, 0.4)), block, board)
    assert found == {"case": PartLabel.UNKNOWN, "cabinet_top": PartLabel.UNKNOWN, "top": PartLabel.TOP_PANEL}


def test_labels_that_the_user_gives_are_kept():
    stated = Part("x", PartLabel.DOOR, part("door", *CASE).surfaces, PartSource("door"), "user")
    assert labels(stated, part("shelf", *INSIDE), part("y", *LEAF))["x"] is PartLabel.DOOR


def test_a_panel_with_buttons_on_it_is_static():
    panel, button = part("Panel", *LEAF), part("Button", (0.5, -0.04, 0.5), (0.53, -0.02, 0.53))
    assert labels(part("oven", *CASE), panel, button)["Panel"] is PartLabel.MISC
    assert labels(part("oven", *CASE), panel)["Panel"] is PartLabel.UNKNOWN


@pytest.mark.parametrize(("height", "count", "is_static"), [(0.12, 2, True), (0.12, 1, False), (0.5, 2, False)])
def test_a_narrow_band_with_several_buttons_on_it_is_static_whatever_it_is_called(height, count, is_static):
    band = part("Pannel", (0.0, -0.02, 1.0 - height), (0.8, 0.0, 1.0))
    buttons = [part(f"Button{k}", (0.5 + 0.1 * k, -0.04, 0.92), (0.55 + 0.1 * k, -0.02, 0.97)) for k in range(count)]
    found = labels(part("washer", *CASE), band, *buttons)["Pannel"]
    assert found is (PartLabel.MISC if is_static else PartLabel.UNKNOWN)


def test_the_box_of_an_appliance_is_its_body_and_its_panel_is_static():
    case = part("kitchen", (0, 0, 0), (2, 0.6, 2))
    oven = part("kitchen_oven_main", (0.1, 0.0, 0.2), (0.7, 0.5, 0.8))
    panel = part("kitchen_oven_panel", (0.1, -0.02, 0.82), (0.7, 0.0, 0.95))
    door = part("kitchen_oven_door", (0.1, -0.03, 0.2), (0.7, 0.0, 0.8))
    found = labels(case, oven, panel, door)

    assert found["kitchen_oven_main"] is BODY
    assert found["kitchen_oven_panel"] is PartLabel.MISC
    assert found["kitchen_oven_door"] is PartLabel.DOOR


def test_the_plate_of_an_appliance_is_left_open():
    case = part("kitchen", (0, 0, 0), (2, 0.6, 2))
    assert labels(case, part("oven", (0.1, -0.03, 0.2), (0.7, 0.0, 0.8)))["oven"] is PartLabel.UNKNOWN


MICROWAVE_DOOR = part("door", (0.0, -0.03, 0.0), (0.33, 0.0, 0.25))
PANEL = part("micro_front", (0.335, -0.03, 0.0), (0.42, 0.0, 0.25))
BUTTON = part("Small_Buttons", (0.35, -0.034, 0.05), (0.4, -0.029, 0.15))


@pytest.mark.parametrize("button", ["Small_Buttons", "microbutton", "display"])
def test_a_narrow_front_with_buttons_beside_a_door_is_a_control_panel(button):
    pressed = part(button, (0.35, -0.034, 0.05), (0.4, -0.029, 0.15))
    found = {p.id: p.label for p in with_control_panels((MICROWAVE_DOOR, PANEL, pressed))}
    assert found["micro_front"] is BODY
    assert found["door"] is PartLabel.DOOR


@pytest.mark.parametrize(
    "others",
    [
        (MICROWAVE_DOOR,),  # nothing to press
        (part("micro_front_1", (0.0, -0.03, 0.0), (0.33, 0.0, 0.25)), BUTTON),  # no door
        (part("door", (0.0, -0.03, 0.0), (0.1, 0.0, 0.25)), BUTTON),  # wider than the door, and not beside it
        (part("door", (0.0, -0.03, 0.4), (0.33, 0.0, 0.7)), BUTTON),  # below the door
        (part("door", (0.0, 0.2, 0.0), (0.33, 0.22, 0.25)), BUTTON),  # in another plane
    ],
    ids=["no button", "no door", "small door", "below", "behind"],
)
def test_other_fronts_are_no_control_panels(others):
    assert {p.id: p.label for p in with_control_panels((*others, PANEL))}["micro_front"] is PartLabel.UNKNOWN


STEPS = [((0.3 * k, 0.0, 0.0), (0.3 * k + 0.3, 0.5, 0.9 - 0.2 * k)) for k in range(4)]  # down along +X


def test_fronts_far_inside_the_whole_are_fronts_where_nothing_stands_before_them():
    fronts = [part(f"drawerstairs{k}", (0.3 * k + 0.3, 0.05, 0.72 - 0.2 * k), (0.3 * k + 0.32, 0.45, 0.88 - 0.2 * k))
              for k in range(4)]  # fmt: skip
    hidden = part("drawerstairs9", (0.28, 0.05, 0.05), (0.3, 0.45, 0.2))  # the other steps stand before it
    behind = part("crate", (0.31, 0.0, 0.0), (0.4, 0.5, 0.25)), part("cupboard", (0.0, 0.0, 0.0), (0.27, 0.5, 0.25))
    found = labels(part("steps", (0, 0, 0), (1.2, 0.5, 0.9)), *fronts, hidden, *behind)
    assert all(found[front.id] is PartLabel.DRAWER for front in fronts)
    assert found["drawerstairs9"] is PartLabel.MISC or found["drawerstairs9"] is PartLabel.UNKNOWN


def test_what_holds_several_drawers_is_their_body_whatever_its_name():
    fronts = [part(f"drawer_{k}", (0.05, 0.0, 0.25 * k + 0.05), (0.45, 0.02, 0.25 * k + 0.25)) for k in range(3)]
    box, beside = part("box", (0, 0, 0), (0.5, 0.5, 0.8)), part("Cube.003", (0.6, 0, 0), (1.1, 0.5, 0.8))
    found = {p.id: (p.label, p.labelled_by) for p in with_bodies((box, beside, *fronts))}
    assert found["box"] == (BODY, "shape")
    assert found["Cube.003"] == (PartLabel.UNKNOWN, "none")
    assert with_bodies((box, beside, fronts[0]))[0].label is PartLabel.UNKNOWN  # a drawer box behind its one front
    named = part("leg", *CASE)
    assert with_bodies((named, *fronts))[0].label is named.label


@pytest.mark.parametrize(
    ("name", "front", "is_body"),
    [
        ("cabinet_1_Cube.004", "flap_1", True),
        ("Cube.004", "flap_1", False),
        ("cabinet_1_Cube.004", "drawer_1", False),
        ("cabinet_1_side", "flap_1", False),
    ],
    ids=["a cabinet", "nothing by its name", "a drawer's box", "a part of it"],
)
def test_what_is_called_a_cabinet_is_the_body_of_its_one_door(name, front, is_body):
    wide = part("top", (-1, 0, 0.8), (1, 0.6, 0.83))
    body, other = part(name, (0, 0.02, 0.3), (0.4, 0.5, 0.8)), part(front, (0, 0, 0.31), (0.4, 0.02, 0.79))
    assert (with_bodies((body, other, wide))[0].label is BODY) is (is_body or body.label is BODY)


def sink_base(*without):
    """Two doors with handles, each under a front that is called a drawer."""
    found = []
    for k, x in enumerate((0.0, 0.5)):
        found += [
            part(f"door_{k}", (x, -0.02, 0.1), (x + 0.48, 0.0, 0.6)),
            replace(part(f"handle_{k}", (x + 0.1, -0.05, 0.5), (x + 0.2, -0.02, 0.51)), carried_by=f"door_{k}"),
            part(f"drawer_front_{k}", (x, -0.02, 0.61), (x + 0.48, 0.0, 0.78)),
        ]
    return tuple(p for p in found if p.id not in without)


def drawers(parts):
    return {p.id for p in with_blind_fronts(parts)[0] if p.label is PartLabel.DRAWER}


def test_fronts_without_handles_above_doors_with_handles_are_blind():
    found, notes = with_blind_fronts(sink_base())
    assert {p.label for p in found if p.id.startswith("drawer_front")} == {PartLabel.FACE_FRAME}
    assert len(notes) == 2
    assert notes[0].startswith("drawer_front_0: taken for a blind front")


def test_a_front_with_a_handle_or_a_box_is_a_drawer():
    handle = replace(part("handle", (0.1, -0.05, 0.7), (0.2, -0.02, 0.71)), carried_by="drawer_front_0")
    assert "drawer_front_0" in drawers((*sink_base(), handle))
    boxed = part("drawer_front_0", (0.0, -0.02, 0.61), (0.48, 0.4, 0.78))
    assert drawers((*sink_base("drawer_front_0"), boxed)) == {"drawer_front_0", "drawer_front_1"}


def test_where_a_door_has_no_handle_either_fronts_are_drawers():
    assert drawers(sink_base("handle_1")) == {"drawer_front_0", "drawer_front_1"}


def test_a_plain_front_elsewhere_is_a_drawer():
    beside = part("drawer_front_9", (1.1, -0.02, 0.1), (1.5, 0.0, 0.3))
    assert drawers((*sink_base("drawer_front_0", "drawer_front_1"), beside)) == {"drawer_front_9"}


@pytest.mark.parametrize(("name", "is_static"), [("console", True), ("plank", False)])
def test_a_console_with_a_screen_on_it_is_static(name, is_static):
    front, screen = part(name, *LEAF), part("screen", (0.5, -0.025, 0.5), (0.7, -0.02, 0.6))
    assert (labels(part("dryer", *CASE), front, screen)[name] is PartLabel.MISC) is is_static
