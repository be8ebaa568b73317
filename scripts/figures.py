"""Prints every measured figure of the pages anew: runs the commands that the pages name, and keeps what they print.

    python scripts/figures.py [--list] [--only NAME ...] [--page PAGE ...] [--quick] [--write] [--again] [--jobs 2]

Without a choice all commands run, one after the other (--list states how long each takes). What was printed lies in
build/figures; a command that ended is not run again for the same code and weights (--again), and one that was stopped
goes on where it can. --write puts the figures into docs/figures.json and the pages; without it they are only
compared. --quick shows that the commands work, on few models; its figures are not kept. Real models are those of
GRAFU_MODELS. Exit code 1: a command failed.
"""

import argparse
import os
import shlex
import subprocess
import sys
import time
from collections.abc import Sequence
from hashlib import sha256
from pathlib import Path

from docs import write_pages
from stated.measures import BY_NAME, MEASURES, Measure
from stated.store import ROOT, Stored, load_store, save_store, tables_in

from grafu.completion.session import SHIPPED_WEIGHTS

KEPT = ROOT / "build" / "figures"
NEEDS_MODELS = "{models}"
NEEDS_FIRST = "{first}"
FIRST = f"325e242:{SHIPPED_WEIGHTS.relative_to(ROOT)}"
"""The weights of the first network, as git names them."""


def main() -> int:
    """Runs what is asked for; returns the exit code."""
    options = parse_arguments()
    measures = chosen(options.only, options.page)
    if options.list:
        return say_all(measures)
    failed = []
    for number, measure in enumerate(measures, 1):
        print(f"[{number}/{len(measures)}] {measure.name}: about {measure.minutes} min", file=sys.stderr, flush=True)
        text = printed_by(measure, options.quick, options.again, options.jobs)
        if text is None:
            failed.append(measure.name)
        elif not options.quick:
            compare(measure, text, options.write)
    if options.write:
        write_pages()
    for name in failed:
        print(f"failed: {name}; {KEPT / slug(name) / 'errors.txt'} states why", file=sys.stderr)
    return 1 if failed else 0


def parse_arguments() -> argparse.Namespace:
    """Returns the options of the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--list", action="store_true", help="say what there is, and run nothing")
    parser.add_argument("--only", nargs="+", default=[], metavar="NAME", help="these measures")
    parser.add_argument(
        "--page", nargs="+", default=[], metavar="PAGE", help="the measures of these pages (network.md)"
    )
    parser.add_argument("--quick", action="store_true", help="few models: do the commands work?")
    parser.add_argument("--write", action="store_true", help="keep the figures, and draw the pages with them")
    parser.add_argument("--again", action="store_true", help="also run what ended for the same code")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    unknown = [name for name in options.only if name not in BY_NAME]
    pages = {page for measure in MEASURES for page in measure.pages}
    unknown += [page for page in options.page if page not in pages]
    if unknown:
        parser.error(f"there is no {unknown[0]!r}: expected one of {', '.join([*BY_NAME, *sorted(pages)])}")
    if options.quick and options.write:
        parser.error("--quick measures nothing that could be kept: leave out --write")
    return options


def chosen(names: Sequence[str], pages: Sequence[str]) -> list[Measure]:
    """Returns the measures that are named or stand in the pages; all, quickest first, where nothing is chosen."""
    every = not names and not pages
    found = [m for m in MEASURES if every or m.name in names or set(pages) & set(m.pages)]
    return sorted(found, key=lambda measure: measure.minutes)


def say_all(measures: Sequence[Measure]) -> int:
    """Prints the measures with their commands, and which figures are old."""
    stored = load_store()
    for measure in measures:
        age = age_of(measure, stored.get(measure.name))
        print(f"{measure.name} ({', '.join(measure.pages)}; about {measure.minutes} min; {age})\n    {measure.command}")
    return 0


def age_of(measure: Measure, kept: Stored | None) -> str:
    """Returns in words how old the figures of a measure are."""
    if kept is None:
        return "never printed"
    if kept.carried:
        return "carried over from the page"
    return "of other weights" if measure.weights and kept.weights != weights_name() else "printed"


def printed_by(measure: Measure, quick: bool, again: bool, jobs: int) -> str | None:
    """Returns what a measure's command prints, kept from an earlier run of the same code or new; None if it failed."""
    folder = KEPT / (slug(measure.name) + ("_quick" if quick else ""))
    folder.mkdir(parents=True, exist_ok=True)
    state = state_of_code()
    kept, out = folder / f"printed_{state}.md", folder / f"out_{state}"
    if kept.is_file() and not again:
        return kept.read_text("utf-8")
    began = time.perf_counter()
    command = filled(measure.quick if quick else measure.command, out, jobs)
    print(f"    {shlex.join(command)}", file=sys.stderr, flush=True)
    with (folder / "errors.txt").open("w") as errors:
        done = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=errors, text=True, env=environment())
    print(f"    exit {done.returncode}, {time.perf_counter() - began:.0f} s", file=sys.stderr, flush=True)
    if done.returncode:
        return None
    kept.write_text(measure.read(done.stdout, out), "utf-8")
    return kept.read_text("utf-8")


def filled(command: str, out: Path, jobs: int) -> list[str]:
    """Returns the words of a command, run by this Python.

    Raises:
        SystemExit: if it needs real models and GRAFU_MODELS names none, or weights that git does not have.
    """
    models = os.environ.get("GRAFU_MODELS", "")
    if NEEDS_MODELS in command and not Path(models or "?").is_dir():
        raise SystemExit(f"GRAFU_MODELS must name the folder of real models: got {models!r}")
    first = first_weights() if NEEDS_FIRST in command else ""
    words = [word.format(models=models, out=out, jobs=jobs, first=first) for word in shlex.split(command)]
    starts = {"python": [sys.executable], "grafu": [sys.executable, "-m", "grafu.cli.main"]}
    return [*starts[words[0]], *words[1:]]


def first_weights() -> Path:
    """Returns the file of the first network's weights, from git."""
    path = KEPT / "first.onnx"
    if not path.is_file():
        shown = subprocess.run(["git", "show", FIRST], cwd=ROOT, stdout=subprocess.PIPE, check=False)
        if shown.returncode:
            raise SystemExit(f"git does not have {FIRST}: this needs a clone with its whole history")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(shown.stdout)
    return path


def environment() -> dict[str, str]:
    """Returns the environment of the commands: this code, whatever is installed."""
    paths = (str(ROOT / "src"), os.environ.get("PYTHONPATH", ""))
    return os.environ | {"PYTHONPATH": os.pathsep.join(path for path in paths if path)}


def compare(measure: Measure, text: str, write: bool) -> None:
    """Says what has changed, and keeps it where that is asked for."""
    stored = load_store()
    new = Stored(
        measure.command,
        [] if measure.whole else tables_in(text),
        text.splitlines() if measure.whole else [],
        weights_name() if measure.weights else "",
    )
    old = stored.get(measure.name)
    same = old is not None and (old.tables, old.lines) == (new.tables, new.lines)
    print(f"    {'as it was' if same else 'changed'}", file=sys.stderr, flush=True)
    print(text)
    if write:
        save_store(stored | {measure.name: new})


def weights_name() -> str:
    """Returns the first digits of the sha256 of the weights that ship."""
    return sha256(SHIPPED_WEIGHTS.read_bytes()).hexdigest()[:12]


def state_of_code() -> str:
    """Returns a hash of all that figures may depend on: the package with its weights, and the scripts that judge."""
    digest = sha256()
    judges = [*(ROOT / "scripts").glob("judge_*.py"), *(ROOT / "tests" / "tools").glob("*.py")]
    for path in sorted([*(ROOT / "src").rglob("*.py"), *judges, SHIPPED_WEIGHTS]):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:12]


def slug(name: str) -> str:
    """Returns a measure's name as a folder's."""
    return name.replace(" ", "_")


if __name__ == "__main__":
    sys.exit(main())
