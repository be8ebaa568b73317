"""A sequence of choices with one cache gives, after each, what a run without a cache gives; most joints are found."""

from dataclasses import replace
from math import radians

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.plan import JointChoice
from grafu.joints.realize import realize
from grafu.processes.cache import Cache, content_key
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import CellRow, Door, Drawer, Stack
from grafu.templates.gallery import builtin_gallery

GALLERY = builtin_gallery()
ASSET = make_cabinet(Cabinet("made", Case(1.6, 0.8), CellRow((Stack((Drawer(), Drawer())), Door(), Door()))))
PLAN = plan_from_annotation(ASSET)
MOVING = [request.moving for request in PLAN.joints]
CHOICES = st.sampled_from(
    (JointChoice(), JointChoice(opening=radians(50.0)), JointChoice(opening=0.12), JointChoice(count=2))
)
EDITS = st.lists(
    st.tuples(st.sampled_from(MOVING), CHOICES | st.sampled_from(("fixed", "other side"))), min_size=2, max_size=3
)


def edited(plan, part, edit):
    """Returns the plan with one joint chosen otherwise, hung on the other side of its part, or left out."""
    if edit == "fixed":
        return replace(plan, joints=tuple(r for r in plan.joints if r.moving != part))
    joints = {request.moving: request for request in plan.joints}
    if part not in joints:
        return plan
    request = joints[part]
    if edit != "other side":
        request = replace(request, choice=edit)
    elif request.kind.turns:
        across = 2 * (ASSET.part(part).box.center - request.axis.point) * (1.0, 0.0, 0.0)
        request = replace(request, axis=request.axis.through(request.axis.point + across).reversed())
    return replace(plan, joints=tuple({**joints, part: request}.values()))


def outcome(plan, cache):
    made = realize(plan, ASSET, GALLERY, cache=cache)
    return content_key(made.object), content_key(made.report.outcomes), content_key(made.scene.hardware)


@settings(max_examples=2, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(EDITS)
def test_choices_one_after_the_other_give_what_each_gives_alone(edits):
    cache, plan = Cache(200), PLAN
    for part, edit in edits:
        plan = edited(plan, part, edit)
        assert outcome(plan, cache) == outcome(plan, Cache(0))


def test_a_choice_builds_its_own_joint_and_no_joint_far_from_it():
    cache = Cache(200)
    outcome(PLAN, cache)
    first = cache.made["joint"]
    assert first == len(MOVING)
    drawer = next(request.moving for request in PLAN.joints if request.kind.slides)
    outcome(edited(PLAN, drawer, JointChoice(opening=0.12)), cache)
    assert cache.made["joint"] == first + 1
    outcome(PLAN, cache)
    assert cache.made["joint"] == first + 1
