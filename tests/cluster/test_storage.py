"""What is read and written at URLs, tried with a storage in memory: whole models, and one line for what goes wrong."""

import sys
from collections.abc import Iterator
from pathlib import Path
from uuid import uuid4

import pytest

pytest.importorskip("fsspec")

from folders import contents
from grafu.cluster.config import FetchConfig
from grafu.cluster.storage import (
    fetch,
    files_below,
    matches,
    names_in,
    read,
    remove,
    require_writable,
    without_secrets,
    write,
)
from grafu.cluster.urls import Url
from grafu.errors import AssetError, AssetTooLarge, ExportError, OptionError, UnreadableAsset


@pytest.fixture
def root() -> Iterator[Url]:
    import fsspec

    url = Url(f"memory://{uuid4().hex}")
    yield url
    system = fsspec.filesystem("memory")
    if system.exists(str(url)):
        system.rm(str(url), recursive=True)


def test_a_pattern_stands_for_files_and_folders(root: Url) -> None:
    write(root / "models", {"b.glb": b"2", "a.glb": b"1", "chair/part.obj": b"3"})

    assert [url.name for url in matches(root / "models/*")] == ["a.glb", "b.glb", "chair"]
    assert [url.name for url in matches(root / "models/a.glb")] == ["a.glb"]
    assert names_in(root / "models") == {"a.glb", "b.glb", "chair"}
    assert names_in(root / "nothing") == frozenset()
    for missing in ("models/c.glb", "models/*.stl"):
        with pytest.raises(UnreadableAsset, match="there is no"):
            matches(root / missing)


def test_a_file_that_holds_all_comes_alone_and_others_with_what_is_beside_them(root: Url, tmp_path: Path) -> None:
    write(root / "one", {"cab.obj": b"o", "cab.mtl": b"m", "textures/oak.png": b"t", "cab.glb": b"g"})

    assert fetch(root / "one/cab.glb", tmp_path / "glb") == tmp_path / "glb/cab.glb"
    assert contents(tmp_path / "glb") == {"cab.glb": b"g"}
    assert fetch(root / "one/cab.obj", tmp_path / "obj") == tmp_path / "obj/cab.obj"
    assert contents(tmp_path / "obj").keys() == {"cab.obj", "cab.mtl", "textures/oak.png", "cab.glb"}
    assert fetch(root / "one", tmp_path / "folder") == tmp_path / "folder/one"
    assert contents(tmp_path / "folder/one")["textures/oak.png"] == b"t"


@pytest.mark.parametrize("config", [FetchConfig(files=2), FetchConfig(bytes=3)])
def test_a_folder_that_is_too_large_for_a_model_is_refused(root: Url, tmp_path: Path, config: FetchConfig) -> None:
    write(root, {"a.obj": b"11", "b.obj": b"22", "c.obj": b"33"})

    with pytest.raises(AssetTooLarge, match="a folder of its own"):
        fetch(root / "a.obj", tmp_path, config)
    assert contents(tmp_path) == {}


@pytest.mark.parametrize("name", ["../outside.obj", "a/../../b.obj", "a\\b.obj", "a//b.obj"])
def test_a_name_that_leads_out_of_the_folder_is_refused(
    root: Url, tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    import fsspec

    write(root, {"a.obj": b"1"})
    system = fsspec.filesystem("memory")
    inside = system._strip_protocol(str(root))
    monkeypatch.setattr(type(system), "find", lambda *_, **__: {f"{inside}/{name}": {"size": 1}})

    with pytest.raises(UnreadableAsset, match="no name on a disk"):
        fetch(root / "a.obj", tmp_path / "in")
    with pytest.raises(UnreadableAsset):
        files_below(root)
    assert contents(tmp_path) == {}


def test_what_is_removed_is_gone_and_what_was_gone_is_no_fault(root: Url, tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"disk")
    write(root / "out", {"a": b"1", "deep/b": tmp_path / "file"})
    require_writable(root / "out")
    remove(root / "out", ["a", "nothing"])

    assert files_below(root / "out") == ("deep/b",)
    assert read(root / "out/deep/b") == b"disk"


def test_what_the_storage_raises_is_one_line_without_secrets(root: Url, monkeypatch: pytest.MonkeyPatch) -> None:
    import fsspec

    monkeypatch.setenv("STORAGE_TOKEN", "abcdefghijkl")
    raised: list[Exception] = [
        PermissionError("abcdefghijkl"),
        type("NoCredentialsError", (Exception,), {})("abcdefghijkl"),
        RuntimeError("line\nwith abcdefghijkl"),
        FileNotFoundError("abcdefghijkl"),
    ]

    def fail(*_: object, **__: object) -> None:
        raise raised[0]

    monkeypatch.setattr(type(fsspec.filesystem("memory")), "pipe_file", fail)
    monkeypatch.setattr(type(fsspec.filesystem("memory")), "cat_file", fail)
    while raised:
        for kind, do in ((ExportError, lambda: require_writable(root)), (AssetError, lambda: read(root / "a"))):
            with pytest.raises(kind) as stated:
                do()
            assert str(root) in str(stated.value)
            assert "abcdefghijkl" not in str(stated.value)
            assert "\n" not in str(stated.value)
        raised.pop(0)


def test_short_words_are_no_secrets(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SORT_KEY", "name")
    assert without_secrets("the name  of\na file") == "the name of a file"


def test_a_scheme_that_is_not_known_or_not_installed_is_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(OptionError, match="must begin with"):
        matches(Url("nowhere://bucket/x"))
    import fsspec.core

    def missing(*_: object, **__: object) -> None:
        raise ImportError("install it")

    with monkeypatch.context() as patch:
        patch.setattr(fsspec.core, "url_to_fs", missing)
        for url, package in (("s3://bucket/x", r"grafu\[cluster\]"), ("gs://bucket/x", "gcsfs")):
            with pytest.raises(OptionError, match=f"pip install '{package}'"):
                matches(Url(url))
    monkeypatch.setitem(sys.modules, "fsspec.core", None)
    with pytest.raises(OptionError, match=r"pip install 'grafu\[cluster\]'"):
        matches(Url("s3://bucket/x"))
