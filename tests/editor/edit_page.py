"""`grafu edit` in a process of its own, and its page in a browser."""

import os
import subprocess
import sys
import time

import pytest
from editing import DOOR

from chromium import Chromium

LATE = 300.0  # seconds: a first build on a busy machine


class Server:
    """`grafu edit` in a process of its own."""

    def __init__(self, *arguments: str) -> None:
        command = [sys.executable, "-m", "grafu", "edit", *arguments, "--no-browser"]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env={**os.environ})
        assert self.process.stdout is not None
        self.address = self.process.stdout.readline().split()[-1]
        assert self.address.startswith("http://127.0.0.1:")

    def kill(self) -> None:
        self.process.kill()
        self.process.wait()
        assert self.process.stdout is not None
        self.process.stdout.close()


def wait(browser: Chromium, condition: str) -> None:
    end = time.monotonic() + LATE
    while not browser.run(condition):
        assert time.monotonic() < end, f"never came true: {condition}"
        time.sleep(0.1)


def opened(browser: Chromium, server: Server) -> None:
    browser.go(server.address)
    wait(browser, "document.getElementById('stage').className !== ''")
    if browser.run("document.getElementById('stage').className") == "without":
        pytest.skip("no WebGL here")
    settled(browser)


def settled(browser: Chromium, build: int = 1) -> None:
    """Waits until the page shows a build of this number, or a later one, and nothing more is built."""
    wait(browser, f"grafuEditor.shown >= {build} && !grafuEditor.building && !grafuEditor.fetching")


def shown(browser: Chromium) -> int:
    return browser.run("grafuEditor.shown")


def side(browser: Chromium) -> str:
    return browser.run(f"grafuEditor.state.motions[{DOOR!r}]?.side ?? ''")


def place_of(browser: Chromium, part: str) -> tuple[float, float]:
    """Returns where the middle of a part is seen, pixels of the window."""
    x, y = browser.run(
        "((view, part) => {document.querySelector('canvas').scrollIntoView({block: 'center'});"
        "const b = view.canvas.getBoundingClientRect(), [x, y] = view.onScreen(view.itemNamed(part));"
        f"return [b.x + x * b.width, b.y + y * b.height]}})(grafuEditor.view, {part!r})"
    )
    return x, y


def enter(browser: Chromium, field: str, text: str, leave: bool = True) -> None:
    """Types into a field, as by hand, in the place of what it holds; then leaves it."""
    held = "field.scrollIntoView(); field.focus(); field.select()"
    browser.run(f"{{const field = document.querySelector({field!r}); {held}}}")
    browser.ask("Input.insertText", text=text)
    if leave:
        browser.run("document.activeElement.blur()")
