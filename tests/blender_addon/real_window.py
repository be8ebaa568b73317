"""A real Blender window on a screen that no one sees: Xvfb, drawing in software. Pictures are taken from it."""

import os
import shutil
import struct
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

ROOT = Path(__file__).parents[2]
SIZE = (1600, 1000)
_STARTS = 60.0  # seconds until a screen or a Blender answers, on a busy machine


def missing() -> str:
    """Returns why there can be no window; empty: there can."""
    for program in ("Xvfb", "blender"):
        if shutil.which(program) is None:
            return f"there is no `{program}`"
    say = "import sys; print('python', *sys.version_info[:2])"
    told = subprocess.run(
        ["blender", "--background", "--factory-startup", "--python-expr", say],
        capture_output=True,
        text=True,
        timeout=_STARTS,
        check=False,
    ).stdout
    own = f"python {sys.version_info[0]} {sys.version_info[1]}"
    return "" if own in told.splitlines() else f"`blender` has another Python than the packages here ({own})"


@contextmanager
def screen(folder: Path) -> Iterator[str]:
    """Gives the name of a display of `SIZE`; what it shows stands in a file of the folder."""
    given, taken = os.pipe()
    command = ["Xvfb", "-displayfd", str(taken), "-screen", "0", f"{SIZE[0]}x{SIZE[1]}x24", "-fbdir", str(folder)]
    quiet = subprocess.DEVNULL
    server = subprocess.Popen(command, pass_fds=(taken,), stdin=quiet, stdout=quiet, stderr=quiet)
    os.close(taken)
    try:
        with open(given, encoding="ascii") as answer:
            yield f":{answer.readline().strip()}"
    finally:
        server.terminate()
        server.wait()


def run_in_window(
    script: Path, arguments: list[str], folder: Path, seconds: float
) -> "subprocess.CompletedProcess[str]":
    """Runs a script in a Blender with a window, and returns what it said. `folder` is for its files, pictures too.

    The script gets `ROOT FOLDER SCREEN` and the arguments after `--`; SCREEN is the file that holds what is seen.
    """
    with TemporaryDirectory(prefix="grafu_screen_") as drawn, screen(Path(drawn)) as display:
        packages = [path for path in sys.path if path.endswith(("site-packages", "src"))]
        environment = {
            **{name: value for name, value in os.environ.items() if not name.startswith(("WAYLAND", "XDG_SESSION"))},
            "DISPLAY": display,
            "LIBGL_ALWAYS_SOFTWARE": "1",
            "HOME": str(folder),  # no preferences of the user's
            "PYTHONPATH": os.pathsep.join([str(ROOT / "src"), str(Path(__file__).parent), *packages]),
        }
        flags = ["--factory-startup", "--python-use-system-env", "--enable-event-simulate", "--no-window-focus"]
        place = ["--window-geometry", "0", "0", *map(str, SIZE)]
        given = ["--", str(ROOT), str(folder), str(Path(drawn) / "Xvfb_screen0"), *arguments]
        return subprocess.run(
            ["blender", *flags, *place, "--python", str(script), *given],
            env=environment,
            capture_output=True,
            text=True,
            timeout=seconds,
            check=False,
        )


def read_screen(path: Path) -> np.ndarray:
    """Returns what a copied screen shows: row, column, RGB."""
    data = path.read_bytes()
    head = struct.unpack(">25I", data[:100])  # of the X window dump format
    size, width, height, row_bytes, colours = head[0], head[4], head[5], head[12], head[19]
    pixels = np.frombuffer(data, np.uint8, row_bytes * height, size + 12 * colours)
    return pixels.reshape(height, row_bytes // 4, 4)[:, :width, 2::-1]
