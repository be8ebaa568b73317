"""Pictures of `grafu edit` as a browser shows it; they need Chromium, which is driven as the tests drive it."""

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image

from grafu.render.picture import Picture

if TYPE_CHECKING:
    from chromium import Chromium

ROOT = Path(__file__).parent.parent
SAMPLES = ROOT / "samples"
ON_WALL = ("sideboard", "chest", "dresser")
SIZE = (1180, 860)
HANDLES = np.s_[60:652, 830:1160]  # rows and columns of the page that show the handles in pictures
STEPS = {
    "edit_part": "grafuEditor.pick('door_1')",
    "edit_doubtful": "document.querySelector('[data-do=next]').click()",
    "edit_done": "grafuEditor.pick('door_1'); grafuEditor.choose('motion', 'door_1', 'right')",
    "edit_lasso": "grafuEditor.pick('door_1'); grafuEditor.cut();"
    " const lasso = grafuEditor.view.lasso.grab({x: 0.242, y: 0.366});"
    " [[0.415, 0.334], [0.42, 0.612], [0.257, 0.666]].forEach(([x, y]) => lasso({x, y}))",
    "edit_handles": "grafuEditor.pick('drawer_1');"
    " document.querySelectorAll('details').forEach((one) => (one.open = true));"
    " document.querySelector('.handles').scrollIntoView({block: 'center'})",
    "edit_export": "document.querySelector('[data-do=export]').click()",
}
"""By picture, what is done before it is taken."""


@contextmanager
def edited(folder: str, *arguments: str) -> "Iterator[tuple[Chromium, str]]":
    """Yields a browser and the address of a server that edits something; it runs in a folder.

    Raises:
        RuntimeError: if there is no Chromium.
    """
    sys.path.insert(0, str(ROOT / "tests"))
    from chromium import Chromium, chromium_path

    path = chromium_path()
    if path is None:
        raise RuntimeError("pictures of the editor need Chromium: install it, or name the other pictures")
    command = [sys.executable, "-m", "grafu", "edit", *arguments, "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=folder) as server:
        browser = Chromium(path)
        try:
            assert server.stdout is not None
            yield browser, server.stdout.readline().split()[-1]
        finally:
            browser.close()
            server.kill()


def taken(browser: "Chromium") -> Picture:
    """Returns what the browser shows."""
    browser.run("new Promise((done) => setTimeout(done, 1500))")
    return np.asarray(Image.open(BytesIO(browser.screenshot())).convert("RGBA"))


def part_sheet(step: str) -> Picture:
    """Returns the page of the sample after a step, its door ajar where no lasso is drawn over it."""
    with TemporaryDirectory() as folder, edited(folder, str(SAMPLES / "sideboard.glb")) as (browser, address):
        browser.go(address, SIZE)
        browser.wait_for("document.getElementById('stage').className === 'ready'")
        number = browser.run("grafuEditor.shown")
        browser.run(f"{step}; 1")
        if "choose(" in step:
            browser.wait_for(f"grafuEditor.shown > {number} && !grafuEditor.building")
        if "export" in step:
            browser.wait_for("document.getElementById('progress').textContent.startsWith('exported')")
        elif "cut(" not in step:
            browser.run("((v) => v.joints.setFraction(v.jointOf(v.view.chosen), 0.7))(grafuEditor.view)")
        shown = taken(browser)
        return shown[HANDLES] if ".handles" in step else shown


def wall_sheet() -> Picture:
    """Returns the wall of some samples, as `grafu functionalize` made them."""
    with TemporaryDirectory() as out:
        inputs = [str(SAMPLES / f"{name}.glb") for name in ON_WALL]
        run = [sys.executable, "-m", "grafu", "functionalize", *inputs, "--out", out, "--formats", "glb"]
        subprocess.run(run, check=True, stdout=subprocess.DEVNULL)
        with edited(out, out) as (browser, address):
            browser.go(address, (900, 560))
            return taken(browser)


SHEETS = {**{name: partial(part_sheet, step) for name, step in STEPS.items()}, "edit_wall": wall_sheet}
