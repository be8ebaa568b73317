import pytest

from grafu.synth.kinds import KINDS, TIDY, UNTIDY
from sweeping import collisions

SUNK = {"doors into the case": "door_1", "inset door into the side": "door", "drawer into both walls": "drawer"}


@pytest.mark.parametrize("name", TIDY)
def test_a_tidy_kind_moves_freely_about_its_true_joints(name):
    asset = TIDY[name]()
    doors = frozenset(p.id for p in asset.parts if "door" in (p.label, str(p.rides_on)[:4]))
    for joint in asset.joints:
        behind = joint.part.startswith("drawer") and name.startswith("drawers behind")
        assert collisions(asset, joint.part, ignored=doors if behind else frozenset()) == {}


@pytest.mark.parametrize("name", UNTIDY)
def test_an_untidy_kind_keeps_its_joints(name):
    asset = UNTIDY[name]()
    assert len(asset.joints) == sum(p.id.startswith(("door", "drawer")) for p in asset.parts) > 0


@pytest.mark.parametrize("name", SUNK)
def test_what_is_sunk_into_a_neighbour_collides_at_rest(name):
    assert collisions(UNTIDY[name](), SUNK[name], values=[0.0]) != {}


def test_kinds_are_the_same_each_time():
    assert all(make().parts == make().parts for make in list(KINDS.values())[::7])
