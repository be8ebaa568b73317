"""Whether a file was opened that lies outside the input's folder: native code is heard of only so. Linux alone."""

import ctypes
import os
import struct
import sys
from pathlib import Path
from typing import final

_OPENED, _CHANGED = 0x20, 0x2 | 0x40 | 0x80 | 0x100 | 0x200
_NONBLOCK = 0o4000
_HEADER = struct.calcsize("iIII")
SUFFIXES = (
    *("", ".obj", ".mtl", ".png", ".jpg", ".bin", ".glb", ".gltf", ".stl", ".ply", ".off", ".json", ".npz", ".npy"),
    *(".urdf", ".sdf", ".xml", ".dtd", ".dae"),
)


def put_secrets(folder: Path) -> None:
    """Writes a file of every kind that must never be opened."""
    folder.mkdir()
    for suffix in SUFFIXES:
        (folder / f"secret{suffix}").write_bytes(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n# SECRET\n")


@final
class Canary:
    """Watches one folder; on other systems than Linux it hears nothing."""

    def __init__(self, folder: Path) -> None:
        self._fd = -1
        if sys.platform.startswith("linux"):
            libc = ctypes.CDLL(None, use_errno=True)
            self._fd = libc.inotify_init1(_NONBLOCK)
            libc.inotify_add_watch(self._fd, os.fsencode(folder), _OPENED | _CHANGED)

    def heard(self) -> list[str]:
        """Returns the names of the files that were opened or changed since the last call."""
        if self._fd < 0:
            return []
        try:
            data = os.read(self._fd, 65_536)
        except BlockingIOError:
            return []
        names, at = [], 0
        while at + _HEADER <= len(data):
            *_, length = struct.unpack_from("iIII", data, at)
            name = data[at + _HEADER : at + _HEADER + length].rstrip(b"\0").decode()
            names += [name] if name else []
            at += _HEADER + length
        return names

    def close(self) -> None:
        """Watches no more."""
        if self._fd >= 0:
            os.close(self._fd)
            self._fd = -1
