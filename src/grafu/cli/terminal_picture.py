"""A picture in the terminal: by the protocols of kitty, iTerm2 or sixel where it has one of them, else as half-blocks.

Which one is known from the environment: a terminal that is asked may answer late, or not at all.
"""

import os
import sys
from base64 import b64encode
from collections.abc import Iterator, Mapping
from enum import StrEnum
from typing import TYPE_CHECKING

from grafu.cli.telling import beneath

if TYPE_CHECKING:
    from rich.text import Text

    from grafu.asset.part import Asset
    from grafu.render.picture import Picture

_SIZE = (480, 360)  # pixels of a picture that is sent as one
_BLOCKS = (64, 48)  # of one that is drawn as half-blocks: columns, and twice the lines
_CHUNK = 4096  # bytes of base64 that one escape of kitty's protocol holds
_COLOURS = 64  # of a sixel picture: each is one pass over the line


class PictureProtocol(StrEnum):
    """How a terminal shows a picture."""

    KITTY = "kitty"
    ITERM = "iterm"
    SIXEL = "sixel"
    BLOCKS = "blocks"


def protocol_of(environment: Mapping[str, str]) -> PictureProtocol:
    """Returns how the terminal of an environment shows a picture; tmux and screen pass none on: half-blocks there."""
    term, program = environment.get("TERM", "").lower(), environment.get("TERM_PROGRAM", "").lower()
    if environment.get("TMUX") or term.startswith(("screen", "tmux")):
        return PictureProtocol.BLOCKS
    if environment.get("KITTY_WINDOW_ID") or "kitty" in term or "ghostty" in (program, term.removeprefix("xterm-")):
        return PictureProtocol.KITTY
    if program in ("iterm.app", "wezterm") or environment.get("LC_TERMINAL", "").lower() == "iterm2":
        return PictureProtocol.ITERM
    if "sixel" in term or term.startswith(("foot", "mlterm", "yaft")) or program == "mintty":
        return PictureProtocol.SIXEL
    return PictureProtocol.BLOCKS


def print_picture(asset: "Asset", environment: Mapping[str, str] = os.environ) -> None:
    """Prints a picture of an asset on stdout, its parts coloured by category, as the terminal shows it best."""
    from grafu.cli.terminal import wide_console
    from grafu.render.picture import encode_png

    protocol = protocol_of(environment)
    if protocol is PictureProtocol.BLOCKS:
        wide_console().print(half_blocks(_picture_of(asset, _BLOCKS)))
        return
    picture = _picture_of(asset, _SIZE)
    if protocol is PictureProtocol.SIXEL:
        shown = sixel(picture)
    else:
        png = encode_png(picture)
        shown = kitty(png) if protocol is PictureProtocol.KITTY else iterm(png)
    stream = beneath(sys.stdout)
    stream.write(f"{shown}\n")
    stream.flush()


def _picture_of(asset: "Asset", size: tuple[int, int]) -> "Picture":
    from grafu.articulation.articulated_object import Visual
    from grafu.render.camera import three_quarter_view
    from grafu.render.exposure import PictureStyle
    from grafu.render.picture import box_of, render

    visuals = [Visual(part.id, part.surfaces, label=part.label) for part in asset.parts]
    camera = three_quarter_view(box_of(visuals), size[0] / size[1])
    return without_margins(render(visuals, camera, size, PictureStyle(background="transparent", by_category=True)))


def without_margins(picture: "Picture") -> "Picture":
    """Returns a picture without the empty rows above and below what it shows; pairs of rows stay pairs."""
    import numpy as np

    shown = np.flatnonzero((picture[..., 3] >= 128).any(axis=1))
    return picture[shown[0] // 2 * 2 : shown[-1] // 2 * 2 + 2] if len(shown) else picture


def kitty(png: bytes) -> str:
    """Returns the escapes of kitty's graphics protocol that show a PNG file."""
    data = b64encode(png).decode()
    chunks = [data[start : start + _CHUNK] for start in range(0, len(data), _CHUNK)]
    last = len(chunks) - 1
    return "".join(
        f"\x1b_G{'a=T,f=100,' if place == 0 else ''}m={int(place < last)};{chunk}\x1b\\"
        for place, chunk in enumerate(chunks)
    )


def iterm(png: bytes) -> str:
    """Returns the escape of iTerm2's inline images that shows a PNG file."""
    return f"\x1b]1337;File=inline=1;size={len(png)}:{b64encode(png).decode()}\x07"


def sixel(picture: "Picture") -> str:
    """Returns the escape that shows a picture as sixels; what is transparent stays as it is."""
    import numpy as np
    from PIL import Image

    opaque = np.asarray(picture)[..., 3] >= 128
    image = Image.fromarray(np.asarray(picture)[..., :3]).quantize(_COLOURS, dither=Image.Dither.NONE)
    index = np.where(opaque, np.asarray(image).astype(np.int64), -1)
    colours = np.array(image.getpalette(), np.int64).reshape(-1, 3) * 100 // 255
    height, width = index.shape
    index = np.pad(index, ((0, -height % 6), (0, 0)), constant_values=-1)
    palette = "".join(f"#{k};2;{r};{g};{b}" for k, (r, g, b) in enumerate(colours.tolist()))
    lines = "-".join(_sixel_line(index[top : top + 6]) for top in range(0, len(index), 6))
    return f'\x1bP0;1q"1;1;{width};{height}{palette}{lines}\x1b\\'


def _sixel_line(rows: "Picture") -> str:
    """Returns six rows of palette indices, one pass for each colour in them."""
    import numpy as np

    weights = (1 << np.arange(6))[:, None]
    passes = ((k, ((rows == k) * weights).sum(axis=0)) for k in np.unique(rows).tolist() if k >= 0)
    return "$".join(f"#{k}{''.join(_run_lengths(bits.tolist()))}" for k, bits in passes)


def _run_lengths(bits: list[int]) -> Iterator[str]:
    start = 0
    for place in range(1, len(bits) + 1):
        if place == len(bits) or bits[place] != bits[start]:
            count, sign = place - start, chr(63 + bits[start])
            yield f"!{count}{sign}" if count > 3 else sign * count
            start = place


def half_blocks(picture: "Picture") -> "Text":
    """Returns a picture as characters, each of two pixels: the upper one in its colour, the lower one behind it."""
    from rich.color import Color
    from rich.style import Style
    from rich.text import Text

    def colour(pixel: list[int]) -> Color | None:
        return Color.from_rgb(*pixel[:3]) if pixel[3] >= 128 else None

    text, rows = Text(no_wrap=True, end=""), picture.tolist()
    for upper, lower in zip(rows[::2], rows[1::2], strict=False):
        for above, below in zip(upper, lower, strict=True):
            top, bottom = colour(above), colour(below)
            if top is None:
                text.append("▄" if bottom else " ", Style(color=bottom))
            else:
                text.append("▀", Style(color=top, bgcolor=bottom))
        text.append("\n")
    return text
