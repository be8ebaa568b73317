"""Makes and judges many specimens: how many have undeclared faults, how many are alike, how long it takes.

    python scripts/survey.py [--count 10000] [--seed 0] [--jobs 2] [--points 512] [--out survey]

Every specimen is checked (`grafu.synth.truth.check.faults_in`) and hashed: two of the same boxes and labels are
duplicates. The first draw of each is judged as well, before it is made noisy: its faults are why draws are rejected.
Results lie in `--out`, a file for each hundred specimens; a survey that was stopped goes on where it ended. Exit code
1: something is wrong.
"""

import argparse
import json
import sys
import time
from collections import Counter, defaultdict
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass, field
from functools import partial
from hashlib import blake2b
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parent.parent
CHUNK = 100  # specimens in one file: a few seconds' work, so that little is lost when it is stopped
GRAIN = 0.001  # metres: boxes that agree in their millimetres are one


@dataclass(frozen=True)
class Finding:
    """What one specimen is like, and all that is wrong with it."""

    index: int
    family: str = ""
    parts: int = 0
    missing: int = 0
    doors: int = 0
    drawers: int = 0
    defects: list[str] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)
    rejected: list[str] = field(default_factory=list)  # the faults of the first draw
    likeness: str = ""
    seconds: float = 0.0


def main() -> int:
    """Runs the survey; returns the exit code."""
    options = parse_arguments()
    folder = options.out / f"seed_{options.seed}"
    folder.mkdir(parents=True, exist_ok=True)
    starts = [s for s in range(0, options.count, CHUNK) if not file_of(folder, s, options.count).is_file()]
    work = partial(survey_chunk, folder, options.count, options.seed, options.points)
    began = time.perf_counter()
    with ProcessPoolExecutor(options.jobs) as pool:
        for done, _ in enumerate(pool.map(work, starts), 1):
            seconds = time.perf_counter() - began
            print(f"  {done}/{len(starts)} chunks, {seconds:.0f} s", file=sys.stderr, end="\r")
    findings = [f for start in range(0, options.count, CHUNK) for f in read(file_of(folder, start, options.count))]
    text, sound = page(findings)
    (options.out / f"seed_{options.seed}.md").write_text(text)
    print(text)
    return 0 if sound else 1


def parse_arguments() -> argparse.Namespace:
    """Returns the options of the command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--points", type=int, default=512)
    parser.add_argument("--out", type=Path, default=ROOT / "survey")
    options = parser.parse_args()
    if min(options.count, options.jobs) < 1 or min(options.seed, options.points) < 0:
        parser.error("--count and --jobs must be at least 1, --seed and --points not negative")
    return options


def file_of(folder: Path, start: int, count: int) -> Path:
    """Returns the file of the findings from one index on; the last chunk of a count may be shorter than others."""
    return folder / f"{start:07d}_{min(start + CHUNK, count):07d}.json"


def survey_chunk(folder: Path, count: int, seed: int, points: int, start: int) -> None:
    """Surveys the specimens from one index on and writes what was found."""
    findings = [survey_one(seed, index, points) for index in range(start, min(start + CHUNK, count))]
    path = file_of(folder, start, count)
    partly = path.with_suffix(".part")
    partly.write_text(json.dumps([asdict(f) for f in findings]))
    partly.replace(path)


def read(path: Path) -> list[Finding]:
    """Returns the findings of one file."""
    return [Finding(**row) for row in json.loads(path.read_text())]


def survey_one(seed: int, index: int, points: int) -> Finding:
    """Returns what one specimen is like; an exception is a fault of its own."""
    from grafu.synth.families.table import draw_made
    from grafu.synth.generate import make_specimen
    from grafu.synth.repair import repaired
    from grafu.synth.truth.check import faults_in, faults_of

    try:
        started = time.process_time()
        specimen = make_specimen(seed, index, points)
        seconds = time.process_time() - started
        faults = [f"{f.kind}: {', '.join(f.parts)} ({f.detail})" for f in faults_in(specimen)]
        rng = np.random.default_rng([seed, index])
        first, _ = repaired(*draw_made(rng), rng)
        labels = Counter(part.label for part in specimen.whole.parts)
        return Finding(
            index,
            specimen.family,
            len(specimen.whole.parts),
            len(specimen.missing),
            labels["door"],
            labels["drawer"],
            sorted({d.kind for d in specimen.defects}),
            faults,
            sorted({f"{f.kind}: {f.detail}" if f.kind != "collision" else f.kind for f in faults_of(first)}),
            likeness(specimen.truth.nodes),
            round(seconds, 4),
        )
    except Exception as error:  # a survey counts what fails; it does not stop there
        return Finding(index, faults=[f"exception: {type(error).__name__}: {error}"])


def likeness(nodes: Iterable) -> str:
    """Returns a hash of boxes, to the millimetre, and labels, in any order."""
    rows = sorted(
        (n.label.value, *np.round(np.concatenate([n.box.low, n.box.high]) / GRAIN).astype(int)) for n in nodes
    )
    return blake2b(repr([tuple(map(str, row)) for row in rows]).encode(), digest_size=12).hexdigest()


def page(findings: list[Finding]) -> tuple[str, bool]:
    """Returns the report, and whether nothing is wrong."""
    wrong = [f for f in findings if f.faults]
    seen: dict[str, list[int]] = defaultdict(list)
    for finding in findings:
        if finding.likeness:
            seen[finding.likeness].append(finding.index)
    alike = [indices for indices in seen.values() if len(indices) > 1]
    seconds = np.array([f.seconds for f in findings if f.seconds])
    parts = np.array([f.parts for f in findings if f.parts])
    lines = [
        f"# Survey of {len(findings)} specimens\n",
        f"* wrong beyond what they declare: {len(wrong)} ({kinds(f.faults for f in wrong)})",
        f"* duplicates: {sum(len(a) - 1 for a in alike)} {alike[:5] or ''}",
        f"* first draws rejected: {np.mean([bool(f.rejected) for f in findings]):.1%}"
        f" ({kinds(f.rejected for f in findings)})",
        f"* parts: {spread(parts)}; movable {spread(np.array([f.doors + f.drawers for f in findings if f.parts]))}",
        f"* with defects: {kinds(f.defects for f in findings)}",
        f"* seconds of one core: {spread(seconds)}, mean {seconds.mean():.4f}: {1 / seconds.mean():.1f} a second\n",
        families(findings),
        histogram(parts),
        "## Wrong\n",
        *(f"* {f.index} {f.family}: {'; '.join(f.faults)[:300]}" for f in wrong[:60]),
    ]
    return "\n".join(lines) + "\n", not wrong and not alike


def kinds(several: Iterable[list[str]]) -> str:
    """Returns how many specimens have each kind of what is listed, in words."""
    counts = Counter(kind for words in several for kind in {word.split(":")[0] for word in words})
    return ", ".join(f"{kind} {count}" for kind, count in counts.most_common()) or "none"


def spread(values: np.ndarray) -> str:
    """Returns the least, the 5, 50 and 95 per cent points, and the most."""
    if not len(values):
        return "none"
    return " / ".join(f"{v:.4g}" for v in np.percentile(values, [0, 5, 50, 95, 100]))


def families(findings: list[Finding]) -> str:
    """Returns a table of the families: how many, their parts, rejected first draws and why, and seconds."""
    of: dict[str, list[Finding]] = defaultdict(list)
    for finding in findings:
        of[finding.family].append(finding)
    rows = []
    for name, group in sorted(of.items()):
        parts, seconds = np.mean([f.parts for f in group]), np.mean([f.seconds for f in group])
        ratio, why = np.mean([bool(f.rejected) for f in group]), kinds(f.rejected for f in group)
        rows.append(f"| {name} | {len(group)} | {parts:.1f} | {seconds:.4f} | {ratio:.0%} | {why} |")
    return "\n".join(
        ["| family | made | parts | seconds | rejected | because of |", "|---|---|---|---|---|---|", *rows, ""]
    )


def histogram(parts: np.ndarray) -> str:
    """Returns how many specimens have how many parts, in bars."""
    edges = [0, 4, 6, 8, 10, 12, 15, 20, 25, 30, 40, 60, 100, 1000]
    counts, _ = np.histogram(parts, edges)
    bars = [
        f"    {low:4d}..{high - 1:<4d}{count:6d} {'#' * round(60 * count / max(counts.max(), 1))}"
        for low, high, count in zip(edges, edges[1:], counts.tolist(), strict=False)
    ]
    return "\n".join(["Parts:\n", *bars, ""])


if __name__ == "__main__":
    sys.exit(main())
