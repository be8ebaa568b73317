import numpy as np
import pytest

from grafu.synth.families.table import FAMILIES, Blueprint, draw_blueprint, draw_made, make_furniture


def test_the_same_generator_state_draws_the_same_blueprint():
    drawn = [draw_blueprint(np.random.default_rng([3, k])) for k in range(8)]
    assert drawn == [draw_blueprint(np.random.default_rng([3, k])) for k in range(8)]
    assert len({blueprint.family for blueprint in drawn}) > 2


def test_what_is_drawn_is_what_is_made():
    blueprint, asset = draw_made(np.random.default_rng(4), "dresser")
    assert blueprint.family == "dresser"
    assert [p.id for p in make_furniture(blueprint).parts] == [p.id for p in asset.parts]


def test_an_unknown_family_is_refused():
    with pytest.raises(ValueError, match=r"`family` must be one of base cabinet, .*: got 'spaceship'"):
        draw_blueprint(np.random.default_rng(0), "spaceship")


def test_a_family_that_finds_no_room_says_why(monkeypatch):
    def never(rng):
        raise ValueError("no room for a door")

    monkeypatch.setitem(FAMILIES, "chest", (1.0, never))
    with pytest.raises(ValueError, match="found no room in 50 draws: no room for a door"):
        draw_made(np.random.default_rng(0), "chest")


def test_every_family_has_a_weight():
    assert all(weight > 0 for weight, _ in FAMILIES.values())
    assert isinstance(Blueprint("chest", FAMILIES["chest"][1](np.random.default_rng(0))), Blueprint)
