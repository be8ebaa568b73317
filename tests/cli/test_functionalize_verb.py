"""`functionalize` through the real command: what is written, several inputs, names, formats."""

import json
from pathlib import Path

import pytest
from obj_inputs import CABINET, write_cabinet

from grafu.cli.format_option import print_formats
from grafu.cli.main import main
from grafu.errors import ExportError
from grafu.export.formats import FORMATS
from grafu.graph.serialize import completion_from_json
from grafu.pipeline.report_schema import Report

LEAST = ("--formats", "urdf", "--no-page")


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("run")
    assert main(["functionalize", str(write_cabinet(folder)), "--out", str(folder / "out")]) == 0
    return folder / "out" / "cabinet"


def test_the_contract_is_written(result: Path) -> None:
    assert {p.name for p in result.iterdir()} >= {"model.glb", "model.urdf", "meshes", "graph.json", "report.json"}


def test_the_report_keeps_its_form(result: Path) -> None:
    text = (result / "report.json").read_text()
    report = Report.read_json(text)

    assert json.loads(text)["schema"] == "grafu.report/1"
    assert report.input.name == "cabinet"
    assert {part.source.name for part in report.parts} == set(CABINET)
    assert {joint.part for joint in report.joints} == {"door", "drawer"}
    assert {"load", "parse", "complete", "plan", "realize", "export"} <= set(report.timings)


def test_a_model_whose_name_is_generic_is_called_as_its_folder_in_all_files(tmp_path: Path) -> None:
    for place in ("45526", "7128"):  # each by a run of its own, as a loop of a shell does
        model = write_cabinet(tmp_path / place, "mobility")
        assert main(["functionalize", str(model), *LEAST, "--out", str(tmp_path / "out")]) == 0
        result = tmp_path / "out" / place
        assert f'<robot name="{place}">' in (result / "model.urdf").read_text()
        assert json.loads((result / "report.json").read_text())["input"]["name"] == place


def test_the_graph_reads_back(result: Path) -> None:
    completion = completion_from_json(json.loads((result / "graph.json").read_text()))

    assert [hinge.child for hinge in completion.completed.hinges] == ["door"]
    assert {rail.child for rail in completion.completed.rails} == {"drawer"}


def test_joints_in_the_report_are_those_of_the_urdf(result: Path) -> None:
    report = Report.read_json((result / "report.json").read_text())
    urdf = (result / "model.urdf").read_text()

    for joint in report.joints:
        assert f'<joint name="{joint.id}" type="{joint.type}">' in urdf
        assert f'<child link="{joint.part}"' in urdf


def test_the_summary_tells_what_opened(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["functionalize", str(write_cabinet(tmp_path)), "--out", str(tmp_path / "out"), *LEAST])
    said = capsys.readouterr().out

    assert "°" in said
    assert " cm" in said
    assert str(tmp_path / "out" / "cabinet") in said


def test_formats_are_a_choice(tmp_path: Path) -> None:
    source, out = str(write_cabinet(tmp_path)), str(tmp_path / "out")
    main(["functionalize", source, "--out", out, "--formats", "GLB", "--no-page"])

    names = {p.name for p in (tmp_path / "out" / "cabinet").iterdir()}
    assert "model.glb" in names
    assert "model.urdf" not in names


def test_a_page_for_each_model_and_one_for_several(
    result: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    first, second = (write_cabinet(tmp_path, name) for name in ("a", "b"))
    out = tmp_path / "out"
    arguments = ["functionalize", str(first), str(second), "--out", str(out), "--formats", "urdf", "--jobs", "1"]

    assert "</html>" in (result / "report.html").read_text()
    assert not (result.parent / "index.html").exists()
    assert main(arguments) == 0
    assert 'href="a/report.html"' in (out / "index.html").read_text()
    assert str(out / "index.html") in capsys.readouterr().out
    (out / "index.html").write_text("mine")
    assert main([*arguments, "--overwrite"]) == 0
    assert (out / "index.html").read_text() == "mine"


def test_pages_can_be_left_out(tmp_path: Path) -> None:
    main(["functionalize", str(write_cabinet(tmp_path)), "--out", str(tmp_path / "out"), *LEAST])

    assert "report.html" not in {p.name for p in (tmp_path / "out" / "cabinet").iterdir()}


def test_overwrite_replaces_an_earlier_result(tmp_path: Path) -> None:
    arguments = ["functionalize", str(write_cabinet(tmp_path)), "--out", str(tmp_path / "out"), *LEAST]
    assert main(arguments) == 0
    assert main(arguments) == 2
    assert main([*arguments, "--overwrite"]) == 0


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        (["--formats", "dwg"], "dwg"),
        (["--templates", "nowhere"], "nowhere"),
        (["--up", "Q"], "--up"),
    ],
)
def test_wrong_choices_write_nothing(
    arguments: list[str], word: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    assert main(["functionalize", str(write_cabinet(tmp_path)), "--out", str(out), *arguments]) == 2
    said = capsys.readouterr().err
    assert word in said
    assert said.count("\n") == 1
    assert not out.exists()


def test_without_an_annotation_nothing_moves_and_the_report_says_so(tmp_path: Path) -> None:
    source, out = str(write_cabinet(tmp_path)), tmp_path / "out"
    assert main(["functionalize", source, "--out", str(out), "--motion", "annotation", *LEAST]) == 0
    report = Report.read_json((out / "cabinet" / "report.json").read_text())

    assert report.joints == ()
    assert {skip.request: skip.reason for skip in report.skipped} == {"door": "no motion", "drawer": "no motion"}


def test_inputs_of_one_name_get_the_names_of_their_folders(tmp_path: Path) -> None:
    inputs = [str(write_cabinet(tmp_path / folder)) for folder in ("a", "b")]
    out = tmp_path / "out"
    assert main(["functionalize", *inputs, "--out", str(out), "--jobs", "1", *LEAST]) == 0
    assert sorted(path.name for path in out.iterdir()) == ["a", "b"]


def test_a_name_that_is_stated_is_that_of_the_results_and_the_page_states_it(tmp_path: Path) -> None:
    (tmp_path / "d1").mkdir()
    made = write_cabinet(tmp_path / "d1")
    out, plain = tmp_path / "out", ("--formats", "urdf")
    assert main(["functionalize", str(made), "--name", "d1", "--out", str(out), *plain]) == 0
    report = Report.read_json((out / "d1" / "report.json").read_text())
    page = (out / "d1" / "report.html").read_text()

    assert [one.name for one in out.iterdir() if one.is_dir()] == ["d1"]
    assert report.input.name == "d1"
    assert '"name":"d1","formats"' in page  # of the command that it makes
    again = ["--settings", str(out / "d1" / "settings.json"), "--name", "d1", "--out", str(out), "--overwrite", *LEAST]
    assert main(["functionalize", str(made), *again]) == 0
    assert [one.name for one in out.iterdir() if one.is_dir()] == ["d1"]


@pytest.mark.parametrize(
    ("more", "told"),
    [
        (["--name", "both"], "the results of one model: got 2 inputs"),
        (["--name", "../up"], "cannot be in a folder's name"),
    ],
)
def test_a_name_that_cannot_be_is_refused(
    more: list[str], told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "d1").mkdir()
    made = [str(write_cabinet(tmp_path / "d1")), str(write_cabinet(tmp_path))]
    given = made if told.endswith("inputs") else made[:1]
    assert main(["functionalize", *given, "--out", str(tmp_path / "out"), *LEAST, *more]) == 2
    assert told in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_inputs_of_one_name_in_folders_of_one_name_are_named_by_the_folders_above(tmp_path: Path) -> None:
    inputs = [write_cabinet(tmp_path / kind / folder / "same") for kind in ("a", "b") for folder in ("1", "2")]

    assert main(["functionalize", *map(str, inputs), "--out", str(tmp_path / "out"), *LEAST]) == 0
    names = {f"{kind}_{folder}_same_cabinet" for kind in ("a", "b") for folder in ("1", "2")}
    assert {one.name for one in (tmp_path / "out").iterdir() if one.is_dir()} == names


def test_two_files_of_one_name_in_one_folder_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    made = write_cabinet(tmp_path)
    made.with_suffix(".glb").write_bytes(b"of the same name")

    assert main(["functionalize", str(made), str(made.with_suffix(".glb")), "--out", str(tmp_path / "out")]) == 2
    assert "different names" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_one_bad_input_does_not_stop_the_others(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    good, bad, out = write_cabinet(tmp_path), tmp_path / "bad.obj", tmp_path / "out"
    bad.write_text("no mesh")

    code = main(
        ["functionalize", str(bad), str(good), str(good), "--out", str(out), "--jobs", "1", "--formats", "urdf"]
    )

    said = capsys.readouterr()
    assert code == 1
    assert "1 of 2 inputs failed" in said.out
    assert str(bad) in said.err
    *ended, why = said.err.splitlines()
    assert sorted(line.partition(" ")[0] for line in ended) == ["[1/2]", "[2/2]"]
    assert why.startswith(f"grafu: {bad}")
    assert why.count(str(bad)) == 1
    assert sorted(p.name for p in out.iterdir()) == ["cabinet", "index.html"]
    assert "bad" in (out / "index.html").read_text()


@pytest.mark.parametrize("words", [["--formats"], ["--formats", "list"], ["x.glb", "--out", "y", "--formats"]])
def test_without_a_list_the_formats_are_listed(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(["functionalize", *words])
    assert end.value.code == 0
    rows = {line.split()[0]: line for line in capsys.readouterr().out.splitlines()}
    assert set(rows) == {"format", *FORMATS}
    assert rows["glb"].rstrip().endswith("by default")
    assert "model.usdc" in rows["usd"]


def test_a_format_that_cannot_be_written_here_is_listed_with_its_extra(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def missing(name: str) -> None:
        raise ExportError(f"{name} needs more")

    monkeypatch.setattr("grafu.export.formats.exporter_for", missing)
    print_formats()
    assert "needs pip install 'grafu[usd]'" in capsys.readouterr().out
