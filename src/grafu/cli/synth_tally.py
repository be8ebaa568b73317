"""What `synth` prints about a data set when it is done: a row for each family, the sum, and faults."""

from collections import Counter, defaultdict
from pathlib import Path
from statistics import median
from typing import final

from rich.markup import escape
from rich.table import Table

from grafu.cli.terminal import plain_table, wide_console
from grafu.data.write_plan import ModelSummary

_NAMED_FAULTS = 10  # faulty models that are named; the rest is counted


@final
class SynthTally:
    """Counts over the models of a run, family by family; it keeps no model."""

    def __init__(self) -> None:
        self.parts: defaultdict[str, Counter[int]] = defaultdict(Counter)  # how many models have so many parts
        self.movable: Counter[str] = Counter()
        self.defects: defaultdict[str, Counter[str]] = defaultdict(Counter)  # how many models have such a defect
        self.fresh = 0
        self.doubles = 0
        self.faulty: dict[str, tuple[str, ...]] = {}
        self._seen: set[bytes] = set()

    def add(self, summary: ModelSummary) -> None:
        """Counts a model."""
        self.parts[summary.family][summary.given] += 1
        self.movable[summary.family] += summary.movable
        self.defects[summary.family].update(set(summary.defects))
        self.fresh += summary.fresh
        self.doubles += summary.shape in self._seen
        self._seen.add(summary.shape)
        if summary.faults:
            self.faulty[summary.model_id] = summary.faults

    @property
    def models(self) -> int:
        """How many models were counted."""
        return sum(counts.total() for counts in self.parts.values())


def print_tally(tally: SynthTally, seconds: float, out: Path, before: int) -> None:
    """Prints the families and the sum on stdout; `before`: how many models earlier runs had made."""
    console = wide_console()
    if tally.models:
        console.print(_families(tally))
        console.print(_sum(tally), soft_wrap=True, markup=False, highlight=False)
    for line in (*_faults(tally), _made(tally, seconds, before), f"written to {out}"):
        console.print(line, soft_wrap=True, markup=False, highlight=False)


def _families(tally: SynthTally) -> Table:
    table = plain_table("family", "models", "parts", "movable", "defects")
    for family in sorted(tally.parts):
        counts = tally.parts[family]
        models = counts.total()
        movable = f"{tally.movable[family] / models:.1f}"
        table.add_row(escape(family), str(models), _range(counts), movable, _defects(tally.defects[family], models))
    return table


def _sum(tally: SynthTally) -> str:
    every = sum(tally.parts.values(), Counter[int]())
    parts = sum(number * models for number, models in every.items())
    defects = sum(tally.defects.values(), Counter[str]())
    doubles = f", {tally.doubles} of them doubles" if tally.doubles else ", no two alike"
    return (
        f"{tally.models} models{doubles}: {parts} parts ({_range(every)} in each), {tally.movable.total()} doors and "
        f"drawers; with defects: {_defects(defects, tally.models) or 'none'}"
    )


def _faults(tally: SynthTally) -> list[str]:
    named = list(tally.faulty.items())[:_NAMED_FAULTS]
    lines = [f"faulty: {model_id}: {'; '.join(faults)}" for model_id, faults in named]
    return [*lines, f"{len(tally.faulty)} models have faults beyond their defects"] if lines else []


def _made(tally: SynthTally, seconds: float, before: int) -> str:
    if not tally.fresh:
        return f"nothing to make: {before} models are there"
    kept = f"; {before} were there before" if before else ""
    return f"{tally.fresh} made in {seconds:.1f} s: {tally.fresh / seconds:.1f} models per second{kept}"


def _range(counts: Counter[int]) -> str:
    """Returns the least, the median and the largest number."""
    numbers = sorted(counts.elements())
    return f"{numbers[0]} · {median(numbers):.0f} · {numbers[-1]}"


def _defects(counts: Counter[str], models: int) -> str:
    return ", ".join(f"{kind} {number / models:.0%}" for kind, number in sorted(counts.items()))
