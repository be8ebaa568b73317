"""Runs cases in processes that may die, gathers what resulted from them, and states it as a table."""

import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import asdict, dataclass, field
from importlib import import_module
from pathlib import Path
from typing import final

from fuzz.worker import Answer, Limits

_PER_WORKER = 1000  # cases after which a process ends: what libraries keep does not add up
_SLOW = "slow"
TESTS = Path(__file__).parent.parent


@final
@dataclass(frozen=True)
class Plan:
    """Which cases are run: `cases` is the module that makes them; `keep` keeps their folders in `scratch`."""

    seed: int
    indices: tuple[int, ...]
    jobs: int = 1
    limits: Limits = field(default_factory=Limits)
    cases: str = "fuzz.cases"
    keep: Path | None = None


def run_cases(plan: Plan, tell: Callable[[Answer], None] = lambda _: None) -> list[Answer]:
    """Returns what resulted from all cases, by index; `tell` hears of each as it ends."""
    waiting, answers, lock = iter(plan.indices), list[Answer](), threading.Lock()
    faults: list[BaseException] = []

    def take() -> int | None:
        with lock:
            return next(waiting, None)

    def work() -> None:
        try:
            with tempfile.TemporaryDirectory(prefix="fuzz-") as scratch:
                for answer in _answers(plan, plan.keep or Path(scratch), take):
                    with lock:
                        answers.append(answer)
                        tell(answer)
        except BaseException as error:  # of the fuzzer itself: the run is worth nothing then
            faults.append(error)

    threads = [threading.Thread(target=work, daemon=True) for _ in range(min(plan.jobs, len(plan.indices)))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if faults:
        raise faults[0]
    return sorted(answers, key=lambda answer: answer.index)


def _answers(plan: Plan, scratch: Path, take: Callable[[], int | None]) -> Iterator[Answer]:
    index = take()
    while index is not None:
        with _Worker(plan, scratch) as worker:
            for _ in range(_PER_WORKER):
                answer = worker.ask(index)
                if answer.outcome == _SLOW:  # here no one stopped the command; as a user runs it, its user must
                    with _Worker(plan, scratch) as another:
                        answer = another.ask(index, supervised=True)
                yield answer
                index = take()
                if index is None or worker.is_dead:
                    break


@final
class _Worker:
    """A process that answers, until it dies."""

    def __init__(self, plan: Plan, scratch: Path) -> None:
        self.plan, self.is_dead = plan, False
        self.log = tempfile.TemporaryFile()  # noqa: SIM115  # closed with the process
        paths = os.pathsep.join([str(TESTS), *(p for p in sys.path if p)])
        environment = {**os.environ, "PYTHONPATH": paths, "PYTHONHASHSEED": "0"}
        command = [sys.executable, "-P", "-m", "fuzz.worker"]
        pipe = subprocess.PIPE
        self.process = subprocess.Popen(
            command, stdin=pipe, stdout=pipe, stderr=self.log, text=True, env=environment, cwd=scratch
        )
        keep = plan.keep is not None
        self._say({"cases": plan.cases, "limits": asdict(plan.limits), "scratch": str(scratch), "keep": keep})

    def __enter__(self) -> "_Worker":
        return self

    def __exit__(self, *_: object) -> None:
        self.process.kill()
        self.process.communicate()
        self.log.close()

    def ask(self, index: int, supervised: bool = False) -> Answer:
        """Returns the answer to a case, also where it killed the process; a command that took too long is `slow`."""
        self._say({"seed": self.plan.seed, "index": index, "supervised": supervised})
        line = self.process.stdout.readline() if self.process.stdout else ""
        if line:
            return Answer(**{**json.loads(line), "broken": tuple(json.loads(line)["broken"])})
        self.is_dead = True
        return self._post_mortem(index)

    def _say(self, what: object) -> None:
        assert self.process.stdin
        try:
            self.process.stdin.write(json.dumps(what) + "\n")
            self.process.stdin.flush()
        except BrokenPipeError:  # it died between two cases: the answer is its death
            pass

    def _post_mortem(self, index: int) -> Answer:
        code, limits = self.process.wait(), self.plan.limits
        self.log.seek(0)
        lines = self.log.read().decode("utf-8", "replace").splitlines()
        tail = " | ".join(lines[-3:])[-600:] if code != -signal.SIGPROF else ""
        deaths = {
            -signal.SIGPROF: f"takes more than {limits.processor:g} s of the processor",
            -signal.SIGALRM: f"waits for more than {limits.clock:g} s",
        }
        name = signal.Signals(-code).name if code < 0 else f"exit code {code}"
        why = deaths.get(code, f"kills the process ({name}): {tail}")
        case = import_module(self.plan.cases).make_case(self.plan.seed, index)
        outcome = _SLOW if code == -signal.SIGPROF and case.by_command else "broken"
        return Answer(index, str(case), case.start, outcome, (why,))


def repeat_line(plan: Plan, answer: Answer) -> str:
    """Returns what to say of a case that broke a rule: the command that runs it again, what it is, and the rules."""
    again = f"make fuzz SEED={plan.seed} CASE={answer.index}"
    return f"{again}   # {answer.case}: {'; '.join(answer.broken)}"


def summary(answers: Iterable[Answer]) -> str:
    """Returns a table of outcomes by kind of starting files."""
    answers = list(answers)
    words = [w for w in ("read", "done", "refused", "broken") if any(a.outcome == w for a in answers)]
    counts = Counter((a.start, a.outcome) for a in answers)
    starts = list(dict.fromkeys(a.start for a in answers))
    rows = [["start", "cases", *words]]
    rows += [[s, sum(counts[s, w] for w in words), *(counts[s, w] for w in words)] for s in starts]
    rows += [["all", len(answers), *(sum(counts[s, w] for s in starts) for w in words)]]
    width = max(len(str(row[0])) for row in rows)
    lines = [f"{row[0]!s:<{width}}" + "".join(f"{cell!s:>9}" for cell in row[1:]) for row in rows]
    slowest, largest = max(answers, key=lambda a: a.seconds), max(answers, key=lambda a: a.peak)
    lines += [f"slowest: case {slowest.index}, {slowest.seconds:.1f} s of the processor ({slowest.case})"]
    return "\n".join([*lines, f"largest: case {largest.index}, {largest.peak / 2**20:.0f} MB ({largest.case})"])
