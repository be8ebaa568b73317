"""Results at URLs: complete with their marker, which is written last; no interrupted upload is taken for one."""

from collections.abc import Callable
from pathlib import Path
from uuid import uuid4

import pytest

pytest.importorskip("fsspec")

from grafu.asset.regular_files import MARKER
from grafu.cluster import result_upload
from grafu.cluster.result_upload import PARTIAL, Upload, fetch_result, remove_unfinished, upload_at, upload_result
from grafu.cluster.storage import files_below, read, write
from grafu.cluster.urls import Url
from grafu.errors import ExportError
from grafu.export.files import ExportFiles, write_files

OLD = {"report.json": b"old", "only_old.obj": b"1", "meshes/a.obj": b"old"}
NEW = {"report.json": b"new", "only_new.obj": b"2", "meshes/a.obj": b"new"}


def folder_of(files: dict[str, bytes], folder: Path) -> Path:
    write_files(ExportFiles(files), folder)
    return folder


def place() -> Url:
    return Url(f"memory://{uuid4().hex}/cab")


def test_a_result_replaces_an_earlier_one_and_keeps_what_is_not_grafus(tmp_path: Path) -> None:
    there = place()
    assert upload_at(there) is Upload.FREE
    upload_result(folder_of(OLD, tmp_path / "old"), there)
    write(there, {"notes.txt": b"mine"})
    upload_result(folder_of(NEW, tmp_path / "new"), there)

    assert upload_at(there) is Upload.COMPLETE
    assert {*files_below(there)} == {*NEW, MARKER, "notes.txt"}
    assert read(there / "meshes/a.obj") == b"new"
    remove_unfinished(there)
    assert upload_at(there) is Upload.COMPLETE


def test_files_without_a_marker_are_not_grafus(tmp_path: Path) -> None:
    there = place()
    write(there, {"notes.txt": b"mine"})
    assert upload_at(there) is Upload.FOREIGN
    remove_unfinished(there)
    assert files_below(there) == ("notes.txt",)


class Stopped(Exception):
    """The process ends here."""


def stop_at(step: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Lets the upload end before its so-manieth call of the storage."""
    calls = [0]

    def counted(do: Callable[..., object]) -> Callable[..., object]:
        def instead(*given: object) -> object:
            calls[0] += 1
            if calls[0] > step:
                raise Stopped
            return do(*given)

        return instead

    for name in ("write", "remove"):
        monkeypatch.setattr(result_upload, name, counted(getattr(result_upload, name)))


@pytest.mark.parametrize("replaces", [False, True])
@pytest.mark.parametrize("step", range(6))
def test_an_upload_that_is_stopped_anywhere_is_no_result(
    replaces: bool, step: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    there = place()
    if replaces:
        upload_result(folder_of(OLD, tmp_path / "old"), there)
    fresh = folder_of(NEW, tmp_path / "new")
    with monkeypatch.context() as patch:
        stop_at(step, patch)
        with pytest.raises(Stopped):
            upload_result(fresh, there)

    if upload_at(there) is Upload.COMPLETE:  # the old one is untouched, or the new one is all there
        reads = {name: read(there / name) for name in files_below(there) if name not in (MARKER, PARTIAL)}
        assert reads in (OLD, NEW)
    else:
        assert upload_at(there) is (Upload.UNFINISHED if step else Upload.FREE)
        remove_unfinished(there)
        assert PARTIAL not in files_below(there)
    upload_result(fresh, there)
    assert {name: read(there / name) for name in NEW} == NEW
    assert PARTIAL not in files_below(there)


def test_what_a_run_that_goes_on_needs_is_fetched_and_the_rest_is_only_named(tmp_path: Path) -> None:
    there = place()
    upload_result(folder_of(NEW, tmp_path / "new"), there)
    fetch_result(there, tmp_path / "again")

    assert (tmp_path / "again/report.json").read_bytes() == b"new"
    assert (tmp_path / "again" / MARKER).read_bytes() == read(there / MARKER)
    assert (tmp_path / "again/meshes/a.obj").read_bytes() == b""


def test_a_damaged_marker_is_replaced(tmp_path: Path) -> None:
    there = place()
    write(there, {MARKER: b"{", "report.json": b"old"})
    upload_result(folder_of(NEW, tmp_path / "new"), there)
    assert read(there / "report.json") == b"new"


def test_a_storage_that_cannot_be_written_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(ExportError, match="cannot write"):
        write(Url("memory://x"), {"a": tmp_path / "missing"})
