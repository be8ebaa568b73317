"""Curves of what hidden labels cost, as SVG: a panel for each figure, ours with its interval, the paper's as points."""

from collections.abc import Sequence
from typing import Final

from grafu.evaluation.bootstrap import Figure
from grafu.evaluation.motion_table import SOURCE
from grafu.evaluation.table import Column, ResultTable

_PANEL: Final = (320, 220)  # pixels, with the space around its axes
_ROOM: Final = (44, 16, 28, 34)  # pixels left, right, above, below
_INK, _OURS, _THEIRS = "#262628", "#24599e", "#a8420f"
_TICKS: Final = (0.0, 0.25, 0.5, 0.75, 1.0)


def curves(table: ResultTable) -> str:
    """Returns the masking table as curves over the fraction of hidden labels; an empty string where it has none."""
    figures = [c for k, c in enumerate(table.columns) if any(isinstance(row[k], Figure) for row in table.rows)]
    if not figures:
        return ""
    width, height = _PANEL
    panels = [_panel(table, column, float(k * width)) for k, column in enumerate(figures)]
    size = f'viewBox="0 0 {width * len(figures)} {height}" width="{width * len(figures)}" height="{height}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="sans-serif" font-size="11" fill="{_INK}">'
    return "\n".join([head, *panels, "</svg>", ""])


def _panel(table: ResultTable, column: Column, left: float) -> str:
    names = [one.name for one in table.columns]
    at, rate, method = (names.index(name) for name in (column.name, "rate", "method"))
    ours = [(float(str(r[rate])), cell) for r in table.rows if isinstance(cell := r[at], Figure)]
    paper = [(float(str(r[rate])), r[at]) for r in table.rows if SOURCE in str(r[method]) and "PN-M" in str(r[method])]
    theirs = [(x, float(y)) for x, y in paper if isinstance(y, float)]
    low, high = _range([*(end for _, f in ours for end in (f.low, f.high)), *(y for _, y in theirs)])

    def place(x: float, y: float) -> str:
        room_left, room_right, above, below = _ROOM
        width, height = _PANEL[0] - room_left - room_right, _PANEL[1] - above - below
        return f"{left + room_left + x * width:.1f},{above + (1 - (y - low) / (high - low)) * height:.1f}"

    lines = [_text(place(0.5, high), column.title, "middle", up=12.0)]
    for tick in _TICKS:
        value = low + tick * (high - low)
        lines.append(f'<path d="M{place(0.0, value)} L{place(1.0, value)}" stroke="#dcdcdc" fill="none"/>')
        lines.append(_text(place(0.0, value), f"{100 * value:.0f}", "end", aside=-5.0, up=-4.0))
        lines.append(_text(place(tick, low), f"{100 * tick:.0f} %", "middle", up=-16.0))
    band = [place(x, f.high) for x, f in ours]
    band += [place(x, f.low) for x, f in reversed(ours)]
    middle = " ".join(place(x, f.value) for x, f in ours)
    lines.append(f'<polygon points="{" ".join(band)}" fill="{_OURS}" fill-opacity="0.15"/>')
    lines.append(f'<polyline points="{middle}" fill="none" stroke="{_OURS}" stroke-width="2"/>')
    for x, y in theirs:
        cx, cy = place(x, y).split(",")
        lines.append(f'<circle cx="{cx}" cy="{cy}" r="3" fill="{_THEIRS}"><title>{SOURCE}, PN-M</title></circle>')
    return "\n".join(lines)


def _range(values: Sequence[float]) -> tuple[float, float]:
    """Returns the least and the greatest value in steps of 5 %, at least 10 % apart, within 0 to 1."""
    low, high = int(min(values) * 20) / 20, min(1.0, -int(-max(values) * 20) / 20 + 0.05)
    return (max(0.0, high - 0.1), high) if high - low < 0.1 else (low, high)


def _text(place: str, words: str, anchor: str, aside: float = 0.0, up: float = 0.0) -> str:
    x, y = map(float, place.split(","))
    return f'<text x="{x + aside:.1f}" y="{y - up:.1f}" text-anchor="{anchor}">{words}</text>'
