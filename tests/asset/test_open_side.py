"""An open bookcase faces where its compartments open, and not where the board at its end is."""

from dataclasses import replace

import pytest

from grafu.asset.open_side import open_side
from grafu.asset.part import Asset
from grafu.vocabulary import PartLabel
from small_scenes import box


def nameless(*boxes):
    return tuple(
        replace(
            box(f"Cube_{k}", *(tuple(map(float, end)) for end in ends)), label=PartLabel.UNKNOWN, labelled_by="none"
        )
        for k, ends in enumerate(boxes)
    )


def bookcase(back=True):
    """1.2 m wide along x, 0.3 deep along y and 0.5 high, open to -y."""
    boards = [((0, 0, z), (1.2, 0.3, z + 0.02)) for z in (0.0, 0.48)]
    boards += [((x, 0, 0.02), (x + 0.02, 0.3, 0.48)) for x in (0.0, 0.4, 0.8, 1.18)]
    return nameless(*boards, *([((0, 0.3, 0), (1.2, 0.31, 0.5))] if back else []))


def table():
    legs = [((x, y, 0), (x + 0.05, y + 0.05, 0.7)) for x in (0.0, 1.15) for y in (0.0, 0.55)]
    return nameless(((0, 0, 0.7), (1.2, 0.6, 0.73)), *legs)


def closed():
    return nameless(((0, 0, 0), (1.2, 0.4, 0.8)))


def facing(parts, usual):
    return open_side(parts, Asset("piece", "", "made", parts).box, "+Z", usual)


@pytest.mark.parametrize("usual", ["+X", "-X"])
@pytest.mark.parametrize(("back", "front"), [(True, "-Y"), (False, "+Y")])
def test_a_bookcase_faces_across_its_broad_side(usual, back, front):
    assert facing(bookcase(back), usual) == front


@pytest.mark.parametrize("usual", ["+Y", "-Y"])
def test_what_faces_across_already_is_left_as_the_format_has_it(usual):
    assert facing(bookcase(), usual) is None


@pytest.mark.parametrize("parts", [table(), closed()], ids=["a table", "a closed case"])
def test_tables_and_closed_cases_tell_nothing(parts):
    assert facing(parts, "+X") is None
