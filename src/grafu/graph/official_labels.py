"""The authors' words for parts (their `material`) and our labels, both ways (official.md 2.1 and 4)."""

import re

from grafu.graph.functional_graph import PartNode
from grafu.vocabulary import PartLabel

# The authors list a countertop apart; to the paper's thirteen categories it is a top panel.
_COUNTERTOP = "countertop"


def normalized_material(word: str) -> str:
    """Returns the word as the authors' loader reads it: no Blender suffix, spaces for underscores, lower case."""
    return re.sub(r"\.\d+$", "", word).replace("_", " ").strip().lower()


def material_to_label(word: str) -> PartLabel:
    """Returns the label of an authors' word; `rail`, `hinge` and any other word are unknown."""
    known = normalized_material(word)
    if known == _COUNTERTOP:
        return PartLabel.TOP_PANEL
    return PartLabel(known) if known in tuple(PartLabel) else PartLabel.UNKNOWN


def node_to_material(node: PartNode) -> str:
    """Returns the authors' word for a node; a top panel that was read as a countertop is one again."""
    was_countertop = normalized_material(node.source_name) == _COUNTERTOP
    return _COUNTERTOP if was_countertop and node.label is PartLabel.TOP_PANEL else node.label.value
