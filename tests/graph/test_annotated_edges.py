"""The joints and attached parts of an asset as edges."""

from dataclasses import replace

import pytest

from grafu.asset.part import Asset
from grafu.graph.annotated import annotated_edges
from grafu.graph.edges import Attached, Hinge, Rail
from grafu.graph.parse import parse_graph
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door, Drawer, Stack


@pytest.fixture(scope="module")
def cabinet() -> Asset:
    return make_cabinet(Cabinet("made", Case(0.8, 1.0), Stack((Drawer(), Door()), (1.0, 3.0))))


def test_a_door_has_one_edge_a_drawer_two_and_each_handle_one(cabinet: Asset) -> None:
    stated = annotated_edges(cabinet, parse_graph(cabinet))

    assert [type(edge) for edge in stated.edges if edge.child == "door"] == [Hinge]
    assert [type(edge) for edge in stated.edges if edge.child == "drawer"] == [Rail, Rail]
    assert {edge.parent for edge in stated.edges if isinstance(edge, Attached)} == {"door", "drawer"}
    assert stated.refused == ()


@pytest.mark.parametrize("limits", [(-1.5, 0.0), (0.0, -1.5), (-1.5, 0.2)])
def test_limits_below_zero_open_the_other_way(cabinet: Asset, limits: tuple[float, float]) -> None:
    graph = parse_graph(cabinet)
    below = tuple(replace(j, axis=j.axis.reversed(), lower=limits[0], upper=limits[1]) for j in cabinet.joints)

    assert annotated_edges(replace(cabinet, joints=below), graph) == annotated_edges(cabinet, graph)


def test_moving_parts_without_a_joint_are_refused(cabinet: Asset) -> None:
    stated = annotated_edges(replace(cabinet, joints=()), parse_graph(cabinet))

    assert {refusal.part for refusal in stated.refused} == {"door", "drawer"}


def test_what_nothing_could_carry_is_refused(cabinet: Asset) -> None:
    alone = replace(cabinet, parts=tuple(p for p in cabinet.parts if not p.label.is_support))

    stated = annotated_edges(alone, parse_graph(alone))

    assert {"no static part" in refusal.why for refusal in stated.refused} == {True}
