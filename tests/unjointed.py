"""The same model without its joints, in the ways in which that comes: left out, made fixed, all bodies merged."""

import json
import re
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.asset.part import Asset
from grafu.asset.resources import ModelFiles
from grafu.asset.urdf import read_bodies
from grafu.geometry.mesh import merge_meshes

_TYPE = re.compile(r"""(<joint\b[^>]*\btype\s*=\s*)(["'])\w+\2""")


def copied(folder: Path, target: Path) -> Path:
    """Returns a copy of a folder whose files can be replaced; a model whose files are links elsewhere is not read."""
    shutil.copytree(folder, target)
    for path in (target, *target.rglob("*")):
        path.chmod(0o755 if path.is_dir() else 0o644)
    return target


def with_fixed_joints(path: Path, target: Path) -> Path:
    """Returns a copy of a model (a folder, or a URDF with what lies beside it) whose every joint is fixed."""
    folder = copied(path if path.is_dir() else path.parent, target)
    for urdf in sorted(folder.rglob("*.urdf")):
        urdf.write_text(_TYPE.sub(r"\1\2fixed\2", urdf.read_text("utf-8-sig")))
    listed = folder / "mobility_v2.json"
    if listed.is_file():
        listed.write_text(json.dumps([{**link, "joint": "heavy", "jointData": {}} for link in _links(listed)]))
    return folder if path.is_dir() else folder / path.name


def without_joints(folder: Path, target: Path) -> Path:
    """Returns a copy of a PartNet-Mobility folder that states that links move, but not how."""

    def bare(link: dict[str, Any]) -> dict[str, Any]:
        moves = link["joint"] in ("hinge", "slider", "slider+")
        return {**{k: v for k, v in link.items() if k != "joint" or not moves}, "jointData": {}}

    return _with_links(folder, target, lambda links: [bare(link) for link in links])


def with_merged_bodies(folder: Path, target: Path) -> Path:
    """Returns a copy of a PartNet-Mobility folder with all parts in one body that is static."""

    def merged(links: list[dict[str, Any]]) -> list[dict[str, Any]]:
        parts = [part for link in links for part in link["parts"]]
        return [{"id": 0, "parent": -1, "joint": "heavy", "name": "body", "parts": parts, "jointData": {}}]

    return _with_links(folder, target, merged)


def as_glb(folder: Path, target: Path) -> Path:
    """Returns a plain GLB of a PartNet-Mobility folder: a node for each of its named pieces, and nothing else."""
    found = read_bodies(folder / "mobility.urdf", ModelFiles(folder), mesh_frame=True)
    pieces: dict[str, list[Any]] = {}
    for visual in found.visuals:
        pieces.setdefault(visual.name, []).extend(s.mesh for s in visual.surfaces if not s.is_empty)
    scene = trimesh.Scene()
    for name, meshes in pieces.items():
        if meshes:
            scene.add_geometry(merge_meshes(meshes).to_trimesh(), node_name=name, geom_name=name)
    scene.export(target)
    return target


def agree(full: Asset, bare: Asset) -> None:
    """Raises AssertionError unless two assets are read as the same parts, in the same frame, with no joints."""
    assert not full.joints
    assert not bare.joints
    assert [told(part) for part in full.parts] == [told(part) for part in bare.parts]
    assert full.frame == bare.frame
    for a, b in zip(full.parts, bare.parts, strict=True):
        np.testing.assert_array_equal(a.mesh.vertices, b.mesh.vertices)
        assert a.surfaces[0].name == b.surfaces[0].name


def told(part: Any) -> tuple[Any, ...]:
    """Returns what is said of a part beside its shape."""
    return (
        part.id,
        part.label,
        part.labelled_by,
        part.source.name,
        part.source.file,
        part.carried_by,
        len(part.surfaces),
    )


def loaded_in_metres(path: Path) -> Asset:
    """Returns the asset at a path, a unit taken for a metre, so that formats can be compared."""
    return load_asset(path, LoadOptions(up="+Y", front="+Z", scale=1.0))


def _with_links(folder: Path, target: Path, change: Callable[[list[dict[str, Any]]], list[dict[str, Any]]]) -> Path:
    copied(folder, target)
    (target / "mobility_v2.json").write_text(json.dumps(change(_links(folder / "mobility_v2.json"))))
    return target


def _links(path: Path) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = json.loads(path.read_text())
    return found
