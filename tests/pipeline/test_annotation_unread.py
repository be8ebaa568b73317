"""What the input says of its joints is not read unless it is asked for: taken out of the files, all stays the same."""

import json
import os
import re
import shutil
from pathlib import Path

import numpy as np
import pytest

from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.templates.gallery import builtin_gallery
from small_assets import write_pnm, write_urdf

_MODELS = Path(os.environ.get("GRAFU_MODELS") or Path(__file__).parents[3] / "shared" / "models") / "pnm"
REAL = sorted(_MODELS.glob("*")) if _MODELS.is_dir() else []


def stripped(folder: Path, target: Path) -> Path:
    """Copies a PartNet-Mobility folder without the kind, axis and limits of any joint; the links stay what they are."""
    target.mkdir()
    links = json.loads((folder / "mobility_v2.json").read_text())
    for link in links:
        if link["joint"] in ("hinge", "slider"):
            del link["joint"]
        link["jointData"] = {}
    (target / "mobility_v2.json").write_text(json.dumps(links))
    for name in ("result.json", "meta.json"):
        if (folder / name).is_file():
            shutil.copy(folder / name, target / name)
    (target / "textured_objs").symlink_to(folder / "textured_objs")
    return target


def without_motions(file: Path) -> Path:
    """Rewrites a URDF so that it says which links move, but not how."""
    text = re.sub(r'type="(revolute|prismatic|continuous)"', 'type="floating"', file.read_text())
    file.write_text(re.sub(r"<(axis|limit)[^>]*/>", "", text))
    return file


def agree(full: Path, bare: Path) -> None:
    first, second = load_asset(full), load_asset(bare)
    assert first.joints
    assert not second.joints
    first, second = first.without_annotation(), second.without_annotation()
    assert [(p.id, p.label, p.labelled_by) for p in first.parts] == [
        (p.id, p.label, p.labelled_by) for p in second.parts
    ]
    assert first.frame == second.frame
    for a, b in zip(first.parts, second.parts, strict=True):
        np.testing.assert_array_equal(a.mesh.vertices, b.mesh.vertices)


def test_a_folder_without_its_joints_reads_the_same(tmp_path: Path) -> None:
    folder = write_pnm(tmp_path / "full")
    agree(folder, stripped(folder, tmp_path / "bare"))


def test_a_urdf_without_its_motions_reads_the_same(tmp_path: Path) -> None:
    agree(write_urdf(tmp_path / "full"), without_motions(write_urdf(tmp_path / "bare")))


@pytest.mark.parametrize("folder", REAL, ids=lambda p: p.name)
def test_real_folders_without_their_joints_read_the_same(folder: Path, tmp_path: Path) -> None:
    agree(folder, stripped(folder, tmp_path / "bare"))


@pytest.mark.parametrize("labels", ["input", "none"])
@pytest.mark.parametrize("source", [MotionSource.AUTO, MotionSource.RULE])
def test_what_is_built_is_the_same(tmp_path: Path, source: MotionSource, labels: str) -> None:
    folder = write_pnm(tmp_path / "full")
    bare = stripped(folder, tmp_path / "bare")
    options = LoadOptions(labels=labels)
    first, second = (functionalize(load_asset(p, options), source, builtin_gallery()) for p in (folder, bare))

    assert first.completion.completed.edges == second.completion.completed.edges
    assert first.object.joints == second.object.joints
    assert (first.report.installed, first.report.skipped) == (second.report.installed, second.report.skipped)


@pytest.mark.parametrize("folder", REAL[::6], ids=lambda p: p.name)
def test_what_is_built_of_real_folders_is_the_same(folder: Path, tmp_path: Path) -> None:
    bare = stripped(folder, tmp_path / "bare")
    first, second = (functionalize(load_asset(p), MotionSource.AUTO, builtin_gallery()) for p in (folder, bare))

    assert first.object.joints == second.object.joints
    assert first.report.skipped == second.report.skipped
