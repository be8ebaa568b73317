"""Judges which static parts are built where the completed graph, the geometry or both decide (`--statics`).

    python scripts/judge_statics.py [MODELS...] [--made 40] [--seed 990002] [--jobs 1] [--log FILE]

Tops, handles, backs, bottoms, shelves and dividers are taken from models (half of those of each model, drawn by its
name); synthetic furniture also lacks what it was made without. What is built in their place is right where its category
is that of a missing part and its middle is within a tenth of the largest side, one to one; a handle must be on the same
door or drawer. MODELS are folders as `grafu evaluate --data` takes them. There a part that is built and was not taken
away may well have been missing before, so that the fraction of what is right means little. Prints a table in Markdown.
"""

import argparse
import json
import sys
from collections import Counter
from collections.abc import Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import partial
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import linear_sum_assignment

from grafu.additions.config import AdditionConfig
from grafu.additions.statics import Statics
from grafu.asset.part import Asset, Part
from grafu.evaluation.dataset import ModelRef, find_models, load_model
from grafu.metrics.graph_accuracy import NEAR
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.processes.cache import CACHED_VALUES, Cache
from grafu.synth.generate import make_specimen
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel

TAKEN = 0.5  # of the parts of these categories
LABELS = (
    PartLabel.TOP_PANEL,
    PartLabel.HANDLE,
    PartLabel.BACK_PANEL,
    PartLabel.BOTTOM_PANEL,
    PartLabel.SHELF,
    PartLabel.DIVIDER,
)
MADE, REAL = "synthetic furniture", "real furniture"
Tally = dict[str, list[int]]
"""By category how many are missing, were built, and are right."""


def main() -> int:
    """Judges, and prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", type=Path, nargs="*", help="folders of annotated models")
    parser.add_argument("--made", type=int, default=0, metavar="N", help="pieces of synthetic furniture")
    parser.add_argument("--seed", type=int, default=990_002)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--log", type=Path, help="JSON lines: what was judged before is read from here, the rest added")
    options = parser.parse_args()
    tasks = {f"made {k}": partial(judge_made, options.seed, k) for k in range(options.made)}
    tasks |= {ref.id: partial(judge_real, ref) for folder in options.models for ref in find_models(folder)}
    lines = options.log.read_text().splitlines() if options.log and options.log.exists() else []
    found: dict[str, Any] = dict(map(json.loads, lines))
    with ProcessPoolExecutor(options.jobs) as pool:
        waiting = {name: pool.submit(task) for name, task in tasks.items() if name not in found}
        for name, future in waiting.items():
            found[name] = future.result()
            if options.log:
                with options.log.open("a") as file:
                    file.write(json.dumps([name, found[name]]) + "\n")
            print(f"  {len(found)}/{len(tasks)}", file=sys.stderr, end="\r")
    print(file=sys.stderr)
    made = [found[name] for name in tasks if name.startswith("made ")]
    real = [found[name] for name in tasks if not name.startswith("made ")]
    print("\n\n".join(table(title, ones) for title, ones in ((MADE, made), (REAL, real)) if ones))
    return 0


def judge_made(seed: int, number: int) -> dict[str, Tally]:
    """Returns the counts of one piece of synthetic furniture for each of `Statics`."""
    specimen = make_specimen(seed, number)
    takeable = [p for p in specimen.asset.parts if p.id in specimen.removable]
    taken = drawn(takeable, f"{seed}/{number}")
    lost = [p for p in specimen.whole.parts if p.id in {*specimen.missing, *taken} and p.label in LABELS]
    given = replace(specimen.asset, parts=tuple(p for p in specimen.asset.parts if p.id not in taken))
    return counts(given, lost)


def judge_real(ref: ModelRef) -> dict[str, Tally]:
    """Returns the counts of one real model for each of `Statics`."""
    asset = load_model(ref)
    moving = {joint.part for joint in asset.joints}
    carrying = {part.carried_by for part in asset.parts}
    taken = drawn([p for p in asset.parts if p.id not in moving | carrying], ref.id)
    lost = [p for p in asset.parts if p.id in taken]
    bare = asset.without_annotation()
    return counts(replace(bare, parts=tuple(p for p in bare.parts if p.id not in taken)), lost)


def drawn(parts: Iterable[Part], name: str) -> set[str]:
    """Returns the ids of half of the parts of the categories in question."""
    ids = [part.id for part in parts if part.label in LABELS and len(part.mesh.faces)]
    rng = np.random.default_rng(int.from_bytes(sha256(name.encode()).digest()[:8]))
    return set(rng.permutation(ids)[: round(TAKEN * len(ids))].tolist())


def counts(given: Asset, lost: Sequence[Part]) -> dict[str, Tally]:
    """Returns by `Statics` and category how many parts are missing, were built, and are right."""
    cache, found = Cache(CACHED_VALUES), {}
    for statics in Statics:
        config = PipelineConfig(Settings(additions=AdditionConfig(statics=statics)))
        made = functionalize(given, MotionSource.NETWORK, builtin_gallery(), config, cache=cache)
        added = [addition.part for addition in made.additions if addition.part.label in LABELS]
        found[statics.value] = {
            label.value: [
                sum(part.label is label for part in lost),
                sum(part.label is label for part in added),
                right(added, lost, label, given.extent),
            ]
            for label in LABELS
        }
    return found


def right(added: Sequence[Part], lost: Sequence[Part], label: PartLabel, extent: float) -> int:
    """Returns how many added parts are missing ones of a category, one to one."""
    mine, theirs = ([p for p in parts if p.label is label and len(p.mesh.faces)] for parts in (added, lost))
    if not mine or not theirs:
        return 0
    apart = np.array([[np.linalg.norm(a.box.center - b.box.center) / extent for b in theirs] for a in mine])
    for row, a in enumerate(mine):
        for column, b in enumerate(theirs):
            if label is PartLabel.HANDLE:
                apart[row, column] = 0.0 if a.carried_by == b.carried_by else 1.0
    rows, columns = linear_sum_assignment(np.minimum(apart, 1.0))
    return int((apart[rows, columns] <= NEAR).sum())


def table(title: str, found: Sequence[dict[str, Tally]]) -> str:
    """Returns the F1 of each category and of all, and how many were missing, built and right."""
    head = ["statics", *(label.value for label in LABELS), "all", "missing", "built", "right"]
    lines = [f"{len(found)} pieces of {title}, F1 of static parts that are built:", ""]
    lines += [f"| {' | '.join(head)} |", "|---" * len(head) + "|"]
    for statics in Statics:
        sums: Counter[tuple[str, int]] = Counter()
        for one in found:
            for label, numbers in one[statics.value].items():
                sums.update({(label, k): number for k, number in enumerate(numbers)})
        whole = [sum(sums[label.value, k] for label in LABELS) for k in range(3)]
        each = [[sums[label.value, k] for k in range(3)] for label in LABELS]
        lines.append(f"| {' | '.join([statics.value, *map(f1, [*each, whole]), *map(str, whole)])} |")
    return "\n".join(lines)


def f1(numbers: Sequence[int]) -> str:
    """Returns the F1 of missing, built and right parts, with how many are missing."""
    missing, built, good = numbers
    return f"{2 * good / (missing + built):.2f} ({missing})" if missing + built else "-"


if __name__ == "__main__":
    sys.exit(main())
