"""`grafu evaluate` from a folder of models to tables: what is done is kept, what fails is said, bytes do not change."""

import json
from pathlib import Path

import pytest

from folders import contents
from grafu.cli.main import main
from small_assets import write_pnm

FEW = ["--methods", "annotation,rule", "--tables", "motion,outcomes,masking,static,models", "--seeds", "1"]
FEW += ["--rates", "50,100", "--jobs", "1"]


def command(data: Path, out: Path, *more: str) -> list[str]:
    return ["evaluate", "--data", str(data), "--out", str(out), *FEW, *more]


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("data")
    write_pnm(folder / "first")
    write_pnm(folder / "second")
    return folder


@pytest.fixture(scope="module")
def done(data: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("results") / "out"
    assert main(command(data, out)) == 0
    return out


def figures(out: Path, method: str) -> dict[str, object]:
    rows = json.loads((out / "tables" / "motion.json").read_text())["rows"]
    return next(row for row in rows if (row["method"], row["over"]) == (method, "objects"))


def test_the_tables_of_a_cabinet_that_works(done: Path) -> None:
    for method in ("annotation", "rule"):
        found = figures(done, method)
        assert (found["objects"], found["parts"]) == (2, 4)
        assert found["aligned"]["value"] == 1.0
        assert found["works_fixed"]["value"] == 1.0
    index = (done / "tables" / "index.md").read_text()
    assert "grafu evaluate --data" in index
    assert "Models of one geometry: first and second." in index
    assert {p.suffix for p in (done / "tables").iterdir()} == {".md", ".csv", ".json", ".tex"}


def test_the_page_of_a_run_holds_every_table_and_model(done: Path) -> None:
    page = (done / "index.html").read_text()

    for words in ("Motion correctness, collision and connectivity", "Every model, worst first", "first", "second"):
        assert words in page
    assert "rule: work as built" in page
    assert "100.0 % to 100.0 %" in page  # the interval of a figure
    assert "http://" not in page.replace("http://www.w3.org/", "")
    assert "https://" not in page


def test_stopped_in_the_middle_the_same_command_gives_the_same_tables(data: Path, done: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.mkdir()
    rows = (done / "rows.jsonl").read_bytes()
    (out / "rows.jsonl").write_bytes(rows[: 2 * len(rows) // 3])  # a kill leaves half a line
    assert main(command(data, out)) == 0
    said = {name: text.replace(str(out).encode(), b"") for name, text in contents(out / "tables").items()}
    expected = {name: text.replace(str(done).encode(), b"") for name, text in contents(done / "tables").items()}
    assert said == expected


def test_the_rates_are_those_that_are_asked_for(done: Path) -> None:
    rows = json.loads((done / "tables" / "masking.json").read_text())["rows"]
    assert [row["rate"] for row in rows if row["method"] == "rule"] == [0.0, 0.5, 1.0]
    assert "--rates 50,100" in (done / "tables" / "index.md").read_text()


def test_several_folders_are_measured_together(data: Path, done: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (out / "rows.jsonl").write_bytes((done / "rows.jsonl").read_bytes())
    both = ["evaluate", "--data", str(data / "first"), str(data / "second"), "--out", str(out), *FEW]
    assert main([*both, "--tables", "motion,outcomes"]) == 0
    assert figures(out, "rule") == figures(done, "rule")
    outcomes = json.loads((out / "tables" / "outcomes.json").read_text())["rows"]
    assert [(row["method"], row["models"], row["aligned"]["value"]) for row in outcomes[:2]] == [
        ("annotation", 2, 1.0),
        ("rule", 2, 1.0),
    ]


def test_pictures_are_drawn_where_they_are_asked_for(data: Path, done: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (out / "rows.jsonl").write_bytes((done / "rows.jsonl").read_bytes())
    assert main(command(data, out, "--pictures")) == 0
    assert (out / "tables" / "masking.svg").read_bytes().startswith(b"<svg")
    assert not (out / "tables" / "worst.png").exists()  # nothing is wrong
    assert "(masking.svg)" in (out / "tables" / "index.md").read_text()
    assert not (done / "tables" / "masking.svg").exists()


def test_what_is_done_is_not_done_again(data: Path, done: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("grafu.cli.pool.run_all", lambda *_: pytest.fail("there was nothing left to do"))
    before = contents(done / "tables")
    assert main(command(data, done)) == 0
    assert contents(done / "tables") == before


def test_a_model_that_fails_is_said_and_stops_no_other(
    data: Path, done: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    folder, out = tmp_path / "data", tmp_path / "out"
    for name in ("first", "second"):
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).symlink_to(data / name)
    (folder / "broken").mkdir()
    (folder / "broken" / "mobility.urdf").write_text("<robot")
    out.mkdir()
    (out / "rows.jsonl").write_bytes((done / "rows.jsonl").read_bytes())
    assert main(command(folder, out, "--tables", "motion", "--json")) == 1
    said, errors = capfd.readouterr()
    assert "broken" in errors
    assert "Traceback" not in errors
    tasks = [json.loads(line) for line in said.splitlines()]
    assert {(task["task"], task["model"]) for task in tasks if task["error"]} >= {("model", "broken")}
    assert figures(out, "annotation")["works_fixed"]["value"] == 1.0
    assert "broken" in (out / "tables" / "index.md").read_text()


def test_a_file_in_place_of_the_folder_is_said_before_any_work(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("grafu.cli.pool.run_all", lambda *_: pytest.fail("work was begun"))
    (tmp_path / "out").write_text("mine")
    for more in ([], ["--overwrite"]):
        assert main(command(data, tmp_path / "out", *more)) == 2
        said = capsys.readouterr().err
        assert "choose another --out" in said
        assert said.count("\n") == 1
    assert (tmp_path / "out").read_text() == "mine"


@pytest.mark.parametrize(
    ("more", "states"),
    [
        (["--methods", "magic"], "a method must be one of"),
        (["--methods", "particulate"], "particulate:DIR"),
        (["--tables", "motion,poem"], "a table must be one of"),
        (["--methods", "annotation", "--tables", "masking"], "needs the method network or rule"),
        (["--methods", "rule,rule"], "methods must be one or more, each once: got rule, rule"),
        (["--methods", ""], "methods must be one or more, each once: got none"),
        (["--methods", "rule,urdf:nowhere"], "`nowhere` of the method urdf must be a folder"),
        (["--data", "synth:1:99999999999"], "at most 1,000,000 models are made"),
        (["--data", "nowhere"], "does not exist"),
        (["--data", "synth:1:2", "synth:1:3"], "must have different ids: got `synth_1_0000000` twice"),
        (["--methods", "network:nothing.onnx"], "`nothing.onnx` of the method network must be a file"),
        (["--methods", "rule:nothing.onnx"], "method `rule` must be given as `rule` alone"),
    ],
)
def test_bad_options_end_in_one_line(
    data: Path, tmp_path: Path, more: list[str], states: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(command(data, tmp_path / "out", *more)) == 2
    said = capsys.readouterr().err
    assert states in said
    assert said.count("\n") == 1
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("name", ["index.html", "tables/mine.csv"])
def test_what_is_not_ours_stays(data: Path, tmp_path: Path, name: str, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / name).parent.mkdir(exist_ok=True)
    (tmp_path / name).write_text("mine")

    assert main(command(data, tmp_path, "--overwrite")) == 2
    assert "choose another --out" in capsys.readouterr().err
    assert contents(tmp_path) == {name: b"mine"}
