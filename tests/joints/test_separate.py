"""What a drawer's mesh holds of its case stays with the case, and nothing else does."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from grafu.asset.part import Asset, Part
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from judging import installed, realized
from small_scenes import box, drawer

HALF = 0.2  # of the drawer's width


def ring(y: tuple[float, float], outer: float, low: float, high: float, margin: float = 0.0005) -> Surface:
    """A frame of one shell in the plane of the front, around the drawer at a distance of `margin`."""
    whole = trimesh.creation.box(bounds=[[-outer, y[0], low], [outer, y[1], high]])
    hole = trimesh.creation.box(
        bounds=[[-HALF - margin, y[0] - 1, 0.02 - margin], [HALF + margin, y[1] + 1, 0.17 + margin]]
    )
    return Surface(TriangleMesh.from_trimesh(whole.difference(hole, engine="manifold")))


def between_posts(*more: Surface) -> Asset:
    """A drawer between two walls, before each of them a post; its mesh holds more surfaces besides its own."""
    made = drawer()
    posts = [
        box("post_left", (-0.26, -0.2, 0.0), (-0.2125, -0.15, 0.5)),
        box("post_right", (0.2125, -0.2, 0.0), (0.26, -0.15, 0.5)),
    ]
    parts = [replace(p, surfaces=(*p.surfaces, *more)) if p.id == "drawer" else p for p in made.parts]
    return replace(made, parts=(*parts, *posts))


def surface(name: str, low: tuple[float, float, float], high: tuple[float, float, float]) -> Surface:
    return box(name, low, high).surfaces[0]


def area(parts: dict[str, Part]) -> float:
    return sum(part.mesh.area for part in parts.values())


def separated(result) -> list:
    return [c for o in result.report.installed for c in o.clearances if c.kind == "separated"]


def meshes(result) -> dict:
    return {v.name: v.mesh for link in result.object.links for v in link.visuals}


FRAME = ring((-0.199, -0.17), 0.235, 0.005, 0.19)


def test_a_frame_around_a_drawer_whose_ends_stand_in_the_posts_stays_with_the_case():
    result = realized(between_posts(FRAME))
    outcome = installed(result)["drawer"]
    (cut,) = separated(result)
    assert cut.part == "drawer"
    assert cut.why.startswith("belongs to the case and stays with post_")
    assert cut.amount == pytest.approx(np.sqrt(FRAME.mesh.area))
    assert outcome.collision_share == 0.0
    assert outcome.opening == pytest.approx(0.3, abs=0.02)
    host = cut.why.split()[-1]
    assert meshes(result)["drawer"].box.size[0] == pytest.approx(2 * HALF, abs=0.03)
    assert meshes(result)[host].box.size[0] == pytest.approx(0.47 + 0.025, abs=0.01)
    before = between_posts(FRAME).part(host)
    assert meshes(result)[host].area >= before.mesh.area + 0.9 * FRAME.mesh.area


def test_nothing_is_separated_from_a_drawer_that_moves_freely():
    small = ring((-0.199, -0.17), 0.21, 0.015, 0.175)  # clear of the posts
    result = realized(between_posts(small))
    assert separated(result) == []
    assert installed(result)["drawer"].collision_share == 0.0


def test_a_front_that_is_wider_than_its_box_is_no_frame():
    front = surface("front", (-0.235, -0.22, 0.005), (0.235, -0.2, 0.19))
    stuck = surface("tongue", (-0.235, -0.2, 0.08), (0.235, -0.18, 0.1))
    result = realized(between_posts(front, stuck))
    assert all(c.amount < np.sqrt(0.9 * front.mesh.area) for c in separated(result))
    assert meshes(result)["drawer"].box.size[0] >= 0.4


def test_slivers_beside_the_outline_of_a_drawer_stay_in_the_posts_that_they_stand_in():
    pin = surface("pin", (0.2, -0.19, 0.05), (0.23, -0.17, 0.06))
    result = realized(between_posts(pin))
    (cut,) = separated(result)
    assert cut.why == "belongs to the case and stays with post_right"
    assert cut.share < 0.02
    assert installed(result)["drawer"].collision_share == 0.0
    assert meshes(result)["drawer"].box.high[0] <= HALF + 1e-6


def test_slivers_within_the_outline_of_a_drawer_are_its_own():
    lid = surface("plate", (-0.03, -0.1, 0.1699), (0.03, -0.05, 0.171))
    above = box("rail", (-0.2125, -0.2, 0.1705), (0.2125, -0.15, 0.19))
    made = between_posts(lid)
    result = realized(replace(made, parts=(*made.parts, above)))
    assert separated(result) == []


def test_many_small_shells_are_no_slivers():
    pins = [surface(f"pin_{k}", (0.2, -0.19 + 0.02 * k, 0.03), (0.23, -0.175 + 0.02 * k, 0.15)) for k in range(6)]
    assert separated(realized(between_posts(*pins))) == []


def test_the_surface_of_all_parts_is_kept():
    made = between_posts(FRAME)
    result = realized(made)
    names = {p.id for p in made.parts}
    after = sum(mesh.area for name, mesh in meshes(result).items() if name in names)
    assert after == pytest.approx(area({p.id: p for p in made.parts}), rel=0.02)
    assert Box.around(np.vstack([m.vertices for m in meshes(result).values()])).size[2] == pytest.approx(0.5, abs=0.01)
