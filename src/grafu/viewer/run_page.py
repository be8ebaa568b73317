"""The page of a whole run: figures, how the numbers are spread, tables that sort by any column, worst first.

It is one file without a network; its links lead to the models' own pages beside it. It writes no files.
"""

from collections.abc import Callable, Sequence
from typing import final
from urllib.parse import quote

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import median
from grafu.viewer.pictures import MIME, THUMBNAIL, data_uri
from grafu.viewer.run_table import LIGHTS, WORDS, Cell, Run, RunColumn, RunFigure, RunRow, RunTable
from grafu.viewer.shell import Html, joined, light_of, section, tag, whole_page

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
    middle = words(median(values))
    svg = tag("svg", *bars, viewBox=f"0 0 {width} {height}", role="img", aria_label=f"{title}: half are below {middle}")
    ends = tag("div", tag("span", words(min(values))), tag("span", words(max(values))), class_="ends")
    caption = tag("figcaption", tag("strong", title), tag("span", f"median {middle}"))
    return tag("figure", joined([caption, svg, ends]), class_="histogram")


def _bar(x: float, step: float, height: float, title: str) -> Html:
    top, width = _SIZE[1] - max(height, 1.5), max(step - _GAP, 1.0)
    shown = tag("title", title)
    return tag(
        "rect", shown, x=f"{x:.1f}", y=f"{top:.1f}", width=f"{width:.1f}", height=f"{_SIZE[1] - top:.1f}", rx=1.5
    )


_STYLES = ("page.css", "run.css")
RUN_SCRIPTS = ("dom.js", "run.js")
_FILTERED = 8  # rows from which on a table can be searched
_SPREAD = 8  # and from which on it states something how their numbers are spread


def run_page(run: Run) -> str:
    """Returns the page of a run."""
    lead = [tag("p", run.lead, class_="verdict")] if run.lead else []
    figures = [tag("div", *map(_figure, run.figures), class_="figures")] if run.figures else []
    body = [
        tag("header", tag("h1", run.title), *lead),
        tag("main", *figures, *(_table_section(table, k) for k, table in enumerate(run.tables))),
    ]
    return whole_page(run.title, joined(body), _STYLES, RUN_SCRIPTS)


def _figure(figure: RunFigure) -> Html:
    value = tag("strong", figure.value, class_="flagged" if figure.flagged else None)
    return tag("div", value, tag("span", figure.what))


def _table_section(table: RunTable, index: int) -> Html:
    drawn = [
        histogram(column.name, numbers, column.words)
        for k, column in enumerate(table.columns)
        if column.histogram and len(table.rows) >= _SPREAD and (numbers := table.numbers(k))
    ]
    spread = [tag("div", *drawn, class_="histograms")] if drawn else []
    search = [_search(table, index)] if len(table.rows) >= _FILTERED else []
    return section(table.title, *spread, *search, _table(table, index), lead=table.lead)


def _search(table: RunTable, index: int) -> Html:
    box = tag("input", type="search", data_filter=f"table-{index}", autocomplete="off")
    return tag("label", tag("span", f"Find in {table.title}"), box, class_="search")


def _table(table: RunTable, index: int) -> Html:
    rank = RunColumn("#", "number", about="worst first")
    heads = [_head(column, k, pressed=k == 0) for k, column in enumerate((rank, *table.columns))]
    rows = [_row(row, table.columns, number) for number, row in enumerate(table.worst_first, start=1)]
    body = tag("table", tag("thead", tag("tr", *heads)), tag("tbody", *rows), id=f"table-{index}")
    return tag("div", body, class_="scroll", tabindex=0, role="region", aria_label=table.title)


def _head(column: RunColumn, index: int, pressed: bool) -> Html:
    button = tag("button", column.name, type="button", data_sort=index, title=column.about or None)
    side = "text" if column.kind in WORDS else "number"
    return tag("th", button, scope="col", class_=side, aria_sort="ascending" if pressed else None)


def _row(row: RunRow, columns: tuple[RunColumn, ...], number: int) -> Html:
    cells = [tag("td", str(number), class_="number rank", data_value=number), _name(row)]
    cells += [_cell(column, cell) for column, cell in zip(columns[1:], row.cells[1:], strict=True)]
    return tag("tr", *cells, class_="flagged" if row.flagged else None)


def _name(row: RunRow) -> Html:
    name = str(row.cells[0])
    words = tag("a", name, href=quote(row.link)) if row.link else tag("span", name)
    width, height = THUMBNAIL
    picture = data_uri(row.picture, MIME) if row.picture else ""
    image = [tag("img", src=picture, width=width, height=height, alt="", loading="lazy")] if picture else []
    return tag("td", tag("div", *image, words, class_="named"), class_="text", data_value=name)


def _cell(column: RunColumn, cell: Cell) -> Html:
    if column.kind == "light":
        light = str(cell)
        return tag("td", light_of(light), class_="text", data_value=f"{LIGHTS.index(light)} {light}")
    side = "text" if column.kind in WORDS else "number"
    return tag("td", column.words(cell), class_=side, data_value="" if cell is None else cell)
