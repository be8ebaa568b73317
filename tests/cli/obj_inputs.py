"""Tiny inputs for the command's tests: boxes as OBJ text, a small cabinet with a door and a drawer."""

from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh

Corners = tuple[tuple[float, float, float], tuple[float, float, float]]

CABINET: dict[str, Corners] = {
    "side_panel_left": ((-0.30, -0.25, 0.0), (-0.28, 0.25, 0.8)),
    "side_panel_right": ((0.28, -0.25, 0.0), (0.30, 0.25, 0.8)),
    "bottom_panel": ((-0.28, -0.25, 0.0), (0.28, 0.25, 0.02)),
    "top_panel": ((-0.30, -0.25, 0.8), (0.30, 0.25, 0.82)),
    "back_panel": ((-0.28, 0.24, 0.02), (0.28, 0.25, 0.8)),
    "divider": ((-0.28, -0.25, 0.5), (0.28, 0.24, 0.52)),
    "door": ((-0.298, -0.27, 0.002), (0.298, -0.25, 0.508)),
    "handle": ((0.24, -0.29, 0.2), (0.26, -0.27, 0.3)),
    "drawer": ((-0.265, -0.27, 0.53), (0.265, 0.2, 0.79)),
}


def obj_text(boxes: Iterable[tuple[str, Corners]]) -> str:
    """Returns an OBJ with one object per named box, in metres, Z up, front -Y; names may repeat."""
    lines, start = [], 1
    for name, (low, high) in boxes:
        mesh = TriangleMesh.box_mesh(Box(np.array(low), np.array(high)))
        lines.append(f"o {name}")
        lines += [f"v {x:g} {y:g} {z:g}" for x, y, z in mesh.vertices]
        lines += [f"f {a} {b} {c}" for a, b, c in mesh.faces + start]
        start += len(mesh.vertices)
    return "\n".join(lines) + "\n"


def write_cabinet(folder: Path, name: str = "cabinet", boxes: Mapping[str, Corners] = CABINET) -> Path:
    """Writes `<name>.obj` and returns its path."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.obj"
    path.write_text(obj_text(boxes.items()), encoding="utf-8")
    return path
