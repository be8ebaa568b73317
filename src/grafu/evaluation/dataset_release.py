"""Models of the authors' releases as assets: the parts' meshes, and joints from the functional graph.

`furfun` states a functional graph for each model; `pnm_clean` and `hssd_test` hold inputs alone, without a truth. What
has points and no meshes cannot be swung. It measures nothing.
"""

from collections.abc import Iterator
from math import pi
from pathlib import Path
from typing import Literal

import numpy as np

from grafu.asset.mesh_files import read_mesh_file
from grafu.asset.names import unique_ids
from grafu.asset.part import AnnotatedJoint, Annotation, Asset, Part, PartSource
from grafu.asset.reading import Convention, Reading
from grafu.asset.resources import ModelFiles
from grafu.asset.settling import settled
from grafu.data.furfun.folder import FurFunFolder
from grafu.data.furfun.graph_files import load_graph_json, read_graph_file
from grafu.data.furfun.layout import FUNCTIONAL, UNFUNCTIONAL, UNFUNCTIONAL_HSSD, LayoutKind, find_layout
from grafu.data.furfun.points import read_ply
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Mat4
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import from_rotation, transform_points
from grafu.graph.edges import Hinge, Rail, Slide
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import hinge_to_axis, rail_to_axis
from grafu.vocabulary import PartLabel

CONVENTION = Convention("the release (Z up)", up="+Z", front="-Y", usual_up="+Z")
DOOR_RANGE = pi / 2  # radians; a graph states no ranges: the authors' records say so for every hinge
DRAWER_RANGE = 0.75  # of a drawer's box along its slide
_FITS = 0.02  # of the object's diagonal: a mesh whose box is farther than this from its graph's is of another frame
_ASSUMED = "its graph states no ranges: doors are taken to open by 90 degrees, drawers by three quarters of their depth"


def release_models(folder: Path, split: str = "") -> Iterator[tuple[str, LayoutKind, Path]]:
    """Gives the id, the kind of release and the input graph of each model; with a `split`, of its test models only.

    Raises:
        AssetError: if the folder is no release, or has no such split.
    """
    layout = find_layout(folder)
    wanted = set(FurFunFolder(folder, points=0, keep_disconnected=True).split(split).test) if split else None
    for model_id, path in layout.inputs.items():
        if wanted is None or model_id in wanted:
            yield model_id, layout.kind, path


def is_release(folder: Path) -> bool:
    """Whether the folder holds the input graphs of a release."""
    return (folder / UNFUNCTIONAL).is_dir() or (folder / UNFUNCTIONAL_HSSD).is_dir()


def read_release_model(input_file: Path) -> Asset:
    """Returns a model by its input graph: a part for each of its nodes that has a mesh, in the object frame.

    Its joints are those of the functional graph, empty where the release has none; pins lie at the border of a door's
    box, as the graph states them.

    Raises:
        AssetError: if a file is missing or damaged, or no part has a mesh.
        GraphError: if a graph is damaged.
    """
    root = next((p for p in input_file.parents[1:3] if is_release(p)), None)
    if root is None:
        raise UnreadableAsset(f"{input_file} lies in no release: expected `{UNFUNCTIONAL}` above it")
    folder = FurFunFolder(root, points=0, keep_disconnected=True)
    model_id = next((k for k, path in folder.layout.inputs.items() if path == input_file), input_file.stem)
    model = folder.model(model_id)
    functional = model.pair.target if model.pair is not None else None
    geometry = _geometry_folder(folder, model_id)
    meshes = _meshes(geometry, model.input)
    if not meshes:
        raise UnreadableAsset(_meshless(geometry, functional is not None))
    T, notes = _frame_of(meshes, model.input)
    parts, ids = _parts(model.input, meshes, T, functional)
    joints = () if functional is None else tuple(_joints(functional, ids))
    silent = f"there is no `{FUNCTIONAL}`: no joint is stated" if functional is None else _ASSUMED
    lost = len(model.input.nodes) - len(parts)
    notes += [f"{lost} of {len(model.input.nodes)} parts have no mesh: left out"] if lost else []
    said = (*(n for n in model.notes if not n.startswith("drew points")), *notes, silent)
    annotation = Annotation(parts, joints) if joints else None
    reading = Reading("release", parts, CONVENTION, annotation, None, said, grouped=True)
    return settled(reading, model_id, input_file).as_annotated()


def _geometry_folder(folder: FurFunFolder, model_id: str) -> Path:
    stated = read_graph_file(folder.layout.inputs[model_id], model_id).geometry_id
    return folder.layout.geometry_of(stated, model_id)


def _meshless(folder: Path, has_truth: bool) -> str:
    can = "labels, edges and motion codes can be compared on its graphs" if has_truth else "it states no motion either"
    return (
        f"{folder} holds no meshes: expected <node>.ply, <node>.obj, or parts.json with objs/; "
        f"without them nothing can be swung ({can})"
    )


def _meshes(folder: Path, graph: FunctionalGraph) -> dict[str, tuple[Surface, ...]]:
    """Returns the surfaces of each node that has a mesh, in the coordinates of its file."""
    listed, files = _listed(folder), ModelFiles(folder)
    found = {}
    for node in graph.nodes:
        if Path(node.id).name != node.id:
            continue  # a node's name is no path: it leads to no file
        named = [listed.get(node.id), folder / f"{node.id}.ply", folder / f"{node.id}.obj"]
        file = next((f for f in named if f is not None and f.is_file()), None)
        surfaces = () if file is None else _surfaces(file, files)
        if surfaces:
            found[node.id] = surfaces
    return found


def _listed(folder: Path) -> dict[str, Path]:
    """Returns the mesh files that `parts.json` names, by node."""
    path = folder / "parts.json"
    if not path.is_file():
        return {}
    entries = load_graph_json(path).get("parts", [])
    rows = [e for e in entries if isinstance(e, dict)] if isinstance(entries, list) else []
    names = {
        str(e.get("id")): Path(str(e.get("obj_file"))).name for e in rows
    }  # a name, never a path out of the folder
    places = {k: [folder / "objs" / name, folder / name] for k, name in names.items()}
    return {k: next((f for f in files if f.is_file()), files[0]) for k, files in places.items()}


def _surfaces(file: Path, files: ModelFiles) -> tuple[Surface, ...]:
    if file.suffix.lower() == ".obj":
        return read_mesh_file(file, files, split=False).surfaces
    mesh = read_ply(files.read(file), str(file), files.tally)
    return (Surface(mesh),) if isinstance(mesh, TriangleMesh) else ()


def _frame_of(meshes: dict[str, tuple[Surface, ...]], graph: FunctionalGraph) -> tuple[Mat4, list[str]]:
    """Returns the quarter turns that lay the meshes into the boxes of the graph, and what is to be said of that.

    Point and PLY files are in the graph's frame; OBJ files may lie Y up, or turned by 180 degrees.
    """
    corners = {k: _around(surfaces).corners() for k, surfaces in meshes.items()}
    boxes = {k: graph.node(k).box for k in meshes}
    size = Box.enclosing(boxes.values()).diagonal
    off = {words: _misfits(corners, boxes, T) for words, T in _TURNS.items()}
    best = min(off, key=lambda words: (round(float(off[words].mean()) / size, 6), list(_TURNS).index(words)))
    strays = int((off[best] > _FITS * size).sum())
    notes = [f"meshes were turned into the frame of the graph: {best}"] if best != _AS_IT_IS else []
    notes += [f"{strays} of {len(meshes)} meshes lie beside the boxes of the graph"] if strays else []
    return _TURNS[best], notes


def _misfits(corners: dict[str, np.ndarray], boxes: dict[str, Box], T: Mat4) -> np.ndarray:
    """Returns how far each turned mesh's box is from its node's, the largest of the six sides."""
    turned = {k: Box.around(transform_points(T, c)) for k, c in corners.items()}
    return np.array(
        [max(np.abs(turned[k].low - b.low).max(), np.abs(turned[k].high - b.high).max()) for k, b in boxes.items()]
    )


def _around(surfaces: tuple[Surface, ...]) -> Box:
    return Box.around(np.vstack([s.mesh.vertices for s in surfaces]))


_AS_IT_IS = "as they are"


def _turns() -> dict[str, Mat4]:
    stood_up = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])  # Y up to Z up
    found = {}
    for quarter in (0, 2, 1, 3):
        c, s = round(np.cos(quarter * pi / 2)), round(np.sin(quarter * pi / 2))
        yaw = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        words = f"yawed by {90 * quarter} degrees" if quarter else ""
        found[words or _AS_IT_IS] = from_rotation(yaw, np.zeros(3))
        found[f"Y up to Z up {words}".strip()] = from_rotation(yaw @ stood_up, np.zeros(3))
    return found


_TURNS = _turns()


def _parts(
    graph: FunctionalGraph, meshes: dict[str, tuple[Surface, ...]], T: Mat4, functional: FunctionalGraph | None
) -> tuple[tuple[Part, ...], dict[str, str]]:
    """Returns the parts in the graph's frame and order, and the id of each by its node."""
    nodes = [node for node in graph.nodes if node.id in meshes]
    ids = dict(zip((n.id for n in nodes), unique_ids((n.id, n.label is PartLabel.HANDLE) for n in nodes), strict=True))
    carried = {} if functional is None else {e.child: e.parent for e in functional.attachments}
    parts = []
    for node in nodes:
        surfaces = tuple(s.transformed(T) for s in meshes[node.id])
        by: Literal["none", "name"] = "none" if node.label is PartLabel.UNKNOWN else "name"
        carrier = ids.get(carried.get(node.id, ""))
        parts.append(Part(ids[node.id], node.label, surfaces, PartSource(node.id), by, carrier))
    return tuple(parts), ids


def _joints(functional: FunctionalGraph, ids: dict[str, str]) -> Iterator[AnnotatedJoint]:
    """Gives the motion of each part that has one, from its first hinge or rail."""
    done: set[str] = set()
    for edge in functional.edges:
        if not isinstance(edge, Hinge | Rail | Slide) or edge.child not in ids or edge.child in done:
            continue
        done.add(edge.child)
        box = functional.node(edge.child).box
        if isinstance(edge, Hinge):
            axis = hinge_to_axis(box, edge.border, edge.sign)
            yield AnnotatedJoint(ids[edge.child], edge.joint_type, axis, 0.0, DOOR_RANGE)
        else:
            travel = DRAWER_RANGE * float(box.size[edge.axis // 2])
            yield AnnotatedJoint(ids[edge.child], edge.joint_type, rail_to_axis(box, edge.axis), 0.0, travel)
