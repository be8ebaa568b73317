"""Synthetic furniture written like the authors' release: graphs, points, meshes, splits.

Models are written one after the other and never held together; the folder appears whole or not at all.
"""

import io
import os
import shutil
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from uuid import uuid4

import numpy as np

from grafu.data.furfun.graph_files import MADE_BY
from grafu.data.furfun.layout import FUNCTIONAL, GEOMETRY, SPLITS, UNFUNCTIONAL
from grafu.data.furfun.split import SPLIT_NAMES, split_models, split_to_json
from grafu.errors import ExportError
from grafu.export.files import ExportFiles
from grafu.export.ply import mesh_to_ply
from grafu.geometry.arrays import Points
from grafu.graph.official_json import functional_to_official, input_to_official
from grafu.graph.serialize import dump_json
from grafu.synth.specimen import Specimen


def furfun_files(specimen: Specimen) -> ExportFiles:
    """Returns the files of one model: its two graphs, and for each part its points (.npy) and its mesh (.ply).

    Numbers are metres in the object frame: six decimals in the graphs, single precision in the rest. Parts that the
    model lacks as it was modelled have files too: they are the answer's.

    Raises:
        ExportError: if an id cannot be a file name.
    """
    name = specimen.id
    target, given = (replace(graph, model_id=name) for graph in (specimen.truth, specimen.given))
    whole = functional_to_official(target, older_labels=True) | dict([MADE_BY])
    files = {
        f"{FUNCTIONAL}/{name}/{name}.json": dump_json(whole).encode(),
        f"{UNFUNCTIONAL}/{name}/{name}.json": dump_json(input_to_official(given)).encode(),
    }
    for node in target.nodes:
        if node.points is not None:
            files[f"{GEOMETRY}/{name}/{node.id}.npy"] = points_to_npy(node.points.points)
        files[f"{GEOMETRY}/{name}/{node.id}.ply"] = mesh_to_ply(specimen.whole.part(node.id).mesh)
    return ExportFiles(files)


def split_files(model_ids: Iterable[str]) -> ExportFiles:
    """Returns the split files of these models, 80/10/10; full and subset are the same: nothing comes from ShapeNet."""
    text = split_to_json(split_models(model_ids)).encode()
    return ExportFiles({f"{SPLITS}/{name}.json": text for name in SPLIT_NAMES})


def write_furfun(specimens: Iterable[Specimen], folder: Path) -> tuple[str, ...]:
    """Writes a release and returns the ids of its models; missing parent folders are made.

    Raises:
        ExportError: if the folder exists and is not empty, cannot be written, an id repeats, or there is no model;
            then nothing is left of it.
    """
    folder = Path(os.path.abspath(folder)).resolve()
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise ExportError(f"the output must be a new or an empty folder: `{folder}` is not")
    fresh = folder.with_name(f".{folder.name}.{uuid4().hex[:8]}.new")
    try:
        fresh.mkdir(parents=True)
        ids = _write_models(specimens, fresh)
        _write(split_files(ids), fresh)
        with suppress(FileNotFoundError):
            folder.rmdir()
        fresh.rename(folder)
    except OSError as error:
        raise ExportError(f"cannot write the output `{folder}`: {error.strerror}; nothing was written") from error
    finally:
        shutil.rmtree(fresh, ignore_errors=True)
    return ids


def points_to_npy(points: Points) -> bytes:
    """Returns points as a .npy file, float32 (M, 3)."""
    buffer = io.BytesIO()
    np.save(buffer, points.astype(np.float32), allow_pickle=False)
    return buffer.getvalue()


def _write_models(specimens: Iterable[Specimen], folder: Path) -> tuple[str, ...]:
    ids: dict[str, None] = {}
    for specimen in specimens:
        if specimen.id in ids:
            raise ExportError(f"models of a release must have different ids: got `{specimen.id}` twice")
        ids[specimen.id] = None
        _write(furfun_files(specimen), folder)
    if not ids:
        raise ExportError(f"a release must hold at least one model: got none for `{folder.parent}`")
    return tuple(ids)


def _write(files: ExportFiles, folder: Path) -> None:
    for name, data in files.contents.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
