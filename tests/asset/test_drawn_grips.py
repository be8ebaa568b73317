"""The handle among the nameless pieces of one door is a part of its own; mouldings and frames are not."""

from pathlib import Path

import pytest

import grafu
from grafu.asset.grips import grip_among
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.vocabulary import PartLabel

LEAF = ((0.0, -0.02, 0.0), (0.4, 0.0, 0.7))
BAR = ((0.34, -0.07, 0.2), (0.36, -0.05, 0.5))
POSTS = (((0.34, -0.051, 0.24), (0.36, -0.02, 0.26)), ((0.34, -0.051, 0.44), (0.36, -0.02, 0.46)))
BEHIND = ((0.34, 0.0, 0.3), (0.36, 0.05, 0.4))


def grip(*boxes) -> tuple[int, ...]:
    return grip_among([Box(vec3(*low), vec3(*high)) for low, high in boxes])


def test_the_bar_and_its_posts_are_the_handle_in_any_order():
    assert grip(LEAF, BAR, *POSTS) == (1, 2, 3)
    assert grip(*POSTS, BAR, LEAF) == (0, 1, 2)
    assert grip(LEAF, BEHIND) == (1,)


@pytest.mark.parametrize(
    "boxes",
    [
        (LEAF,),
        (LEAF, BAR),
        (LEAF, ((0.02, -0.03, 0.02), (0.06, -0.02, 0.68)), ((0.34, -0.03, 0.02), (0.38, -0.02, 0.68))),
        (LEAF, ((0.02, -0.06, 0.02), (0.38, -0.02, 0.3))),
        (LEAF, ((0.15, -0.02, 0.2), (0.25, 0.0, 0.5))),
        (LEAF, ((0.42, -0.06, 0.3), (0.44, -0.02, 0.4))),
        (((0.0, 0.0, 0.0), (0.4, 0.4, 0.5)), ((0.1, -0.06, 0.3), (0.3, 0.0, 0.32))),
        (),
    ],
    ids=["alone", "not touching", "mouldings", "a large panel", "in its plane", "beside it", "no leaf", "nothing"],
)
def test_other_pieces_are_none(boxes):
    assert grip(*boxes) == ()


MJCF = """<mujoco><worldbody><body name="case">
<geom type="box" size="0.02 0.3 0.2" pos="-0.38 0 0"/><geom type="box" size="0.02 0.3 0.2" pos="0.38 0 0"/>
<geom type="box" size="0.36 0.02 0.2" pos="0 0.28 0"/><geom type="box" size="0.36 0.26 0.02" pos="0 0 -0.18"/>
<geom type="box" size="0.36 0.26 0.02" pos="0 0 0.18"/>
{doors}</body></worldbody></mujoco>"""
DOOR = """<body name="{side}door" pos="{x} -0.32 0"><geom type="box" size="0.19 0.018 0.2"/>
<geom type="cylinder" size="0.012 0.1" pos="{h} -0.08 0"/>
<geom type="cylinder" size="0.01 0.03" euler="90 0 0" pos="{h} -0.045 0.07"/>
<geom type="cylinder" size="0.01 0.03" euler="90 0 0" pos="{h} -0.045 -0.07"/></body>"""


def test_doors_of_nameless_shapes_turn_about_the_side_away_from_their_handles(tmp_path: Path):
    doors = DOOR.format(side="left", x=-0.195, h=0.15) + DOOR.format(side="right", x=0.195, h=-0.15)
    path = tmp_path / "cabinet.xml"
    path.write_text(MJCF.format(doors=doors))
    result = grafu.functionalize(path, front="-Y")
    handles = [part for part in result.asset.parts if part.label is PartLabel.HANDLE]
    assert {part.carried_by for part in handles} == {"leftdoor", "rightdoor"}
    joints = result.object.joint_of
    assert float(joints["leftdoor"].axis.point[0]) < -0.3
    assert float(joints["rightdoor"].axis.point[0]) > 0.3
