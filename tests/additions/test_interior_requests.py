"""The words in which interiors are asked for."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.additions.interior.request import (
    AUTO,
    MOST_PANELS,
    MOST_TRAYS,
    NOTHING,
    PREDICTED,
    InteriorKind,
    InteriorRequest,
    parse_interior,
)
from grafu.additions.step import PanelHint
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.vocabulary import PartLabel

counted = st.builds(
    lambda s, d, a: InteriorRequest(InteriorKind.COUNTED, s, d, a if s else 0.0),
    st.integers(0, MOST_PANELS),
    st.integers(0, MOST_PANELS),
    st.one_of(st.just(0.0), st.integers(1, 450).map(lambda tenths: tenths / 10)),
)


carousels = st.integers(1, MOST_TRAYS).map(lambda trays: InteriorRequest(InteriorKind.COUNTED, trays=trays))


@given(st.one_of(st.sampled_from([AUTO, NOTHING, PREDICTED]), counted, carousels))
def test_what_is_spelled_is_read_back(request_) -> None:
    assert parse_interior(str(request_)) == request_


def test_order_case_and_spaces_do_not_matter() -> None:
    assert parse_interior(" Dividers=1, shelves=2 ") == InteriorRequest(InteriorKind.COUNTED, 2, 1)
    assert parse_interior("AUTO") == AUTO
    assert parse_interior("angle=20, shelves=2") == parse_interior("shelves=2,angle=20.0deg")
    assert str(parse_interior("shelves=2,angle=12.5deg")) == "shelves=2,angle=12.5deg"


@pytest.mark.parametrize(
    "text",
    [
        *("", "shelf=2", "shelves", "shelves=-1", "shelves=21", "shelves=1,shelves=2", "shelves=1,", "auto,shelves=1"),
        *("angle=20deg", "shelves=1,angle=46", "shelves=0,angle=5", "dividers=1,angle=5", "shelves=1,angle=-5"),
        *("shelves=1,angle=5,angle=6", "shelves=1,angle=5rad", "auto,angle=5"),
        *(
            "carousel",
            "carousel=0",
            "carousel=9",
            "carousel=2,shelves=1",
            "shelves=1,carousel=2",
            "carousel=1,carousel=1",
        ),
    ],
)
def test_what_spells_nothing_is_refused_in_one_line(text: str) -> None:
    with pytest.raises(ValueError, match="`interior` must be") as error:
        parse_interior(text)

    assert repr(text) in str(error.value)
    assert "shelves=N,dividers=N" in str(error.value)
    assert "\n" not in str(error.value)


def test_only_counted_requests_count() -> None:
    with pytest.raises(ValueError, match="counted"):
        InteriorRequest(InteriorKind.AUTO, shelves=1)
    with pytest.raises(ValueError, match="trays"):
        InteriorRequest(InteriorKind.COUNTED, shelves=1, trays=1)
    with pytest.raises(ValueError, match="counted"):
        InteriorRequest(InteriorKind.AUTO, trays=1)
    with pytest.raises(ValueError, match="angle_deg"):
        InteriorRequest(InteriorKind.COUNTED, dividers=1, angle_deg=10.0)
    with pytest.raises(ValueError, match="0 to 20"):
        InteriorRequest(InteriorKind.COUNTED, shelves=-1)


def test_a_hint_is_a_shelf_or_a_divider() -> None:
    with pytest.raises(ValueError, match="shelf or divider"):
        PanelHint("x", PartLabel.DOOR, Box(vec3(0.0, 0.0, 0.0), vec3(1.0, 1.0, 1.0)))
