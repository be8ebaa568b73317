"""How the numbers of a column are spread, as a small drawing. It knows no tables."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.viewer.markup import Html, joined, tag

_BINS = 16
_SIZE = (220, 64)  # pixels
_GAP = 2


@final
@dataclass(frozen=True)
class Bins:
    """How many values lie between each two edges; the last bin holds its upper edge too."""

    edges: tuple[float, ...]
    counts: tuple[int, ...]


def binned(values: Sequence[float], bins: int = _BINS) -> Bins:
    """Returns values in bins of one width; whole numbers of a small range have a bin each.

    Where all values are one, it has a narrow bin in the middle.

    Raises:
        ValueError: if there is no value.
    """
    if not len(values):
        raise ValueError("`values` must hold a number: got none")
    low, high = float(min(values)), float(max(values))
    if low == high:
        return Bins((low,) * (bins + 1), tuple(len(values) if k == bins // 2 else 0 for k in range(bins)))
    whole = high - low < bins and all(float(v).is_integer() for v in values)
    edges = np.arange(low - 0.5, high + 1.0) if whole else np.linspace(low, high, bins + 1)
    counts, _ = np.histogram(values, edges)
    return Bins(tuple(edges.tolist()), tuple(counts.tolist()))


def histogram(title: str, values: Sequence[float], words: Callable[[float], str]) -> Html:
    """Returns a figure: bars, the least and the largest value below them, and the middle one in the caption."""
    bins, (width, height) = binned(values), _SIZE
    step, most = width / len(bins.counts), max(bins.counts)
    bars = [
        _bar(k * step, step, height * count / most, f"{words(a)} to {words(b)}: {count}")
        for k, (count, a, b) in enumerate(zip(bins.counts, bins.edges, bins.edges[1:], strict=False))
        if count
    ]
    middle = words(float(np.median(values)))
    svg = tag("svg", *bars, viewBox=f"0 0 {width} {height}", role="img", aria_label=f"{title}: half are below {middle}")
    ends = tag("div", tag("span", words(min(values))), tag("span", words(max(values))), class_="ends")
    caption = tag("figcaption", tag("strong", title), tag("span", f"median {middle}"))
    return tag("figure", joined([caption, svg, ends]), class_="histogram")


def _bar(x: float, step: float, height: float, title: str) -> Html:
    top, width = _SIZE[1] - max(height, 1.5), max(step - _GAP, 1.0)
    said = tag("title", title)
    return tag("rect", said, x=f"{x:.1f}", y=f"{top:.1f}", width=f"{width:.1f}", height=f"{_SIZE[1] - top:.1f}", rx=1.5)
