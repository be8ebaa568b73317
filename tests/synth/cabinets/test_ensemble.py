import pytest

from grafu.synth.cabinets.cabinet import Cabinet
from grafu.synth.cabinets.ensemble import Ensemble, Placed, Slab, make_ensemble
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import OpenCell, Pair
from grafu.vocabulary import PartLabel


def test_members_stand_where_they_are_placed():
    low = Cabinet(case=Case(0.8, 0.8, 0.5), layout=Pair())
    high = Cabinet(case=Case(0.8, 0.6, 0.3), layout=OpenCell())
    board = Slab(PartLabel.TOP_PANEL, "worktop", (-0.4, -0.25, 0.8), (0.4, 0.25, 0.82))
    made = make_ensemble(Ensemble("hutch", (Placed(low), Placed(high, (0.0, 0.1, 0.82))), (board,)))
    assert made.box.size[2] == pytest.approx(1.42)
    assert made.part("worktop").box.low[2] == pytest.approx(0.8)
    assert len(made.joints) == 2


def test_a_turned_member_opens_to_the_other_side():
    made = make_ensemble(Ensemble("two", (Placed(Cabinet(layout=Pair()), turned=True),)))
    assert all(made.part(joint.part).box.center[1] > 0 for joint in made.joints)


def test_an_ensemble_needs_members():
    with pytest.raises(ValueError, match="must have a member"):
        Ensemble("none", ())
