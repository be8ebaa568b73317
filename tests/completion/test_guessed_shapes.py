"""What has not the shape of a door or drawer stays static, whatever is guessed; what looks like it moves."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from grafu.asset.part import Asset, Part
from grafu.completion.guessed_shapes import shape_against
from grafu.completion.static_guesses import with_static_guesses
from grafu.geometry.appearance import Surface
from grafu.geometry.mesh import TriangleMesh
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Edge, Hinge, Rail, Slide
from grafu.graph.edit import relabelled, with_edges, without_edges
from grafu.graph.parse import parse_graph
from grafu.vocabulary import PartLabel
from small_scenes import BASE_CASE, box

FRONT = 2  # -Y
NO_TOP = [part for part in BASE_CASE if part.id != "top"]
TOP = box("board", (-0.1, -0.1, 0.82), (0.7, 0.65, 0.84))
LEGS = [
    box(f"leg_{x}_{y}", (x, y, 0.0), (x + 0.03, y + 0.03, 0.82)) for x in (-0.1, 0.67) for y in (-0.1, 0.62)
]  # the corners of a table


def merged(name: str, *parts: Part) -> Part:
    return replace(parts[0], id=name, label=PartLabel.UNKNOWN, surfaces=tuple(s for p in parts for s in p.surfaces))


def shaped(name: str, mesh: trimesh.Trimesh) -> Part:
    made = box(name, (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
    return replace(made, label=PartLabel.UNKNOWN, surfaces=(Surface(TriangleMesh.from_trimesh(mesh)),))


def ring(name: str, low, high, wall: float = 0.01) -> Part:
    """Four walls without a bottom."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    return merged(
        name,
        box("left", low, (x0 + wall, y1, z1)),
        box("right", (x1 - wall, y0, z0), high),
        box("front", low, (x1, y0 + wall, z1)),
        box("back", (x0, y1 - wall, z0), high),
    )


def tray(name: str, low, high) -> Part:
    return merged(name, ring(name, low, high), box("bottom", low, (high[0], high[1], low[2] + 0.01)))


def made(parts: list[Part], taken: str, edge: Edge) -> tuple[Asset, GraphCompletion]:
    label = PartLabel.DRAWER if isinstance(edge, Rail) else PartLabel.DOOR
    asset = Asset("made", "", "made", tuple(replace(p, label=PartLabel.UNKNOWN, labelled_by="none") for p in parts))
    graph = parse_graph(asset)
    support = {p.id: PartLabel.SIDE_PANEL for p in asset.parts}
    completed = with_edges(relabelled(graph, support | {taken: label}), [edge])
    return asset, GraphCompletion(graph, completed, "network", decisions=(Decision(taken, "label", label, 0.9),))


def why(parts: list[Part], taken: str = "guess", edge: Edge | None = None, is_held: bool = False) -> str:
    asset, completion = made(parts, taken, edge or Rail(parts[0].id, taken, FRONT))
    return shape_against(completion.completed.node(taken), asset, completion.completed, is_held)


LOW, HIGH = (0.02, 0.0, 0.6), (0.58, 0.5, 0.8)  # where the upper drawer of the case is


def test_a_cushion_between_the_arms_of_a_sofa_is_no_drawer_and_an_open_one_in_a_case_without_a_top_is():
    cushion = box("guess", LOW, HIGH)
    assert "solid block" in why([*NO_TOP, cushion])
    assert why([*NO_TOP, tray("guess", LOW, HIGH)]) == ""
    assert why([*BASE_CASE, cushion]) == "", "a block that the case covers is a drawer that was drawn simply"
    assert why([*NO_TOP, cushion], is_held=True) == "", "a handle on it shows that it is one"


def test_a_block_whose_case_is_drawn_into_it_is_a_drawer():
    """Of parts that overlap, the bottom ends within the drawer: it is below it all the same."""
    sides = [part for part in BASE_CASE if part.id in ("left", "right", "back")]
    sunk = box("bottom", (0.02, 0.0, 0.596), (0.58, 0.5, 0.606)), box("lid", (0.0, 0.0, 0.795), (0.6, 0.55, 0.804))

    assert why([*sides, *sunk, box("guess", LOW, HIGH)]) == ""
    assert "solid block" in why([*sides, sunk[0], box("guess", LOW, HIGH)]), "it is open from above"


def test_the_base_under_a_mattress_is_no_drawer_and_one_under_a_table_top_is():
    low, high = (-0.06, -0.08, 0.7), (0.66, 0.6, 0.82)
    assert "solid block" in why([TOP, *LEGS, box("guess", low, high)])
    assert why([TOP, *LEGS, tray("guess", low, high)]) == ""
    keys = box("guess", (0.1, -0.08, 0.79), (0.5, 0.4, 0.82))
    assert why([TOP, *LEGS, keys]) == "", "a board for a keyboard"


@pytest.mark.parametrize(("length", "is_held", "said"), [(1.9, False, "longer"), (0.9, False, ""), (1.9, True, "")])
def test_a_mattress_under_its_blanket_is_no_drawer(length, is_held, said):
    """The blanket hangs down on all sides, as a case would stand around a drawer."""
    blanket = merged(
        "blanket",
        ring("sides", (-0.71, 0.0, 0.2), (0.71, length, 0.5)),
        box("above", (-0.71, 0.0, 0.48), (0.71, length, 0.5)),
    )
    base = box("base", (-0.7, 0.0, 0.1), (0.7, length, 0.24))
    told = why([base, blanket, box("guess", (-0.69, 0.02, 0.25), (0.69, length - 0.02, 0.43))], is_held=is_held)
    assert told == ("" if not said else "it is longer than drawers are")


@pytest.mark.parametrize(
    ("width", "height", "is_held", "said"),
    [(0.05, 0.2, False, True), (0.05, 0.2, True, False), (0.05, 0.06, False, False), (0.12, 0.2, False, False)],
    ids=["a book", "with a handle", "a low one", "a wide one"],
)
def test_a_book_in_a_case_is_no_drawer(width, height, is_held, said):
    books = [box(f"book_{k}", (0.03 + k, 0.1, 0.1), (0.02 + k + width, 0.35, 0.1 + height)) for k in (0.2, 0.4)]
    guess = tray("guess", (0.25, 0.1, 0.1), (0.25 + width, 0.35, 0.1 + height))
    told = why([*BASE_CASE, *books, guess], is_held=is_held)
    assert (told == "it is as narrow and high as a book") is said


def test_the_frame_of_a_table_is_no_drawer():
    assert "no bottom" in why([TOP, *LEGS, ring("guess", (-0.06, -0.08, 0.7), (0.66, 0.6, 0.82))])
    assert "no bottom" in why([TOP, *LEGS, ring("guess", (-0.06, -0.08, 0.7), (0.66, 0.6, 0.82))], is_held=True)
    floor = box("floor_of_it", (-0.05, -0.07, 0.7), (0.65, 0.59, 0.71))
    assert why([TOP, *LEGS, ring("guess", (-0.06, -0.08, 0.7), (0.66, 0.6, 0.82)), floor]) == "", "another part is it"


def test_a_seat_on_legs_is_in_no_case():
    low, high = (-0.05, -0.05, 0.4), (0.65, 0.6, 0.5)
    seat = tray("guess", low, high)
    beside = [box(f"bar_{x}", (x, 0.1, 0.4), (x + 0.02, 0.45, 0.6)) for x in (-0.1, 0.68)]
    assert "in no case" in why([*LEGS, *beside, seat])
    assert "in no case" in why([*LEGS, *beside, seat], is_held=True)
    assert why([TOP, *LEGS, *beside, seat]) == "", "a drawer that both ends of a table show"


def test_a_plant_is_no_door_and_a_bent_front_or_one_that_stands_open_is():
    ball = trimesh.creation.icosphere(subdivisions=3, radius=0.25)
    ball.apply_scale([1.0, 0.3, 1.0]).apply_translation([0.3, -0.08, 0.4])
    edge = Hinge("left", "guess", 0, 1)
    assert "round" in why([*BASE_CASE, shaped("guess", ball)], edge=edge)
    assert why([*BASE_CASE, shaped("guess", ball)], edge=edge, is_held=True) == "", "a round lid with a handle"

    angles = np.radians(np.linspace(-110, -70, 9))
    arc = np.array([[0.3 + r * np.cos(a), 0.8 + r * np.sin(a)] for r in (0.8, 0.82) for a in angles])
    arc[len(angles) :] = arc[len(angles) :][::-1]
    bent = trimesh.creation.extrude_polygon(trimesh.path.polygons.Polygon(arc), 0.6)
    assert why([*BASE_CASE, shaped("guess", bent)], edge=edge) == ""

    ajar = trimesh.creation.box((0.5, 0.02, 0.6))
    ajar.apply_translation([0.25, 0.0, 0.4]).apply_transform(trimesh.transformations.rotation_matrix(-0.7, [0, 0, 1]))
    assert why([*BASE_CASE, shaped("guess", ajar)], edge=edge) == ""


def bevelled(low, high, width: float, deep: float) -> trimesh.Trimesh:
    """A plate at y = 0 whose face slopes to all four sides, over so much of its width."""
    inner_low, inner_high = np.array(low) + width, np.array(high) - width
    rims = [(low, high, 0.0), (low, high, -0.005), (inner_low, inner_high, -0.005 - deep)]
    points = [(x, y, z) for a, b, y in rims for x in (a[0], b[0]) for z in (a[1], b[1])]
    return trimesh.Trimesh(points).convex_hull


def test_fronts_with_bevels_on_all_sides_are_not_round_and_domes_and_pipes_are():
    """Of a low drawer the bevels are most of what is seen."""
    rail, edge = Rail("left", "guess", FRONT), Hinge("left", "guess", 0, 1)
    low = bevelled((0.02, 0.6), (0.58, 0.76), 0.06, 0.05)
    assert why([*BASE_CASE, shaped("guess", low)], edge=rail) == ""
    assert why([*BASE_CASE, shaped("guess", bevelled((0.02, 0.1), (0.58, 0.7), 0.2, 0.12))], edge=edge) == ""

    dome = trimesh.creation.icosphere(subdivisions=3, radius=0.25)
    dome.apply_scale([1.0, 0.4, 1.0]).apply_translation([0.3, 0.0, 0.4])
    assert "round" in why([*BASE_CASE, shaped("guess", dome.slice_plane([0, 0, 0], [0, -1, 0], cap=True))], edge=edge)
    pipe = trimesh.creation.cylinder(0.08, 0.56, sections=24)
    pipe.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, [0, 1, 0])).apply_translation([0.3, 0, 0.7])
    assert "round" in why([*BASE_CASE, shaped("guess", pipe)], edge=rail)


@pytest.mark.parametrize(("depth", "is_static"), [(0.02, False), (0.1, False), (0.2, True)])
def test_a_post_is_no_door(depth, is_static):
    post = box("guess", (0.0, -depth, 0.1), (0.3, 0.0, 0.8))
    assert ("too thick" in why([*BASE_CASE, post], edge=Hinge("left", "guess", 0, 1))) is is_static


PANE = np.array([[0, 1, 2], [0, 2, 3]])


def frame(bar: float) -> Part:
    x0, x1, z0, z1 = 0.0, 0.6, 0.1, 0.8
    return merged(
        "guess",
        box("a", (x0, -0.02, z0), (x1, 0.0, z0 + bar)),
        box("b", (x0, -0.02, z1 - bar), (x1, 0.0, z1)),
        box("c", (x0, -0.02, z0), (x0 + bar, 0.0, z1)),
        box("d", (x1 - bar, -0.02, z0), (x1, 0.0, z1)),
    )


def test_a_frame_around_nothing_is_a_door_of_glass_but_no_front_of_a_drawer_and_a_loop_of_wire_is_neither():
    edge = Hinge("left", "guess", 0, 1)
    assert why([*BASE_CASE, frame(0.08)], edge=edge) == ""
    assert "hardly anything" in why([*BASE_CASE, frame(0.005)], edge=edge)
    assert "a front is closed" in why([*BASE_CASE, frame(0.08)])
    panel = box("panel", (0.05, -0.015, 0.15), (0.55, -0.005, 0.75))
    assert why([*BASE_CASE, frame(0.08), panel]) == ""


@pytest.mark.parametrize("deep", [0.01, 0.02, 0.03])
def test_a_pane_within_the_thickness_of_a_high_leaf_closes_it(deep):
    """It is a face without thickness: rays that start behind it meet nothing."""
    bars = [
        ((0.0, 0.0), (0.06, 2.0)),
        ((0.74, 0.0), (0.8, 2.0)),
        ((0.06, 0.0), (0.74, 0.06)),
        ((0.06, 1.94), (0.74, 2.0)),
    ]
    boxes = [box(str(k), (a[0], -0.04, a[1]), (b[0], 0.0, b[1])) for k, (a, b) in enumerate(bars)]
    corners = np.array([[x, deep - 0.04, z] for x, z in ((0.06, 0.06), (0.74, 0.06), (0.74, 1.94), (0.06, 1.94))])
    pane = replace(box("pane", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), surfaces=(Surface(TriangleMesh(corners, PANE)),))
    edge = Hinge("left", "guess", 0, 1)
    assert "hardly anything" in why([*BASE_CASE, merged("guess", *boxes)], edge=edge)
    assert why([*BASE_CASE, merged("guess", *boxes), pane], edge=edge) == ""


@pytest.mark.parametrize("count", [4, 5, 8, 10])
def test_a_door_of_planks_is_closed_and_one_of_wires_is_not(count):
    """Seams between planks lie at even steps, where a regular grid of rays would meet nothing else."""
    width, edge = 0.8 / count, Hinge("left", "guess", 0, 1)

    def upright(seam: float) -> Part:
        ends = [(k * width + seam / 2, (k + 1) * width - seam / 2) for k in range(count)]
        return merged("guess", *(box(str(k), (x0, -0.02, 0.0), (x1, 0.0, 1.0)) for k, (x0, x1) in enumerate(ends)))

    assert why([*BASE_CASE, upright(0.003)], edge=edge) == ""
    assert "hardly anything" in why([*BASE_CASE, upright(width - 0.002)], edge=edge)


def test_a_drawer_drawn_as_one_sheet_is_closed():
    sheet = TriangleMesh(
        np.array([[0.0, 0, 0.1], [0.6, 0, 0.1], [0.6, 0, 0.8], [0.0, 0, 0.8]]), np.array([[0, 1, 2], [0, 2, 3]])
    )
    part = replace(box("guess", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), surfaces=(Surface(sheet),))
    assert why([*BASE_CASE, part]) == ""


def test_a_grip_along_a_front_is_no_drawer_and_a_low_front_or_one_with_a_box_is():
    grip = box("guess", (0.02, -0.02, 0.6), (0.58, 0.0, 0.63))
    assert why([*BASE_CASE, grip]) == "it is a strip, lower than fronts of drawers are"
    assert why([*BASE_CASE, grip], is_held=True) == ""
    assert why([*BASE_CASE, box("guess", (0.02, -0.02, 0.6), (0.58, 0.0, 0.67))]) == "", "twice as high"
    assert why([*BASE_CASE, box("guess", (0.02, -0.02, 0.6), (0.2, 0.0, 0.63))]) == "", "a third as wide"
    assert why([*BASE_CASE, tray("guess", (0.02, -0.02, 0.6), (0.58, 0.5, 0.63))]) == "", "a shallow drawer"


def test_what_stays_static_slides_no_more():
    post = box("guess", (0.0, -0.2, 0.1), (0.3, 0.0, 0.8))
    asset, completion = made([*BASE_CASE, post], "guess", Slide("left", "guess", 1))
    found = with_static_guesses(completion, asset)
    assert [refusal.part for refusal in found.refused] == ["guess"]
    assert found.completed.motions == ()


def test_what_no_rail_carries_is_judged_as_a_drawer_that_opens_to_the_front():
    trestle = ring("guess", (-0.06, -0.08, 0.0), (0.66, 0.6, 0.82), 0.03)
    asset, completion = made([TOP, *LEGS, trestle], "guess", Rail("board", "guess", FRONT))
    graph = without_edges(completion.completed, completion.completed.rails)
    assert "no bottom" in shape_against(graph.node("guess"), asset, graph)


@pytest.mark.parametrize(("width", "is_static"), [(0.03, False), (0.3, True)])
def test_a_knob_in_one_with_its_front_makes_no_door_too_thick(width, is_static):
    """What stands out of it has little of its surface; a block on it makes it one."""
    front, middle = box("front", (0.02, -0.02, 0.6), (0.58, 0.0, 0.72)), 0.3
    knob = box("knob", (middle - width / 2, -0.06, 0.66 - min(width, 0.1) / 2), (middle + width / 2, -0.02, 0.68))
    door = merged("guess", front, knob)
    assert ("too thick" in why([*BASE_CASE, door], edge=Hinge("left", "guess", 0, 1))) is is_static


def test_a_board_of_a_post_is_no_door_and_that_of_a_slim_cabinet_is():
    edge = Hinge("board", "guess", 0, 1)

    def of_boards(width: float, depth: float) -> list[Part]:
        end = 0.01 + width
        return [
            TOP,
            box("left", (0.0, 0.01, 0.0), (0.01, depth, 0.8)),
            box("right", (end, 0.01, 0.0), (end + 0.01, depth, 0.8)),
            box("back", (0.01, depth - 0.01, 0.0), (end, depth, 0.8)),
            box("guess", (0.0, 0.0, 0.0), (end + 0.01, 0.01, 0.8)),
        ]

    assert why(of_boards(0.1, 0.1), edge=edge) == "it is a board of a post, which holds nothing"
    assert why(of_boards(0.1, 0.1), edge=edge, is_held=True) == "", "a handle is on it"
    assert why(of_boards(0.1, 0.4), edge=edge) == "", "bottles stand behind each other"
    assert why(of_boards(0.3, 0.1), edge=edge) == "", "a shallow wall cabinet"
    assert why([part for part in of_boards(0.1, 0.1) if part.id in {"board", "guess"}], edge=edge) == "", (
        "a board alone"
    )


@pytest.mark.parametrize(("hollow", "kept"), [(False, False), (True, True)])
def test_a_cushion_on_a_closed_seat_is_no_lid(hollow, kept):
    cushion = box("cushion", (-0.3, -0.35, 0.3), (0.3, 0.25, 0.45))
    body = (
        tray("base", (-0.3, -0.35, 0.0), (0.3, 0.25, 0.3))
        if hollow
        else box("base", (-0.3, -0.35, 0.0), (0.3, 0.25, 0.3))
    )
    asset, completion = made([cushion, body], "cushion", Hinge("base", "cushion", 0, 1))
    assert (shape_against(completion.completed.node("cushion"), asset, completion.completed) == "") is kept


@pytest.mark.parametrize(
    ("depth", "is_held", "is_static"), [(0.15, True, False), (0.15, False, True), (0.45, True, True)]
)
def test_a_door_with_a_handle_may_have_bins_behind_it(depth, is_held, is_static):
    """Nearly half as deep as wide; a drawer, which reaches far back, and a block without a handle are no doors."""
    asset, completion = made(
        [*BASE_CASE, box("guess", (0.0, -0.02, 0.1), (0.35, depth, 0.8))], "guess", Hinge("left", "guess", 0, 1)
    )
    said = shape_against(completion.completed.node("guess"), asset, completion.completed, is_held)
    assert ("too thick" in said) is is_static
