"""Curves of hidden labels as SVG: a panel per figure, the interval around ours, the paper's rates as points."""

from xml.etree import ElementTree

from grafu.evaluation.bootstrap import Figure
from grafu.evaluation.curves import curves
from grafu.evaluation.table import Column, ResultTable

NAMESPACE = "{http://www.w3.org/2000/svg}"
COLUMNS = (
    Column("method", "Method"),
    Column("rate", "Labels hidden", "ratio"),
    Column("aligned", "GT-aligned", "ratio", "more"),
    Column("collision", "Collision", "ratio", "less"),
)


def drawn(*rows) -> ElementTree.Element:
    return ElementTree.fromstring(curves(ResultTable("masking", "t", COLUMNS, rows)))


def lines(root: ElementTree.Element) -> list[list[tuple[float, float]]]:
    found = root.iter(f"{NAMESPACE}polyline")
    return [[tuple(map(float, point.split(","))) for point in line.attrib["points"].split()] for line in found]


def test_each_figure_has_a_line_through_all_rates() -> None:
    rows = [("network", k / 10, Figure(1 - k / 20, 0.4, 1.0, 9), Figure(k / 40, 0.0, 0.5, 9)) for k in range(11)]
    falls, rises = lines(drawn(*rows))
    assert len(falls) == len(rises) == 11
    assert [x for x, _ in falls] == sorted(x for x, _ in falls)
    assert [y for _, y in falls] == sorted(y for _, y in falls)  # down on the page
    assert [y for _, y in rises] == sorted((y for _, y in rises), reverse=True)
    assert min(x for x, _ in rises) > max(x for x, _ in falls)


def test_the_papers_rows_are_points_and_those_of_other_data_are_left_out() -> None:
    ours = ("network", 0.5, Figure(0.9, 0.8, 1.0, 9), Figure(0.1, 0.0, 0.2, 9))
    paper = [(f"GraFu (the paper, {data})", rate, 0.85, 0.04) for data in ("PN-M", "HSSD") for rate in (0.1, 0.5)]
    root = drawn(ours, *paper)
    assert len(list(root.iter(f"{NAMESPACE}circle"))) == 4
    texts = [text.text for text in root.iter(f"{NAMESPACE}text")]
    assert {"GT-aligned", "Collision"} <= set(texts)


def test_one_value_alone_and_no_row_of_ours_can_be_drawn() -> None:
    assert lines(drawn(("rule", 0.5, Figure(1.0, 1.0, 1.0, 3), None)))
    assert curves(ResultTable("masking", "t", COLUMNS, (("GraFu (the paper, PN-M)", 0.5, 0.9, 0.1),))) == ""
