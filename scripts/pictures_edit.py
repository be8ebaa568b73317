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
STEPS = {
    "edit_part": "grafuEditor.pick('door_1')",
    "edit_done": "grafuEditor.pick('door_1'); grafuEditor.choose('motion', 'door_1', 'right')",
    "edit_lasso": "grafuEditor.pick('door_1'); grafuEditor.cut();"
    " const lasso = grafuEditor.view.lasso.grab({x: 0.242, y: 0.366});"
    " [[0.415, 0.334], [0.42, 0.612], [0.257, 0.666]].forEach(([x, y]) => lasso({x, y}))",
}
"""By picture, what is done before it is taken."""


@contextmanager
def edited(*arguments: str) -> "Iterator[tuple[Chromium, str]]":
    """Yields a browser and the address of a server that edits something.

    Raises:
        RuntimeError: if there is no Chromium.
    """
    sys.path.insert(0, str(ROOT / "tests"))
    from chromium import Chromium, chromium_path

    path = chromium_path()
    if path is None:
        raise RuntimeError("pictures of the editor need Chromium: install it, or name the other pictures")
    command = [sys.executable, "-m", "grafu", "edit", *arguments, "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
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
    with TemporaryDirectory() as out, edited(str(SAMPLES / "sideboard.glb"), "--out", out) as (browser, address):
        browser.go(address, SIZE)
        browser.wait_for("document.getElementById('stage').className === 'ready'")
        number = browser.run("grafuEditor.shown")
        browser.run(f"{step}; 1")
        if "choose(" in step:
            browser.wait_for(f"grafuEditor.shown > {number} && !grafuEditor.building")
        if "cut(" not in step:
            browser.run("((v) => v.joints.setFraction(v.jointOf(v.view.chosen), 0.7))(grafuEditor.view)")
        return taken(browser)


def wall_sheet() -> Picture:
    """Returns the wall of some samples, as `grafu functionalize` made them."""
    with TemporaryDirectory() as out:
        inputs = [str(SAMPLES / f"{name}.glb") for name in ON_WALL]
        run = [sys.executable, "-m", "grafu", "functionalize", *inputs, "--out", out, "--formats", "glb"]
        subprocess.run(run, check=True, stdout=subprocess.DEVNULL)
        with edited(out) as (browser, address):
            browser.go(address, (900, 420))
            return taken(browser)


SHEETS = {**{name: partial(part_sheet, step) for name, step in STEPS.items()}, "edit_wall": wall_sheet}
