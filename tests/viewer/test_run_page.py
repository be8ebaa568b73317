"""The page of a run: worst first, every column sorts, names are escaped, rows from plain values."""

import pytest
from made_models import ATTACK
from page_reader import PageReader

from grafu.pipeline.report_schema import NOT_ADDED, SkippedRecord
from grafu.refusal import Reason
from grafu.viewer.run_page import binned, run_page
from grafu.viewer.run_table import Run, RunColumn, RunEntry, RunFigure, RunRow, RunTable, functionalized_run

REASONS = (*Reason, NOT_ADDED)
COLUMNS = (
    RunColumn("model"),
    RunColumn("note"),
    RunColumn("ratio", "percent", histogram=True),
    RunColumn("count", "number", histogram=True),
    RunColumn("time", "seconds"),
)


def row(name, note, ratio, count, seconds, badness):
    return RunRow((name, note, ratio, count, seconds), badness, f"{name}/report.html")


ROWS = (
    row("b10", "zebra", 0.5, 10, 1.0, 1.0),
    row("b9", "", 0.25, 9, 30.0, 0.0),
    row(ATTACK, "Ärger", None, None, None, 9.0),
    row("a b#1", "apple", 1.0, 100, 2.5, 2.0),
    *(row(f"c{k}", f"n{k}", k / 10, k, float(k), -1.0) for k in range(6)),
)
RUN = Run("A run", (RunFigure("10", "models"), RunFigure("1", "failed", True)), (RunTable("Models", COLUMNS, ROWS),))


def names(read):
    return [found["data-value"] for found in read.all("td", class_="text")][::2]


def test_the_page_is_worst_first_and_escaped():
    page = run_page(RUN)
    read = PageReader(page)

    assert names(read)[:4] == [ATTACK, "a b#1", "b10", "b9"]
    assert ATTACK not in page
    assert read.all("a", href="a%20b%231/report.html")
    assert len(read.all("rect")) > 5


def test_a_few_rows_have_no_histograms():
    few = Run("A run", (), (RunTable("Models", COLUMNS, ROWS[:3]),))

    assert PageReader(run_page(few)).all("rect") == []


def test_every_column_has_a_button_that_sorts():
    heads = PageReader(run_page(RUN)).all("button", type="button")

    assert [head["data-sort"] for head in heads] == [str(k) for k in range(len(COLUMNS) + 1)]


def test_all_columns_sort_in_the_browser(browser, tmp_path):
    path = tmp_path / "index.html"
    path.write_text(run_page(RUN))
    browser.open(path)

    def column(index):
        rows = f"[...document.querySelectorAll('#table-0 tbody tr')].map((r) => r.cells[{index}].dataset.value ?? '')"
        return browser.run(rows)

    def click(index):
        browser.run(f"document.querySelector('[data-sort=\"{index}\"]').click()")

    for index in (3, 4, 5):
        for fall in (True, False):  # of numbers the largest first; what is missing stays at the end
            click(index)
            values = column(index)
            assert values[-1] == ""
            assert values[:-1] == sorted(values[:-1], key=float, reverse=fall)
    click(1)
    assert column(1).index("b9") < column(1).index("b10")
    click(2)
    assert column(2)[1:3] == ["apple", "Ärger"] or column(2)[:2] == ["apple", "Ärger"]
    assert browser.run("document.querySelector('[data-sort=\"2\"]').parentElement.ariaSort") == "ascending"
    click(0)
    assert column(0) == [str(k) for k in range(1, len(ROWS) + 1)]
    assert browser.run("window.hurt ?? null") is None
    assert browser.complaints() == []


def test_the_search_keeps_what_holds_the_word(browser, tmp_path):
    path = tmp_path / "index.html"
    path.write_text(run_page(RUN))
    browser.open(path)
    browser.run(
        "{const b = document.querySelector('[data-filter]'); b.value = 'ZEB'; b.dispatchEvent(new Event('input'))}"
    )

    assert browser.run("document.querySelectorAll('#table-0 tbody tr:not([hidden])').length") == 1


def test_reports_become_rows(made):
    report = made.report
    bad = report.with_changes(joints=tuple(j.with_changes(collision_share=0.4) for j in report.joints))
    entries = [RunEntry("good", report, seconds=1.5), RunEntry("bad", bad), RunEntry("gone", None, "no mesh")]
    run = functionalized_run("Run", entries)

    assert [r.cells[0] for r in run.tables[0].worst_first] == ["gone", "bad", "good"]
    assert "no mesh" in str(run.tables[0].worst_first[0].cells[2])
    assert [r.cells[1] for r in run.tables[0].worst_first] == ["failed", "red", "green"]
    assert ("1", "failed") in {(f.value, f.what) for f in run.figures}
    run_page(run)


def test_what_somebody_stopped_is_no_fault(made):
    first, *rest = made.report.joints
    skips = {why: SkippedRecord(request=first.part, reason=why, detail="") for why in REASONS}
    entries = [
        RunEntry(why, made.report.with_changes(joints=tuple(rest), skipped=(skip,))) for why, skip in skips.items()
    ]
    rows = {row.cells[0]: row for row in functionalized_run("Run", entries).tables[0].rows}
    figures = {figure.what: figure.value for figure in functionalized_run("Run", entries).figures}

    assert {name for name, row in rows.items() if not row.flagged} == {Reason.REJECTED}
    assert rows[Reason.REJECTED].cells[1:3] == ("green", "")
    assert (figures["green"], figures["red"]) == ("1", str(len(REASONS) - 1))
    assert figures["doors and drawers that are static"] == str(len(REASONS) - 1)


def test_a_run_without_rows_is_a_page():
    PageReader(run_page(functionalized_run("Nothing", [])))


def test_tables_check_their_rows():
    with pytest.raises(ValueError, match="2 columns: a row has 1 cells"):
        RunTable("t", COLUMNS[:2], (RunRow(("a",)),))
    with pytest.raises(ValueError, match="`ratio` is a column of numbers: got `x`"):
        RunTable("t", COLUMNS[:3], (RunRow(("a", "b", "x")),))


def test_values_are_written_as_people_read_them():
    assert RunColumn("a", "percent").words(0.1234) == "12.3 %"
    assert RunColumn("a", "number").words(7) == "7"
    assert RunColumn("a", "number").words(0.07512) == "0.0751"
    assert RunColumn("a").words(None) == "–"


@pytest.mark.parametrize("values", [[3.0, 3.0], [0.0, 1.0, 1.0, 5.0], [0.25, 0.5, 9.75], [-1e9, 1e9]])
def test_bins_hold_every_value(values):
    bins = binned(values)

    assert sum(bins.counts) == len(values)
    assert len(bins.edges) == len(bins.counts) + 1
