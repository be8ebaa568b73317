"""A run keeps to itself: it opens no connection, asks for no host, and writes nothing but its results.

The kernel is asked, not the program: every call of every process of a whole run is recorded, and judged.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
SAMPLE = ROOT / "samples" / "chest.glb"
CALLS = (  # a question mark: not every processor has the older ones
    "socket,connect,sendto,sendmsg,sendmmsg,bind,?open,openat,?creat,?mkdir,mkdirat,?rename,?renameat,renameat2,"
    "?symlink,symlinkat,?link,linkat,truncate"
)
REACHES_OUT = re.compile(r"\b(?:socket|connect|sendto|sendmsg|sendmmsg|bind)\(.*AF_(?!UNIX)\w+")
OPENED = re.compile(r'\b(?:openat|open|creat)\((?P<at>[^"]*)"(?P<path>[^"]*)"(?P<flags>.*)')
MADE = re.compile(
    r'\b(?:mkdir|mkdirat|rename|renameat|renameat2|symlink|symlinkat|link|linkat|truncate)\([^"]*"(?P<path>[^"]*)"'
)
WRITES = re.compile(r"O_WRONLY|O_RDWR|O_CREAT|O_TRUNC|O_APPEND")
NOWHERE = ("/dev/null", "/dev/tty", "/dev/shm/", "/proc/self/")

strace = shutil.which("strace")
pytestmark = pytest.mark.skipif(strace is None, reason="strace is not installed")


def traced(tmp_path: Path, *arguments: str, home: Path) -> tuple[list[str], str]:
    """Returns the recorded calls that did something, and what the run said on stderr."""
    record, temporary = tmp_path / "calls.txt", tmp_path / "temporary"
    temporary.mkdir(exist_ok=True)
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("ORT_", "XDG_"))}
    environment |= {"HOME": str(home), "TMPDIR": str(temporary), "PYTHONDONTWRITEBYTECODE": "1"}
    command = [str(strace), "-f", "-qq", "--seccomp-bpf", "-s", "4096", "-e", f"trace={CALLS}", "-o", str(record)]
    ran = subprocess.run(
        [*command, sys.executable, "-m", "grafu.cli.main", *arguments], env=environment, capture_output=True, text=True
    )
    lines = record.read_text(errors="replace").splitlines() if record.is_file() else []
    if not lines:
        pytest.skip(f"no process may be traced here: {ran.stderr.strip()[-200:]}")
    assert ran.returncode == 0, ran.stderr
    return [line for line in lines if " = -1 " not in line or REACHES_OUT.search(line)], ran.stderr


def written(calls: list[str]) -> set[str]:
    """Returns the paths that were written, made, or moved."""
    opened = (found for line in calls if (found := OPENED.search(line)) and WRITES.search(found["flags"]))
    made = (found for line in calls if (found := MADE.search(line)))
    return {found["path"] for found in (*opened, *made)}


def outside(paths: set[str], *folders: Path) -> set[str]:
    allowed = tuple(str(folder) for folder in folders)
    return {path for path in paths if not path.startswith((*allowed, *NOWHERE))}


@pytest.mark.parametrize("count", [1, 2])
def test_a_run_reaches_nobody_and_writes_its_results_alone(tmp_path: Path, count: int) -> None:
    home, out = tmp_path / "home", tmp_path / "out"
    home.mkdir()
    inputs = [shutil.copy(SAMPLE, tmp_path / f"chest_{i}.glb") for i in range(count)]
    arguments = (*map(str, inputs), "--out", str(out), "--jobs", "2", "--quiet")
    calls, said = traced(tmp_path, "functionalize", *arguments, home=home)

    assert [line for line in calls if REACHES_OUT.search(line)] == []
    paths = written(calls)
    assert outside(paths, out, tmp_path / "temporary") == set()
    assert any(path.startswith(str(out)) for path in paths)  # the record sees what is written
    assert list(home.iterdir()) == []
    assert list((tmp_path / "temporary").iterdir()) == []
    assert said == ""


def test_the_record_shows_who_reaches_out(tmp_path: Path) -> None:
    record = tmp_path / "calls.txt"
    code = "import socket; socket.socket(socket.AF_INET, socket.SOCK_DGRAM).connect(('127.0.0.1', 53))"
    command = [str(strace), "-f", "-qq", "-e", f"trace={CALLS}", "-o", str(record), sys.executable, "-c", code]
    if subprocess.run(command, capture_output=True, check=False).returncode:
        pytest.skip("no process may be traced here")
    assert len([line for line in record.read_text().splitlines() if REACHES_OUT.search(line)]) == 2


def test_where_there_is_no_home_nothing_is_said_of_it(tmp_path: Path) -> None:
    home = tmp_path / "file"
    home.touch()  # no folder: nothing can be made in it, not even by root
    _, said = traced(tmp_path, "functionalize", str(SAMPLE), "--out", str(tmp_path / "out"), "--no-page", home=home)
    assert said == ""
