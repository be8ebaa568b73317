"""Rows: whole or ignored, the last of a key counts, failures are rows and are tried again."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.errors import ExportError
from grafu.evaluation.dataset import ModelRef
from grafu.evaluation.methods import Method
from grafu.evaluation.perform import perform
from grafu.evaluation.records import NAME, MadeFacts, ResultRow, append_rows, begin_rows, done, read_rows
from grafu.evaluation.tasks import MadeTask, MaskTask, MethodTask, ModelTask, TwinTask, _state_of, key_of
from small_assets import write_pnm
from spoiled_files import SPOILS


def row(key: str, value: float = 1.0, error: str = "") -> ResultRow:
    return ResultRow(key=key, task={"task": "made"}, seconds=0.1, error=error, facts=MadeFacts(features=(value,)))


def test_what_was_appended_is_read(tmp_path: Path) -> None:
    file = tmp_path / "deep" / "rows.jsonl"
    assert begin_rows(file) == {}
    append_rows(file, [row("a"), row("b", 2.0)])
    append_rows(file, [row("a", 3.0)])
    assert read_rows(file) == begin_rows(file) == {"a": row("a", 3.0), "b": row("b", 2.0)}
    assert begin_rows(file, anew=True) == read_rows(file) == {}


def test_nothing_was_read_where_nothing_is(tmp_path: Path) -> None:
    assert read_rows(tmp_path / "rows.jsonl") == {}


@given(st.data())
def test_a_file_cut_anywhere_keeps_its_whole_lines_and_can_be_gone_on_with(tmp_path_factory, data) -> None:
    file = tmp_path_factory.mktemp("cut") / "rows.jsonl"
    rows = [row(f"key{k}", float(k)) for k in range(4)]
    append_rows(file, rows)
    whole = file.read_bytes()
    cut = data.draw(st.integers(0, len(whole)))
    file.write_bytes(whole[:cut])
    kept = whole[:cut].count(b"\n")
    complete = kept + (whole[cut : cut + 1] == b"\n")  # a line that lacks its break alone is whole
    assert list(read_rows(file)) == [r.key for r in rows[:complete]]
    append_rows(file, [row("more")])
    assert list(read_rows(file)) == [*(r.key for r in rows[:complete]), "more"]


def test_lines_of_another_form_are_left_out(tmp_path: Path) -> None:
    file = tmp_path / "rows.jsonl"
    append_rows(file, [row("a")])
    with file.open("a") as stream:
        stream.write('{"key": "b"}\nnull\n[]\n\xff\n')
    assert list(read_rows(file)) == ["a"]


def test_what_failed_is_tried_again() -> None:
    rows = {"a": row("a"), "b": row("b", error="no")}
    assert done(rows, "a")
    assert not done(rows, "b")
    assert not done(rows, "c")


def test_a_file_that_cannot_be_written_is_said_plainly(tmp_path: Path) -> None:
    with pytest.raises(ExportError, match="cannot be"):
        append_rows(tmp_path, [row("a")])
    with pytest.raises(ExportError, match="cannot be read"):
        read_rows(tmp_path)
    (tmp_path / "file").write_text("mine")
    for anew in (True, False):
        with pytest.raises(ExportError, match=r"cannot write into `.*file`.*choose another --out"):
            begin_rows(tmp_path / "file" / "rows.jsonl", anew)


def test_a_key_says_all_that_determines_a_task(tmp_path: Path) -> None:
    (tmp_path / "m").mkdir()
    (tmp_path / "m" / "a.urdf").write_text("<robot/>")
    model = ModelRef("m", "urdf", tmp_path / "m")
    other = ModelRef("n", "made", seed=1, number=2)
    rule, network = Method("rule"), Method("network")
    tasks = [
        ModelTask(model),
        ModelTask(other),
        MethodTask(model, rule),
        MethodTask(model, network),
        MethodTask(other, network),
        MaskTask(model, network, 0.1, 0),
        MaskTask(model, network, 0.1, 1),
        MaskTask(model, network, 0.3, 0),
        MaskTask(model, rule, 0.1, 0),
        TwinTask(model, other),
        TwinTask(other, model),
        MadeTask(0, 1),
        MadeTask(1, 1),
    ]
    assert len({key_of(task) for task in tasks}) == len(tasks)
    assert key_of(ModelTask(model)) == key_of(ModelTask(ModelRef("m", "urdf", tmp_path / "m")))


def test_a_change_of_the_model_or_of_predictions_changes_the_key(tmp_path: Path) -> None:
    from grafu.evaluation.tasks import _state_of

    def keys() -> tuple[str, str]:
        _state_of.cache_clear()
        model = ModelRef("m", "urdf", tmp_path / "m")
        return key_of(ModelTask(model)), key_of(MethodTask(model, Method("urdf", tmp_path / "predicted")))

    for folder in ("m", "predicted/m"):
        (tmp_path / folder).mkdir(parents=True)
        (tmp_path / folder / "a.urdf").write_text("<robot/>")
    before = keys()
    (tmp_path / "predicted" / "m" / "a.urdf").write_text("<Robot/>")
    after = keys()
    assert after[0] == before[0]
    assert after[1] != before[1]
    (tmp_path / "m" / "a.urdf").write_text("<ROBOT/>")
    assert keys()[0] != after[0]


def test_a_model_that_cannot_be_read_is_a_row_with_its_error(tmp_path: Path) -> None:
    (tmp_path / "m").mkdir()
    (tmp_path / "m" / "mobility.urdf").write_text("<robot")
    found = perform(ModelTask(ModelRef("m", "partnet-mobility", tmp_path / "m")))
    assert found.facts is None
    assert "mobility.urdf" in found.error
    assert "\n" not in found.error


def test_an_internal_error_is_a_row_too(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object, **__: object) -> None:
        raise RuntimeError("first line\nsecond line")

    monkeypatch.setattr("grafu.evaluation.perform.make_specimen", broken)
    found = perform(MadeTask(0, 0))
    assert found.error == "internal error, which is our fault (RuntimeError: first line second line)"


@pytest.mark.parametrize("anew", [True, False])
def test_rows_of_others_stay(tmp_path: Path, anew: bool) -> None:
    (tmp_path / NAME).write_text('{"city": "Paris"}\n')

    with pytest.raises(ExportError, match="no rows of grafu's"):
        begin_rows(tmp_path / NAME, anew)
    assert (tmp_path / NAME).read_text() == '{"city": "Paris"}\n'


@pytest.mark.parametrize("what", SPOILS)
def test_rows_that_are_no_plain_file_are_refused_in_one_line(tmp_path: Path, what: str) -> None:
    path = tmp_path / "run" / NAME
    path.parent.mkdir()
    append_rows(path, [row("a")])
    SPOILS[what](path)
    for read in (read_rows, begin_rows):
        with pytest.raises(ExportError, match=f"{what}.*choose another --out"):
            read(path)


def test_no_row_goes_where_a_link_leads(tmp_path: Path) -> None:
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / NAME).symlink_to(tmp_path / "elsewhere")
    with pytest.raises(ExportError, match="link that leads out"):
        begin_rows(tmp_path / "run" / NAME)


@pytest.mark.parametrize("what", SPOILS)
def test_a_key_opens_nothing_that_no_reader_would(tmp_path: Path, what: str) -> None:
    model = write_pnm(tmp_path / "model")
    path = model / "mobility_v2.json"
    facts = [ModelTask(ModelRef("m", "partnet-mobility", model)).facts()]
    SPOILS[what](path)
    for text in ("one", "two") if path.is_symlink() else ("",):
        if text:
            path.write_text(text)  # where the link leads: of that nothing is read
        _state_of.cache_clear()
        facts.append(ModelTask(ModelRef("m", "partnet-mobility", model)).facts())
    assert facts[0] != facts[1] == facts[-1]
