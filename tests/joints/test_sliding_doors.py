import numpy as np
import pytest

from grafu.asset.edit import mirrored, yawed
from grafu.asset.part import Asset
from judging import hardware, installed, realized, swept_collisions
from small_scenes import box, scene, sliding


def two_sliding_doors(gap: float) -> Asset:
    """A case of 1.2 x 0.5 x 0.8 m with two doors that slide past one another between its top and bottom."""
    shell = [
        box("side_left", (-0.6, -0.25, 0.0), (-0.58, 0.25, 0.8)),
        box("side_right", (0.58, -0.25, 0.0), (0.6, 0.25, 0.8)),
        box("bottom", (-0.58, -0.25, 0.0), (0.58, 0.25, 0.02)),
        box("top", (-0.58, -0.25, 0.78), (0.58, 0.25, 0.8)),
        box("back", (-0.58, 0.24, 0.02), (0.58, 0.25, 0.78)),
    ]
    front = box("door_front", (-0.58 + gap, -0.25, 0.02 + gap), (0.02, -0.232, 0.78 - gap))
    behind = box("door_behind", (-0.02, -0.228, 0.02 + gap), (0.58 - gap, -0.21, 0.78 - gap))
    joints = (sliding("door_front", (1.0, 0.0, 0.0), 0.5), sliding("door_behind", (-1.0, 0.0, 0.0), 0.5))
    return scene(*shell, front, behind, joints=joints)


@pytest.mark.parametrize("gap", [0.001, 0.003, 0.01])
def test_sliding_doors_run_on_tracks_above_and_below(gap):
    result = realized(two_sliding_doors(gap))
    made = installed(result)

    assert set(made) == {"door_front", "door_behind"}
    for name, outcome in made.items():
        joint = result.object.joint_of[name]
        moving, still = hardware(result, name)
        assert outcome.opening >= 0.7 * 0.5
        assert abs(joint.axis.direction[0]) == pytest.approx(1.0)
        assert swept_collisions(result.object, joint, 50) == {}
        assert min(v.mesh.box.low[2] for v in still) < 0.03
        assert max(v.mesh.box.high[2] for v in still) > 0.77
        assert len(moving) == 2


@pytest.mark.parametrize("turn", [lambda a: yawed(a, np.pi / 2), lambda a: mirrored(a, "x")])
def test_tracks_turn_with_the_case(turn):
    plain = installed(realized(two_sliding_doors(0.003)))
    turned = installed(realized(turn(two_sliding_doors(0.003))))
    assert {k: round(v.opening, 3) for k, v in turned.items()} == {k: round(v.opening, 3) for k, v in plain.items()}
