"""`make fuzz`: so many cases of a seed, or one of them again."""

import argparse
import os
import sys
import time
from pathlib import Path

from fuzz.runner import Plan, repeat_line, run_cases, summary
from fuzz.worker import Answer


def main() -> int:
    """Runs the cases that the arguments state and returns 1 if one of them broke a rule."""
    parser = argparse.ArgumentParser(prog="make fuzz", description=__doc__)
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--seed", type=int, default=15)
    parser.add_argument("--case", type=int, nargs="*", help="run these cases alone and keep their folders")
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    options = parser.parse_args()
    if options.case:
        keep = Path("out", "fuzz", str(options.seed)).resolve()
        plan = Plan(options.seed, tuple(options.case), keep=_emptied(keep, options.case))
    else:
        plan = Plan(options.seed, tuple(range(options.first, options.first + options.count)), options.jobs)
    progress = _Progress(plan)
    answers = run_cases(plan, progress.tell)
    print(summary(answers))
    for answer in answers if plan.keep else ():
        place = f"{plan.keep}/case_{answer.index}"
        print(f"case {answer.index}: {answer.outcome} in {answer.seconds:.2f} s, {place}; said: {answer.said!r}")
    broken = [answer for answer in answers if answer.broken]
    print(f"{len(answers):,} cases of seed {plan.seed} in {progress.seconds:.0f} s: {len(broken)} broke a rule")
    return 1 if broken else 0


def _emptied(folder: Path, cases: list[int]) -> Path:
    import shutil

    for index in cases:
        shutil.rmtree(folder / f"case_{index}", ignore_errors=True)
    folder.mkdir(parents=True, exist_ok=True)
    return folder


class _Progress:
    """States each case that broke a rule at once, and from time to time how far all are."""

    def __init__(self, plan: Plan) -> None:
        self.plan, self.done, self.broken = plan, 0, 0
        self.started = self.last = time.monotonic()

    @property
    def seconds(self) -> float:
        return time.monotonic() - self.started

    def tell(self, answer: Answer) -> None:
        self.done += 1
        if answer.broken:
            self.broken += 1
            print(repeat_line(self.plan, answer), flush=True)
        if time.monotonic() - self.last > 10:
            self.last = time.monotonic()
            total = len(self.plan.indices)
            print(
                f"{self.done:,} of {total:,} in {self.seconds:.0f} s, {self.broken} broken", file=sys.stderr, flush=True
            )


if __name__ == "__main__":
    sys.exit(main())
