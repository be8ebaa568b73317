"""Every command that prints figures of the pages. It runs none; `scripts/figures.py` does.

In a command `{models}` is the folder of real models (GRAFU_MODELS), `{first}` the weights of the first network, as git
holds them, `{out}` an empty folder of its own, `{jobs}` the number of processes. `quick` is the same on few models or
steps: it shows that the command works; nothing of it is kept.
"""

import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import final

sys.path.insert(0, str(Path(__file__).parents[1]))

from docs_results import hard_text, hidden_text, motion_text, results_text

Read = Callable[[str, Path], str]


def printed(text: str, _: Path) -> str:
    """Returns what a command printed."""
    return text


def ablation_table(_: str, out: Path) -> str:
    """Returns the table that `grafu ablate` wrote."""
    return (out / "table.md").read_text("utf-8")


def evaluation_tables(_: str, out: Path) -> str:
    """Returns the tables that `grafu evaluate` wrote, as docs/results.md has them."""
    return results_text(out)


def evaluated_motions(_: str, out: Path) -> str:
    """Returns the table of motions that `grafu evaluate` wrote."""
    return motion_text(out)


def hard_model_tables(_: str, out: Path) -> str:
    """Returns the tables that `grafu evaluate` wrote of the harder models, as docs/results.md has them."""
    return hard_text(out)


def hidden_label_table(_: str, out: Path) -> str:
    """Returns the table that `grafu evaluate` wrote of harder models with labels hidden, as docs/results.md has it."""
    return hidden_text(out)


@final
@dataclass(frozen=True)
class Measure:
    """A command, and how the figures are read from what it prints and writes into `{out}`."""

    name: str
    command: str
    quick: str
    states: str
    pages: tuple[str, ...]
    minutes: int  # about, on two cores
    read: Read = printed
    weights: bool = False  # whether the shipped weights matter
    whole: bool = False  # whether a page repeats the text, not cells of tables alone

    def __post_init__(self) -> None:
        if ":" in self.name or not self.pages:
            raise ValueError(f"a measure has a name without a colon, and pages: got {self.name!r}, {self.pages}")


_ABLATE = "grafu ablate {kind} --out {{out}} --steps {steps} --jobs 1"
_LOSSES, _FOLDS = (_ABLATE.format(kind=kind, steps=800) for kind in ("losses", "folds"))
_ON_REAL = " --real {models}/pnm {models}/pnm2"
_FEW = "--config tiny --steps 2 --jobs 2"

MEASURES = (
    Measure(
        "synthetic",
        "python scripts/judge_network.py --count 600 --jobs {jobs}",
        "python scripts/judge_network.py --count 4 --jobs {jobs}",
        "the network on synthetic furniture that was not used in training",
        ("network.md",),
        25,
        weights=True,
    ),
    Measure(
        "synthetic by rules",
        "python scripts/judge_network.py --rule --count 600 --jobs {jobs}",
        "python scripts/judge_network.py --rule --count 4 --jobs {jobs}",
        "the rules on the same furniture",
        ("network.md",),
        5,
    ),
    Measure(
        "motions",
        "python scripts/judge_motions.py {models}/pnm --jobs {jobs}",
        "python scripts/judge_motions.py {models}/pnm --copies 0 --jobs {jobs}",
        "the network on motions of real models, complete and with parts or labels removed",
        ("network.md",),
        2,
        weights=True,
    ),
    Measure(
        "motions by rules",
        "python scripts/judge_motions.py {models}/pnm --rule --jobs {jobs}",
        "python scripts/judge_motions.py {models}/pnm --rule --copies 0 --jobs {jobs}",
        "the rules on the same motions",
        ("network.md",),
        1,
    ),
    Measure(
        "motions of hard models",
        "python scripts/judge_motions.py {models}/pnm2 --jobs {jobs}",
        "python scripts/judge_motions.py {models}/pnm2 --copies 0 --jobs {jobs}",
        "the network on motions of models that were chosen because they are hard",
        ("network.md",),
        4,
        weights=True,
    ),
    Measure(
        "motions of hard models by the first network",
        "python scripts/judge_motions.py {models}/pnm2 --copies 0 --weights {first} --jobs {jobs}",
        "python scripts/judge_motions.py {models}/pnm --copies 0 --weights {first} --jobs {jobs}",
        "the first network on the same motions",
        ("network.md",),
        2,
    ),
    Measure(
        "motions of hard models by rules",
        "python scripts/judge_motions.py {models}/pnm2 --copies 0 --rule --jobs {jobs}",
        "python scripts/judge_motions.py {models}/pnm --copies 0 --rule --jobs {jobs}",
        "the rules on the same motions",
        ("network.md",),
        1,
    ),
    Measure(
        "results",
        "grafu evaluate --data {models}/pnm --out {out} --jobs {jobs}",
        "grafu evaluate --data {models}/pnm/46408 --out {out} --jobs {jobs} --seeds 1",
        "the tables of `grafu evaluate` on real models",
        ("results.md",),
        90,
        read=evaluation_tables,
        weights=True,
        whole=True,
    ),
    Measure(
        "welded",
        "grafu evaluate --data welded:990002:40 --methods annotation,network --tables motion --out {out} --jobs {jobs}",
        "grafu evaluate --data welded:990002:2 --methods annotation,network --tables motion --out {out} --jobs {jobs}",
        "furniture whose parts are welded: what the reader and the network find of its motions",
        ("benchmarks.md",),
        10,
        read=evaluated_motions,
        weights=True,
    ),
    Measure(
        "results of hard models",
        "grafu evaluate --data {models}/pnm {models}/pnm2 --methods network --tables motion,outcomes,static,models,ood "
        "--pictures --out {out} --jobs {jobs}",
        "grafu evaluate --data {models}/pnm/46408 --methods network --tables motion,outcomes,static,models,ood "
        "--out {out} --jobs {jobs}",
        "the tables of `grafu evaluate` on hard models",
        ("results.md",),
        15,
        read=hard_model_tables,
        weights=True,
        whole=True,
    ),
    Measure(
        "hidden labels of hard models",
        "grafu evaluate --data {models}/pnm {models}/pnm2 --methods network --tables motion,masking --pictures "
        "--seeds 5 --out {out} --jobs {jobs}",
        "grafu evaluate --data {models}/pnm/46408 --methods network --tables motion,masking --rates 50 --seeds 1 "
        "--out {out} --jobs {jobs}",
        "motions of hard models where labels are hidden",
        ("results.md",),
        120,
        read=hidden_label_table,
        weights=True,
        whole=True,
    ),
    Measure(
        "statics",
        "python scripts/judge_statics.py {models}/pnm {models}/pnm2 --made 60 --jobs {jobs}",
        "python scripts/judge_statics.py {models}/pnm/46408 --made 2 --jobs {jobs}",
        "static parts that are built where the completed graph, the geometry or both decide",
        ("additions.md",),
        5,
        weights=True,
    ),
    Measure(
        "losses",
        _LOSSES,
        f"grafu ablate losses --out {{out}} {_FEW}",
        "the effect of each loss",
        ("training.md",),
        150,
        read=ablation_table,
    ),
    Measure(
        "folds",
        _FOLDS + _ON_REAL,
        f"grafu ablate folds --out {{out}} {_FEW} --real {{models}}/pnm/46408",
        "the effect of corrupted copies, also on real models",
        ("training.md",),
        25,
        read=ablation_table,
    ),
    Measure(
        "departures",
        "grafu ablate departures --out {out} --seeds 1 2 3 --steps 800 --jobs {jobs}",
        f"grafu ablate departures --out {{out}} {_FEW}",
        "the worth of each departure from the paper",
        ("training.md",),
        170,
        read=ablation_table,
    ),
    Measure(
        "synthetic and real",
        "grafu synth --stats {models}/pnm --count 4000 --jobs {jobs}",
        "grafu synth --stats {models}/pnm --count 20 --jobs {jobs}",
        "statistics of synthetic and real furniture",
        ("synthetic.md",),
        5,
        whole=True,
    ),
    Measure(
        "hinge side",
        "python tests/tools/hinge_side.py --count 1500 --real {models}/pnm",
        "python tests/tools/hinge_side.py --count 100 --real {models}/pnm",
        "a small classifier, trained on synthetic doors, tested on real ones",
        ("synthetic.md",),
        2,
    ),
    Measure(
        "cluster",
        "python scripts/bench_cluster.py --models 40",
        "python scripts/bench_cluster.py --models 3 --workers 1",
        "models an hour by Ray on one machine, and what a million models take",
        ("cluster.md",),
        3,
    ),
    Measure(
        "speed",
        "python scripts/bench.py {models}/pnm {models}/pnm2 {models}/wild --repeats 2 --out {out}",
        "python scripts/bench.py {models}/pnm/46408 --quick --out {out}",
        "seconds, growth, memory and rates, each with its bar, on a machine that does nothing else",
        ("speed.md",),
        25,
        weights=True,
    ),
)
BY_NAME = {measure.name: measure for measure in MEASURES}
