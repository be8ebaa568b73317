"""What pages state is bound: figures to commands, numbers to the code; and what is not bound is refused by name."""

import sys
from dataclasses import replace
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "scripts"))

import docs  # noqa: E402
import figures  # noqa: E402
from stated import configs, constants_built, drawn  # noqa: E402
from stated.measures import MEASURES, Measure  # noqa: E402
from stated.numbers import unbound  # noqa: E402
from stated.store import Stored, drawn_table, load_store, save_store, tables_in  # noqa: E402

TABLE = "| asked about | right |\n|---|---|\n| no labels | 48 |"
KEPT = {"motions": Stored("a command", tables_in(TABLE), [])}


@pytest.mark.parametrize(
    "claim",
    [
        "Of 50 motions 49 of 50 are right.",
        "It reaches 98.5 %.",
        "F1 is 0.889.",
        "It takes 12 minutes.",
        "0.9 ± 0.1",
        "A page has 1.4 MB.",
        "Chosen after 11,500 steps.",
        "a fraction of\n0.25 in all",
        "| hinge | 0.889 |",
        "3.5 times",
    ],
)
def test_a_number_that_looks_measured_is_refused_with_its_line(claim: str) -> None:
    (line,) = unbound("network.md", f"# Page\n\n{claim}\n", [])

    assert line.startswith(f"docs/network.md:{4 if 'in all' in claim else 3}: `")
    assert "no figure" in line


@pytest.mark.parametrize(
    "text",
    [
        "It reaches <!-- figure: made: hinge / natural -->98.5 %<!-- end -->.",
        "A fraction of 98.5 % counts as whole. <!-- no figure: a definition -->",
        "<!-- no figure: a definition -->\n| fraction | counts |\n|---|---|\n| 98.5 % | yes |",
        "<!-- made: drawn by scripts/docs.py from docs/figures.json -->\n\n| 98.5 % |\n\n<!-- end of made -->",
        "```text\n98.5 %\n```",
        "`98.5 %` and [98](https://x.org/98.55)",
        "Python 3.11 or newer, in 2 places, 18 mm thick",
    ],
)
def test_what_is_bound_or_is_no_measurement_passes(text: str) -> None:
    assert unbound("network.md", f"# Page\n\n{text}\n", []) == []


def test_a_mark_holds_for_its_paragraph_alone() -> None:
    text = "# Page\n\nA fraction of 98.5 %. <!-- no figure: why -->\n\nA fraction of 98.5 %.\n"

    assert [line.split(": ")[0] for line in unbound("x.md", text, [])] == ["docs/x.md:5"]


def test_a_sentence_that_was_compared_with_the_code_is_bound_over_lines() -> None:
    assert unbound("x.md", "# Page\n\nup to 0.15\nm, or 0.25 m\n", ["up to 0.15 m"])[0].startswith(
        "docs/x.md:4: `0.25`"
    )


def test_pages_are_as_drawn_and_say_what_the_code_does() -> None:
    assert docs.stale_pages() + docs.other_commands() + docs.untrue_sentences() + docs.unbound_numbers() == []


def test_a_number_that_changes_in_the_code_is_missed_in_its_page(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(constants_built, "TOP", replace(constants_built.TOP, gallery=0.17))

    assert any("do not hide it (up to 0.17 m)" in line for line in docs.untrue_sentences())


def test_a_run_that_changes_is_another_table(monkeypatch: pytest.MonkeyPatch) -> None:
    before = configs.training_configs()
    faster = replace(configs.CONFIGS["base"], optimiser=replace(configs.CONFIGS["base"].optimiser, rate=0.005))
    monkeypatch.setattr(configs, "CONFIGS", {**configs.CONFIGS, "base": faster})

    assert "| `optimiser.rate` | 0.005 | 0.0003 | 0.0003 |" in configs.training_configs() != before


def test_departures_are_listed_until_there_are_none(monkeypatch: pytest.MonkeyPatch) -> None:
    assert "| `free_boxes` | `network.free_boxes` | pointed | absolute |" in configs.paper_departures()
    monkeypatch.setattr(configs, "PAPER", configs.BASE)

    assert len(configs.paper_departures().splitlines()) == 2


def test_a_figure_is_written_where_its_mark_stands() -> None:
    text = "Right: <!-- figure: motions: no labels / right -->7<!-- end --> of 50."

    assert "-->48<!-- end --> of 50." in drawn.with_figures(Path("x.md"), text, KEPT)
    with pytest.raises(SystemExit, match=r"no labels / wrong -->.* names no figure: expected MEASURE: ROW / COLUMN"):
        drawn.with_figures(Path("x.md"), text.replace("/ right", "/ wrong"), KEPT)


def test_tables_and_the_store_come_back_as_they_were(tmp_path: Path) -> None:
    assert drawn_table(tables_in(TABLE)[0]) == TABLE
    save_store(KEPT, tmp_path / "kept.json")
    assert load_store(tmp_path / "kept.json") == KEPT


def test_every_command_has_its_script() -> None:
    scripts = [words[1] for m in MEASURES if (words := m.command.split())[0] == "python"]

    assert [name for name in scripts if not (ROOT / name).is_file()] == []
    assert len({m.name for m in MEASURES}) == len(MEASURES)


def measure(code: str) -> Measure:
    return Measure("try", f"python -c {code!r}", f"python -c {code!r}", "a trial", ("network.md",), 1)


def test_what_was_printed_is_kept_for_the_same_code(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(figures, "KEPT", tmp_path)
    counts = measure(
        f"import pathlib; p = pathlib.Path({str(tmp_path / 'runs')!r}); p.open(chr(97)).write(chr(120)); print(1)"
    )

    assert [figures.printed_by(counts, False, again, 1) for again in (False, False, True)] == ["1\n"] * 3
    assert (tmp_path / "runs").read_text() == "xx"


def test_a_command_that_fails_says_why(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(figures, "KEPT", tmp_path)

    assert figures.printed_by(measure("raise SystemExit(chr(33) * 3)"), False, False, 1) is None
    assert (tmp_path / "try" / "errors.txt").read_text() == "!!!\n"


@pytest.mark.parametrize(
    ("words", "states"), [(["--only", "nothing"], "there is no 'nothing'"), (["--quick", "--write"], "leave out")]
)
def test_wrong_choices_are_refused(
    words: list[str], states: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", ["figures.py", *words])
    with pytest.raises(SystemExit):
        figures.parse_arguments()
    assert states in capsys.readouterr().err


def test_real_models_are_asked_for_by_name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("GRAFU_MODELS", raising=False)
    with pytest.raises(SystemExit, match="GRAFU_MODELS must name the folder"):
        figures.filled("python x.py {models}/pnm", Path("out"), 1)
