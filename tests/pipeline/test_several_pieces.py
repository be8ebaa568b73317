"""A scene of several pieces is completed piece by piece; the motions are stated in the frame of the scene."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from furniture_rooms import Boxes, corner, furnished_room, island, numbered, write_scene
from grafu.asset.edit import moved
from grafu.asset.load import load_asset
from grafu.asset.part import Asset
from grafu.geometry.transform import from_rotation, rotation_matrix
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Hinge, Rail
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import opening_face
from grafu.graph.parse import parse_graph
from grafu.joints.make_plan import plan_from_completion
from grafu.pipeline.complete import complete_by_shape, complete_by_weights
from grafu.pipeline.several_pieces import completed_by_pieces

UP = np.array([0.0, 0.0, 1.0])


def read(folder: Path, boxes: Boxes) -> Asset:
    return load_asset(write_scene(folder / "scene.glb", boxes))


def fronts_of(completion: GraphCompletion) -> dict[str, set[int]]:
    """By the first word of their names, the signed axes along which doors and drawers open."""
    graph, found = completion.completed, dict[str, set[int]]()
    for edge in graph.motions:
        node = graph.node(edge.child)
        opens = opening_face(node.box.thin_axis, edge.border, edge.sign) if isinstance(edge, Hinge) else edge.axis
        found.setdefault(node.source_name.split()[0], set()).add(opens)
    return found


@pytest.mark.parametrize("complete", [complete_by_weights, complete_by_shape], ids=["network", "rule"])
def test_each_wing_opens_to_its_own_front(tmp_path: Path, complete) -> None:
    asset = read(tmp_path, corner())
    found = fronts_of(complete(asset, parse_graph(asset)))
    (back,), (left,) = found["back"], found["left"]
    assert back // 2 != left // 2


def test_the_far_side_of_an_island_opens_away_from_the_near_one(tmp_path: Path) -> None:
    asset = read(tmp_path, island())
    found = fronts_of(complete_by_weights(asset, parse_graph(asset)))
    assert {tuple(found["near"]), tuple(found["far"])} == {(2,), (3,)}


def test_nameless_fronts_on_both_sides_are_found(tmp_path: Path) -> None:
    asset = read(tmp_path, numbered(island()))
    graph = complete_by_weights(asset, parse_graph(asset)).completed
    opening = [
        opening_face(graph.node(e.child).box.thin_axis, e.border, e.sign) if isinstance(e, Hinge) else e.axis
        for e in graph.motions
        if isinstance(e, Hinge | Rail)
    ]
    assert {2, 3} <= set(opening)


def test_floor_and_walls_do_not_move(tmp_path: Path) -> None:
    asset = read(tmp_path, furnished_room())
    graph = complete_by_weights(asset, parse_graph(asset)).completed
    assert {"floor", "wall_behind", "wall_left"} & graph.moving == frozenset()
    assert graph.moving


def slid_in_its_own_frame(asset: Asset, graph: FunctionalGraph) -> GraphCompletion:
    """Completes a piece by a drawer that slides to its front, and a door that hangs on its left."""
    drawer, door = (next(n for n in graph.nodes if n.label.value == kind) for kind in ("drawer", "door"))
    side = next(n for n in graph.nodes if n.label.is_support)
    edges = (Rail(side.id, drawer.id, 2), Hinge(side.id, door.id, 0, 0))
    return GraphCompletion(graph, replace(graph, edges=edges), "network")


def axes_of(asset: Asset) -> dict[str, np.ndarray]:
    """The direction of each joint that is planned of the first piece, by its moving part."""
    first = replace(asset, standings=asset.standings[:1])
    plan = plan_from_completion(completed_by_pieces(first, parse_graph(first), slid_in_its_own_frame), first)
    return {joint.moving: joint.axis.direction for joint in plan.joints}


@pytest.mark.parametrize("degrees", [0, 90, 180, 270])
def test_motions_turn_with_the_piece(tmp_path: Path, degrees: int) -> None:
    asset = read(tmp_path, corner())
    T = from_rotation(rotation_matrix(UP, np.radians(degrees)))
    before, after = axes_of(asset), axes_of(moved(asset, T))
    assert len(before) == 2
    assert before.keys() == after.keys()
    assert all(np.allclose(T[:3, :3] @ before[part], after[part], atol=1e-9) for part in before)


def test_a_drawer_of_a_piece_that_stands_askew_slides_along_that(tmp_path: Path) -> None:
    turned = moved(read(tmp_path, corner()), from_rotation(rotation_matrix(UP, np.radians(30))))
    (slide,) = (axis for axis in axes_of(turned).values() if abs(axis[2]) < 0.5)
    assert np.allclose(turned.standings[0].T_piece_object[:3, :3] @ slide, [0.0, -1.0, 0.0], atol=1e-9)
