"""Readers that break each rule on purpose, and some that break none: what the fuzzer must tell apart."""

import ctypes
import os
import pickle
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any
from unittest.mock import patch

from fuzz.case import Case, Reader
from fuzz.entries import Odd
from grafu.errors import OptionError, UnreadableAsset

NAMED = "named.obj"
FILES = {
    "model.obj": b"v 0 0 0\n",
    "out": Odd("link", "../outside"),
    "pipe": Odd("fifo"),
    NAMED: Odd("link", "../outside/secret.obj"),
}
Does = Callable[[Path, Path], Any]


def _end(code: int, complained: str = "", said: str = "") -> int:
    print(said, end="")
    print(complained, end="", file=sys.stderr)
    return code


def _raise(error: BaseException) -> None:
    raise error


def _for_ever() -> None:
    while True:
        pass


def _caught(entry: Path) -> None:
    try:
        (entry.parent / "../outside/secret.obj").read_bytes()
    except BaseException:
        return


def _native(entry: Path) -> None:
    libc = ctypes.CDLL(None)
    libc.close(libc.open(os.fsencode(entry.parent / "../outside/secret.obj"), os.O_RDONLY))


def _made_and_removed(entry: Path, out: Path) -> None:
    (out / "a" / "b").mkdir(parents=True)
    (out / "a" / "b" / "link").symlink_to(entry)
    (out / "a" / "copy").write_bytes(entry.read_bytes())
    (out / "a").rename(out / "c")
    shutil.rmtree(out / "c")


class _Bad:
    def __reduce__(self) -> tuple[object, tuple[str]]:
        return (os.getenv, ("HOME",))


PICKLED = pickle.dumps(_Bad())
LIBRARY: dict[str, Does] = {
    "raises ValueError": lambda entry, out: _raise(ValueError("no")),
    "raises SystemExit": lambda entry, out: sys.exit(3),
    "raises MemoryError": lambda entry, out: bytearray(2**40),
    "an exception states nothing": lambda entry, out: _raise(UnreadableAsset("")),
    "kills the process (SIGABRT)": lambda entry, out: os.abort(),
    "kills the process (SIGKILL)": lambda entry, out: os.kill(os.getpid(), signal.SIGKILL),
    "opens outside the input: /etc/passwd": lambda entry, out: Path("/etc/passwd").read_bytes(),
    "opens outside the input": lambda entry, out: (entry.parent / "out" / "secret.obj").read_bytes(),
    "opens outside the input: /proc/": lambda entry, out: os.open("/proc/self/environ", os.O_RDONLY),
    "secret.obj": lambda entry, out: _caught(entry),
    "os.listdir outside the input": lambda entry, out: os.listdir(entry.parent / ".." / "outside"),
    "opens what is no plain file": lambda entry, out: (entry.parent / "pipe").read_bytes(),
    "by native code": lambda entry, out: _native(entry),
    "opens for writing outside --out": lambda entry, out: entry.with_name("new").write_bytes(b""),
    "os.remove outside --out": lambda entry, out: entry.unlink(),
    "os.rename outside --out": lambda entry, out: entry.rename(out / "model.obj"),
    "os.symlink outside --out": lambda entry, out: os.symlink(out, entry.parent / "y"),
    "os.rmdir outside --out": lambda entry, out: os.rmdir("x", dir_fd=os.open(entry.parent, os.O_RDONLY)),
    "changes `tmp`": lambda entry, out: tempfile.mkstemp(),
    "starts a process": lambda entry, out: subprocess.run(["true"], check=True),
    "asks the network": lambda entry, out: socket.create_connection(("127.0.0.1", 9), 1),
    "unpickles": lambda entry, out: pickle.loads(PICKLED),
}
# What breaks a limit is run with limits of its own: the others are not held to them, however slow the machine.
WITHOUT_END: dict[str, Does] = {
    "takes more than 1 s of the processor": lambda entry, out: _for_ever(),
}
WAITING: dict[str, Does] = {"waits for more than": lambda entry, out: time.sleep(9999)}
LARGE: dict[str, Does] = {"MB of memory": lambda entry, out: len(b"x" * 500_000_000)}
COMMAND: dict[str, Does] = {
    "states 20008 characters": lambda entry, out: _end(2, f"grafu: {'x' * 20_000}\n"),
    "exit code 3": lambda entry, out: _end(3, "grafu: no\n"),
    "exit code 2 with 0 lines": lambda entry, out: _end(2),
    "exit code 2 with 2 lines": lambda entry, out: _end(2, "grafu: no\nand no\n"),
    "exit code 1 with 1 lines": lambda entry, out: _end(1, "no\n"),
    "states 'internal error'": lambda entry, out: _end(1, "grafu: internal error in x\n"),
    "states 'Traceback'": lambda entry, out: _end(0, "Traceback (most recent call last):\n"),
    "states 'Warning:'": lambda entry, out: __import__("warnings").warn("odd", stacklevel=1) or 0,
    "states 'out of memory'": lambda entry, out: _end(2, "grafu: out of memory\n"),
    "opens outside the input: ": lambda entry, out: len((entry.parent / "out" / "secret.mtl").read_bytes()),
    "prints control characters": lambda entry, out: _end(0, "", "\x1b[31mred\n"),
    "raises UnicodeEncodeError": lambda entry, out: _end(0, "", "\ud800"),
    "changes `out`": lambda entry, out: (out / "half").write_bytes(b"x") and _end(2, "grafu: no\n"),
    "writes report.json, which is damaged": lambda entry, out: (out / "report.json").write_text("[NaN]") and 0,
    "writes model.urdf, which is damaged": lambda entry, out: (out / "model.urdf").write_text("<a>\x1b</a>") and 0,
}
INNOCENT: dict[str, Does] = {
    "read": lambda entry, out: _made_and_removed(entry, out),
    "refused": lambda entry, out: _raise(OptionError("give another")),
}
INNOCENT_COMMANDS: dict[str, Does] = {
    "done": lambda entry, out: (out / "report.json").write_text("[1]") and _end(0, "", "all is well\n"),
    "refused": lambda entry, out: _end(2, "grafu: give another\n"),
    "done by a link": lambda entry, out: _end(0, "", (entry.parent / NAMED).read_text()),
}


def _reader(does: Does) -> Reader:
    return Reader(lambda entry, _: does(entry, entry.parent.parent / "out"))


def _command(does: Does) -> Reader:
    def arguments(entry: Path, out: Path, chance: Random) -> list[str]:
        patch("grafu.cli.main.main", lambda _: does(entry, out)).start()
        return ["x", str(entry.with_name(NAMED))]

    return Reader(lambda entry, _: None, arguments)


PLANTED: list[tuple[str, bool, Reader]] = [
    *((name, False, _reader(does)) for name, does in LIBRARY.items()),
    *((name, False, _reader(does)) for name, does in {**WITHOUT_END, **WAITING, **LARGE}.items()),
    *((name, True, _command(does)) for name, does in COMMAND.items()),
    *((f"innocent: {name}", False, _reader(does)) for name, does in INNOCENT.items()),
    *((f"innocent: {name}", True, _command(does)) for name, does in INNOCENT_COMMANDS.items()),
]
READERS = {f"{name}, {by_command}": reader for name, by_command, reader in PLANTED}


def make_case(seed: int, index: int) -> Case:
    """Returns the case of a planted reader."""
    name, by_command, _ = PLANTED[index]
    return Case(seed, index, f"{name}, {by_command}", (), FILES, "model.obj", by_command)
