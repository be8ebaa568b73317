"""`doctor` finds what is missing, and `show` the page of a result."""

from importlib.metadata import metadata
from pathlib import Path

import pytest
from obj_inputs import write_cabinet

from grafu.cli import doctor, show
from grafu.cli.main import main
from grafu.completion import session
from grafu.errors import UnreadableAsset
from grafu.export.formats import FORMATS


@pytest.mark.slow
def test_doctor_lists_packages_formats_and_a_piece_that_works(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["doctor"]) == 0
    said = capsys.readouterr().out
    assert "FAILS" not in said
    assert all(name in said for name in ("numpy", "onnxruntime", *(f"--formats {one}" for one in FORMATS)))
    assert "2 doors" in said


def test_a_package_that_is_missing_is_told_with_the_remedy() -> None:
    found = doctor._package("no-such-package")
    assert not found.works
    assert found.needed
    assert found.said == "not installed: pip install no-such-package"


def test_verbs_that_need_more_are_told_with_their_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(doctor, "find_spec", lambda name: None if name == "starlette" else object())
    found = {one.what: one for one in doctor._verbs()}
    assert (found["grafu edit"].works, found["grafu edit"].needed) == (False, False)
    assert found["grafu edit"].said == "needs starlette: pip install 'grafu[edit]'"
    assert found["grafu check"].works
    extras = set(metadata("grafu").get_all("Provides-Extra") or ())
    assert {extra for extra, *_ in doctor._NEEDED.values()} <= extras


def test_without_weights_doctor_fails(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(doctor, "_self_test", lambda: doctor.Finding("a piece", True, ""))
    monkeypatch.setattr(session, "SHIPPED_WEIGHTS", tmp_path / "gone.onnx")
    assert main(["doctor"]) == 1
    assert "there are no trained weights" in " ".join(capsys.readouterr().out.split())


def test_show_opens_the_page_of_a_result_of_a_run_and_of_the_only_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    (tmp_path / "one").mkdir()
    page = tmp_path / "one" / "report.html"
    page.write_text("<html></html>")
    for given in (tmp_path / "one", tmp_path, page):
        assert main(["show", str(given)]) == 0
    assert opened == [page.as_uri()] * 3
    (tmp_path / "index.html").write_text("<html></html>")
    assert show.page_of(tmp_path) == tmp_path / "index.html"
    assert capsys.readouterr().out.splitlines() == opened


def test_show_writes_the_page_over_results_that_were_made_one_by_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    for name in ("a", "b"):
        cabinet = write_cabinet(tmp_path / "models", name)
        assert main(["functionalize", str(cabinet), "--out", str(tmp_path / "out")]) == 0
    page = tmp_path / "out" / "index.html"
    assert not page.exists()
    assert main(["show", str(tmp_path / "out")]) == 0
    assert opened == [page.as_uri()]
    assert all(f'href="{name}/report.html"' in page.read_text() for name in ("a", "b"))


def test_a_folder_without_a_page_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UnreadableAsset, match=r"there is no .*gone"):
        show.page_of(tmp_path / "gone")
    with pytest.raises(UnreadableAsset, match="without --no-page"):
        show.page_of(tmp_path)
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "report.html").write_text("")
    with pytest.raises(UnreadableAsset, match="choose one of its 2 results"):
        show.page_of(tmp_path)
