"""A result never is an input, and never holds one, whatever way leads there."""

import os
from pathlib import Path

import pytest

from grafu.export.apart import why_not_apart


@pytest.fixture
def models(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "models" / "cab" / "meshes").mkdir(parents=True)
    (tmp_path / "models" / "cab" / "cab.urdf").write_text("<robot/>")
    monkeypatch.chdir(tmp_path)
    return tmp_path / "models"


@pytest.mark.parametrize("given", ["models/cab", "models/cab/cab.urdf", "models/cab/meshes", "models/../models/cab"])
@pytest.mark.parametrize("result", ["models/cab", "models", ".", "models/cab/meshes/.."])
def test_an_input_inside_is_found(models: Path, given: str, result: str) -> None:
    assert "choose another --out" in why_not_apart(Path(result), [Path(given)])
    assert "choose another --out" in why_not_apart(Path(result).absolute(), [Path("gone.glb"), Path(given)])


@pytest.mark.parametrize("result", ["models/cab/out", "models/cab/meshes", "models/other", "out/cab", "models/cabin"])
def test_results_beside_and_below_are_apart(models: Path, result: str) -> None:
    (models.parent / "models/cabin").mkdir()

    assert why_not_apart(Path(result), [Path("models/cab"), Path("models/cab/cab.urdf")]) == ""


def test_links_are_followed_both_ways(models: Path) -> None:
    os.symlink(models, "link")
    os.symlink(models / "cab" / "cab.urdf", "by_link.urdf")
    (models / "out").mkdir()
    os.symlink(models.parent / "elsewhere.glb", models / "out" / "in.glb")
    Path("elsewhere.glb").write_bytes(b"")

    assert why_not_apart(Path("link/cab"), [Path("models/cab")])
    assert why_not_apart(Path("models/cab"), [Path("link/cab/cab.urdf")])
    assert why_not_apart(Path("models/cab"), [Path("by_link.urdf")])
    assert why_not_apart(Path("models/out"), [Path("models/out/in.glb")])  # the link would go
    assert not why_not_apart(Path("models/out"), [Path("elsewhere.glb")])


def test_places_are_compared_as_the_disk_knows_them(models: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    real = os.path.samefile

    def folding(first: Path, second: Path) -> bool:
        return real(str(first).replace("MODELS/CAB", "models/cab"), second)

    monkeypatch.setattr(os.path, "samefile", folding)  # a disk on which case does not count

    assert why_not_apart(Path("MODELS/CAB"), [Path("models/cab/cab.urdf")])
