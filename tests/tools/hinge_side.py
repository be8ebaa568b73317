"""A baseline learner: on which side does a door hang? Trained on made doors alone, asked about real ones.

It sees boxes only: where the door is in the object, what stands on its four sides, and, where that is allowed, its
handle. It prints a table in Markdown:

    python tests/tools/hinge_side.py --count 1500 --real MODELS
"""

import argparse
import warnings
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from sklearn.ensemble import HistGradientBoostingClassifier

from grafu.asset.load import load_asset
from grafu.evaluation.statistics_fronts import MeasuredFront, doors_of
from grafu.graph.annotated import annotated_edges
from grafu.graph.edit import with_edges, without_nodes
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.parse import parse_graph
from grafu.synth.generate import make_specimen
from grafu.vocabulary import PartLabel

SIDES = ("left", "right", "top", "bottom")
_FAR = 1.0  # fraction of the object's largest side: there is nothing on this side


@dataclass(frozen=True)
class Door:
    """What is known of one door, and the side that it truly hangs on; `model` names whose it is."""

    model: str
    part: str
    features: np.ndarray
    handle: np.ndarray  # NaN where there is none
    side: str


def doors_in(name: str, graph: FunctionalGraph) -> Iterator[Door]:
    """Yields the doors of a graph that hang on one of the four sides."""
    extent = float(graph.box.size.max())
    for front in doors_of(graph):
        if front.hinge_side in SIDES:
            yield Door(
                name, front.node.id, _surroundings(front, graph, extent), _handle(front, graph), front.hinge_side
            )


def synthetic_doors(count: int, seed: int = 0) -> list[Door]:
    """Returns the doors of `count` specimens as they were modelled: without the parts that they lack."""
    found: list[Door] = []
    for index in range(count):
        specimen = make_specimen(seed, index, 0)
        found += doors_in(specimen.id, without_nodes(specimen.truth, specimen.missing))
    return found


def real_doors(folder: Path) -> list[Door]:
    """Returns the doors of all models in a folder."""
    found: list[Door] = []
    for path in sorted(folder.iterdir()):
        asset = load_asset(path).as_annotated()
        graph = parse_graph(asset)
        found += doors_in(path.name, with_edges(graph, annotated_edges(asset, graph).edges))
    return found


def predictions(train: Iterable[Door], asked: Iterable[Door], with_handles: bool) -> list[str]:
    """Returns the side for each door asked about, learnt from the others."""
    train = list(train)
    learner = HistGradientBoostingClassifier(max_iter=150, learning_rate=0.1, max_leaf_nodes=15, random_state=0)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a feature that no door has is empty, which is no concern here
        learner.fit(_matrix(train, with_handles), [d.side for d in train])
        return [str(side) for side in learner.predict(_matrix(asked, with_handles))]


def accuracy(train: list[Door], asked: list[Door], with_handles: bool) -> float:
    """Returns the fraction of doors whose side is predicted rightly."""
    found = predictions(train, asked, with_handles)
    return float(np.mean([side == door.side for side, door in zip(found, asked, strict=True)]))


def _matrix(doors: Iterable[Door], with_handles: bool) -> np.ndarray:
    return np.array([np.concatenate([d.features, d.handle]) if with_handles else d.features for d in doors])


def _plane(front: MeasuredFront, graph: FunctionalGraph) -> tuple[int, float]:
    """Returns the horizontal axis of the door's plane, and 1 or -1: whether it grows to the right as one sees it."""
    thin = front.node.box.thin_axis
    outward = 1.0 if front.node.box.center[thin] > graph.box.center[thin] else -1.0
    return 1 - thin, -outward if thin == 1 else outward


def _surroundings(front: MeasuredFront, graph: FunctionalGraph, extent: float) -> np.ndarray:
    """Returns the door's place and shape, and for each side how far the next door, drawer and other part is."""
    box, around = front.node.box, graph.box
    across, sign = _plane(front, graph)
    low, high = (box.low - around.low) / around.size, (box.high - around.low) / around.size
    seen = (low[across], high[across]) if sign > 0 else (1 - high[across], 1 - low[across])
    numbers = [*seen, low[2], high[2], front.width / extent, front.height / extent, front.height / front.width]
    numbers += [front.depth / extent, around.size[2] / around.size[0]]
    groups = (
        [n for n in graph.labelled(PartLabel.DOOR) if n.id != front.node.id],
        list(graph.labelled(PartLabel.DRAWER)),
        [n for n in graph.nodes if n.label.is_support],
    )
    for nodes in groups:
        for axis, direction in ((across, -sign), (across, sign), (2, 1.0), (2, -1.0)):
            numbers.append(min((_distance_to(box, n.box, axis, direction, extent) for n in nodes), default=_FAR))
    return np.array(numbers)


def _distance_to(box, other, axis: int, direction: float, extent: float) -> float:
    """Returns how far another box begins beyond one side of a door, where it stands beside it and near its plane."""
    gaps = box.axis_gaps(other)
    beside = [a for a in range(3) if a != axis]
    if max(gaps[a] for a in beside) > 0.02 * extent:
        return _FAR
    middle = (other.center[axis] - box.center[axis]) * direction
    if middle < 0.4 * box.size[axis]:  # it lies before, behind or on the other side
        return _FAR
    return float(gaps[axis] / extent)


def _handle(front: MeasuredFront, graph: FunctionalGraph) -> np.ndarray:
    """Returns where the first handle is on the door as one sees it (0..1 to the right, 0..1 up), and its shape."""
    if not front.handles:
        return np.full(4, np.nan)
    box, handle = front.node.box, front.handles[0]
    across, sign = _plane(front, graph)
    right = (handle.center[across] - box.center[across]) * sign / box.size[across]
    up = (handle.center[2] - box.center[2]) / box.size[2]
    return np.array([right, up, handle.size[across] / box.size[across], handle.size[2] / box.size[2]])


def main() -> None:
    """Prints the accuracy on real doors, with and without handles, and which doors were mistaken."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=2000, help="specimens to learn from")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--real", type=Path, required=True, help="folder of real models")
    options = parser.parse_args()
    train, asked = synthetic_doors(options.count, options.seed), real_doors(options.real)
    common = max(sum(d.side == side for d in asked) for side in SIDES)
    rows = [("always the commonest side", common)]
    for with_handles in (True, False):
        found = predictions(train, asked, with_handles)
        wrong = [f"{d.model}/{d.part} {d.side}, not {s}" for s, d in zip(found, asked, strict=True) if s != d.side]
        rows.append(("with handles" if with_handles else "without handles", len(asked) - len(wrong)))
        print(f"wrong {rows[-1][0]}: {', '.join(wrong) or 'none'}\n")
    print("| of real doors | doors | right | fraction | learnt from |\n|---|---|---|---|---|")
    for name, right in rows:
        print(f"| {name} | {len(asked)} | {right} | {right / len(asked):.0%} | {len(train)} |")


if __name__ == "__main__":
    main()
