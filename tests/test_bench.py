"""What the bench prints: medians against bars, ratios in units of a fixed piece of work, and joints that have moved."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "scripts"))

from bench_figure import WORK, Figure, figure_table  # noqa: E402
from bench_growth import Grown, exponents  # noqa: E402
from bench_same import Joint, joints_of, same_section  # noqa: E402
from stated.store import Stored, tables_in  # noqa: E402


def printed(*figures, page=None):
    """The table's rows by their first cell."""
    return {row[0]: row for row in tables_in(figure_table(figures, page))[0][1:]}


def stored(text):
    return Stored("a command", tables_in(text), [])


def test_the_median_is_held_against_the_bar_either_way():
    rows = printed(Figure("slow", (0.2, 0.3, 0.9), "s", 0.3), Figure("few", (1.0, 3.0), "a second", 2.1, at_least=True))

    assert rows["slow"][1:7] == ["0.3", "0.2", "0.9", "s", "<= 0.3", "yes"]
    assert rows["few"][1:7] == ["2", "1", "3", "a second", ">= 2.1", "NO"]
    assert printed(Figure("free", (1.0,), "s"))["free"][5:7] == ["", ""]


def test_a_figure_without_a_value_is_refused():
    with pytest.raises(ValueError, match="`nothing` has none"):
        Figure("nothing", ())


def test_a_machine_of_half_the_speed_changes_no_ratio():
    figures = Figure("time", (1.0,), "s"), Figure("rate", (10.0,), "a second"), Figure("memory", (100.0,), "MB")
    page = stored(figure_table([Figure(WORK, (0.1,), "s"), *figures], None))
    slow = replace(figures[0], values=(2.0,)), replace(figures[1], values=(5.0,)), figures[2]
    rows = printed(Figure(WORK, (0.2,), "s"), *slow, Figure("another", (1.0,)), page=page)

    assert {name: row[7] for name, row in rows.items()} == {
        WORK: "2.00",
        "time": "1.00",
        "rate": "1.00",
        "memory": "1.00",
        "another": "new",
    }


def test_more_time_on_the_same_machine_is_a_larger_ratio():
    page = stored(figure_table([Figure(WORK, (0.1,), "s"), Figure("time", (1.0,), "s")], None))

    assert printed(Figure(WORK, (0.1,), "s"), Figure("time", (1.5,), "s"), page=page)["time"][7] == "1.50"


def test_the_exponent_of_what_grows_with_the_square_is_two():
    squares = [Grown(size, (size**2 / 1e4, size**2 / 5e3), 0.0) for size in (10, 20, 80)]

    np.testing.assert_allclose(exponents(squares), (2.0, 2.0), atol=1e-3)


DOOR = Joint("revolute", (0.0, 0.0, -1.0), (-0.4, -0.2, 0.5), (0.0, 1.9))
DRAWER = Joint("prismatic", (0.0, -1.0, 0.0), (0.0, -0.2, 0.5), (0.0, 0.3))


def figures_against_page(**now):
    page = stored(same_section({"door": DOOR, "drawer": DRAWER}, None).text)
    return {figure.name.split(",")[0]: figure.value for figure in same_section(now, page).figures}


def test_joints_as_on_the_page_have_not_moved_wherever_on_their_axis_the_origin_lies():
    lower = replace(DOOR, origin=(-0.4, -0.2, 0.1))

    assert set(figures_against_page(door=lower, drawer=DRAWER).values()) == {0.0}
    assert same_section({"door": DOOR}, None).figures == ()


def test_what_has_changed_is_stated_in_degrees_and_millimetres():
    turned = (np.sin(np.radians(2.0)), 0.0, -np.cos(np.radians(2.0)))
    door = replace(DOOR, axis=tuple(turned), origin=(-0.4, -0.197, 0.5), limits=(0.0, 1.9 - np.radians(10)))
    found = figures_against_page(door=door, drawer=replace(DRAWER, limits=(0.0, 0.28)))

    np.testing.assert_allclose(list(found.values())[:2], [0.0, 2.0], atol=1e-2)
    assert found["axes: largest distance from the page's"] == pytest.approx(3.0, abs=0.01)
    assert found["ranges: largest difference"] == pytest.approx(20.0, abs=0.01)


def test_a_joint_that_is_gone_and_one_of_another_type_are_counted():
    found = figures_against_page(door=replace(DOOR, kind="prismatic"))

    assert found["joints that are other than the page's"] == 3  # the door twice, as it was and as it is, and the drawer


def test_reversed_axes_are_half_a_turn_apart():
    assert figures_against_page(door=replace(DOOR, axis=(0.0, 0.0, 1.0)))["axes: largest angle to the page's"] == 180.0


def test_a_page_without_joints_has_none():
    assert joints_of(None) == {} == joints_of(stored("| a | b |\n|---|---|\n| 1 | 2 |"))
