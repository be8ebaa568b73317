import errno
import os
from pathlib import Path

import pytest

from folders import contents
from grafu.asset.regular_files import MARKER
from grafu.errors import ExportError
from grafu.export.files import ExportFiles, add_files, whole_folder, write_files
from grafu.export.marker import Marker, read_marker

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


def test_a_folder_without_our_marker_is_kept(tmp_path):
    (tmp_path / "out" / "meshes").mkdir(parents=True)
    (tmp_path / "out" / "model.urdf").write_bytes(b"the user's own")

    for overwrite in (False, True):
        with pytest.raises(ExportError, match=r"\.grafu\.json.*move it away"):
            write_files(FILES, tmp_path / "out", overwrite)
    assert contents(tmp_path) == {"out/model.urdf": b"the user's own"}


def test_what_we_did_not_write_stays_when_we_write_again(tmp_path):
    out = tmp_path / "out"
    write_files(FILES, out)
    (out / "meshes" / "mine").mkdir()
    (out / "empty" / "inside").mkdir(parents=True)
    (out / "notes.txt").write_bytes(b"weeks of work")
    (out / "meshes" / "mine" / "notes.txt").write_bytes(b"more of it")
    (tmp_path / "elsewhere").mkdir()
    (out / "link").symlink_to(tmp_path / "elsewhere", target_is_directory=True)
    (out / "dangling").symlink_to("nowhere")

    for _ in range(2):
        write_files(ExportFiles({"model.glb": b"glTF"}), out, overwrite=True)

    assert contents(out) == {
        "model.glb": b"glTF",
        "notes.txt": b"weeks of work",
        "meshes/mine/notes.txt": b"more of it",
    }
    assert (out / "empty" / "inside").is_dir()
    assert os.readlink(out / "link") == str(tmp_path / "elsewhere")
    assert os.readlink(out / "dangling") == "nowhere"
    assert sorted(os.listdir(tmp_path)) == ["elsewhere", "out"]


@pytest.mark.parametrize("mine", ["model.glb", "MODEL.GLB", "model.glb/notes.txt", "objs"])
def test_what_stands_in_the_way_is_named_and_stays(tmp_path, mine):
    out = tmp_path / "out"
    write_files(FILES, out)
    (out / mine).parent.mkdir(exist_ok=True)
    (out / mine).write_bytes(b"mine")
    before = contents(out)

    with pytest.raises(ExportError, match="none of grafu's files"):
        write_files(ExportFiles({"model.glb": b"glTF", "objs/a.obj": b""}), out, overwrite=True)
    assert contents(out) == before


def test_a_link_in_place_of_our_folder_is_not_followed(tmp_path):
    out, precious = tmp_path / "out", tmp_path / "precious"
    write_files(FILES, out)
    precious.mkdir()
    (precious / "door.obj").write_bytes(b"the user's")
    (out / "meshes" / "door.obj").unlink()
    (out / "meshes").rmdir()
    (out / "meshes").symlink_to(precious, target_is_directory=True)

    with pytest.raises(ExportError, match="meshes"):
        write_files(FILES, out, overwrite=True)
    write_files(ExportFiles({"model.glb": b"glTF"}), out, overwrite=True)
    assert contents(precious) == {"door.obj": b"the user's"}


@pytest.mark.parametrize(
    "text", ["", "{", "[]", '{"schema": "grafu.output/2"}', '{"schema": "grafu.output/1", "files": [1], "formats": {}}']
)
def test_a_damaged_marker_protects_the_folder(tmp_path, text):
    write_files(FILES, tmp_path / "out")
    (tmp_path / "out" / MARKER).write_text(text)

    with pytest.raises(ExportError, match=r"damaged.*move"):
        write_files(FILES, tmp_path / "out", overwrite=True)
    assert contents(tmp_path / "out") == dict(FILES.contents)


def test_a_marker_that_lists_other_places_deletes_nothing_there(tmp_path):
    write_files(FILES, tmp_path / "out")
    (tmp_path / "victim").write_bytes(b"mine")
    (tmp_path / "out" / MARKER).write_bytes(Marker(("../victim", str(tmp_path / "victim"))).to_bytes())

    write_files(ExportFiles({"a": b""}), tmp_path / "out", overwrite=True)
    assert contents(tmp_path) == {"victim": b"mine", "out/a": b"", **{f"out/{n}": b for n, b in FILES.contents.items()}}


def test_the_same_files_give_the_same_marker(tmp_path):
    given = ExportFiles({"b": b"", "a/c": b""}, {"urdf": ("b", "a/c"), "glb": ("b",)})
    turned = ExportFiles({"a/c": b"", "b": b""}, {"glb": ("b",), "urdf": ("a/c", "b")})
    write_files(given, tmp_path / "one")
    write_files(turned, tmp_path / "two")

    assert (tmp_path / "one" / MARKER).read_bytes() == (tmp_path / "two" / MARKER).read_bytes()
    marker = read_marker(tmp_path / "one")
    assert marker is not None
    assert marker.lacks(tmp_path / "one", ("glb", "urdf", "usd")) == ("usd",)
    (tmp_path / "one" / "a" / "c").unlink()
    assert marker.lacks(tmp_path / "one", ("glb", "urdf")) == ("urdf",)


def test_no_export_writes_the_marker():
    for name in (MARKER, MARKER.upper()):
        with pytest.raises(ExportError):
            ExportFiles({name: b""})


def test_added_files_are_ours_and_replace_no_other(tmp_path):
    out, made = tmp_path / "out", tmp_path / "made"
    write_files(FILES, out)
    made.write_bytes(b"blend")
    (out / "notes.txt").write_bytes(b"mine")

    for _ in range(2):
        add_files(out, {"model.blend": made}, {"blend": ("model.blend",)})
    with pytest.raises(ExportError, match=r"notes\.txt"):
        add_files(out, {"notes.txt": made})
    with pytest.raises(ExportError, match="a folder that grafu wrote"):
        add_files(tmp_path, {"model.blend": made})
    marker = read_marker(out)
    assert marker is not None
    assert marker.lacks(out, ("blend",)) == ()
    write_files(FILES, out, overwrite=True)
    assert contents(out) == {**FILES.contents, "notes.txt": b"mine"}


@pytest.mark.parametrize("hard_links", [True, False], ids=["hard links", "a disk without them"])
def test_what_is_not_ours_is_kept_and_links_stay_links(tmp_path, monkeypatch, hard_links):
    def refused(*_: object, **__: object) -> None:
        raise OSError(errno.EPERM, "Operation not permitted")

    if not hard_links:
        monkeypatch.setattr(os, "link", refused)
    write_files(FILES, tmp_path / "out")
    (tmp_path / "out" / "notes.txt").write_bytes(b"mine")
    (tmp_path / "out" / "link").symlink_to("notes.txt")

    write_files(FILES, tmp_path / "out", overwrite=True)
    assert (tmp_path / "out" / "link").readlink().name == "notes.txt"
    assert contents(tmp_path / "out") == {**FILES.contents, "notes.txt": b"mine", "link": b"mine"}


def test_a_folder_filled_piece_by_piece_appears_whole(tmp_path):
    with whole_folder(tmp_path / "a" / "set") as fresh:
        (fresh / "sub").mkdir()
        (fresh / "sub" / "one.tar").write_bytes(b"1")
        assert not (tmp_path / "a" / "set").exists()

    assert contents(tmp_path / "a" / "set") == {"sub/one.tar": b"1"}
    assert read_marker(tmp_path / "a" / "set").files == (MARKER, "sub/one.tar")
    assert os.listdir(tmp_path / "a") == ["set"]


def test_a_folder_whose_filling_fails_leaves_the_earlier_one(tmp_path):
    write_files(FILES, tmp_path / "set")

    def fill(error):
        with whole_folder(tmp_path / "set", overwrite=True) as fresh:
            (fresh / "half.tar").write_bytes(b"1")
            raise error

    with pytest.raises(ZeroDivisionError):
        fill(ZeroDivisionError())
    with pytest.raises(ExportError, match="No space left"):
        fill(OSError(errno.ENOSPC, "No space left on device"))
    assert contents(tmp_path / "set") == dict(FILES.contents)
    assert os.listdir(tmp_path) == ["set"]


def fill_with_results(folder, *names, overwrite=False):
    with whole_folder(folder, overwrite) as fresh:
        for name in names:
            write_files(FILES, fresh / name)


def test_folders_with_markers_of_their_own_are_replaced_with_the_whole(tmp_path):
    fill_with_results(tmp_path / "set", "cabinet", "chest")
    (tmp_path / "set" / "chest" / "notes.txt").write_text("mine")
    assert read_marker(tmp_path / "set").files == (MARKER, f"cabinet/{MARKER}", f"chest/{MARKER}")

    fill_with_results(tmp_path / "set", "desk", overwrite=True)

    found = contents(tmp_path / "set")
    assert found == {"chest/notes.txt": b"mine"} | {f"desk/{name}": data for name, data in FILES.contents.items()}


def test_a_result_that_a_user_put_into_a_folder_of_results_stays(tmp_path):
    fill_with_results(tmp_path / "set", "cabinet")
    write_files(FILES, tmp_path / "set" / "mine")

    fill_with_results(tmp_path / "set", "cabinet", overwrite=True)
    assert (tmp_path / "set" / "mine" / "model.urdf").is_file()

    (tmp_path / "set" / "cabinet" / "extra.txt").write_text("mine")
    with pytest.raises(ExportError, match=r"extra\.txt"), whole_folder(tmp_path / "set", overwrite=True) as fresh:
        write_files(ExportFiles({"extra.txt": b"grafu's"}), fresh / "cabinet")
    assert (tmp_path / "set" / "cabinet" / "extra.txt").read_text() == "mine"
