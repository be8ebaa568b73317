"""What a process may open, list, write and start while a case runs; the first thing beyond that is refused and told.

It hears of all this by an audit hook. What native code opens is not told there: see `canary`.
"""

import os
import stat
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType
from typing import Any, final

_WRITES = {"os.mkdir", "os.rename", "os.remove", "os.rmdir", "os.truncate", "os.chmod", "os.chown", "os.utime"}
_WRITES |= {"os.link", "os.symlink", "os.setxattr", "os.removexattr"}
_READS = {"os.listdir", "os.scandir", "os.chdir", "os.walk", "glob.glob"}
_STARTS = {"subprocess.Popen", "os.system", "os.exec", "os.posix_spawn", "os.spawn", "os.fork", "os.forkpty"}
_NETWORK = {"socket.connect", "socket.bind", "socket.sendto", "socket.getaddrinfo", "socket.gethostbyname"}
_NETWORK |= {"urllib.Request", "http.client.connect", "ftplib.connect", "smtplib.connect", "webbrowser.open"}
_WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
# Which arguments are what is written, and which the folders that these are counted from, where they are open already.
_WRITTEN = {"os.rename": ((0, 2), (1, 3)), "os.link": ((1, 3),), "os.symlink": ((1, 2),), "os.mkdir": ((0, 2),)}
_WRITTEN |= {"os.remove": ((0, 1),), "os.rmdir": ((0, 1),)}
# What Python and its packages read on their own: their files, devices that are no data, what the system is.
_HARMLESS = (
    *("/dev/null", "/dev/urandom", "/proc/cpuinfo", "/proc/meminfo", "/sys", "/etc/mime.types"),
    *("/etc/os-release", "/usr/lib/os-release"),
)
_packages: list[str] = []


class Refused(BaseException):
    """Ends a case that did what none may; no reader catches it by accident."""


@final
@dataclass
class Guard:
    """The folders that a case may read and write, and what it did beyond that."""

    reads: tuple[Path, ...]
    writes: tuple[Path, ...]
    broken: list[str] = field(default_factory=list)

    def may_read(self, place: Path) -> bool:
        """Whether a place lies in the folders that may be read."""
        return _within(str(place), self.reads)

    def check(self, event: str, args: tuple[Any, ...]) -> None:
        """Refuses what is beyond the folders.

        Raises:
            Refused: if it is.
        """
        if event == "open":
            self._open(*args[:3])
        elif event in _WRITES:
            for path, folder in _WRITTEN.get(event, ((0, len(args)),)):
                self._write(_below(args[path], args[folder] if folder < len(args) else -1), event)
        elif event in _READS:
            self._read(args[0], event)
        elif event in _STARTS:
            self._refuse(f"starts a process: {str(args[0])[:200]}")
        elif event in _NETWORK:
            self._refuse(f"asks the network: {str(args)[:200]}")
        elif event == "pickle.find_class":
            self._refuse(f"unpickles {args[0]}.{args[1]}")

    def _open(self, path: Any, mode: Any, flags: Any) -> None:
        if isinstance(flags, int) and flags & _WRITING:
            self._write(path, "opens for writing")
        else:
            self._read(path, "opens")

    def _read(self, path: Any, what: str) -> None:
        place = _place(path)
        if place is None or _within(place, (*self.reads, *self.writes)):
            self._require_plain(place, what)
        elif not _within(place, (*_packages, *_HARMLESS, *_of_this_process())):
            self._refuse(f"{what} outside the input: {place[-300:]}")

    def _write(self, path: Any, what: str) -> None:
        place = _place(path, follow=what == "opens for writing")
        if (
            place is not None
            and not _within(place, self.writes)
            and not place.endswith(".pyc")
            and place != "/dev/null"
        ):
            parent = os.path.dirname(place)
            if not (_within(parent, _packages) and "__pycache__" in place):
                self._refuse(f"{what} outside --out: {place[-300:]}")

    def _require_plain(self, place: str | None, what: str) -> None:
        if place is None or what != "opens":
            return
        try:
            mode = os.stat(place).st_mode
        except (OSError, ValueError):
            return
        if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
            self._refuse(f"opens what is no plain file: {place[-300:]}")

    def _refuse(self, what: str) -> None:
        self.broken.append(f"{what}{_caller()}")
        raise Refused(what)


def _of_this_process() -> tuple[str, ...]:
    """Returns where the system states how much memory this process holds."""
    return f"/proc/{os.getpid()}/statm", f"/proc/{os.getpid()}/status"


def _caller() -> str:
    """Returns where our own code did it, or nothing where it did not."""
    frame: FrameType | None = sys._getframe()
    while frame and "grafu" not in Path(frame.f_code.co_filename).parts:
        frame = frame.f_back
    return f" (in {Path(frame.f_code.co_filename).name}:{frame.f_lineno})" if frame else ""


def _place(path: Any, follow: bool = True) -> str | None:
    """Returns where a path leads to, or None where it is an open file's number or leads nowhere."""
    if not isinstance(path, str | bytes | os.PathLike):
        return None
    try:
        text = os.fsdecode(path)
        if follow:
            return os.path.realpath(text)
        parent, name = os.path.split(os.path.normpath(text))
        return os.path.join(os.path.realpath(parent), name)
    except (ValueError, OSError):
        return None


def _below(path: Any, folder: Any) -> Any:
    """Returns a path that is counted from an open folder as one below it; where the system does not tell, as it is."""
    try:
        below = isinstance(folder, int) and folder >= 0 and not os.path.isabs(os.fsdecode(path))
        return os.path.join(os.readlink(f"/proc/self/fd/{folder}"), os.fsdecode(path)) if below else path
    except (OSError, TypeError, ValueError):
        return path


def _within(place: str, folders: Iterable[Any]) -> bool:
    return any(place == str(folder) or place.startswith(f"{str(folder).rstrip(os.sep)}{os.sep}") for folder in folders)


_current: list[Guard] = []


def _hear(event: str, args: tuple[Any, ...]) -> None:
    if _current:
        guard = _current.pop()  # what the check itself asks the system is not checked
        try:
            guard.check(event, args)
        finally:
            _current.append(guard)


def install(scratch: Path) -> None:
    """Lets this process be heard, for good; what Python's packages are is settled now. Cases lie in `scratch`."""
    places = {os.path.realpath(path) for path in (sys.prefix, sys.base_prefix, *sys.path) if os.path.isdir(path)}
    _packages[:] = [place for place in places if not _within(os.path.realpath(scratch), [place])]
    sys.addaudithook(_hear)


@contextmanager
def guarded(guard: Guard) -> Iterator[Guard]:
    """Holds a guard over what runs inside."""
    _current.append(guard)
    try:
        yield guard
    finally:
        _current.clear()
