"""`functionalize` with URLs and `--cluster`: what it refuses, in one line, and a bucket without a cluster."""

import json
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from uuid import uuid4

import pytest
from obj_inputs import write_cabinet

from grafu.cli.main import main
from grafu.cli.outcome import Ended
from grafu.cli.remote_job import RemoteJob

CLUSTER = Path(__file__).parents[1] / "cluster"


def said(capsys: pytest.CaptureFixture[str], *words: str, code: int = 2) -> str:
    assert main(["functionalize", *words]) == code
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1, lines
    return lines[0]


def test_a_plain_run_imports_neither_ray_nor_fsspec(tmp_path: Path) -> None:
    model = write_cabinet(tmp_path)
    words = ["functionalize", str(model), "--out", str(tmp_path / "out"), "--no-page", "--formats", "urdf"]
    unwanted = {"ray", "fsspec", "s3fs", "grafu.cluster.storage", "grafu.cluster.ray_tasks"}
    code = f"import sys; from grafu.cli.main import main; main({words}); print(sorted({unwanted} & set(sys.modules)))"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout.splitlines()[-1] == "[]"


def test_without_ray_the_extra_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "ray", None)
    model = str(write_cabinet(tmp_path))
    assert "pip install 'grafu[cluster]'" in said(capsys, model, "--cluster", "auto", "--out", str(tmp_path / "out"))


@pytest.mark.parametrize("address", ["somewhere", "ray://host", "http://host:8265", "host:port"])
def test_what_is_no_address_is_refused(address: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("ray")
    model = str(write_cabinet(tmp_path))
    line = said(capsys, model, "--cluster", address, "--out", str(tmp_path / "out"))
    assert f"`--cluster` must be ray://HOST:10001, HOST:6379, auto or local: got `{address}`" in line


def test_a_cluster_that_is_not_there_is_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("ray")
    with socket.socket() as bound:  # and never listens
        bound.bind(("127.0.0.1", 0))
        address = f"ray://127.0.0.1:{bound.getsockname()[1]}"
        line = said(capsys, str(write_cabinet(tmp_path)), "--cluster", address, "--out", str(tmp_path / "out"))
    assert f"the cluster `{address}` cannot be reached" in line


@pytest.mark.parametrize(("option", "words"), [("--check", "`grafu check`"), ("--pieces=split", "`--pieces split`")])
def test_what_needs_files_of_this_machine_is_refused(
    option: str, words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    if option == "--check":
        pytest.importorskip("mujoco")
    assert words in said(capsys, str(write_cabinet(tmp_path)), "--cluster", "local", option, "--out", str(tmp_path))


def test_a_password_in_a_url_is_refused_and_not_repeated(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["functionalize", "s3://key:hidden@bucket/cab.glb", "--out", "out"])
    printed = capsys.readouterr().err
    assert "must not hold a name or a password" in printed
    assert "hidden" not in printed


def test_an_interruption_takes_away_what_was_half_written(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("fsspec")
    from grafu.cluster.result_upload import PARTIAL
    from grafu.cluster.storage import files_below, write
    from grafu.cluster.urls import Url

    root = Url(f"memory://{uuid4().hex}")
    write(root, {"models/cab.glb": b"g", "models/desk.glb": b"g"})

    def interrupted(jobs: list[RemoteJob], *given: Any) -> Iterator[Ended]:
        for job in jobs:
            given[-1](job)
        write(root / "out/cab", {PARTIAL: b'{"files": ["model.urdf"]}', "model.urdf": b"half", "notes.txt": b"mine"})
        raise KeyboardInterrupt
        yield

    monkeypatch.setattr("grafu.cli.remote_run.run_all", interrupted)
    assert main(["functionalize", f"{root}/models/*", "--out", f"{root}/out"]) == 130
    assert "0 of 2 inputs were done; with --resume" in capsys.readouterr().err
    assert files_below(root / "out") == ("cab/notes.txt",)


def test_results_go_to_no_place_of_an_input(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("fsspec")
    from grafu.cluster.storage import files_below, write
    from grafu.cluster.urls import Url

    root = Url(f"memory://{uuid4().hex}")
    write(root, {"cab/cab.glb": b"g", "other/cab.glb": b"g"})
    for inputs in ("cab/cab.glb", "cab"):
        assert "choose another --out" in said(capsys, f"{root}/{inputs}", "--out", str(root))
    same = ["functionalize", f"{root}/cab/cab.glb", f"{root}/cab", "--out", f"{root}/out"]
    assert main(same) == 2
    assert "must have different names" in capsys.readouterr().err
    assert files_below(root) == ("cab/cab.glb", "other/cab.glb")


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")  # of sockets that s3fs leaves open
def test_a_bucket_without_a_cluster(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("s3fs")
    pytest.importorskip("moto")
    monkeypatch.syspath_prepend(str(CLUSTER))
    from local_s3 import local_s3

    with local_s3() as storage:
        for name in ("one", "two"):
            storage.put(str(write_cabinet(tmp_path, name)), f"bucket/models/{name}/{name}.obj")
        storage.pipe("bucket/out/two/notes.txt", b"mine")
        words = ["functionalize", "s3://bucket/models/*", "--formats", "urdf", "--no-page", "--json"]
        assert main([*words, "--out", "s3://bucket/out"]) == 1
        lines = {line["name"]: line for line in map(json.loads, capsys.readouterr().out.splitlines())}
        assert lines["one"]["error"] is None
        assert "notes.txt" not in lines["two"]["error"]
        assert "so it is kept" in lines["two"]["error"]
        there = {name.partition("out/one/")[2] for name in storage.find("bucket/out/one")}
        assert there == {*lines["one"]["files"], ".grafu.json"}
        assert main([*words[:1], "s3://bucket/models/one", *words[2:], "--out", "s3://bucket/out", "--resume"]) == 0
        assert json.loads(capsys.readouterr().out)["seconds"] is not None
        assert (
            "s3://bucket/out" in said(capsys, "s3://bucket/out/two", "--out", "s3://bucket/out", code=2).split(": ")[1]
        )
        for inputs, out in (("s3://none/*", "s3://bucket/out"), ("s3://bucket/models/*", "s3://none/out")):
            assert "s3://none" in said(capsys, inputs, "--out", out)
