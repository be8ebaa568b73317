"""Words with sizes: what they make of the configuration of additions, and what is refused in one line."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.additions.grip.config import GripKind
from grafu.errors import OptionError
from grafu.geometry.lengths import METRES_PER_UNIT, metres_of
from grafu.pipeline.addition_choice import choose_additions

KNOWN = ("knob-round", "bar-round")


def test_a_top_takes_its_sizes_behind_its_shape() -> None:
    top = choose_additions(KNOWN, top="oval, thickness=30mm, front=2in, side=0, back=5 cm").top
    assert top is not None
    found = (top.shape, top.thickness, top.front, top.side, top.back)
    assert found == ("oval", 0.03, pytest.approx(0.0508), 0.0, 0.05)


def test_a_grip_takes_its_sizes_and_profile_behind_its_name() -> None:
    chosen = choose_additions(KNOWN, handles="groove,length=12cm,width=0.02,depth=8mm,profile=sharp")
    assert chosen.handles is None
    assert chosen.grips is not None
    wanted = chosen.grips.wanted(GripKind.GROOVE)
    assert (chosen.grips.kind, chosen.grips.profile) == (GripKind.GROOVE, "sharp")
    assert (wanted.length, wanted.width, wanted.depth) == (0.12, 0.02, 0.008)
    usual = choose_additions(KNOWN, handles="grip,depth=8mm").grips
    assert usual is not None
    assert (usual.kind, usual.profile, usual.wanted(GripKind.EDGE).length) == ("auto", "rounded", 0.10)
    handle = choose_additions(KNOWN, handles="bar-round,length=20cm").handles
    assert handle is not None
    assert (handle.style, handle.length) == ("bar-round", 0.2)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (
            {"top": "oval,thick=3cm"},
            "`top` takes thickness=, front=, side=, back= after `oval`, each once: got 'thick=3cm'",
        ),
        ({"top": "ovl"}, "`top` must be one of rectangle, rounded, chamfered, oval, capsule: got 'ovl'; did you mean"),
        ({"top": "oval,front=1cm,front=2cm"}, "each once: got 'front=2cm'"),
        ({"top": "oval,front=3 parsec"}, "`front` of `top` must be a number, or one with a unit of mm, cm, m, in, ft"),
        ({"top": "oval,front=-1cm"}, "`front` of `top` must be a length of at least 0: got '-1cm'"),
        ({"top": "oval,side=inf"}, "`side` of `top` must be a length of at least 0: got 'inf'"),
        ({"top": "oval,thickness=0"}, "`thickness` of `top` must be above 0"),
        ({"top": "oval,"}, "each once: got ''"),
        ({"handles": "hole,depth=0"}, "`depth` of `handle` must be above 0"),
        ({"handles": "edge,profile=round"}, "`profile` of `handle` must be one of sharp, rounded: got 'round'"),
        ({"handles": "knob-round,width=3cm"}, "`handle` takes length= after `knob-round`"),
        ({"handles": "knob-round,length=0"}, "`length` of `handle` must be above 0"),
        ({"handles": "knob-rond,length=3cm"}, "got 'knob-rond'; did you mean `knob-round`?"),
    ],
)
def test_what_is_no_size_is_refused(words: dict[str, str], message: str) -> None:
    with pytest.raises(OptionError) as refused:
        choose_additions(KNOWN, **words)
    assert message in str(refused.value)
    assert "\n" not in str(refused.value)


@given(st.floats(0.0, 1e4), st.sampled_from(sorted(METRES_PER_UNIT)), st.booleans())
def test_lengths_are_read_with_their_units(number: float, unit: str, apart: bool) -> None:
    text = f"{number!r}{' ' if apart else ''}{unit.upper() if apart else unit}"
    assert metres_of(text) == pytest.approx(number * METRES_PER_UNIT[unit])
