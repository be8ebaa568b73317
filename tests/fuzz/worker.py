"""One process that runs cases, told by lines of JSON; its limits kill it, and the runner then states which case did it.

A case has a folder of its own: `input` with its files, `out` for results, `tmp`, an empty `cwd`, and `outside`, where
files lie that must never be opened.
"""

import faulthandler
import gc
import io
import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import warnings
from contextlib import redirect_stderr, redirect_stdout, suppress
from dataclasses import asdict, dataclass
from importlib import import_module
from pathlib import Path
from typing import Any, final

from fuzz import guard, rules
from fuzz.canary import Canary, put_secrets
from fuzz.entries import write_entries


@final
@dataclass(frozen=True)
class Limits:
    """Seconds of the processor and of the clock that a case may take, and bytes of memory.

    The clock's are many, for other work on the machine takes them too: they end what waits for something for ever.
    """

    processor: float = 10.0
    clock: float = 120.0
    memory: int = 1500 * 2**20


@final
@dataclass(frozen=True)
class Answer:
    """What resulted from a case: `outcome` is a word for the summary, `broken` states which rules it broke."""

    index: int
    case: str
    start: str
    outcome: str
    broken: tuple[str, ...] = ()
    seconds: float = 0.0
    peak: int = 0
    said: str = ""


def main() -> None:
    """Reads a line `{cases, limits, scratch, keep}`, then answers a line `{seed, index, supervised}` at a time."""
    faulthandler.enable()
    told = os.fdopen(os.dup(0), "r")
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    os.dup2(2, 1)
    setup = json.loads(told.readline())
    provider, limits, scratch = import_module(setup["cases"]), Limits(**setup["limits"]), Path(setup["scratch"])
    resource.setrlimit(resource.RLIMIT_AS, (8 * 2**30, resource.RLIM_INFINITY))
    guard.install(scratch)
    for line in told:
        asked = json.loads(line)
        answer = run_case(provider, asked, limits, scratch, setup["keep"])
        answers.write(json.dumps(asdict(answer)) + "\n")
        answers.flush()
    os._exit(0)


def run_case(provider: Any, asked: dict[str, Any], limits: Limits, scratch: Path, keep: bool) -> Answer:
    """Returns what resulted from one case."""
    case = provider.make_case(asked["seed"], asked["index"])
    place = scratch / f"case_{case.index}"
    shutil.rmtree(place, ignore_errors=True)
    try:
        return _run(case, provider.READERS[case.start], limits, place, asked["supervised"])
    finally:
        os.chdir(scratch)
        tempfile.tempdir = None
        if not keep:
            shutil.rmtree(place, ignore_errors=True)


def _run(case: Any, reader: Any, limits: Limits, place: Path, supervised: bool) -> Answer:
    for name in ("input", "out", "tmp", "cwd"):
        (place / name).mkdir(parents=True)
    write_entries(case.files, place / "input")
    put_secrets(place / "outside")
    os.chdir(place / "cwd")
    tempfile.tempdir = str(place / "tmp")
    entry, out = place / "input" / case.entry, place / "out"
    arguments = reader.arguments(entry, out, case.chance()) if case.by_command else []
    before = {name: rules.listing(place / name) for name in ("input", "out", "tmp", "cwd")}
    canary = Canary(place / "outside")
    meant = _meant([str(entry), *arguments])
    held = guard.Guard((place / "input", place / "cwd", *meant), (out, place / "tmp"))
    _reset_peak()
    started = _processor()
    if supervised:
        outcome, said, broken = _supervised(arguments)
    else:
        with _timed(limits), guard.guarded(held):
            outcome, said, broken = _by_command(arguments) if arguments else _by_library(reader, entry, case.chance())
    seconds, peak = _processor() - started, _peak()
    broken += held.broken
    if not held.broken:  # what Python opened is reported already
        heard = [name for name in canary.heard() if not held.may_read(place / "outside" / name)]
        broken += [f"opens outside/{name} by native code" for name in heard]
    canary.close()
    broken += [f"takes {peak / 2**20:.0f} MB of memory"] if peak > limits.memory else []
    done = outcome in ("done", "read")
    for name in ("input", "tmp", "cwd", *(() if done else ("out",))):
        broken += rules.of_change(f"`{name}`", before[name], rules.listing(place / name))
    broken += rules.of_results(out, before["out"]) if done else []
    return Answer(
        case.index, str(case), case.start, "broken" if broken else outcome, tuple(broken), seconds, peak, said[-2000:]
    )


def _meant(named: list[str]) -> list[Path]:
    """Returns where links lead that the user names: these may lead anywhere."""
    return [Path(os.path.realpath(name)) for name in named if os.path.islink(name)]


def _by_library(reader: Any, entry: Path, chance: Any) -> tuple[str, str, list[str]]:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            reader.reads(entry, chance)
        return "read", "", []
    except guard.Refused:
        return "broken", "", []
    except BaseException as error:
        return "refused", str(error), rules.of_exception(error)


def _by_command(arguments: list[str]) -> tuple[str, str, list[str]]:
    from grafu.cli.main import main as command

    said, complained = _Said("strict"), _Said("backslashreplace")
    code: object = None
    try:
        with redirect_stdout(said), redirect_stderr(complained), warnings.catch_warnings():
            warnings.simplefilter("always")
            code = command(arguments)
    except guard.Refused:
        return "broken", "", []
    except SystemExit as error:
        code = error.code
    except BaseException as error:
        return "broken", "", rules.of_exception(error)
    texts = said.text(), complained.text()
    return "done" if code == 0 else "refused", "".join(texts), rules.of_command(code, *texts)


def _supervised(arguments: list[str]) -> tuple[str, str, list[str]]:
    """Runs a command as a user does, in processes of its own, one of which ends the other when its time is up."""
    ended = subprocess.run([sys.executable, "-m", "grafu.cli.main", *arguments], capture_output=True, check=False)
    texts = ended.stdout.decode("utf-8", "replace"), ended.stderr.decode("utf-8", "replace")
    return "done" if ended.returncode == 0 else "refused", "".join(texts), rules.of_command(ended.returncode, *texts)


class _Said(io.TextIOWrapper):
    """What is printed, with the errors of a real stream: characters that UTF-8 has not are none here either."""

    def __init__(self, errors: str) -> None:
        super().__init__(io.BytesIO(), encoding="utf-8", errors=errors, newline="\n", write_through=True)

    def text(self) -> str:
        self.flush()
        return self.buffer.getvalue().decode("utf-8", "replace")  # type: ignore[attr-defined]


class _timed:  # noqa: N801  # used like a function
    """Kills this process when the time inside is up: what native code does cannot be interrupted otherwise."""

    def __init__(self, limits: Limits) -> None:
        self.limits = limits

    def __enter__(self) -> None:
        for wanted in (signal.SIGPROF, signal.SIGALRM):
            signal.signal(wanted, signal.SIG_DFL)
        signal.setitimer(signal.ITIMER_PROF, self.limits.processor)
        signal.setitimer(signal.ITIMER_REAL, self.limits.clock)

    def __exit__(self, *_: object) -> None:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.setitimer(signal.ITIMER_REAL, 0)


def _processor() -> float:
    used = os.times()
    return used.user + used.system


def _reset_peak() -> None:
    gc.collect(1)
    with suppress(OSError):
        Path("/proc/self/clear_refs").write_text("5")


def _peak() -> int:
    """Returns the most memory since the last reset, bytes; where Linux does not say, since the process began."""
    with suppress(OSError, StopIteration):
        lines = Path("/proc/self/status").read_text().splitlines()
        return int(next(line for line in lines if line.startswith("VmHWM")).split()[1]) * 1024
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return most if sys.platform == "darwin" else most * 1024


if __name__ == "__main__":
    main()
