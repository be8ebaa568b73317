"""A completed graph as the authors' inference writes one: the input graph, `_pred.json`, and the mesh of each part.

Their Blender add-on reads such files, and so does `--motion grafu-pred:FILE`. Coordinates are the object frame's,
metres: Z up, front -Y.
"""

from typing import Any

from grafu.articulation.articulated_object import ArticulatedObject, VisualRole
from grafu.export.files import ExportFiles
from grafu.export.ply import mesh_to_ply
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import MotionEdge
from grafu.graph.functional_graph import paper_edges
from grafu.graph.official_json import input_to_official, prediction_to_official
from grafu.graph.serialize import dump_json

FOLDER = "prediction"
_MESHES = "part_geometries"


def export_prediction(articulated: ArticulatedObject, completion: GraphCompletion) -> ExportFiles:
    """Returns `prediction/`: the graphs of one model, its parts' meshes as PLY, and the manifest that names them.

    The manifest's paths are relative to its own folder; the authors' are absolute.
    """
    name = completion.input.model_id.replace("/", "_")
    given = {node.id for node in completion.input.nodes}
    visuals = [visual for link in articulated.links_from_root for visual in link.visuals]
    parts = {v.name: v.mesh for v in visuals if v.role is VisualRole.PART and v.name in given and len(v.mesh.faces)}
    texts: dict[str, Any] = {
        f"{name}_pred.json": prediction_to_official(completion),
        f"{name}_input.json": input_to_official(completion.input),
        "inference_manifest.json": {name: {"input": f"{name}_input.json", "mesh_dir": f"{_MESHES}/{name}"}},
    }
    files = {f"{FOLDER}/{file}": dump_json(data).encode() for file, data in texts.items()}
    meshes = {f"{FOLDER}/{_MESHES}/{name}/{part}.ply": mesh_to_ply(mesh) for part, mesh in parts.items()}
    return ExportFiles(files | meshes, notes=_unsaid(completion, f"{name}_pred.json"))


def _unsaid(completion: GraphCompletion, file: str) -> tuple[str, ...]:
    """Returns the note of what the authors' four kinds of edges cannot say; none where they say all."""
    graph = completion.completed
    kept = {edge.child for edge in paper_edges(graph) if isinstance(edge, MotionEdge)}
    lost = sorted({edge.child for edge in graph.edges if isinstance(edge, MotionEdge)} - kept)
    return (f"{file} cannot say how these parts move: {', '.join(lost)}",) if lost else ()
