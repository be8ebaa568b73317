import runpy
from pathlib import Path

import numpy as np
import pytest

from grafu.asset.load import load_asset
from grafu.synth.samples import KINDS, NOISY, SAMPLES, TIDY, furniture_of
from sweeping import collisions

ROOT = Path(__file__).parent.parent.parent


@pytest.mark.parametrize("name", SAMPLES)
def test_a_shipped_sample_is_what_its_maker_makes(name):
    shipped, made = load_asset(ROOT / "samples" / f"{name}.glb"), SAMPLES[name]()
    assert {p.source.name for p in shipped.parts} == {p.id for p in made.parts}
    assert shipped.box.size == pytest.approx(made.box.size, abs=1e-6)
    assert shipped.joints == ()
    textures = {s.material.base_color_texture for p in shipped.parts for s in p.surfaces} - {None}
    assert len(textures) == 1


@pytest.mark.parametrize("name", SAMPLES)
def test_the_reader_finds_every_door_drawer_and_handle(name):
    shipped, made = load_asset(ROOT / "samples" / f"{name}.glb"), SAMPLES[name]()
    for label in ("door", "drawer", "handle"):
        assert sorted(p.source.name for p in shipped.parts if p.label == label) == sorted(
            p.id for p in made.parts if p.label == label
        )


def test_samples_are_small_and_written_the_same_twice():
    script = runpy.run_path(str(ROOT / "scripts" / "make_samples.py"))
    assert script["sample_bytes"]("chest") == script["sample_bytes"]("chest")
    assert b"extras" not in script["sample_bytes"]("chest")
    assert all((ROOT / "samples" / f"{name}.glb").stat().st_size < 300_000 for name in SAMPLES)


@pytest.mark.parametrize("parts", [7, 8, 9, 10, 14, 15, 16, 50, 200])
def test_walls_have_exactly_as_many_parts_as_asked(parts):
    wall = furniture_of(parts)
    assert len(wall.parts) == parts
    assert np.all(wall.box.size > 0.3)


def test_a_wall_of_too_few_parts_is_refused():
    with pytest.raises(ValueError, match="at least 7"):
        furniture_of(6)


SUNK = {"doors into the case": "door_1", "inset door into the side": "door", "drawer into both walls": "drawer"}


@pytest.mark.parametrize("name", TIDY)
def test_a_tidy_kind_moves_freely_about_its_true_joints(name):
    asset = TIDY[name]()
    doors = frozenset(p.id for p in asset.parts if "door" in (p.label, str(p.carried_by)[:4]))
    for joint in asset.joints:
        behind = joint.part.startswith("drawer") and name.startswith("drawers behind")
        assert collisions(asset, joint.part, ignored=doors if behind else frozenset()) == {}


@pytest.mark.parametrize("name", NOISY)
def test_a_noisy_kind_keeps_its_joints(name):
    asset = NOISY[name]()
    assert len(asset.joints) == sum(p.id.startswith(("door", "drawer")) for p in asset.parts) > 0


@pytest.mark.parametrize("name", SUNK)
def test_what_is_sunk_into_a_neighbour_collides_at_rest(name):
    assert collisions(NOISY[name](), SUNK[name], values=[0.0]) != {}


def test_kinds_are_the_same_each_time():
    assert all(make().parts == make().parts for make in list(KINDS.values())[::7])
