"""Tools of tests about processes: who is there, and whether they end."""

import os
from collections.abc import Iterable
from pathlib import Path
from time import monotonic, sleep

SOON = 300.0
"""Seconds in which even a busy machine starts what a test waits for."""


def is_alive(process: int) -> bool:
    """Whether a process runs; one that is dead and that no one has asked about does not."""
    try:
        os.kill(process, 0)
        stat = Path(f"/proc/{process}/stat").read_text()
    except (ProcessLookupError, FileNotFoundError):
        return False
    return stat.rsplit(")", 1)[1].split()[0] not in "ZX"


def survivors(processes: Iterable[int], seconds: float) -> list[int]:
    """Returns those that still run after so many seconds, or none as soon as all have ended."""
    left, end = list(processes), monotonic() + seconds
    while (left := [one for one in left if is_alive(one)]) and monotonic() < end:
        sleep(0.02)
    return left
