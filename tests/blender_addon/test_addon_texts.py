"""Words in the sidebar: lines are broken, never lost; a list gives names the room that they need. Without Blender."""

import ast
import importlib
import re
from pathlib import Path
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

ROOT = Path(__file__).parents[2]
WIDE, NARROW = 400.0, 160.0  # pixels


@pytest.fixture(scope="module")
def texts():
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(ROOT))
        module = importlib.import_module("blender_addon.texts")
        patch.setattr(module, "length_of", lambda text: 7.0 * len(text))
        yield module


def sidebar(width: float, scale: float = 1.0) -> SimpleNamespace:
    """A context of Blender with a sidebar of this width at usual size."""
    system = SimpleNamespace(ui_scale=scale)
    return SimpleNamespace(region=SimpleNamespace(width=width * scale), preferences=SimpleNamespace(system=system))


@given(st.text(alphabet="ab _", max_size=80), st.integers(3, 40))
def test_no_letter_is_lost_and_no_line_too_long(texts, text, width):
    lines = texts.wrapped(text, width)
    assert "".join(lines).replace(" ", "") == text.replace(" ", "")
    assert all(len(line) <= width for line in lines)


def test_the_longest_name_decides_how_much_names_get(texts):
    short = texts.factor_for_names(sidebar(WIDE), ["door_1"], 20.0)
    long = texts.factor_for_names(sidebar(WIDE), ["door_1", "cabinet_left_upper_door_1"], 20.0)
    assert short < long < 1.0
    assert long * (WIDE - 58.0 - 26.0 - 20.0) >= 7.0 * len("cabinet_left_upper_door_1")
    assert texts.factor_for_names(sidebar(NARROW), ["cabinet_left_upper_door_1"], 20.0) == 1.0
    assert texts.factor_for_names(sidebar(WIDE), []) == pytest.approx(0.3)


def test_what_stands_beside_names_keeps_its_room(texts):
    ratio = texts.factor_for_names(sidebar(WIDE), ["name" * 30], rest=116.0)
    assert (1.0 - ratio) * (WIDE - 58.0 - 26.0) == pytest.approx(116.0)


@given(st.text(alphabet="abcdefgh_", min_size=1, max_size=60))
def test_a_name_without_room_keeps_both_its_ends(texts, name):
    shown = texts.fitted(sidebar(WIDE), name, 20.0)
    room = WIDE - 58.0 - 26.0 - 20.0 - 14.0
    assert texts.length_of(shown) <= room
    assert (shown == name) == (texts.length_of(name) <= room)
    assert shown[0] == name[0]
    assert shown[-8:] == name[-8:]


@pytest.mark.parametrize("scale", [1.0, 2.0])
def test_a_name_is_cut_exactly_where_it_gets_less_than_it_needs(texts, scale):
    room = WIDE - 58.0 - 26.0 - 14.0
    fits, cut = "x" * int(room / 7.0), "x" * (int(room / 7.0) + 1)
    assert not texts.is_cut(sidebar(WIDE, scale), fits)
    assert texts.is_cut(sidebar(WIDE, scale), cut)
    assert texts.is_cut(sidebar(WIDE, scale), fits, rest=60.0)


def test_every_button_and_box_that_the_page_names_is_called_so():
    modules = [ast.parse(path.read_text()) for path in (ROOT / "blender_addon").glob("*.py")]
    strings = {node.value for tree in modules for node in ast.walk(tree) if isinstance(node, ast.Constant)}
    called = {text.removesuffix(" ...") for text in strings if isinstance(text, str)}
    named = set(re.findall(r"(?<!\*)\*([A-Z][^*\n]*)\*(?!\*)", (ROOT / "docs" / "blender.md").read_text()))
    assert len(named) > 10
    assert named - called == set()
