"""Processes end together: a worker with its parent, however that ends, and what it started with the worker.

Folders for what is passed between programs are gone when they are closed, and when their process is killed.

Nothing leaves the machine: the telemetry of libraries is switched off.
"""

import multiprocessing
import os
import shutil
import signal
import sys
import tempfile
import threading
from contextlib import suppress
from pathlib import Path
from typing import Final

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


_SWITCH = "ORT_DISABLE_TELEMETRY"  # ONNX Runtime reads it as it is loaded; later it is too late


def keep_private() -> None:
    """Switches off the telemetry of ONNX Runtime, for this process and those that it starts.

    To be called before the library is imported: as it loads, it would make a device id and a queue of events under the
    user's cache folder, and ask for its makers' host.
    """
    os.environ[_SWITCH] = "1"
