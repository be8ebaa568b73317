"""One model at a URL: the results of a local run, whole or not at all, and refusals that name the URL."""

from dataclasses import replace
from pathlib import Path
from uuid import uuid4

import pytest

pytest.importorskip("fsspec")

from obj_inputs import write_cabinet

from folders import contents
from grafu.cli.job import Job, JobOptions, run_job
from grafu.cli.remote_job import RemoteJob, run_remote_job
from grafu.cluster.result_upload import PARTIAL, Upload, upload_at
from grafu.cluster.storage import files_below, read, write
from grafu.cluster.urls import Url
from grafu.pipeline.settings import Settings

TIMES = "report.json"  # it holds seconds


@pytest.fixture
def job(tmp_path: Path) -> RemoteJob:
    root = Url(f"memory://{uuid4().hex}")
    write(root / "models", {"cabinet.obj": write_cabinet(tmp_path).read_bytes()})
    options = JobOptions(Path(), formats=("urdf",), page=False)
    return RemoteJob(root / "models/cabinet.obj", "cabinet", root / "out", options)


def test_the_results_are_those_of_a_local_run(job: RemoteJob, tmp_path: Path) -> None:
    ended = run_remote_job(job)
    place = job.place
    assert isinstance(place, Url)
    local = Job(tmp_path / "cabinet.obj", "cabinet", replace(job.options, out=tmp_path / "out"))
    run_job(local)

    assert (ended.why, ended.values["input"], ended.values["folder"]) == ("", str(job.source), str(place))
    there = {name: read(place / name) for name in files_below(place) if name != ".grafu.json"}
    expected = contents(local.folder)
    assert there.keys() == expected.keys() == {*ended.values["files"]}
    assert {n: there[n] for n in there if n != TIMES} == {n: expected[n] for n in expected if n != TIMES}
    assert f'"path": "{job.source}"'.encode() in there[TIMES]
    assert b"grafu_scratch" not in b"".join(there.values())


def test_results_that_are_there_are_kept_taken_up_or_replaced(job: RemoteJob) -> None:
    first = run_remote_job(job)
    later = replace(job, present=True)
    refused = run_remote_job(later)
    resumed = run_remote_job(replace(later, options=replace(job.options, resume=True)))
    other = replace(job.options, resume=True, settings=Settings(trim=False))
    changed = run_remote_job(replace(later, options=other))
    more = run_remote_job(replace(later, options=replace(job.options, resume=True, formats=("urdf", "mjcf"))))
    replaced = run_remote_job(replace(later, options=replace(job.options, overwrite=True)))

    assert "exists already" in refused.why
    assert refused.users_fault
    assert resumed.row.earlier
    assert resumed.values["files"] == first.values["files"]
    assert f"`{job.place}` was made with other options" in changed.why
    assert not more.row.earlier
    assert "model.xml" in more.values["files"]
    assert replaced.values["files"] == first.values["files"]
    assert "model.xml" not in files_below(job.place)  # type: ignore[arg-type]


def test_another_try_replaces_what_the_first_one_left(job: RemoteJob) -> None:
    place = job.place
    assert isinstance(place, Url)
    run_remote_job(job)
    assert run_remote_job(job.tried_again()).why == ""
    write(place.parent / "half", {PARTIAL: b"{}", "model.urdf": b"half"})
    assert run_remote_job(replace(job, name="half", present=True)).why == ""
    assert upload_at(place.parent / "half") is Upload.COMPLETE


def test_files_of_others_are_kept(job: RemoteJob) -> None:
    place = job.place
    assert isinstance(place, Url)
    write(place, {"thesis.txt": b"mine"})
    for options in (job.options, replace(job.options, overwrite=True), replace(job.options, resume=True)):
        assert "no `.grafu.json`" in run_remote_job(replace(job, present=True, options=options)).why
    assert files_below(place) == ("thesis.txt",)


def test_a_damaged_model_is_stated_by_its_url_and_leaves_nothing(job: RemoteJob) -> None:
    source = job.source.parent / "bad.glb"
    assert isinstance(source, Url)
    write(source.parent, {"bad.glb": b"glTF"})
    failed = run_remote_job(replace(job, source=source, name="bad"))

    assert str(source) in failed.why
    assert "grafu_scratch" not in str(failed)
    assert failed.users_fault
    assert files_below(job.out / "bad") == ()  # type: ignore[arg-type]
    missing = run_remote_job(replace(job, source=source.parent / "none.glb"))
    assert "there is no" in missing.why


def test_paths_that_all_machines_see_are_used_in_place(tmp_path: Path) -> None:
    options = JobOptions(Path(), formats=("urdf",), page=False)
    job = RemoteJob(write_cabinet(tmp_path), "cabinet", tmp_path / "out", options)
    assert run_remote_job(job).why == ""
    assert (tmp_path / "out/cabinet/model.urdf").is_file()
    assert run_remote_job(job.tried_again()).why == ""
    assert "exists already" in run_remote_job(replace(job, present=True)).why
