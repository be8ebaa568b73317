"""Reads OBJ and MTL text back, for tests: as the format states, faces in the order of the file."""

from dataclasses import dataclass, field

import numpy as np


@dataclass
class Obj:
    triangles: np.ndarray
    uv: np.ndarray | None
    normals: np.ndarray | None
    materials: list[str] = field(default_factory=list)  # of each face
    mtllib: str = ""


def parse_obj(text: str) -> Obj:
    rows: dict[str, list] = {"v": [], "vt": [], "vn": []}
    faces, materials, current, mtllib = [], [], "", ""
    for key, *values in (line.split() for line in text.splitlines() if line):
        if key in rows:
            rows[key].append([float(v) for v in values])
        elif key == "usemtl":
            current = values[0]
        elif key == "mtllib":
            mtllib = values[0]
        elif key == "f":
            faces.append([[int(i) - 1 if i else -1 for i in (corner + "//").split("/")[:3]] for corner in values])
            materials.append(current)
    index = np.array(faces)
    points = np.array(rows["v"])[:, :3]
    uv = np.array(rows["vt"])[index[..., 1]] if rows["vt"] else None
    normals = np.array(rows["vn"])[index[..., 2]] if rows["vn"] else None
    return Obj(points[index[..., 0]], uv, normals, materials, mtllib)


def parse_mtl(text: str) -> dict[str, dict[str, list[str]]]:
    materials: dict[str, dict[str, list[str]]] = {}
    for key, *values in (line.split() for line in text.splitlines() if line):
        if key == "newmtl":
            materials[values[0]] = current = {}
        else:
            current[key] = values
    return materials
