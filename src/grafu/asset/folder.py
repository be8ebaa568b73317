"""Plain meshes: a folder with one mesh file per part, or one OBJ with named groups. It settles no frame.

Sweet Home 3D names what moves in its OBJ groups: `sweethome3d_opening_on_hinge_1_...` turns about the longest extent
of `sweethome3d_hinge_1_...`; `..._on_rail_...` slides along a rail. Those groups become annotated joints.
"""

from collections.abc import Sequence
from pathlib import Path

from grafu.asset.drafts import PartDraft, parts_of_drafts
from grafu.asset.folders import folders_within
from grafu.asset.loose import shell_count
from grafu.asset.mesh_files import MESH_SUFFIXES, read_mesh_file
from grafu.asset.mesh_pieces import MeshFile
from grafu.asset.options import LoadOptions, check_parts
from grafu.asset.reading import Convention, Reading
from grafu.asset.resources import ModelFiles
from grafu.asset.sweethome import is_sweethome, read_sweethome
from grafu.errors import UnsegmentedAsset
from grafu.geometry.appearance import Surface

_DIVIDE = "divide it first, an object for each part (Blender: Edit Mode, P, By Loose Parts), and export it as GLB"


def divide(surfaces: Sequence[Surface]) -> str:
    """Returns what to do about one mesh where parts were expected."""
    shells = shell_count(surfaces)
    return f"--parts loose makes parts of its {shells} shells, or {_DIVIDE}" if shells > 1 else _DIVIDE


def mesh_files_in(folder: Path) -> list[Path]:
    """Returns the mesh files directly in the folder, or, where there are none, in its only mesh subfolder."""
    found = sorted(p for p in folder.iterdir() if p.suffix.lower() in MESH_SUFFIXES and p.is_file())
    if found:
        return found
    inside = [sorted(p for p in sub.iterdir() if p.suffix.lower() in MESH_SUFFIXES) for sub in folders_within(folder)]
    filled = [files for files in inside if files]
    return filled[0] if len(filled) == 1 else []


def read_mesh_folder(folder: Path, options: LoadOptions, files: ModelFiles | None = None) -> Reading:
    """Returns the meshes of a folder, one part per file; a lone OBJ gives its groups instead.

    Raises:
        UnsegmentedAsset: if there is one part only.
        UnreadableAsset: if a file is damaged.
        AssetTooLarge: if there are more files or faces than the limits allow.
    """
    files = files or ModelFiles(folder, options.limits)
    meshes = mesh_files_in(folder)
    if len(meshes) == 1:
        return read_mesh(meshes[0], options, files)
    check_parts(len(meshes), folder, options.limits)
    drafts: list[PartDraft] = []
    notes: list[str] = []
    for path in meshes:
        found = read_mesh_file(path, files, split=False)
        drafts.append(PartDraft(path.stem, found.surfaces, file=path.name))
        notes += found.notes
    parts = parts_of_drafts(drafts)
    return Reading("mesh folder", parts, _convention(meshes), notes=tuple(dict.fromkeys(notes)))


def read_mesh(path: Path, options: LoadOptions, files: ModelFiles | None = None) -> Reading:
    """Returns the groups or objects of one mesh file as parts.

    Raises:
        UnsegmentedAsset: if the file is a single piece.
        UnreadableAsset: if the file is damaged.
    """
    found = read_mesh_file(path, files or ModelFiles(path, options.limits))
    if is_sweethome(found):
        return read_sweethome(path, found)
    filled = [piece for piece in found.pieces if piece.surfaces]
    check_parts(len(filled), path, options.limits)
    if len(filled) == 1 and options.parts != "loose":
        raise UnsegmentedAsset(_one_piece(path, found))
    drafts = [PartDraft(piece.name or path.stem, piece.surfaces, file=path.name) for piece in filled]
    return Reading("mesh file", parts_of_drafts(drafts), _convention([path]), notes=found.notes)


def _one_piece(path: Path, found: MeshFile) -> str:
    kind = "one group" if path.suffix.lower() == ".obj" else "one mesh"
    faces = sum(len(s.mesh.faces) for s in found.surfaces)
    return (
        f"{path} is {kind} of {faces} faces: expected parts (groups in an OBJ, nodes in a GLB, files in a folder); "
        + divide(found.surfaces)
    )


def _convention(files: list[Path]) -> Convention:
    suffix = files[0].suffix.lower()
    usual = "+Y" if suffix == ".obj" else "+Z"
    return Convention(f"habit ({suffix[1:].upper()} files are mostly {usual[1]} up)", usual_up=usual)
