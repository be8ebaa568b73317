"""Who decides which static parts are built: the completed graph, the geometry, or both. It builds nothing."""

from enum import StrEnum


class Statics(StrEnum):
    """What proposes tops, handles, backs, bottoms, shelves and dividers that are built by default.

    Geometry always has a say in where they go: what does not fit, or would be a second one, is not built.
    """

    GRAPH = "graph"  # only what the completed graph adds
    GEOMETRY = "geometry"  # only what the tests on meshes find missing
    BOTH = "both"  # what either does
