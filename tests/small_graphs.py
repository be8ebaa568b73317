"""A small cabinet as a functional graph, with at least two of every category that a corruption drops."""

import numpy as np

from grafu.geometry.box import Box
from grafu.geometry.sampling import PointCloud
from grafu.graph.edges import Attached, Contact, Edge, Hinge, Rail
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.vocabulary import PartLabel

LABELS = {
    "left": PartLabel.SIDE_PANEL,
    "right": PartLabel.SIDE_PANEL,
    "back": PartLabel.BACK_PANEL,
    "top_1": PartLabel.TOP_PANEL,
    "top_2": PartLabel.TOP_PANEL,
    "bottom_1": PartLabel.BOTTOM_PANEL,
    "bottom_2": PartLabel.BOTTOM_PANEL,
    "shelf_1": PartLabel.SHELF,
    "shelf_2": PartLabel.SHELF,
    "divider_1": PartLabel.DIVIDER,
    "door_1": PartLabel.DOOR,
    "door_2": PartLabel.DOOR,
    "drawer_1": PartLabel.DRAWER,
    "drawer_2": PartLabel.DRAWER,
    "knob_1": PartLabel.HANDLE,
    "knob_2": PartLabel.HANDLE,
    "knob_3": PartLabel.HANDLE,
    "knob_4": PartLabel.HANDLE,
}
FUNCTIONAL: tuple[Edge, ...] = (
    Hinge("left", "door_1", 0, 0),
    Hinge("right", "door_2", 1, 1),
    Rail("left", "drawer_1", 2),
    Rail("right", "drawer_2", 2),
    Attached("door_1", "knob_1"),
    Attached("door_2", "knob_2"),
    Attached("drawer_1", "knob_3"),
    Attached("drawer_2", "knob_4"),
)
CONTACTS = tuple(
    Contact(a, b)
    for a, b in [
        ("left", "back"),
        ("right", "back"),
        ("left", "top_1"),
        ("right", "top_2"),
        ("left", "bottom_1"),
        ("right", "bottom_2"),
        ("left", "shelf_1"),
        ("right", "shelf_2"),
        ("back", "divider_1"),
        ("door_1", "door_2"),
        ("divider_1", "drawer_1"),
        ("shelf_1", "divider_1"),
    ]
)


def cabinet(points: int = 0) -> FunctionalGraph:
    """The cabinet; its parts stand in a row, each with this many points on it."""
    return FunctionalGraph(
        "cabinet", tuple(_node(k, name, points) for k, name in enumerate(LABELS)), FUNCTIONAL + CONTACTS
    )


def _node(place: int, name: str, points: int) -> PartNode:
    low = np.array([0.1 * place, 0.0, 0.0])
    size = np.array([0.08, 0.02, 0.3]) if LABELS[name] is PartLabel.DOOR else np.array([0.08, 0.4, 0.3])
    rng = np.random.default_rng(place)
    cloud = PointCloud(low + size * rng.random((points, 3))) if points else None
    return PartNode(name, LABELS[name], Box(low, low + size), cloud)
