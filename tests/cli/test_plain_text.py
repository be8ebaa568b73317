"""What is printed in a pipe is what `rich` prints there, and where it is folded or on a terminal `rich` prints it."""

import string

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from grafu.cli import plain_text
from grafu.cli.pipe_layout import PIPE_WIDTH
from grafu.cli.plain_text import TextTable, print_line, print_table

COLUMNS = ("part", "joint", "mechanism", "opening", "notes")
CELLS = st.text(string.ascii_letters + string.digits + " [](),.:;/'%-+_×°éß", max_size=30)
ROWS = st.lists(st.tuples(*[CELLS] * len(COLUMNS)), max_size=4).map(tuple)


def printed(capsys: pytest.CaptureFixture[str], print_it: object, *given_: object) -> str:
    """Returns what is printed."""
    print_it(*given_)  # type: ignore[operator]
    return capsys.readouterr().out


def by_rich(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leaves all that is printed to `rich`."""
    monkeypatch.setattr(plain_text, "_looks_the_same", lambda *_: False)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(rows=ROWS)
def test_a_table_is_the_same_by_rich(capsys: pytest.CaptureFixture[str], rows: tuple[tuple[str, ...], ...]) -> None:
    table = TextTable(COLUMNS, rows)

    ours = printed(capsys, print_table, table)
    with pytest.MonkeyPatch.context() as patch:
        by_rich(patch)
        theirs = printed(capsys, print_table, table)

    assert ours == theirs


LINES = [
    "green: all opens",
    "  door_1 [skipped]: why",
    "guessed: 0.5 m; --height changes it",
    "Tür, 2 × 90°",
    "戸" * 3,
    "a" * 300,
    "x\ty",
]


@pytest.mark.parametrize("line", LINES)
@pytest.mark.parametrize("folds", [True, False])
def test_a_line_is_the_same_by_rich(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, line: str, folds: bool
) -> None:
    ours = printed(capsys, print_line, line, folds)
    by_rich(monkeypatch)

    assert ours == printed(capsys, print_line, line, folds)


@pytest.mark.parametrize("name", ["FORCE_COLOR", "TTY_COMPATIBLE"])
def test_a_forced_terminal_is_left_to_rich(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    monkeypatch.setenv(name, "1")

    assert not plain_text._looks_the_same("green")


def test_what_is_too_long_or_no_plain_letters_is_left_to_rich(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("FORCE_COLOR", "TTY_COMPATIBLE"):
        monkeypatch.delenv(name, raising=False)

    assert plain_text._looks_the_same("a" * PIPE_WIDTH)
    assert not plain_text._looks_the_same("a" * PIPE_WIDTH, "a" * (PIPE_WIDTH + 1))
    assert not plain_text._looks_the_same("戸")
