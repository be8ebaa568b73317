"""Words in the sidebar: lines that are broken where it ends, and names in its lists, which get the room they need.

Lengths are pixels at Blender's usual size.
"""

from collections.abc import Iterable
from functools import lru_cache

_LETTER = 5.6  # of a letter in the sidebar's font, about
_MARGIN = 58.0  # of the sidebar beside a panel's text: tabs and borders
_AROUND = 26.0  # of a list's row beside its texts: borders, and the bar that moves a long list
_NAME_BORDER = 14.0  # around a name
_LEAST_NAMES = 0.3  # of a row
_POINTS = 11.0  # of the font, at Blender's usual size


def draw_text(context, layout, text: str, taken: float = 0.0) -> None:
    """Draws lines of words, broken where the sidebar ends; `taken`: what is around them takes."""
    column = layout.column(align=True)
    column.scale_y = 0.8
    for line in text.splitlines():
        for part in wrapped(line, max(int((_width(context) - taken) / _LETTER), 12)):
            column.label(text=part)


def wrapped(text: str, width: int) -> list:
    """Returns the lines of a text, none longer than `width` letters; a word that is too long goes on in the next."""
    lines = [""]
    for word in text.split():
        while len(word) > width:
            lines += [word[:width]]
            word = word[width:]
        if lines[-1] and len(lines[-1]) + 1 + len(word) > width:
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    return [line for line in lines if line]


def factor_for_names(context, names: Iterable[str], icons: float = 0.0, rest: float = 0.0) -> float:
    """Returns the factor of a list's row that its longest name needs.

    `icons` is what stands beside the name takes, `rest` what must be left for the other column.
    """
    room = max(_width(context) - _AROUND - icons, 1.0)
    needed = max((length_of(name) for name in names), default=0.0) + _NAME_BORDER
    return min(max(needed / room, _LEAST_NAMES), max(1.0 - rest / room, _LEAST_NAMES))


def is_cut(context, name: str, icons: float = 0.0, rest: float = 0.0) -> bool:
    """Whether a list has less room than a name needs."""
    room = max(_width(context) - _AROUND - icons, 1.0)
    return length_of(name) + _NAME_BORDER > max(room - rest, _LEAST_NAMES * room)


def fitted(context, name: str, icons: float = 0.0, rest: float = 0.0) -> str:
    """Returns a name as a list shows it: where it has too little room, without letters of its middle.

    Names often differ at their ends, which Blender itself cuts off.
    """
    room = max(_width(context) - _AROUND - icons, 1.0)
    room = max(room - rest, _LEAST_NAMES * room) - _NAME_BORDER
    shown, half = name, len(name) // 2
    while length_of(shown) > room and half > 1:
        half -= 1
        shown = f"{name[:half]}\N{HORIZONTAL ELLIPSIS}{name[-half:]}"
    return shown


@lru_cache(maxsize=4096)
def length_of(text: str) -> float:
    """Returns how long a text is in the sidebar's font."""
    import blf

    blf.size(0, _POINTS)
    return float(blf.dimensions(0, text)[0])


def _width(context) -> float:
    """Returns how wide the texts of a panel may be."""
    scale = context.preferences.system.ui_scale
    return (context.region.width / scale if context.region else 300.0) - _MARGIN
