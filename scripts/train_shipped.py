"""Trains the weights that ship once more: the whole chain of runs and means of weights, from the first network on.

    python scripts/train_shipped.py --out runs/shipped [--list] [--quick] [--threads 1] [--jobs 1]

Each run trains on the furniture of its own commit, whose code is checked out under OUT/code; means of weights are taken
by the code here. What is finished lies in OUT and is not made again: the same command goes on after a stop. All runs
take about 23,800 steps of 16 graphs, some seven hours on one core. --list states the commands and runs none; --quick
trains two steps in each run: it shows that the chain works. Needs git, this repository with its history, and torch.
"""

import argparse
import os
import shlex
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import final

from grafu.completion.session import SHIPPED_WEIGHTS

ROOT = Path(__file__).parents[1]
FIRST = "325e242"
"""The commit whose weights are the first network's."""
QUICK_STEPS = 2


@final
@dataclass(frozen=True)
class Run:
    """A run of `grafu train --config tune` on the furniture of a commit, from the weights in the file `start`."""

    seed: int
    commit: str
    start: str
    steps: int

    @property
    def made(self) -> str:
        """The folder that it makes, in OUT."""
        return f"run_{self.seed}"


@final
@dataclass(frozen=True)
class Mean:
    """A mean of weights, calibrated with furniture of this seed: exported files and checkpoints of runs, in OUT.

    With `only_new` the first source gets what it lacks of the last one, and else stays as it is.
    """

    made: str
    sources: tuple[str, ...]
    seed: int
    only_new: bool = False


CHAIN: tuple[Run | Mean, ...] = (
    Run(7, "325e242", "named.onnx", 3600),
    Mean("second.onnx", ("named.onnx", "named.onnx", "run_7/best.pt", "run_7/last.pt"), 7),
    Run(8, "57ea53af", "second.onnx", 4400),
    Mean("third.onnx", ("second.onnx", "run_8/best.pt"), 8),
    Run(9, "a8eb3a13", "third.onnx", 4800),
    Mean("fourth.onnx", ("second.onnx", "run_9/best.pt", "run_9/last.pt"), 9),
    Run(10, "3ac84691", "fourth.onnx", 3600),
    Mean("fifth.onnx", ("fourth.onnx", "fourth.onnx", "fourth.onnx", "run_10/best.pt"), 10),
    Run(11, "6d964bed", "fifth.onnx", 3800),
    Mean("sixth.onnx", ("fifth.onnx", "run_11/best.pt", "run_11/best.pt"), 11),
    Run(12, "449184aa", "sixth.onnx", 3600),
    Mean("grafu.onnx", ("sixth.onnx", "run_12/best.pt"), 12, only_new=True),
)
"""How the weights that ship were made; `named.onnx` are the first network's, with names."""


def main() -> int:
    """Runs what is not made yet; returns the exit code."""
    options = parse_arguments()
    if options.list:
        print("\n".join(shlex.join(words) for _, words in commands(Path("OUT"), options)))
        return 0
    out = options.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    for stage, words in commands(out, options):
        if stage is not None and is_made(out, stage, options.quick):
            continue
        print(shlex.join(words), file=sys.stderr, flush=True)
        code = subprocess.run(words, cwd=ROOT, env=environment(out, stage)).returncode
        if code:
            print(f"failed with exit code {code}; the same command goes on from here", file=sys.stderr)
            return code
    print(f"wrote {out / 'grafu.onnx'}")
    return 0


def parse_arguments() -> argparse.Namespace:
    """Returns the options of the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True, metavar="OUT", help="where runs and weights go")
    parser.add_argument("--list", action="store_true", help="print the commands, run none")
    parser.add_argument("--quick", action="store_true", help="two steps in each run")
    parser.add_argument("--threads", type=int, default=1, help="threads that compute (default: 1)")
    parser.add_argument("--jobs", type=int, default=1, help="processes that make furniture (default: 1)")
    return parser.parse_args()


def commands(out: Path, options: argparse.Namespace) -> Iterator[tuple[Run | Mean | None, Sequence[str]]]:
    """Yields the commands of the chain in order, each with the stage that it makes (None: it prepares)."""
    named = out / "named.onnx"
    if options.list or not named.exists():
        first = out / "first.onnx"
        yield None, ["git", "worktree", "prune"]
        yield None, ["sh", "-c", f"git show {FIRST}:{SHIPPED_WEIGHTS.relative_to(ROOT)} > {shlex.quote(str(first))}"]
        yield None, [sys.executable, "scripts/name_weights.py", str(first), "--out", str(named)]
    for stage in CHAIN:
        if isinstance(stage, Mean):
            sources = [str(out / source) for source in stage.sources]
            script = [sys.executable, "scripts/average_weights.py", *sources]
            how = ["--only-new"] if stage.only_new else []
            yield stage, [*script, *how, "--out", str(out / stage.made), "--seed", str(stage.seed)]
            continue
        code = code_of(out, stage)
        if options.list or not code.exists():
            yield None, ["git", "worktree", "add", "--quiet", "--detach", str(code), stage.commit]
        yield stage, training(out, stage, options)


def training(out: Path, run: Run, options: argparse.Namespace) -> Sequence[str]:
    """Returns the command that begins a run, or goes on with it."""
    steps = QUICK_STEPS if options.quick else run.steps
    begun = (out / run.made / "last.pt").exists()
    how = ["--resume"] if begun else ["--start", str(out / run.start)]
    numbers = {"steps": steps, "seed": run.seed, "threads": options.threads, "jobs": options.jobs}
    words = [sys.executable, "-m", "grafu.cli.main", "train", "--config", "tune", *how, "--out", str(out / run.made)]
    return [*words, *(word for name, number in numbers.items() for word in (f"--{name}", str(number)))]


def is_made(out: Path, stage: Run | Mean, quick: bool) -> bool:
    """Whether a file of weights is there, or a run has done its steps."""
    if isinstance(stage, Mean):
        return (out / stage.made).exists()
    log = out / stage.made / "validation.csv"
    if not log.exists():
        return False
    last = log.read_text("utf-8").splitlines()[-1].split(",")[0]
    return last == str(QUICK_STEPS if quick else stage.steps)


def code_of(out: Path, run: Run) -> Path:
    """Returns where the code of a run's commit is checked out."""
    return out / "code" / run.commit


def environment(out: Path, stage: Run | Mean | None) -> dict[str, str]:
    """Returns the environment in which a stage runs: a run imports the code of its own commit."""
    code = code_of(out, stage) if isinstance(stage, Run) else ROOT
    return os.environ | {"PYTHONPATH": str(code / "src")}


if __name__ == "__main__":
    sys.exit(main())
