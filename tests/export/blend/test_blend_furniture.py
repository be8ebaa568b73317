"""Whole furniture, made and real, in Blender: all open by its limits at the middle frame, closed at both ends."""

import os
from pathlib import Path

import numpy as np
import pytest
from blend_reading import assert_posed, objects_of, visuals_of

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.sweep import all_open
from grafu.asset.load import load_asset
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.synth.generate import make_specimen
from grafu.synth.truth.clashes import articulated_of
from grafu.templates.gallery import builtin_gallery

_ROOT = Path(__file__).parents[3]
_MODELS = Path(os.environ.get("GRAFU_MODELS", _ROOT.parent / "shared" / "models")) / "pnm"
REAL = sorted(_MODELS.iterdir()) if _MODELS.is_dir() else []
SAMPLES = sorted((_ROOT / "samples").glob("*.glb"))
MADE = range(6)


def functional(path: Path) -> ArticulatedObject:
    return functionalize(load_asset(path), MotionSource.AUTO, builtin_gallery()).object


def assert_works(found, made: ArticulatedObject) -> None:
    assert set(visuals_of(found)) == {visual.name for link in made.links for visual in link.visuals}
    assert set(objects_of(found, "joint")) == {joint.id for joint in made.joints}
    assert_posed(found, found["frames"][0], made, {})
    assert_posed(found, found["frames"][50], made, all_open(made))
    assert_posed(found, found["frames"][100], made, {})
    for joint in made.moving_joints:
        ratio, poses = found["alone"][joint.id]
        assert_posed(found, poses, made, {joint.id: ratio * joint.limits.upper})
    assert not any(o["mended"] for _, o in visuals_of(found).values())
    assert_looks(found, made)


def assert_looks(found, made: ArticulatedObject) -> None:
    """Each image is there byte for byte, and was read; each material with its numbers."""
    surfaces = [s for link in made.links for v in link.visuals for s in v.surfaces if not s.is_empty]
    seen = [s.material.base_color_texture for s in surfaces if s.uv is not None]
    assert {image["data"] for image in found["images"].values()} == {t.data for t in seen if t is not None}
    assert all(np.prod(image["size"]) > 1 for image in found["images"].values())
    numbers = [(m["values"]["Metallic"], m["values"]["Roughness"]) for m in found["materials"].values()]
    for material in {s.material for s in surfaces}:
        assert any(np.allclose((material.metallic, material.roughness), pair) for pair in numbers), material.name


@pytest.mark.parametrize("index", MADE)
def test_made_furniture_works_in_blender(reopened, index):
    made = articulated_of(make_specimen(7, index).whole)

    assert_works(reopened(made), made)


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.stem)
def test_samples_work_in_blender(reopened, path):
    made = functional(path)

    assert made.moving_joints
    assert_works(reopened(made), made)


@pytest.mark.skipif(not REAL, reason="real models are not here")
@pytest.mark.parametrize("path", REAL, ids=lambda path: path.name)
def test_real_furniture_works_in_blender(reopened, path):
    made = functional(path)

    assert_works(reopened(made), made)
