"""The options that say how much time and memory one model may take, and what is said where it takes more."""

import argparse
import math
import re

from grafu.processes.limits import PATIENCE, Ending, ProcessLimits

SECONDS, MEMORY = 120.0, "4G"
NONE = "none"
_UNITS = {"": 1, "K": 10**3, "M": 10**6, "G": 10**9, "T": 10**12}
_SIZE = re.compile(r"(?P<count>\d+(?:\.\d+)?)(?P<unit>[KMGT]?)B?", re.IGNORECASE)
_LEAST = 10**8  # bytes: no model is read with less


def add_limit_options(parser: argparse.ArgumentParser, seconds: float = SECONDS) -> None:
    """Adds --timeout, with so many seconds by default, and --memory."""
    group = parser.add_argument_group("how much one model may take (docs/limits.md)")
    group.add_argument(
        "--timeout",
        type=_seconds,
        default=seconds,
        metavar="SECONDS",
        help=f"time for each model; after {PATIENCE:g} times that it is stopped, or `{NONE}` (default: {seconds:g})",
    )
    group.add_argument(
        "--memory",
        type=_bytes,
        default=MEMORY,
        metavar="SIZE",
        help=f"memory for each model, say 800M or 4G; one that needs more is stopped, or `{NONE}` (default: {MEMORY})",
    )


def limits_of(options: argparse.Namespace) -> ProcessLimits:
    """Returns the limits that the arguments state."""
    return ProcessLimits(options.timeout, options.memory)


def why_stopped(ending: Ending, limits: ProcessLimits) -> str:
    """Returns one line that states why there is no result, and what to do."""
    if ending is Ending.LATE and limits.seconds is not None:
        return (
            f"it was not done after {PATIENCE * limits.seconds:g} s, {PATIENCE:g} times its --timeout, and stopped: "
            "give --timeout more seconds, or simplify the input"
        )
    if ending is Ending.LARGE and limits.memory is not None:
        return too_large(limits)
    if ending is Ending.SET_ASIDE:
        return (
            "it was set aside: its process died each time that it was tried (out of memory, or a crash in a native "
            "library); run it alone, or simplify the input"
        )
    if ending is Ending.LOST:
        return "the machine that it was on was lost each time that it was tried: --resume tries it again"
    return "the process died while working on it (out of memory, or a crash in a native library)"


def too_large(limits: ProcessLimits) -> str:
    """Returns one line that states that a model needed more memory than there was, and what to do."""
    needed = f"more than {size_said(limits.memory)} of memory" if limits.memory else "more memory than there is"
    return f"it needed {needed} and was stopped: give --memory more, or simplify the input"


def size_said(size: int) -> str:
    """Returns a number of bytes as people say it."""
    unit = max((name for name in _UNITS if _UNITS[name] <= size), key=lambda name: _UNITS[name])
    return f"{size / _UNITS[unit]:.3g} {unit}B"


def _seconds(text: str) -> float | None:
    if text.lower() == NONE:
        return None
    try:
        seconds = float(text)
    except ValueError:
        seconds = math.nan
    if not 0.0 < seconds < math.inf:
        raise argparse.ArgumentTypeError(f"must be seconds above 0, or `{NONE}`: got {text!r}")
    return seconds


def _bytes(text: str) -> int | None:
    if text.lower() == NONE:
        return None
    found = _SIZE.fullmatch(text.strip())
    size = int(float(found["count"]) * _UNITS[found["unit"].upper()]) if found else 0
    if size < _LEAST:
        raise argparse.ArgumentTypeError(f"must be at least 100M, say 800M or 4G, or `{NONE}`: got {text!r}")
    return size
