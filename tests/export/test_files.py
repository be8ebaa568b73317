import errno
import os
from pathlib import Path

import pytest

from folders import contents
from grafu.errors import ExportError
from grafu.export.files import ExportFiles, write_files

FILES = ExportFiles({"model.urdf": b"<robot/>", "meshes/door.obj": b"v 0 0 0\n"})


def test_a_folder_appears_whole_with_its_parents(tmp_path):
    write_files(FILES, tmp_path / "a" / "b")

    assert contents(tmp_path / "a" / "b") == dict(FILES.contents)
    assert os.listdir(tmp_path / "a") == ["b"]  # no temporary folder is left


def test_an_empty_folder_is_filled(tmp_path):
    (tmp_path / "out").mkdir()

    write_files(FILES, tmp_path / "out")

    assert contents(tmp_path / "out") == dict(FILES.contents)


def test_an_existing_output_is_kept(tmp_path):
    write_files(ExportFiles({"model.urdf": b"old"}), tmp_path / "out")

    with pytest.raises(ExportError, match="--overwrite"):
        write_files(FILES, tmp_path / "out")
    assert contents(tmp_path / "out") == {"model.urdf": b"old"}


def test_overwrite_replaces_the_whole_folder(tmp_path):
    write_files(ExportFiles({"model.urdf": b"old", "stale.obj": b""}), tmp_path / "out")

    write_files(FILES, tmp_path / "out", overwrite=True)

    assert contents(tmp_path / "out") == dict(FILES.contents)
    assert os.listdir(tmp_path) == ["out"]


def test_overwrite_never_deletes_what_is_no_output(tmp_path):
    (tmp_path / "thesis.tex").write_bytes(b"years of work")

    with pytest.raises(ExportError, match=r"thesis\.tex"):
        write_files(FILES, tmp_path, overwrite=True)
    assert contents(tmp_path) == {"thesis.tex": b"years of work"}


def test_a_file_in_the_way_is_named(tmp_path):
    (tmp_path / "out").write_bytes(b"")

    with pytest.raises(ExportError, match="is a file"):
        write_files(FILES, tmp_path / "out", overwrite=True)


@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EROFS, errno.EACCES])
def test_a_failing_disk_leaves_nothing(tmp_path, monkeypatch, code):
    real = Path.write_bytes

    def failing(path: Path, data: bytes) -> int:
        if path.name == "door.obj":
            raise OSError(code, os.strerror(code))
        return real(path, data)

    monkeypatch.setattr(Path, "write_bytes", failing)

    with pytest.raises(ExportError, match=os.strerror(code)):
        write_files(FILES, tmp_path / "a" / "out")
    assert os.listdir(tmp_path) == []


def test_a_failing_rename_brings_the_old_output_back(tmp_path, monkeypatch):
    write_files(ExportFiles({"model.urdf": b"old"}), tmp_path / "out")
    real = Path.rename

    def failing(path: Path, target: Path) -> Path:
        if path.name.endswith(".new"):
            raise OSError(errno.EIO, "Input/output error")
        return real(path, target)

    monkeypatch.setattr(Path, "rename", failing)

    with pytest.raises(ExportError, match="nothing was written"):
        write_files(FILES, tmp_path / "out", overwrite=True)
    assert contents(tmp_path) == {"out/model.urdf": b"old"}


def test_an_interrupt_leaves_nothing(tmp_path, monkeypatch):
    def interrupted(path: Path, data: bytes) -> int:
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "write_bytes", interrupted)

    with pytest.raises(KeyboardInterrupt):
        write_files(FILES, tmp_path / "out")
    assert os.listdir(tmp_path) == []


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="permissions do not bind this user")
def test_a_read_only_folder_is_named(tmp_path):
    tmp_path.chmod(0o500)

    with pytest.raises(ExportError, match="Permission denied"):
        write_files(FILES, tmp_path / "out")


def test_a_folder_cannot_be_made_inside_a_file(tmp_path):
    (tmp_path / "file").write_bytes(b"")

    with pytest.raises(ExportError, match="cannot write the output"):
        write_files(FILES, tmp_path / "file" / "out")


@pytest.mark.parametrize("name", ["/etc/passwd", "../up", "a/../b", "", ".", "a\\b", "a//b", "./a", "a/"])
def test_names_stay_inside_the_folder(name):
    with pytest.raises(ExportError, match="plain relative path"):
        ExportFiles({name: b""})


@pytest.mark.parametrize("names", [("a.obj", "A.obj"), ("a", "a/b")])
def test_names_must_be_apart_on_any_disk(names):
    with pytest.raises(ExportError, match=r"case|folder"):
        ExportFiles(dict.fromkeys(names, b""))


def test_joining_refuses_two_contents_for_one_name():
    joined = FILES.joined(ExportFiles({"model.glb": b"glTF", "model.urdf": b"<robot/>"}))

    assert joined.names == ("model.urdf", "meshes/door.obj", "model.glb")
    with pytest.raises(ExportError, match=r"model\.urdf"):
        FILES.joined(ExportFiles({"model.urdf": b"other"}))


def test_the_table_cannot_be_changed():
    with pytest.raises(TypeError):
        FILES.contents["x"] = b""
