"""Processes end together: a worker with its parent, however that ends, and what it started with the worker.

Folders for what is passed between programs are gone when they are closed, and when their process is killed.

Nothing leaves the machine: the telemetry of libraries is switched off.

Ctrl-C and requests to end: what hears them, and when.
"""

import multiprocessing
import os
import shutil
import signal
import sys
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import FrameType
from typing import Final, final

from grafu.processes.limits import descendants


def scratch_folder() -> "tempfile.TemporaryDirectory[str]":
    """Returns a new folder in the system's temporary folder, to be used in a `with`; its name states whose it is."""
    return tempfile.TemporaryDirectory(prefix=_prefix(os.getpid()))


def clear_scratch(process: int) -> None:
    """Removes the folders of a process that was killed."""
    with suppress(OSError):
        for folder in Path(tempfile.gettempdir()).glob(f"{_prefix(process)}*"):
            shutil.rmtree(folder, ignore_errors=True)


def _prefix(process: int) -> str:
    return f"grafu_scratch_{process}_"


_SIGNAL_AT_PARENTS_DEATH: Final = 1  # PR_SET_PDEATHSIG


def end_with_parent(started_by_main_thread: bool = True) -> None:
    """Ends this process, which multiprocessing started, as soon as its parent is gone, even amid native code.

    Linux counts the end of the thread that started it as its parent's: where that was not the main thread, and
    elsewhere, a thread of this process watches instead, which has to wait for native code that blocks all other
    threads.
    """
    parent = multiprocessing.parent_process()
    if parent is None:
        return
    if not (started_by_main_thread and is_killed_with(parent.pid)):
        threading.Thread(target=_watch, daemon=True).start()


def is_killed_with(parent: int | None) -> bool:
    """Has Linux kill this process when its parent, of this id (None: whatever it is), dies; whether it will do so."""
    if sys.platform != "linux":
        return False
    import ctypes

    try:
        answer = ctypes.CDLL(None).prctl(_SIGNAL_AT_PARENTS_DEATH, int(signal.SIGKILL), 0, 0, 0)
    except (OSError, AttributeError):
        return False
    if parent is not None and os.getppid() != parent:  # it died before the system was asked
        os._exit(1)
    return bool(answer == 0)


def started_by_main_thread() -> bool:
    """Whether a process that is started now has a parent that lives as long as this process."""
    return threading.current_thread() is threading.main_thread()


def kill(process: int) -> None:
    """Kills a process and all that it started; those that are gone already are no fault."""
    found = descendants(process)
    for one in (process, *found):
        with suppress(OSError):
            os.kill(one, signal.SIGKILL if sys.platform != "win32" else signal.SIGTERM)


def _watch() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


_SWITCHES = {  # they are read as the libraries are loaded; later it is too late
    "ORT_DISABLE_TELEMETRY": "1",
    "RAY_USAGE_STATS_ENABLED": "0",
    "HF_HUB_DISABLE_TELEMETRY": "1",
}


def keep_private() -> None:
    """Switches off the telemetry of ONNX Runtime, Ray and Hugging Face, for this process and those that it starts.

    To be called before the libraries are imported: as it loads, ONNX Runtime would make a device id and a queue of
    events under the user's cache folder, and ask for its makers' host.
    """
    os.environ.update(_SWITCHES)


@final
class Terminated(KeyboardInterrupt):
    """SIGTERM reached this process; it ends as after Ctrl-C."""


@final
class Requests:
    """Whether this process was asked to end."""

    def __init__(self) -> None:
        self.are_made = False

    def hear(self, _: int, __: FrameType | None) -> None:
        """Takes SIGTERM, as its handler.

        Raises:
            Terminated: always.
        """
        self.are_made = True
        raise Terminated


END_REQUESTS = Requests()
"""Of this process: signals are the process's, too."""


@contextmanager
def end_requests_heard() -> Iterator[Requests]:
    """Makes SIGTERM raise `Terminated` in the main thread; where it is ignored, or heard already, that stays."""
    END_REQUESTS.are_made = False
    if not started_by_main_thread() or signal.getsignal(signal.SIGTERM) is not signal.SIG_DFL:
        yield END_REQUESTS
        return
    signal.signal(signal.SIGTERM, END_REQUESTS.hear)
    try:
        yield END_REQUESTS
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)


@contextmanager
def interrupts_later() -> Iterator[None]:
    """Puts Ctrl-C off; a process that is started meanwhile never hears of it, not even while it imports modules."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def leave_interrupts_to_parent() -> None:
    """Has a worker ignore Ctrl-C, and end at once when it is asked to: its parent states what there is to say."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
