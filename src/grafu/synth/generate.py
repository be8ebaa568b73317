"""Furniture without end: one specimen for each seed and index, the same for the same two. It writes no files."""

import numpy as np

from grafu.asset.part import Asset
from grafu.graph.edges import Attached, Edge, Hinge, Rail
from grafu.graph.edit import with_edges
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import axis_to_hinge, axis_to_rail
from grafu.graph.parse import ParsingConfig, parse_graph
from grafu.synth.kinds import TIDY
from grafu.synth.specimen import Specimen
from grafu.vocabulary import JointType, PartLabel


def make_specimen(seed: int, index: int, points: int = 512) -> Specimen:
    """Returns the specimen number `index` of the furniture of `seed`, with this many surface points on each node."""
    rng = np.random.default_rng([seed, index])
    kind = str(rng.choice(sorted(TIDY)))
    whole = TIDY[kind]()
    truth = _truth(whole, points, index)
    name = f"synth_{seed}_{index:07d}"
    removable = frozenset(p.id for p in whole.parts if p.label in (PartLabel.HANDLE, PartLabel.TOP_PANEL))
    return Specimen(name, kind, whole.without_annotation(), whole, truth, removable)


def _truth(whole: Asset, points: int, index: int) -> FunctionalGraph:
    graph = parse_graph(whole, ParsingConfig(points=points, seed=index))
    edges: list[Edge] = []
    for joint in whole.joints:
        node = graph.node(joint.part)
        mount = next((i for i in graph.neighbours[node.id] if graph.node(i).label.is_support), None)
        if mount and joint.type is JointType.REVOLUTE:
            edges.append(Hinge(mount, node.id, *axis_to_hinge(node.box, joint.axis)))
        elif mount:
            edges.append(Rail(mount, node.id, axis_to_rail(joint.axis)))
    edges += [Attached(p.rides_on, p.id) for p in whole.parts if p.rides_on]
    return with_edges(graph, edges)
