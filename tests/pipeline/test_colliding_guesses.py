"""What is only guessed to move stays where it cuts into the rest; what was named or stated moves as before."""

from dataclasses import replace

import pytest

from clocks import Clock
from grafu.asset.part import Asset, Part
from grafu.completion.static_guesses import StaticGuessConfig
from grafu.geometry.budget import UNLIMITED, Budget, present_budget, require_time
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Attached, Rail
from grafu.graph.edit import relabelled, with_edges
from grafu.graph.parse import parse_graph
from grafu.joints.motion_choice import MotionChoice, Moves
from grafu.joints.report import Installed
from grafu.pipeline import joint_stages
from grafu.pipeline.colliding_guesses import blocked_guesses, colliding_guesses
from grafu.pipeline.functionalize import Functionalized, functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.refusal import Reason, Refusal
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel
from small_scenes import box, drawer

LEGS, RAILS = (-0.6, 0.0, 0.6), (-0.2, 0.2)


def bench() -> list[Part]:
    """A bench of slats, 1.4 x 0.47 x 0.46 m: its two rails run through the three boards on its legs; screws hold it."""
    parts = [box(f"rail_{k}", (-0.6, y - 0.03, 0.36), (0.6, y + 0.03, 0.42)) for k, y in enumerate(RAILS)]
    for k, x in enumerate(LEGS):
        parts.append(box(f"board_{k}", (x - 0.03, -0.23, 0.36), (x + 0.03, 0.23, 0.42)))
        parts += [box(f"leg_{k}{j}", (x - 0.03, y - 0.03, 0.0), (x + 0.03, y + 0.03, 0.4)) for j, y in enumerate(RAILS)]
    for k in range(5):
        y = -0.2 + 0.1 * k
        parts.append(box(f"slat_{k}", (-0.7, y - 0.035, 0.43), (0.7, y + 0.035, 0.46)))
        parts += [
            box(f"screw_{k}{j}", (x - 0.01, y - 0.01, 0.37), (x + 0.01, y + 0.01, 0.465)) for j, x in enumerate(LEGS)
        ]
    return parts


def chest() -> list[Part]:
    """A chest of three drawers in a case, fronts alone, 3 mm apart."""
    parts = [
        box("a", (-0.4, -0.25, 0.0), (-0.38, 0.25, 0.7)),
        box("b", (0.38, -0.25, 0.0), (0.4, 0.25, 0.7)),
        box("c", (-0.4, -0.25, 0.7), (0.4, 0.25, 0.72)),
        box("d", (-0.38, -0.25, 0.04), (0.38, 0.25, 0.06)),
        box("e", (-0.38, 0.23, 0.06), (0.38, 0.25, 0.7)),
    ]
    parts += [box(f"f_{k}", (-0.378, -0.27, 0.062 + 0.213 * k), (0.378, -0.25, 0.272 + 0.213 * k)) for k in range(3)]
    return parts


def made(parts: list[Part], budget: Budget = UNLIMITED, **motions: MotionChoice) -> Functionalized:
    """Returns nameless parts as the network makes them work."""
    nameless = tuple(replace(part, label=PartLabel.UNKNOWN, labelled_by="none") for part in parts)
    config = PipelineConfig(Settings(motions=motions))
    whole = Asset("made", "", "made", nameless)
    return functionalize(whole, MotionSource.AUTO, builtin_gallery(), config, budget=budget)


@pytest.fixture(scope="module", name="seat")
def made_bench() -> Functionalized:
    return made(bench())


def test_the_rails_of_a_bench_are_no_drawers(seat):
    assert not seat.object.joints  # nor are the screws columns that lift it
    why = {refusal.part: refusal for refusal in seat.report.skipped}
    guessed = {"rail_0", "rail_1"} & set(why)  # which of the two the network takes for a drawer is by chance
    assert guessed
    for rail in guessed:
        assert why[rail].reason is Reason.UNLIKELY
        assert "cuts into other parts in 100% of its poses" in why[rail].why
        assert seat.completion.completed.node(rail).label is PartLabel.MISC


def test_one_that_the_user_pulls_out_moves_whatever_it_cuts_into():
    moving = {joint.child for joint in made(bench(), rail_0=MotionChoice(Moves.SLIDES)).object.joints}
    assert moving == {"rail_0"}


def test_nameless_drawers_that_are_free_move():
    assert {joint.child for joint in made(chest()).object.joints} == {"f_0", "f_1", "f_2"}


def one_guess(handle: PartLabel = PartLabel.UNKNOWN, ratio: float = 1.0) -> tuple[GraphCompletion, Installed]:
    """Returns a drawer that is only guessed, with what is taken for its handle, and its joint as it was built."""
    parts = [
        *drawer().parts[:-1],
        replace(drawer().part("drawer"), label=PartLabel.UNKNOWN),
        replace(box("knob", (-0.02, -0.23, 0.08), (0.02, -0.2, 0.12)), label=handle),
    ]
    graph = parse_graph(Asset("made", "", "made", tuple(parts)))
    taken = {part.id: PartLabel.MISC for part in parts if part.label is PartLabel.UNKNOWN}
    labelled = relabelled(graph, taken | {"drawer": PartLabel.DRAWER, "knob": PartLabel.HANDLE})
    edges = (Rail("side_left", "drawer", 2), Attached("drawer", "knob"))
    decisions = (Decision("drawer", "label", "drawer", 0.9, "misc", 0.1),)
    (done,) = functionalize(drawer(), MotionSource.ANNOTATION, builtin_gallery()).report.installed
    completion = GraphCompletion(graph, with_edges(labelled, edges), "network", decisions=decisions)
    return completion, replace(done, collision_share=ratio)


def test_a_handle_that_the_input_names_shows_that_a_drawer_moves():
    completion, done = one_guess(PartLabel.HANDLE)
    assert not tuple(colliding_guesses(completion, [done]))


def test_a_handle_that_is_itself_a_guess_does_not():
    completion, done = one_guess()
    (refusal,) = colliding_guesses(completion, [done])
    assert (refusal.part, refusal.reason) == ("drawer", Reason.UNLIKELY)
    assert "taken for a drawer (90%)" in refusal.why


@pytest.mark.parametrize("ratio", [0.0, StaticGuessConfig().cuts])
def test_what_hardly_touches_anything_moves(ratio):
    completion, done = one_guess(ratio=ratio)
    assert not tuple(colliding_guesses(completion, [done]))


def test_what_the_user_states_is_no_guess():
    completion, done = one_guess()
    assert not tuple(colliding_guesses(completion, [done], settled={"drawer"}))


def test_nor_is_what_the_input_calls_a_drawer():
    completion, done = one_guess()
    assert not tuple(colliding_guesses(replace(completion, decisions=()), [done]))


@pytest.mark.parametrize(
    ("reason", "handle", "is_doubted"),
    [
        (Reason.BLOCKED, PartLabel.UNKNOWN, True),
        (Reason.NO_FACING_SURFACES, PartLabel.UNKNOWN, True),
        (Reason.NO_ROOM, PartLabel.UNKNOWN, False),
        (Reason.BLOCKED, PartLabel.HANDLE, False),
    ],
)
def test_a_guess_that_nothing_lets_move_is_doubted(reason, handle, is_doubted):
    completion, _ = one_guess(handle)
    found = tuple(blocked_guesses(completion, [Refusal("drawer", reason, "nothing lets it")]))
    assert bool(found) is is_doubted
    assert all(r.reason is Reason.UNLIKELY and r.why.endswith(", but nothing lets it") for r in found)
    assert not tuple(blocked_guesses(completion, [Refusal("drawer", reason, "nothing lets it")], {"drawer"}))


def test_joints_stay_where_there_is_no_time_to_build_them_without_those_that_collide(monkeypatch):
    """What was built is delivered: the second turn, in which a guess stays, must not cost all joints theirs."""
    clock, turns = Clock(), list[int]()

    def slow_the_second_time(*given):
        turns.append(len(given))
        if len(turns) == 2:
            clock.now = present_budget().deadline
            require_time()
        return build(*given)

    build = joint_stages.realize
    monkeypatch.setattr(joint_stages, "realize", slow_the_second_time)
    monkeypatch.setattr(joint_stages, "colliding_guesses", lambda made, joints, settled: [(joints[0].moving, "cuts")])
    monkeypatch.setattr(joint_stages, "with_static", lambda completion, doubtful: completion)
    found = made(chest(), budget=Budget.lasting(1e6, clock=clock))
    assert len(turns) == 2
    assert len(found.object.joints) == 3
    assert found.notes == ("guesses that cut into other parts still move: no time was left for 3 joints",)
