"""The add-on's processes, without Blender: one stays, is stopped at once, may die, and leaves nothing behind."""

import importlib
import os
import signal
import subprocess
import sys
from pathlib import Path
from time import monotonic, sleep

import pytest

from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.settings import Settings
from grafu.vocabulary import PartLabel

ROOT = Path(__file__).parents[2]
SAMPLE = ROOT / "samples" / "chest.glb"
SETTINGS = Settings(motion=MotionSource.RULE)
ASKER = """
import os, shutil, sys
sys.path.insert(0, {root!r})
from blender_addon import work
from grafu.pipeline.settings import Settings
run = work.Run(Settings())
shutil.copyfile({sample!r}, run.source)
run.start()
print(run.folder, run._process._running.pid, flush=True)
sys.stdin.readline()
os._exit(1)
"""


@pytest.fixture(scope="module")
def work():
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(ROOT))
        module = importlib.import_module("blender_addon.work")
        yield module
        module.end()


def begun(work, settings=SETTINGS):
    run = work.Run(settings)
    run.source.write_bytes(SAMPLE.read_bytes())
    run.start()
    return run


def is_alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return "Z" not in Path(f"/proc/{pid}/stat").read_text().split()[2] if Path("/proc").is_dir() else True


def gone_within(seconds: float, pid: int, folder: Path) -> bool:
    end = monotonic() + seconds
    while monotonic() < end and (is_alive(pid) or folder.exists()):
        sleep(0.05)
    return not is_alive(pid) and not folder.exists()


def test_runs_share_a_process_and_each_says_how_far_it_is(work):
    first = begun(work)
    ratios = {first.ratio}
    while not first.is_done:
        ratios.add(first.ratio)
        sleep(0.01)
    first.require_success()
    first.close()
    assert len(first.result().moving_joints) == 1
    assert 0.0 in ratios
    assert all(0.0 <= ratio < 1.0 for ratio in ratios)
    second = begun(work)
    second.wait()
    second.require_success()
    assert second.folder == first.folder
    assert "chest" not in second.text("report.json").split('"joints"')[1]
    assert second.stage == "write"
    assert second.doing == "writing"


def test_what_is_wrong_is_one_line_and_the_process_stays(work):
    run = begun(work, SETTINGS.with_label("no_one", PartLabel.MISC))
    run.wait()
    with pytest.raises(work.Failed, match="has no no_one"):
        run.require_success()
    run.close()
    again = begun(work)
    again.wait()
    again.require_success()
    assert again.folder == run.folder


def test_a_run_is_stopped_at_once_and_the_next_works(work):
    run = begun(work)
    pid = run._process._running.pid
    began = monotonic()
    run.close()
    assert monotonic() - began < 1.0
    assert not is_alive(pid)
    assert not run.folder.exists()
    again = begun(work)
    again.wait()
    again.require_success()
    assert again.folder != run.folder


def test_a_process_that_dies_is_one_line_and_the_next_run_starts_another(work):
    run = begun(work)
    os.kill(run._process._running.pid, getattr(signal, "SIGKILL", signal.SIGTERM))
    run.wait()
    with pytest.raises(work.Failed, match="the process ended by itself") as raised:
        run.require_success()
    assert "\n" not in str(raised.value)
    run.close()
    again = begun(work)
    again.wait()
    again.require_success()


def test_a_run_that_takes_too_long_is_stopped(work, monkeypatch):
    run = begun(work)
    monkeypatch.setattr(work, "SECONDS", 0.0)
    run.wait()
    with pytest.raises(work.Failed, match="longer than"):
        run.require_success()
    run.close()


def test_a_command_has_a_process_and_a_folder_of_its_own(work):
    command = work.Command()
    command.start("grafu.cli.finalize", [str(command.folder / "none.json")])
    command.wait()
    with pytest.raises(work.Failed, match="cannot be read"):
        command.require_success()
    command.close()
    assert not command.folder.exists()


def test_the_end_leaves_nothing(work):
    work.warm()
    run = begun(work)
    pid = run._process._running.pid
    work.end()
    assert gone_within(5.0, pid, run.folder)


@pytest.mark.parametrize("killed", [False, True])
def test_with_blender_goes_all_that_it_started(killed):
    code = ASKER.format(root=str(ROOT), sample=str(SAMPLE))
    pipe = subprocess.PIPE
    with subprocess.Popen([sys.executable, "-c", code], stdin=pipe, stdout=pipe, text=True) as asker:
        folder, pid = asker.stdout.readline().rsplit(" ", 1)
        if killed:
            asker.kill()
        else:
            asker.communicate("end\n")
    assert gone_within(120.0, int(pid), Path(folder))  # it is starting: on a busy machine that takes long


def test_folders_that_nobody_uses_are_cleared_at_the_next_start(work, tmp_path, monkeypatch):
    leftovers = work.leftovers
    monkeypatch.setattr(leftovers.tempfile, "gettempdir", lambda: str(tmp_path))
    names = ["grafu_blender_dead", "grafu_blender_held", "grafu_blender_young", "grafu_other"]
    folders = dict(zip(names, [tmp_path / name for name in names], strict=True))
    for name, folder in folders.items():
        folder.mkdir()
        (folder / "output.txt").write_text("stage load\n")
        if name != "grafu_blender_young":
            os.utime(folder, (0, 0))
    with open(folders["grafu_blender_held"] / "output.txt", "ab") as said:
        leftovers.hold(said)
        leftovers.clear()
        assert sorted(path.name for path in tmp_path.iterdir()) == names[1:]
    leftovers.clear()
    assert sorted(path.name for path in tmp_path.iterdir()) == names[2:]


@pytest.mark.skipif(os.name == "nt", reason="there an open file cannot be moved, which is the lock")
def test_a_folder_is_in_use_as_long_as_the_process_that_works_in_it_lives(work, tmp_path, monkeypatch):
    leftovers = work.leftovers
    folder = tmp_path / "grafu_blender_x"
    folder.mkdir()
    with open(folder / "output.txt", "wb") as said:
        leftovers.hold(said)
        sleeper = subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE, stdout=said)
    monkeypatch.setattr(leftovers.tempfile, "gettempdir", lambda: str(tmp_path))
    os.utime(folder, (0, 0))
    leftovers.clear()
    assert folder.exists()
    sleeper.communicate(b"\n")
    leftovers.clear()
    assert not folder.exists()
