"""`functionalize --resume`: what is done stays and is shown; what was made otherwise is refused."""

import shutil
from base64 import b64encode
from io import BytesIO
from pathlib import Path

import pytest
from obj_inputs import write_cabinet
from PIL import Image

from folders import contents
from grafu.asset.options import Limits, LoadOptions
from grafu.cli.earlier import finished_in
from grafu.cli.job import Failed, Job, JobOptions, Succeeded, run_job, small_picture_in
from grafu.cli.main import main
from grafu.cli.run_page import write_index
from grafu.export.formats import FORMATS
from grafu.export.marker import Marker, read_marker
from grafu.pipeline.settings import Settings
from spoiled_files import DAMAGED, SPOILS


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
        ({"settings": Settings(trim=False)}, "other options"),
        ({"resume": False}, "--resume"),
    ],
)
def test_what_was_made_otherwise_is_refused(done: Job, options: dict[str, object], said: str) -> None:
    result = run_job(with_options(done, **options))

    assert isinstance(result, Failed)
    assert result.users_fault
    assert said in result.why


@pytest.fixture
def part_of_it(done: Job, tmp_path: Path) -> Job:
    """A model that was made as URDF, mended by hand, without its page."""
    arguments = ["functionalize", str(done.input), "--out", str(tmp_path), "--formats", "urdf", "--no-page"]
    assert main([*arguments, "--move", "door=right"]) == 0
    return Job(done.input, done.name, JobOptions(tmp_path, formats=("urdf",), page=False, resume=True))


def test_every_format_that_is_wanted_is_made(part_of_it: Job) -> None:
    wanted = tuple(name for name in FORMATS if name not in ("blend", "usd", "usdz"))
    settings = (part_of_it.folder / "settings.json").read_bytes()
    (part_of_it.folder / "notes.txt").write_text("mine")
    files = {"glb": "model.glb", "mjcf": "model.xml", "singapo": "object.json", "particulate": "eval/pred.npz"}

    result = run_job(with_options(part_of_it, formats=wanted[1:], page=False))
    assert isinstance(result, Succeeded)
    assert not result.earlier
    assert not (part_of_it.folder / "model.glb").exists()
    result = run_job(with_options(part_of_it, formats=("glb",), page=False))
    assert isinstance(result, Succeeded)

    assert all((part_of_it.folder / name).is_file() for name in (*files.values(), "model.urdf", "notes.txt"))
    assert (part_of_it.folder / "settings.json").read_bytes() == settings  # what was decided by hand stays
    wider = Settings(reading=LoadOptions(limits=Limits(max_faces=3_000_000)))  # how much is read changes no result
    again = run_job(with_options(part_of_it, formats=wanted, page=False, settings=wider))
    assert isinstance(again, Succeeded)
    assert again.earlier


@pytest.mark.parametrize("gone", ["model.urdf", "meshes/", "report.html"])  # the page was not asked for: now it is
def test_what_is_gone_is_made_again(part_of_it: Job, gone: str) -> None:
    marker = read_marker(part_of_it.folder)
    assert marker is not None
    path = part_of_it.folder / next(name for name in (*marker.files, "report.html") if name.startswith(gone))
    path.unlink(missing_ok=True)
    result = run_job(with_options(part_of_it, page=gone == "report.html"))

    assert isinstance(result, Succeeded)
    assert not result.earlier
    assert path.is_file()


def test_results_without_a_marker_are_not_taken_for_ours(part_of_it: Job) -> None:
    (part_of_it.folder / ".grafu.json").unlink()
    before = contents(part_of_it.folder)
    result = run_job(with_options(part_of_it, formats=("glb",)))

    assert isinstance(result, Failed)
    assert "move it away" in result.why
    assert contents(part_of_it.folder) == before


def test_a_model_that_was_mended_by_hand_is_done(done: Job, tmp_path: Path) -> None:
    arguments = ["functionalize", str(done.input), "--out", str(tmp_path), "--formats", "urdf", "--no-page"]
    assert main([*arguments, "--move", "door=right"]) == 0
    result = run_job(Job(done.input, done.name, JobOptions(tmp_path, formats=("urdf",), page=False, resume=True)))

    assert isinstance(result, Succeeded)
    assert result.earlier


def test_a_report_of_another_form_is_refused(done: Job, tmp_path: Path) -> None:
    (tmp_path / "cabinet").mkdir()
    (tmp_path / "cabinet" / "report.json").write_text("{}")
    (tmp_path / "cabinet" / ".grafu.json").write_bytes(Marker(("report.json",)).to_bytes())
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

    third = write_cabinet(tmp_path, "third")
    (out / "mine").mkdir()
    shutil.copy(out / "cabinet" / "report.json", out / "mine" / "report.json")  # no result of ours: it has no marker
    assert main(["functionalize", str(third), "--out", str(out), "--formats", "urdf", "--jobs", "1", "--resume"]) == 0
    page = (out / "index.html").read_text()
    assert all(f'href="{name}/report.html"' in page for name in ("cabinet", "second", "third"))
    assert "mine" not in page
    assert page.count("<img") == 3


@pytest.fixture
def copied(done: Job, tmp_path: Path) -> Job:
    shutil.copytree(done.folder, tmp_path / "out" / "cabinet")
    return Job(done.input, done.name, JobOptions(tmp_path / "out", formats=("urdf",), resume=True))


@pytest.mark.parametrize("name", ["report.json", "settings.json", ".grafu.json"])
@pytest.mark.parametrize("what", [*SPOILS, *DAMAGED])
def test_damaged_results_are_refused_or_made_again(copied: Job, name: str, what: str) -> None:
    path = copied.folder / name
    SPOILS[what](path) if what in SPOILS else path.write_bytes(DAMAGED[what])
    result = run_job(copied)

    assert isinstance(result, Failed)
    assert result.users_fault
    assert "choose another --out" in result.why or "move `" in result.why


@pytest.mark.parametrize("what", [*SPOILS, "no picture", "a bomb"])
def test_a_page_that_holds_no_picture_costs_no_model(copied: Job, what: str) -> None:
    path = copied.folder / "report.html"
    page = '<img src="data:image/webp;base64,{}" alt="x: open">'
    if what in SPOILS:
        SPOILS[what](path)
    else:
        bomb = BytesIO()
        Image.new("L", (4_000, 3_000)).save(bomb, "WEBP", quality=1, method=0)
        path.write_text(page.format("AAA" if what == "no picture" else b64encode(bomb.getvalue()).decode()))

    assert small_picture_in(copied.folder) == b""
    assert [name for name, _ in finished_in(copied.options.out)] == ["cabinet"]


@pytest.mark.parametrize("what", SPOILS)
def test_what_is_no_page_in_its_place_stays(done: Job, tmp_path: Path, what: str) -> None:
    path = tmp_path / "index.html"
    path.write_text("mine")
    SPOILS[what](path)

    assert write_index([Succeeded(done, r, 1.0) for _, r in finished_in(done.options.out)], tmp_path) is None


def test_a_page_that_is_not_ours_stays(done: Job, tmp_path: Path) -> None:
    (tmp_path / "index.html").write_text("mine")

    assert write_index([Succeeded(done, r, 1.0) for _, r in finished_in(done.options.out)], tmp_path) is None
    assert (tmp_path / "index.html").read_text() == "mine"


def test_resuming_and_overwriting_exclude_each_other(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(["functionalize", "a.glb", "--out", "out", "--resume", "--overwrite"])
    assert end.value.code == 2
    assert "not allowed with" in capsys.readouterr().err
