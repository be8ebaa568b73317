"""The page of a whole run: figures, how the numbers are spread, tables that sort by any column, worst first.

It is one file without a network; its links lead to the models' own pages beside it. It writes no files.
"""

from urllib.parse import quote

from grafu.viewer.histogram import histogram
from grafu.viewer.lights import light_of
from grafu.viewer.markup import Html, joined, tag
from grafu.viewer.pictures import MIME, THUMBNAIL
from grafu.viewer.run_table import LIGHTS, WORDS, Cell, Column, Figure, Run, RunRow, RunTable
from grafu.viewer.shell import section, whole_page
from grafu.viewer.textures import data_uri

_STYLES = ("page.css", "run.css")
_SCRIPTS = ("run.js",)
_FILTERED = 8  # rows from which on a table can be searched
_SPREAD = 8  # and from which on it says something how their numbers are spread


def run_page(run: Run) -> str:
    """Returns the page of a run."""
    lead = [tag("p", run.lead, class_="verdict")] if run.lead else []
    figures = [tag("div", *map(_figure, run.figures), class_="figures")] if run.figures else []
    body = [
        tag("header", tag("h1", run.title), *lead),
        tag("main", *figures, *(_table_section(table, k) for k, table in enumerate(run.tables))),
    ]
    return whole_page(run.title, joined(body), _STYLES, _SCRIPTS)


def _figure(figure: Figure) -> Html:
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
    rank = Column("#", "number", about="worst first")
    heads = [_head(column, k, pressed=k == 0) for k, column in enumerate((rank, *table.columns))]
    rows = [_row(row, table.columns, number) for number, row in enumerate(table.worst_first, start=1)]
    body = tag("table", tag("thead", tag("tr", *heads)), tag("tbody", *rows), id=f"table-{index}")
    return tag("div", body, class_="scroll", tabindex=0, role="region", aria_label=table.title)


def _head(column: Column, index: int, pressed: bool) -> Html:
    button = tag("button", column.name, type="button", data_sort=index, title=column.about or None)
    side = "text" if column.kind in WORDS else "number"
    return tag("th", button, scope="col", class_=side, aria_sort="ascending" if pressed else None)


def _row(row: RunRow, columns: tuple[Column, ...], number: int) -> Html:
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


def _cell(column: Column, cell: Cell) -> Html:
    if column.kind == "light":
        light = str(cell)
        return tag("td", light_of(light), class_="text", data_value=f"{LIGHTS.index(light)} {light}")
    side = "text" if column.kind in WORDS else "number"
    return tag("td", column.words(cell), class_=side, data_value="" if cell is None else cell)
