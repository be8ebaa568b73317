"""A cushion on a lid goes with it; what something else holds, or what is below the lid, stays."""

from dataclasses import replace

import pytest

from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.joints.on_lids import with_parts_on_lids
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.vocabulary import JointType, PartLabel
from small_scenes import box, scene

LID = replace(box("lid", (-0.6, -0.2, 0.43), (0.6, 0.2, 0.45)), label=PartLabel.DOOR)
BODY = replace(box("body", (-0.6, -0.2, 0.0), (0.6, 0.2, 0.43)), label=PartLabel.SIDE_PANEL)
CUSHION = box("cushion", (-0.59, -0.195, 0.4515), (0.59, 0.195, 0.5))
PILLOW = box("pillow", (-0.5, -0.1, 0.5), (-0.1, 0.1, 0.58))


LEVEL = vec3(-1.0, 0.0, 0.0)


def attached(*parts, settled=(), axis=LEVEL):
    hinge = JointRequest("lid", JointType.REVOLUTE, Axis(vec3(0.0, 0.2, 0.43), axis), "network")
    asset = scene(BODY, LID, *(replace(p, label=p.label if p.label.is_support else PartLabel.UNKNOWN) for p in parts))
    (request,) = with_parts_on_lids(RealizationPlan((hinge,)), asset, settled).joints
    return set(request.attached)


def test_a_cushion_and_what_lies_on_it_go_with_the_lid():
    assert attached(CUSHION) == {"cushion"}
    assert attached(CUSHION, PILLOW) == {"cushion", "pillow"}


OTHERS = {
    "beside the lid": box("other", (0.4, -0.1, 0.451), (0.8, 0.1, 0.5)),
    "in the air above it": box("other", (-0.5, -0.1, 0.6), (0.5, 0.1, 0.62)),
    "below it": box("other", (-0.5, -0.1, 0.3), (0.5, 0.1, 0.42)),
    "as high as a hutch": box("other", (-0.5, -0.1, 0.451), (0.5, 0.1, 1.2)),
    "a board": replace(box("other", (-0.5, -0.1, 0.451), (0.5, 0.1, 0.47)), label=PartLabel.SIDE_PANEL),
}


@pytest.mark.parametrize("what", OTHERS)
def test_others_stay(what):
    assert attached(OTHERS[what]) == set()


def test_what_something_else_holds_stays_and_so_does_what_the_user_settled():
    wall = replace(box("wall", (-0.6, 0.196, 0.45), (0.6, 0.21, 1.0)), label=PartLabel.BACK_PANEL)
    assert attached(CUSHION, wall) == set()
    assert attached(CUSHION, settled=("cushion",)) == set()
    assert attached(CUSHION, axis=vec3(0.0, 0.0, 1.0)) == set()
