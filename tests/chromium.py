"""A headless Chromium that tests drive through its debugging pipe: nothing to install beside the browser itself."""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
FLAGS = (
    "--headless=new",
    "--remote-debugging-pipe",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--no-sandbox",
    "--no-first-run",
    "--disable-extensions",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-dev-shm-usage",
    "--hide-scrollbars",
    "--mute-audio",
)
PATIENCE = 90.0  # seconds for any one answer: WebGL in software on a busy machine is slow


def chromium_path() -> str | None:
    return next((found for name in NAMES if (found := shutil.which(name))), None)


class Chromium:
    """One browser with one page; messages go over file descriptors 3 and 4, each ended by a zero byte."""

    def __init__(self, path: str) -> None:
        self._profile = tempfile.mkdtemp(prefix="chromium")
        to_browser, self._out = os.pipe()
        self._in, from_browser = os.pipe()
        self._process = self._start(path, to_browser, from_browser)
        os.close(to_browser)
        os.close(from_browser)
        self._rest, self._last, self.events = b"", 0, list[dict[str, Any]]()
        target = self._ask("Target.createTarget", url="about:blank")["targetId"]
        self._session = self._ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.ask(f"{domain}.enable")

    def _start(self, path: str, to_browser: int, from_browser: int) -> "subprocess.Popen[bytes]":
        command = [path, *FLAGS, f"--user-data-dir={self._profile}", "about:blank"]
        shell = 'exec "$@" 3<&$IN 4>&$OUT'  # the browser wants its pipe at these two numbers
        script = shell.replace("$IN", str(to_browser)).replace("$OUT", str(from_browser))
        return subprocess.Popen(
            ["bash", "-c", script, "bash", *command],
            pass_fds=(to_browser, from_browser),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )

    def close(self) -> None:
        with suppress(Exception):
            self._ask("Browser.close")
        with suppress(OSError):
            os.close(self._out)
        try:
            self._process.wait(10)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait(10)
        os.close(self._in)
        shutil.rmtree(self._profile, ignore_errors=True)

    def ask(self, method: str, **params: Any) -> dict[str, Any]:
        return self._ask(method, self._session, **params)

    def open(self, path: Path, size: tuple[int, int] = (1200, 900), dark: bool = False, phone: bool = False) -> None:
        """Opens a file and waits until it is loaded; what was logged before is forgotten."""
        self.ask("Emulation.setDeviceMetricsOverride", width=size[0], height=size[1], deviceScaleFactor=1, mobile=phone)
        scheme = [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]
        self.ask("Emulation.setEmulatedMedia", features=scheme)
        self.ask("Page.navigate", url="about:blank")
        self.events.clear()
        self.ask("Page.navigate", url=path.resolve().as_uri())
        self.wait_for("document.readyState === 'complete' && location.protocol === 'file:'")

    def run(self, script: str) -> Any:
        """Returns the value of an expression; a promise is waited for."""
        answer = self.ask("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise AssertionError(answer["exceptionDetails"])
        return answer["result"].get("value")

    def wait_for(self, condition: str) -> None:
        end = time.monotonic() + PATIENCE
        while not self.run(condition):
            assert time.monotonic() < end, f"never came true: {condition}"
            time.sleep(0.05)

    def screenshot(self, whole: bool = False) -> bytes:
        answer = self.ask("Page.captureScreenshot", format="png", captureBeyondViewport=whole)
        return base64.b64decode(answer["data"])

    def go(self, address: str, size: tuple[int, int] = (1280, 900)) -> None:
        """Opens an address and waits until it is loaded; what was logged before is forgotten."""
        self.ask("Emulation.setDeviceMetricsOverride", width=size[0], height=size[1], deviceScaleFactor=1, mobile=False)
        self.ask("Page.navigate", url="about:blank")
        self.events.clear()
        self.ask("Page.navigate", url=address)
        self.wait_for("document.readyState === 'complete' && location.protocol !== 'about:'")

    def press(self, key: str, code: str = "", control: bool = False) -> None:
        """Presses and lets go of a key."""
        stated = {"key": key, "code": code or key, "modifiers": 2 if control else 0}
        text = {} if control or len(key) > 1 else {"text": key}
        self.ask("Input.dispatchKeyEvent", type="keyDown", **stated, **text)
        self.ask("Input.dispatchKeyEvent", type="keyUp", **stated)

    def drag(self, *places: tuple[float, float]) -> None:
        """Presses the mouse at the first place, moves over the others and lets go; one place is a click."""
        for kind, at in (
            ("mousePressed", places[:1]),
            ("mouseMoved", places[1:]),
            ("mouseReleased", places[-1:]),
        ):
            for x, y in at:
                held = {"button": "left", "buttons": 0 if kind == "mouseReleased" else 1, "clickCount": 1}
                self.ask("Input.dispatchMouseEvent", type=kind, x=x, y=y, **held)

    def complaints(self, *own: str) -> list[str]:
        """Returns errors and warnings of the console, exceptions, and requests for anything but the file itself.

        What begins with one of `own` may be asked for, too.
        """
        self.run("1")
        found = []
        for event in self.events:
            params, method = event.get("params", {}), event.get("method")
            if method == "Runtime.exceptionThrown":
                found.append(json.dumps(params["exceptionDetails"]))
            elif method == "Runtime.consoleAPICalled" and params["type"] in ("error", "warning"):
                found.append(json.dumps(params["args"]))
            elif method == "Log.entryAdded" and params["entry"]["level"] in ("error", "warning"):
                found.append(params["entry"]["text"])
            elif method == "Network.requestWillBeSent":
                url = params["request"]["url"]
                if not url.startswith(("file:", "data:", "blob:", "about:", *own)):
                    found.append(f"a request to {url}")
        return found

    def _ask(self, method: str, session: str | None = None, **params: Any) -> dict[str, Any]:
        self._last += 1
        message = {"id": self._last, "method": method, "params": params}
        if session:
            message["sessionId"] = session
        os.write(self._out, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._next()
            if answer.get("id") == self._last:
                if "error" in answer:
                    raise AssertionError(f"{method}: {answer['error']}")
                return answer["result"]
            self.events.append(answer)

    def _next(self) -> dict[str, Any]:
        while b"\0" not in self._rest:
            ready, _, _ = select.select([self._in], [], [], PATIENCE)
            data = os.read(self._in, 1 << 20) if ready else b""
            if not data:
                raise AssertionError("the browser does not answer")
            self._rest += data
        message, _, self._rest = self._rest.partition(b"\0")
        return json.loads(message)
