"""How long the network takes to complete a graph: features, ONNX and decode together, on one core.

`bench.py` runs it. The graphs are of synthetic furniture of about `PARTS` parts, as found,
and with their labels hidden; points are drawn beforehand.
"""

import time
from dataclasses import dataclass
from itertools import count, islice
from statistics import median

from bench_figure import Figure, Section
from bench_table import measured_table

PARTS = 30
WITHIN = 1  # parts more or fewer
GRAPHS = 12
SEED = 7
MOST = 0.15  # seconds of one completion


@dataclass(frozen=True)
class Completing:
    """Sorted seconds of the processor for each completion, one forward pass, and how many the network had."""

    parts: int
    seconds: list[float]
    forward: float
    passes: float

    @property
    def median(self) -> float:
        """Seconds of the median completion."""
        return median(self.seconds)


def time_completing(parts: int, repeats: int) -> Completing:
    """Returns how long graphs of about so many parts take, after one that only warms up."""
    from grafu.completion.features import GraphFeatures, Scores
    from grafu.completion.network import complete_by_network, forward
    from grafu.completion.session import open_network
    from grafu.data.corruption.corrupt import masked_pair
    from grafu.data.pair import specimen_pair
    from grafu.synth.generate import make_specimen

    network = open_network()
    made = (specimen_pair(make_specimen(SEED, k, network.features.points)) for k in count())
    pairs = list(islice((p for p in made if abs(len(p.input.nodes) - parts) <= WITHIN), GRAPHS))
    graphs = [graph for pair in pairs for graph in (pair.input, masked_pair(pair).input)]
    asked = 0

    def counted(features: GraphFeatures) -> Scores:
        nonlocal asked
        asked += 1
        return network(features)

    complete_by_network(graphs[0], counted, network.features)
    asked, seconds, passes = 0, [], []
    for _ in range(repeats):
        for graph in graphs:
            started = time.process_time()
            complete_by_network(graph, counted, network.features)
            seconds.append(time.process_time() - started)
    had = asked / len(seconds)
    for graph in graphs:
        started = time.process_time()
        forward(graph, network, network.features)
        passes.append(time.process_time() - started)
    return Completing(parts, sorted(round(s, 4) for s in seconds), round(median(passes), 4), round(had, 2))


def completing_section(completing: Completing) -> Section:
    """Returns the time of a completion as a figure, and its table."""
    return Section(
        (Figure("the network completes 30 parts", tuple(completing.seconds), "s", MOST),), completing_table(completing)
    )


def completing_table(completing: Completing) -> str:
    """Returns one table in Markdown."""
    seconds = completing.seconds
    rows = [
        ("milliseconds of one completion", f"{1e3 * completing.median:.0f}"),
        ("least and most", f"{1e3 * seconds[0]:.0f} .. {1e3 * seconds[-1]:.0f}"),
        ("of which one forward pass", f"{1e3 * completing.forward:.0f}"),
        ("forward passes, mean", f"{completing.passes:.1f}"),
    ]
    return measured_table("Completing", f"Graphs of about {completing.parts} parts, by the network.", rows)
