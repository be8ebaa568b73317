"""Pictures in a terminal: which way is chosen, and that each way holds the picture that was to be shown."""

import re
import sys
from base64 import b64decode
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from obj_inputs import write_cabinet
from PIL import Image
from rich.style import Style

from grafu.cli.main import main
from grafu.cli.terminal_picture import (
    PictureProtocol,
    half_blocks,
    iterm,
    kitty,
    protocol_of,
    sixel,
    without_margins,
)
from grafu.render.picture import encode_png

SEED = 22


@pytest.mark.parametrize(
    ("environment", "protocol"),
    [
        ({"TERM": "xterm-kitty"}, "kitty"),
        ({"TERM": "xterm-256color", "KITTY_WINDOW_ID": "1"}, "kitty"),
        ({"TERM": "xterm-ghostty"}, "kitty"),
        ({"TERM": "xterm-256color", "TERM_PROGRAM": "iTerm.app"}, "iterm"),
        ({"TERM": "xterm-256color", "TERM_PROGRAM": "WezTerm"}, "iterm"),
        ({"TERM": "xterm-256color", "LC_TERMINAL": "iTerm2"}, "iterm"),
        ({"TERM": "foot"}, "sixel"),
        ({"TERM": "xterm-sixel"}, "sixel"),
        ({"TERM": "mlterm-256color"}, "sixel"),
        ({"TERM": "xterm-256color"}, "blocks"),
        ({}, "blocks"),
        ({"TERM": "tmux-256color", "KITTY_WINDOW_ID": "1"}, "blocks"),
        ({"TERM": "xterm-256color", "TERM_PROGRAM": "iTerm.app", "TMUX": "socket,1,0"}, "blocks"),
    ],
)
def test_the_environment_states_the_protocol(environment: dict[str, str], protocol: str) -> None:
    assert protocol_of(environment) is PictureProtocol(protocol)


@pytest.fixture
def picture() -> np.ndarray:
    random = np.random.default_rng(SEED)
    colours = random.integers(0, 256, (7, 3))  # few, so that a palette holds them
    shown = np.full((20, 33, 4), 255, np.uint8)
    shown[..., :3] = colours[random.integers(0, 7, (20, 33))]
    shown[5:9, 4:20, 3] = 0
    return shown


def test_kitty_gets_the_file_in_chunks_that_it_takes(picture: np.ndarray) -> None:
    noisy = encode_png(np.random.default_rng(SEED).integers(0, 256, (60, 80, 4), dtype=np.uint8))
    escapes = re.findall(r"\x1b_G([^;]*);([^\x1b]*)\x1b\\", kitty(noisy))
    assert len(escapes) > 3
    assert all(len(data) <= 4096 for _, data in escapes)
    assert [keys[-3:] for keys, _ in escapes] == ["m=1"] * (len(escapes) - 1) + ["m=0"]
    assert escapes[0][0].startswith("a=T,f=100,")
    assert b64decode("".join(data for _, data in escapes)) == noisy
    (one,) = re.findall(r"\x1b_G([^;]*);", kitty(encode_png(picture)[:90]))
    assert one == "a=T,f=100,m=0"


def test_iterm_gets_the_file_whole(picture: np.ndarray) -> None:
    (data,) = re.fullmatch(r"\x1b\]1337;File=inline=1;size=\d+:(.*)\x07", iterm(encode_png(picture))).groups()  # type: ignore[union-attr]
    assert (np.array(Image.open(BytesIO(b64decode(data)))) == picture).all()


def decoded(escape: str) -> np.ndarray:
    """Returns the picture of a sixel escape as percentages; -1 where nothing was drawn."""
    width, height, body = re.fullmatch(r'\x1bP0;1q"1;1;(\d+);(\d+)(.*)\x1b\\', escape).groups()  # type: ignore[union-attr]
    shown = np.full((int(height) + 6, int(width), 3), -1)
    palette: dict[int, list[int]] = {}
    row = column = colour = 0
    for token in re.findall(r"#\d+;2;\d+;\d+;\d+|#\d+|!\d+[?-~]|[$-]|[?-~]", body):
        if token.startswith("#"):
            number, *rest = map(int, token[1:].split(";"))
            if rest:
                palette[number] = rest[1:]
            colour = number
        elif token in "$-":
            column, row = 0, row + 6 * (token == "-")
        else:
            count = int(token[1:-1]) if token.startswith("!") else 1
            for bit in range(6):
                if (ord(token[-1]) - 63) >> bit & 1:
                    shown[row + bit, column : column + count] = palette[colour]
            column += count
    return shown[: int(height)]


def test_sixels_decode_to_the_picture_and_leave_what_is_transparent(picture: np.ndarray) -> None:
    shown = decoded(sixel(picture))
    opaque = picture[..., 3] > 0
    assert (shown[~opaque] == -1).all()
    assert (np.abs(shown[opaque] - picture[opaque][:, :3].astype(float) * 100 / 255) <= 1.0).all()


def test_half_blocks_hold_two_pixels_each(picture: np.ndarray) -> None:
    lines = half_blocks(picture).split("\n")
    assert [len(line) for line in lines if line] == [33] * 10
    for column, row in ((0, 0), (10, 2), (10, 3), (10, 4)):
        (character,) = lines[row][column].plain
        style = next((span.style for span in lines[row][column].spans), Style())
        upper, lower = picture[2 * row, column], picture[2 * row + 1, column]
        wanted = [tuple(pixel[:3]) if pixel[3] else None for pixel in (upper, lower)]
        found = {
            "▀": (style.color and style.color.triplet, style.bgcolor and style.bgcolor.triplet),
            "▄": (None, style.color and style.color.triplet),
            " ": (None, None),
        }[character]
        assert list(found) == wanted


@pytest.mark.parametrize(("first", "last", "kept"), [(7, 8, (6, 10)), (4, 5, (4, 6)), (0, 19, (0, 20))])
def test_empty_rows_above_and_below_are_left_out_in_pairs(first: int, last: int, kept: tuple[int, int]) -> None:
    picture = np.zeros((20, 5, 4), np.uint8)
    picture[first, 2, 3] = picture[last, 0, 3] = 255
    picture[:, :, 0] = np.arange(20)[:, None]
    assert without_margins(picture)[:, 0, 0].tolist() == list(range(*kept))
    assert without_margins(np.zeros((4, 5, 4), np.uint8)).shape == (4, 5, 4)


@pytest.mark.parametrize(("term", "mark"), [("xterm-kitty", "\x1b_Ga=T"), ("foot", '\x1bP0;1q"'), ("xterm", "▀")])
def test_inspect_shows_a_picture_on_a_terminal_alone(
    term: str, mark: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("KITTY_WINDOW_ID", "TERM_PROGRAM", "LC_TERMINAL", "TMUX"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("TERM", term)
    monkeypatch.setenv("COLORTERM", "truecolor")
    source = str(write_cabinet(tmp_path))
    assert main(["inspect", source]) == 0
    assert mark not in capsys.readouterr().out
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    assert main(["inspect", source]) == 0
    said = capsys.readouterr().out
    assert mark in said
    assert "a run would make 2 parts move" in re.sub(r"\x1b\[[0-9;]*m", "", said)
    assert main(["inspect", source, "--no-picture"]) == 0
    assert mark not in capsys.readouterr().out
