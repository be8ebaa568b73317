"""What is only guessed to be a door or drawer stays static where others stand on it, and where the guess is weak.

Each case stands beside what looks like it and moves.
"""

from dataclasses import replace

import pytest

from grafu.asset.part import Asset, Part
from grafu.completion.static_guesses import StaticGuessConfig, static_guesses, with_static_guesses
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Attached, Edge, Hinge, Rail
from grafu.graph.edit import relabelled, with_edges
from grafu.graph.functional_graph import PartNode
from grafu.graph.parse import parse_graph
from grafu.pipeline.complete import complete_by_weights
from grafu.refusal import Reason
from grafu.vocabulary import PartLabel
from small_scenes import box

FRONT, BACK = 2, 3  # -Y, +Y
DEFAULT = StaticGuessConfig()
UNKNOWN = PartLabel.UNKNOWN


def at(name: str, low, high, label: PartLabel = UNKNOWN) -> Part:
    return replace(box(name, low, high), label=label)


def legs(height: float, aside: float = 0.45) -> list[Part]:
    places = [(x, y) for x in (-aside, aside) for y in (-aside, aside)]
    return [
        at(f"leg_{k}", (x - 0.03, y - 0.03, 0.0), (x + 0.03, y + 0.03, height), PartLabel.LEG)
        for k, (x, y) in enumerate(places)
    ]


def drawer(name: str, low, high) -> Part:
    """A drawer as one part: a bottom and four sides, open from above."""
    (x0, y0, z0), (x1, y1, z1), t = low, high, 0.01
    boards = [
        at("bottom", low, (x1, y1, z0 + t)),
        at("left", low, (x0 + t, y1, z1)),
        at("right", (x1 - t, y0, z0), high),
        at("front", low, (x1, y0 + t, z1)),
        at("back", (x0, y1 - t, z0), high),
    ]
    return replace(boards[0], id=name, surfaces=tuple(surface for board in boards for surface in board.surfaces))


TOP = at("board", (-0.55, -0.55, 0.7), (0.55, 0.55, 0.72), PartLabel.TOP_PANEL)
APRON = at("frame", (-0.48, -0.48, 0.6), (0.48, 0.48, 0.7))
BETWEEN = drawer("frame", (-0.4, -0.42, 0.58), (0.4, 0.42, 0.7))
SIDES = [
    at(f"side_{k}", (x, -0.3, 0.0), (x + 0.02, 0.3, 0.5), PartLabel.SIDE_PANEL) for k, x in enumerate((-0.3, 0.28))
]


def guessed(
    parts: list[Part], taken: str, label: PartLabel = PartLabel.DRAWER, score: float = 0.9, edges: tuple[Edge, ...] = ()
) -> tuple[GraphCompletion, Asset]:
    """Returns furniture of which the part `taken`, which has no label, was guessed to be a door or drawer."""
    asset = Asset("made", "", "made", tuple(parts))
    graph = parse_graph(asset)
    mount = next(part.id for part in parts if part.id != taken and part.label is not PartLabel.HANDLE)
    moves = edges or ((Rail(mount, taken, FRONT),) if label is PartLabel.DRAWER else (Hinge(mount, taken, 0, 1),))
    labelled = relabelled(graph, {p.id: PartLabel.MISC for p in parts if p.label is UNKNOWN} | {taken: label})
    decisions = (Decision(taken, "label", label, score, "misc", 1.0 - score),)
    return GraphCompletion(graph, with_edges(labelled, moves), "network", decisions=decisions), asset


def reasons(completion: GraphCompletion, asset: Asset) -> list[Reason]:
    return [refusal.reason for refusal in static_guesses(completion, asset)]


def with_score(completion: GraphCompletion, part: str, question: str, score: float) -> GraphCompletion:
    decision = Decision(part, question, "0", score, "1", 1.0 - score)
    return replace(completion, decisions=(*completion.decisions, decision))


@pytest.mark.parametrize("ornament", [(), (at("rosette", (-0.05, -0.5, 0.63), (0.05, -0.48, 0.67)),)])
def test_the_frame_between_a_top_and_its_legs_is_no_drawer(ornament):
    completion, asset = guessed([TOP, APRON, *legs(0.6), *ornament], "frame")
    (refusal,) = static_guesses(completion, asset)
    assert refusal.reason is Reason.CARRIES
    assert "taken for a drawer (90%)" in refusal.why
    assert "board stands on it" in refusal.why


def test_a_top_and_its_legs_may_be_one_part():
    whole = [TOP, *legs(0.6)]
    surfaces = tuple(surface for part in whole for surface in part.surfaces)
    merged = replace(TOP, id="table", surfaces=surfaces, label=PartLabel.MISC)
    assert reasons(*guessed([merged, APRON], "frame")) == [Reason.CARRIES]


MATTRESS = at("mattress", (-0.47, -0.47, 0.4), (0.47, 0.47, 0.55), PartLabel.MISC)
BASE = at("base", (-0.48, -0.48, 0.3), (0.48, 0.48, 0.4))
HEADBOARD = at("headboard", (-0.5, 0.48, 0.0), (0.5, 0.5, 0.9), PartLabel.BACK_PANEL)


def test_the_base_of_a_bed_stands_on_its_legs_and_is_no_drawer():
    (refusal,) = static_guesses(*guessed([HEADBOARD, MATTRESS, BASE, *legs(0.3)], "base"))
    assert (refusal.reason, "legs carry it" in refusal.why) == (Reason.CARRIES, True)


def test_what_legs_do_not_carry_may_be_a_drawer():
    on_two = [HEADBOARD, MATTRESS, BASE, *legs(0.3)[:2]]
    beside = [HEADBOARD, MATTRESS, BASE, *legs(0.4, aside=0.51)]
    for parts in (on_two, beside):
        assert Reason.CARRIES not in reasons(*guessed(parts, "base"))


def test_what_stands_on_the_floor_under_all_else_is_no_door():
    parts = [at("shaft", (-0.2, -0.2, 0.0), (0.2, 0.2, 0.9)), at("cap", (-0.3, -0.3, 0.9), (0.3, 0.3, 1.1))]
    assert reasons(*guessed(parts, "shaft", PartLabel.DOOR)) == [Reason.CARRIES]


def test_it_stays_whatever_the_shipped_network_takes_it_for():
    parts = [at("a", (-0.22, -0.22, 0.0), (0.22, 0.22, 0.88)), at("b", (-0.33, -0.33, 0.88), (0.33, 0.33, 1.1))]
    asset = Asset("made", "", "made", tuple(replace(part, labelled_by="none") for part in parts))
    completion = complete_by_weights(asset, parse_graph(asset))
    assert not completion.completed.moving


LOOK_ALIKES = {
    "a drawer that hangs below the top between legs": ([TOP, BETWEEN, *legs(0.7)], "frame"),
    "a drawer with a handle on its front": ([TOP, APRON, *legs(0.6), "handle"], "frame"),
    "a drawer as wide as a night stand": (
        [
            *SIDES,
            at("top", (-0.3, -0.3, 0.5), (0.3, 0.3, 0.52), PartLabel.TOP_PANEL),
            drawer("front", (-0.3, -0.32, 0.2), (0.3, 0.28, 0.5)),
        ],
        "front",
    ),
    "a drawer on which a lamp stands": (
        [
            *SIDES,
            at("lamp", (-0.05, -0.05, 0.4), (0.05, 0.05, 0.7)),
            drawer("tray", (-0.27, -0.28, 0.2), (0.27, 0.28, 0.4)),
        ],
        "tray",
    ),
}


@pytest.mark.parametrize("case", LOOK_ALIKES)
def test_what_looks_like_such_a_frame_moves(case):
    given, taken = LOOK_ALIKES[case]
    parts = [part for part in given if isinstance(part, Part)]
    edges: tuple[Edge, ...] = (Rail(parts[0].id, taken, FRONT),)
    if "handle" in given:
        parts.append(at("handle", (-0.1, -0.5, 0.64), (0.1, -0.48, 0.66), PartLabel.HANDLE))
        edges += (Attached(taken, "handle"),)
    assert reasons(*guessed(parts, taken, edges=edges)) == []


def test_a_lid_with_a_cushion_on_it_turns():
    parts = [
        at("chest", (-0.4, -0.2, 0.0), (0.4, 0.2, 0.4), PartLabel.SIDE_PANEL),
        at("lid", (-0.4, -0.2, 0.4), (0.4, 0.2, 0.42)),
        at("cushion", (-0.4, -0.2, 0.42), (0.4, 0.2, 0.5), PartLabel.MISC),
    ]
    assert reasons(*guessed(parts, "lid", PartLabel.DOOR)) == []


def case_with(*parts: Part) -> list[Part]:
    return [*SIDES, at("base", (-0.28, -0.3, 0.0), (0.28, 0.3, 0.02), PartLabel.BOTTOM_PANEL), *parts]


INSIDE = at("front", (-0.27, -0.32, 0.05), (0.27, -0.3, 0.25))


@pytest.mark.parametrize("score", [0.2, 0.49, 0.51, 0.9])
@pytest.mark.parametrize(
    ("label", "question", "least"),
    [(PartLabel.DRAWER, "slide", DEFAULT.slide), (PartLabel.DOOR, "sign", DEFAULT.sign)],
)
def test_what_may_as_well_open_another_way_stays(score, label, question, least):
    completion, asset = guessed(case_with(INSIDE), "front", label)
    unsure = with_score(completion, "front", question, score)
    assert reasons(unsure, asset) == ([Reason.UNLIKELY] if score < least else [])

    handle = at("handle", (-0.1, -0.34, 0.14), (0.1, -0.32, 0.16), PartLabel.HANDLE)
    edges = (*completion.completed.motions, Attached("front", "handle"))
    held, asset = guessed(case_with(INSIDE, handle), "front", label, edges=edges)
    assert reasons(with_score(held, "front", question, score), asset) == []

    soap = at("handle", (-0.1, -0.32, 0.25), (0.1, -0.3, 0.3), PartLabel.HANDLE)  # it lies on it
    laid, asset = guessed(case_with(INSIDE, soap), "front", label, edges=edges)
    assert reasons(with_score(laid, "front", question, score), asset) == ([Reason.UNLIKELY] if score < least else [])


def test_what_is_likelier_neither_door_nor_drawer_stays():
    assert reasons(*guessed(case_with(INSIDE), "front", score=0.3)) == [Reason.UNLIKELY]
    completion, asset = guessed(case_with(INSIDE), "front", score=0.3)
    either = (replace(completion.decisions[0], runner_up="door", runner_up_score=0.3),)
    assert reasons(replace(completion, decisions=either), asset) == []
    handle = at("handle", (-0.1, -0.34, 0.14), (0.1, -0.32, 0.16), PartLabel.HANDLE)
    edges = (Rail("side_0", "front", FRONT), Attached("front", "handle"))
    assert reasons(*guessed(case_with(INSIDE, handle), "front", score=0.3, edges=edges)) == []


PLATE = at("glass", (-0.5, -0.2, 0.4), (0.5, 0.2, 0.41), PartLabel.MISC)


@pytest.mark.parametrize(
    ("parts", "taken", "is_static"),
    [
        ([PLATE, at("bracket", (-0.2, -0.2, 0.3), (0.2, -0.17, 0.4))], "bracket", True),
        ([PLATE, drawer("tray", (-0.2, -0.2, 0.3), (0.2, 0.15, 0.4))], "tray", False),
        ([PLATE, at("bottle", (-0.1, -0.1, 0.41), (0.1, 0.1, 0.8))], "bottle", True),
        ([PLATE, *SIDES, at("bracket", (-0.2, -0.2, 0.3), (0.2, -0.17, 0.4))], "bracket", False),
    ],
    ids=["a bracket below a plate", "a box that hangs from it", "a bottle on it", "a front between sides"],
)
def test_a_drawer_needs_something_that_could_hold_it(parts, taken, is_static):
    assert reasons(*guessed(parts, taken)) == ([Reason.UNLIKELY] if is_static else [])


def test_a_part_whose_label_is_stated_is_no_guess():
    completion, asset = guessed([TOP, replace(APRON, label=PartLabel.DRAWER), *legs(0.6)], "frame")
    stated = replace(completion, decisions=())
    assert reasons(stated, asset) == []


def test_what_stays_static_is_refused_and_all_others_move_as_they_did():
    handle = at("handle", (-0.05, -0.05, 0.72), (0.05, 0.05, 0.76), PartLabel.HANDLE)
    tray = at("tray", (-0.2, -0.2, 0.0), (0.2, 0.2, 0.1), PartLabel.DRAWER)
    edges = (Rail("board", "frame", FRONT), Rail("leg_0", "tray", BACK), Attached("frame", "handle"))
    completion, asset = guessed([TOP, APRON, *legs(0.6), handle, tray], "frame", edges=edges)
    added = PartNode("handle_added_1", PartLabel.HANDLE, handle.box)
    graph = completion.completed
    grown = replace(graph, nodes=(*graph.nodes, added), edges=(*graph.edges, Attached("frame", "handle_added_1")))
    told = (
        Decision("frame", "slide", "2", 0.9),
        Decision("handle", "parent", "frame", 0.9),
        Decision("tray", "slide", "3", 0.8),
        Decision("handle_added_1", "exists", "yes", 0.9),
    )
    made = GraphCompletion(
        completion.input,
        grown,
        "network",
        ("handle_added_1",),
        (*completion.decisions, *told),
        rides=(("frame", "handle"),),
    )

    found = with_static_guesses(made, asset)

    assert [(edge.parent, edge.child) for edge in found.completed.motions] == [("leg_0", "tray")]
    assert (found.completed.attachments, found.added, found.rides) == ((), (), ())
    assert [(refusal.part, refusal.reason) for refusal in found.refused] == [("frame", Reason.CARRIES)]
    (label, tray_slides) = found.decisions
    assert (label.choice, label.runner_up, label.runner_up_score) == ("misc", "drawer", 0.9)
    assert tray_slides == told[2]
    assert with_static_guesses(found, asset) is found


def test_a_door_on_a_post_that_was_taken_for_one_hangs_on_the_post():
    post = at("post", (-0.32, -0.3, 0.0), (-0.3, 0.3, 0.5))
    door = at("door", (-0.3, -0.32, 0.0), (0.0, -0.3, 0.5), PartLabel.DOOR)
    edges = (Hinge("side_1", "post", 0, 1), Hinge("post", "door", 0, 1))
    weak, asset = guessed([SIDES[1], post, door], "post", PartLabel.DOOR, score=0.3, edges=edges)
    completion = with_static_guesses(weak, asset)
    assert [refusal.part for refusal in completion.refused] == ["post"]
    assert completion.completed.node("post").label is PartLabel.MISC
    assert completion.completed.motions == (Hinge("post", "door", 0, 1),)


CASE = drawer("case", (-0.25, 0.0, 0.3), (0.25, 0.5, 0.6))


def front(low=(-0.25, -0.025, 0.3), high=(0.25, -0.005, 0.6), label: PartLabel = PartLabel.DOOR) -> Part:
    return at("front", low, high, label)


def behind(before: Part, side: int) -> tuple[GraphCompletion, Asset]:
    """Returns a part behind another that was guessed to be a drawer, and to slide to one of the faces."""
    doors = (Hinge("side_0", "front", 0, 1),) if before.label is PartLabel.DOOR else ()
    return guessed([*SIDES, CASE, before], "case", edges=(Rail("side_0", "case", side), *doors))


def test_the_case_behind_a_front_does_not_slide_out_at_its_back():
    completion, asset = behind(front(), BACK)
    (refusal,) = static_guesses(completion, asset)
    assert refusal.reason is Reason.UNLIKELY
    assert "away from front, which closes it" in refusal.why


@pytest.mark.parametrize(
    ("before", "side"),
    [
        (front(), FRONT),
        (front(high=(0.1, -0.005, 0.6)), BACK),
        (front((-0.25, -0.2, 0.3), (0.25, -0.18, 0.6)), BACK),
        (front(label=PartLabel.BACK_PANEL), BACK),
        (front((-0.25, -0.305, 0.3), (0.25, -0.005, 0.6)), BACK),
    ],
    ids=["towards its front", "beside half a front", "far behind a door", "no front is there", "back to back"],
)
def test_another_drawer_slides_as_predicted(before, side):
    completion, asset = behind(before, side)
    assert not [r for r in static_guesses(completion, asset) if "which closes it" in r.why]


def table_with(twin: float, guess: float = 0.7, aside: float = -0.2):
    """Returns why a board right of the middle stays that may be a drawer, with one on the left like it."""
    boards = [at(n, (x - 0.15, -0.3, 0.6), (x + 0.15, -0.28, 0.7)) for n, x in (("front", 0.2), ("twin", aside))]
    completion, asset = guessed([TOP, *SIDES, *boards, *legs(0.7)], "front", score=guess)
    decision = Decision("twin", "label", "bar", 1.0 - twin, "drawer", twin)
    return [r.why for r in static_guesses(replace(completion, decisions=(*completion.decisions, decision)), asset)]


def test_a_board_whose_mirror_image_stays_is_no_drawer():
    assert table_with(0.1) == ["it is taken for a drawer (70%), but twin on the other side is like it, and is none"]


@pytest.mark.parametrize(
    "changed", [{"twin": 0.4}, {"twin": 0.1, "guess": 0.95}, {"twin": 0.1, "aside": -0.25}], ids=str
)
def test_a_board_whose_mirror_image_may_move_or_that_has_none_is_no_less_a_drawer(changed):
    assert not any("on the other side" in why for why in table_with(**changed))
