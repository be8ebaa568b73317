"""A thick front with flanges looks like an incomplete box: where missing boards have no room it gets a whole one."""

from dataclasses import replace

from grafu.additions.drawer_box.complete import complete_drawers
from grafu.asset.part import Asset
from grafu.joints.make_plan import plan_from_annotation
from grafu.pipeline.additions import planned_scene
from small_scenes import box, scene, sliding

FRONT = -0.25
LEGS = [
    box(f"leg_{k}", (x, y, -0.4), (x + 0.05, y + 0.05, 0.2))
    for k, (x, y) in enumerate([(-0.3, FRONT), (0.22, FRONT + 0.04), (-0.3, 0.25), (0.22, 0.25)])
]
TOP = box("top", (-0.35, FRONT - 0.02, 0.2), (0.35, 0.35, 0.22))


def desk(deep: float) -> Asset:
    """A desk without an apron; its front lies on the legs, with a flange on the left and below, a short one right."""
    pieces = [
        box("face", (-0.28, FRONT - 0.02, 0.0), (0.28, FRONT, 0.19)),
        box("left", (-0.245, FRONT, 0.0), (-0.24, FRONT + deep, 0.19)),
        box("right", (0.24, FRONT, 0.0), (0.245, FRONT + 0.3 * deep, 0.19)),
        box("below", (-0.24, FRONT, 0.0), (0.24, FRONT + deep, 0.005)),
    ]
    whole = box("drawer", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
    front = replace(whole, surfaces=tuple(surface for piece in pieces for surface in piece.surfaces))
    return scene(*LEGS, TOP, front, joints=(sliding("drawer", (0.0, -1.0, 0.0)),))


def boxes_of(asset: Asset):
    plan = plan_from_annotation(asset)
    return complete_drawers(planned_scene(asset, plan), plan)


def test_it_gets_a_box_that_passes_between_the_legs():
    made = boxes_of(desk(deep=0.1))

    assert {a.part.id for a in made.additions} == {f"drawer_{b}" for b in ("side_left", "side_right", "back", "bottom")}
    assert not made.refused
    for addition in made.additions:
        assert all(addition.part.box.axis_gaps(leg.box).max() > 0.0 for leg in LEGS)


def test_a_box_that_is_nearly_as_deep_as_the_desk_stays_incomplete():
    made = boxes_of(desk(deep=0.4))

    assert made.additions == ()
    assert [refusal.part for refusal in made.refused] == ["drawer"]
    assert made.verdicts[0].kind == "incomplete"
