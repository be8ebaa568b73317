"""Every addition is a step of one shape; the loop runs them in the order of the tables."""

from dataclasses import replace

import pytest

from grafu.additions.config import AdditionConfig
from grafu.additions.step import Addition, Changes, StepRequest, StepResult, added_part
from grafu.additions.steps import BEFORE_JOINTS, INSIDE, ON_FRONTS, Step, run_steps
from grafu.geometry.appearance import Surface
from grafu.joints.make_plan import plan_from_annotation
from grafu.pipeline.additions import planned_scene
from grafu.scene.scene import Scene
from grafu.vocabulary import PartLabel
from small_scenes import DOOR, SIDE, box, drawer, hinged, scene

STEPS = (*BEFORE_JOINTS, *ON_FRONTS, *INSIDE)
OLD = box("old", (1.0, 0.0, 0.0), (1.2, 0.2, 0.2))


def planned(asset) -> tuple[Scene, StepRequest]:
    plan = plan_from_annotation(asset)
    return planned_scene(asset, plan), StepRequest(plan, names=("made",))


def adding(name: str, carried_by: str | None = None, removed: frozenset[str] = frozenset(), is_chosen=False) -> Step:
    """A step that adds a board, and tells by the board's reason what was attached to the door before."""

    def add(scene: Scene, request: StepRequest, _: AdditionConfig) -> StepResult:
        part = added_part(name, PartLabel.MISC, [Surface(OLD.mesh)], carried_by)
        told = ",".join(request.plan.joints[0].attached)
        return StepResult(scene.without_parts(removed).with_parts([part]), (Addition(part, told),), Changes(removed))

    return Step(name, add, is_chosen)


def test_no_two_steps_have_one_name():
    assert len({step.name for step in STEPS}) == len(STEPS)


@pytest.mark.parametrize("step", BEFORE_JOINTS, ids=lambda step: step.name)
def test_the_scene_of_a_step_is_the_old_one_with_its_additions(step):
    before, request = planned(drawer())
    made = step.add(before, request, AdditionConfig())
    assert set(made.scene.parts) - {a.part.id for a in made.additions} == set(before.parts) - made.changes.removed
    riding = {a.part.id: a.part.carried_by for a in made.additions if a.part.carried_by}
    assert all(part in made.scene.moving_bodies[moving].members for part, moving in riding.items())


def test_what_is_added_to_a_moving_part_the_next_step_knows_of():
    before, request = planned(scene(DOOR, SIDE, joints=(hinged(),)))
    made = run_steps((adding("first", "door"), adding("second")), before, request, AdditionConfig())
    assert [a.why for a in made.additions] == ["", "first"]
    assert made.attached == (("door", "first"),)
    assert made.scene.moving_bodies["door"].members == ("door", "first")


def test_what_was_rejected_is_left_out_unless_it_was_chosen_by_hand():
    before, request = planned(scene(DOOR, SIDE, joints=(hinged(),)))
    config = replace(AdditionConfig(), rejected=frozenset({"first", "second"}))
    steps = (adding("first", "door"), adding("second", is_chosen=True))
    made = run_steps(steps, before, request, config)
    assert [a.part.id for a in made.additions] == ["second"]
    assert made.scene.moving_bodies["door"].members == ("door",)


def test_nothing_is_replaced_by_what_was_rejected():
    before, request = planned(scene(DOOR, SIDE, OLD, joints=(hinged(),)))
    steps = (adding("new", removed=frozenset({"old"})),)
    kept = run_steps(steps, before, request, AdditionConfig())
    left = run_steps(steps, before, request, replace(AdditionConfig(), rejected=frozenset({"new"})))
    assert ("old" in kept.scene.parts, kept.changes.removed) == (False, {"old"})
    assert (set(left.scene.parts), left.changes) == (set(before.parts), Changes())
