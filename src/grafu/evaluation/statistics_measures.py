"""What is measured on one model: plain numbers by name. It compares nothing and reads no files.

A measure is either a value (one number for the model; of several doors the median) or a tally (how many of how many).
Lengths are fractions of the object's largest side, so that the unknown scale of real models does not matter.
"""

from collections import Counter
from collections.abc import Mapping
from statistics import median
from types import MappingProxyType
from typing import final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.evaluation.statistics_fronts import MeasuredFront, boxes_of, doors_of, drawers_of, lacks_top
from grafu.graph.edges import ends_of
from grafu.graph.edit import without_nodes
from grafu.graph.functional_graph import FunctionalGraph, joined_groups
from grafu.vocabulary import PartLabel

_FLAT = 1e-4  # fraction of the object's largest side under which a part has no thickness: half a millimetre in 5 m
_PANELS = (
    PartLabel.TOP_PANEL,
    PartLabel.SIDE_PANEL,
    PartLabel.BACK_PANEL,
    PartLabel.BOTTOM_PANEL,
    PartLabel.SHELF,
    PartLabel.DIVIDER,
)


@final
@dataclass(frozen=True)
class ModelMeasures:
    """The measures of one model; those that do not apply to it (doors of a bookcase) are absent.

    `tallies` are pairs: how many, of how many.
    """

    name: str
    values: Mapping[str, float]
    tallies: Mapping[str, tuple[int, int]]

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", MappingProxyType(dict(self.values)))
        object.__setattr__(self, "tallies", MappingProxyType(dict(self.tallies)))


def measure_model(asset: Asset, truth: FunctionalGraph) -> ModelMeasures:
    """Returns the measures of an asset as it is given.

    `truth` is its functional graph; nodes that the asset lacks are left out of account. Labels are counted as the asset
    gives them; what is a door, a drawer or a handle is the truth's word.
    """
    given = {part.id for part in asset.parts}
    graph = without_nodes(truth, [n.id for n in truth.nodes if n.id not in given])
    doors, drawers = doors_of(graph), drawers_of(graph)
    extent = asset.extent
    values = {
        **_part_values(asset, graph),
        **_graph_values(graph, extent),
        "doors": float(len(doors)),
        "drawers": float(len(drawers)),
        "movable parts": float(len(doors) + len(drawers)),
        **_front_values("door", doors, extent),
        **_front_values("drawer", drawers, extent),
    }
    return ModelMeasures(asset.name, values, _tallies(asset, graph, doors, drawers))


def _part_values(asset: Asset, graph: FunctionalGraph) -> dict[str, float]:
    low, high = boxes_of(graph.nodes)
    sizes, (width, depth, height) = high - low, asset.box.size
    volumes = sizes.prod(axis=1) / max(float(asset.box.size.prod()), 1e-12)
    values = {
        "parts": float(len(asset.parts)),
        "width / height": float(width / height),
        "depth / width": float(depth / width),
        "part length, median": float(np.median(sizes.max(axis=1)) / asset.extent),
        "part thickness, median": float(np.median(sizes.min(axis=1)) / asset.extent),
        "part volume, median": float(np.median(volumes)),
        "part volume, largest": float(volumes.max()),
        "faces per part, median": float(np.median([len(p.mesh.faces) for p in asset.parts])),
    }
    panels = [p.box.size.min() for p in asset.parts if p.label in _PANELS]
    if panels:
        values["panel thickness, median"] = float(np.median(panels) / asset.extent)
        values["panel thickness, largest / smallest"] = float(max(panels) / max(min(panels), 1e-4 * asset.extent))
    return values | _label_ratios(asset)


def _label_ratios(asset: Asset) -> dict[str, float]:
    """Returns each label's fraction of the labelled parts, and the fraction of parts without a label."""
    labels = Counter(part.label for part in asset.parts)
    lost = labels.pop(PartLabel.UNKNOWN, 0)
    values = {"parts without a label": lost / len(asset.parts)}
    if labels:
        known = [label for label in PartLabel if label is not PartLabel.UNKNOWN]
        values |= {f"label: {label.value}": labels[label] / labels.total() for label in known}
    return values


def _graph_values(graph: FunctionalGraph, extent: float) -> dict[str, float]:
    values = {
        "contacts per node": 2 * len(graph.edges) / len(graph.nodes),
        "connected components": float(len(joined_groups(graph.neighbours))),
    }
    if graph.edges:
        depths = [-float(graph.node(a).box.axis_gaps(graph.node(b).box).max()) for a, b in map(ends_of, graph.edges)]
        overlaps = np.maximum(depths, 0.0) / extent
        values["boxes overlap, median"] = float(np.median(overlaps))
        values["boxes overlap, largest"] = float(overlaps.max())
    return values


def _front_values(word: str, fronts: tuple[MeasuredFront, ...], extent: float) -> dict[str, float]:
    if not fronts:
        return {}
    lists = {
        f"{word} width": [f.width / extent for f in fronts],
        f"{word} height": [f.height / extent for f in fronts],
        f"{word} {'thickness' if word == 'door' else 'depth'}": [f.depth / extent for f in fronts],
        f"{word} height / width": [f.height / f.width for f in fronts if f.width > 0],
        f"{word} handle length / front": [f.handle_ratio for f in fronts if f.handle_ratio is not None],
        f"{word} handle height on front": [f.handle_height for f in fronts if f.handle_height is not None],
        f"{word} handle from pin": [ratio for f in fronts for ratio in f.along[:1]],
    }
    return {name: float(median(numbers)) for name, numbers in lists.items() if numbers}


def _tallies(
    asset: Asset, graph: FunctionalGraph, doors: tuple[MeasuredFront, ...], drawers: tuple[MeasuredFront, ...]
) -> dict[str, tuple[int, int]]:
    fronts = (*doors, *drawers)
    sides = Counter(f.hinge_side for f in doors if f.hinge_side)
    places = Counter(f.handle_place for f in doors if f.handle_place)
    flat = sum(float(p.box.size.min()) < _FLAT * asset.extent for p in asset.parts)
    closed, doubled = zip(*map(_surface, asset.parts), strict=True)
    found = {
        "models without a top": (int(lacks_top(asset, graph)), 1),
        "parts without thickness": (flat, len(asset.parts)),
        "parts with a closed surface": (sum(closed), len(asset.parts)),
        "parts drawn from both sides": (sum(doubled), len(asset.parts)),
    }
    if fronts:
        found["models without handles"] = (int(not any(f.handles for f in fronts)), 1)
        found["movable parts with a handle"] = (sum(bool(f.handles) for f in fronts), len(fronts))
    for side in ("left", "right", "top", "bottom", "lid") if sides else ():
        found[f"hinges: {side}"] = (sides[side], sides.total())
    for place in ("opposite", "centre", "same") if places else ():
        found[f"handles: {place} of the hinge"] = (places[place], places.total())
    return found


def _surface(part: Part) -> tuple[bool, bool]:
    """Returns whether a part is closed, and whether it is drawn twice, once from either side.

    Closed: every edge is shared by two faces that pass it in opposite senses. Corners are merged by place (0.1 µm).
    """
    faces, vertices = part.mesh.faces, part.mesh.vertices
    _, merged = np.unique(np.round(vertices * 1e7).astype(np.int64), axis=0, return_inverse=True)
    corners = merged.reshape(-1)[faces]
    corners = corners[(corners != np.roll(corners, 1, axis=1)).all(axis=1)]  # a face that merging made a line
    if not len(corners):
        return False, False
    ends = np.stack([corners, np.roll(corners, -1, axis=1)], axis=-1).reshape(-1, 2)
    there, back = np.sort(ends @ np.array([len(vertices), 1])), np.sort(ends @ np.array([1, len(vertices)]))
    closed = bool(np.array_equal(there, back)) and bool((np.diff(there) > 0).all())
    _, copies = np.unique(np.sort(corners, axis=1), axis=0, return_counts=True)
    return closed, bool((copies > 1).mean() > 0.5)
