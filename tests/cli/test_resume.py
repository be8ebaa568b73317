"""`functionalize --resume`: what is done stays and is shown; what was made otherwise is refused."""

from pathlib import Path

import pytest
from obj_inputs import write_cabinet

from grafu.cli.job import Failed, Job, JobOptions, Succeeded, run_job
from grafu.cli.main import main


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory) -> Job:
    folder = tmp_path_factory.mktemp("run")
    job = Job(write_cabinet(folder), "cabinet", JobOptions(folder / "out", formats=("urdf",), resume=True))
    assert isinstance(run_job(job), Succeeded)
    return job


def with_options(job: Job, **options: object) -> Job:
    given = {"formats": ("urdf",), "resume": True} | options
    return Job(job.input, job.name, JobOptions(job.options.out, **given))  # type: ignore[arg-type]


def test_what_is_done_is_not_made_again(done: Job) -> None:
    before = (done.folder / "report.json").stat().st_mtime_ns
    result = run_job(done)

    assert isinstance(result, Succeeded)
    assert result.earlier
    assert result.report.joints
    assert result.picture[:4] == b"RIFF"
    assert (done.folder / "report.json").stat().st_mtime_ns == before


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"trim": False}, "other options"),
        ({"formats": ("urdf", "glb")}, "without glb"),
        ({"resume": False}, "--resume"),
    ],
)
def test_what_was_made_otherwise_is_refused(done: Job, options: dict[str, object], said: str) -> None:
    result = run_job(with_options(done, **options))

    assert isinstance(result, Failed)
    assert result.users_fault
    assert said in result.why


def test_a_model_that_was_mended_by_hand_is_done(done: Job, tmp_path: Path) -> None:
    arguments = ["functionalize", str(done.input), "--out", str(tmp_path), "--formats", "urdf"]
    assert main([*arguments, "--move", "door=right"]) == 0
    result = run_job(Job(done.input, done.name, JobOptions(tmp_path, formats=("urdf",), resume=True)))

    assert isinstance(result, Succeeded)
    assert result.earlier


def test_a_report_of_another_form_is_refused(done: Job, tmp_path: Path) -> None:
    (tmp_path / "cabinet").mkdir()
    (tmp_path / "cabinet" / "report.json").write_text("{}")
    result = run_job(Job(done.input, "cabinet", JobOptions(tmp_path, resume=True)))

    assert isinstance(result, Failed)
    assert "another form" in result.why


def test_a_run_that_goes_on_shows_all(done: Job, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    second = write_cabinet(tmp_path, "second")
    out = done.options.out
    arguments = ["functionalize", str(done.input), str(second), "--out", str(out), "--formats", "urdf", "--jobs", "1"]
    assert main([*arguments, "--resume"]) == 0

    assert "in 2 inputs (1 of them done earlier)" in capsys.readouterr().out
    page = (out / "index.html").read_text()
    assert 'href="cabinet/report.html"' in page
    assert page.count("<img") == 2


def test_resuming_and_overwriting_exclude_each_other(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(["functionalize", "a.glb", "--out", "out", "--resume", "--overwrite"])
    assert end.value.code == 2
    assert "not allowed with" in capsys.readouterr().err
