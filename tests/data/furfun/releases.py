"""Releases built by hand: the graphs and point files of a small cupboard, odd where a test makes them so."""

import copy
import json
from pathlib import Path
from typing import Any

import numpy as np

HALVES = {
    "side_panel_0": ([0.0, 0.0, 0.5], [0.01, 0.2, 0.5]),
    "door_0": ([0.25, -0.2, 0.5], [0.24, 0.01, 0.49]),
    "drawer_0": ([0.25, 0.0, 0.1], [0.2, 0.19, 0.08]),
    "handle_0": ([0.45, -0.22, 0.5], [0.01, 0.01, 0.06]),
}
MOTIONS = [
    {"src": "side_panel_0", "dst": "door_0", "kind": "hinge", "hinge_border_4": 0, "hinge_axis_sign": 0},
    {"src": "side_panel_0", "dst": "drawer_0", "kind": "rail", "rail_axis_signed": 2},
    {"src": "door_0", "dst": "handle_0", "kind": "attached"},
]


def node(name: str) -> dict[str, Any]:
    center, half = HALVES[name]
    obb = {"center": list(center), "half": list(half), "quat": [1.0, 0.0, 0.0, 0.0]}
    return {"id": name, "type": "part", "material": name[:-2].replace("_", " "), "obb": obb}


def functional(model_id: str = "fur_001") -> dict[str, Any]:
    """A functional graph as the authors write it."""
    edges = [{"connector": None, **edge} for edge in copy.deepcopy(MOTIONS)]
    return {"model_id": model_id, "nodes": {name: node(name) for name in HALVES}, "edges": edges}


def unfunctional(model_id: str = "fur_001") -> dict[str, Any]:
    """The same at rest, and without its handle."""
    graph = functional(model_id)
    del graph["nodes"]["handle_0"]
    graph["edges"] = [{"src": e["src"], "dst": e["dst"], "kind": "contact"} for e in graph["edges"][:2]]
    return graph


def put(path: Path, data: Any) -> Path:
    """Writes JSON, text, bytes or points where they belong."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if isinstance(data, np.ndarray):
        np.save(path, data)
    else:
        path.write_bytes(data if isinstance(data, bytes) else json.dumps(data).encode())
    return path


def put_model(root: Path, mid: str = "fur_001", given: Any = None, whole: Any = None) -> Path:
    """Adds a model to a release of the furfun kind and returns the release."""
    put(root / "graphs_unfunctional" / mid / f"{mid}.json", unfunctional(mid) if given is None else given)
    put(root / "graphs_functional" / mid / f"{mid}.json", functional(mid) if whole is None else whole)
    return root
