"""The rule under a budget: what it decided in time stands, and every other door and drawer is answered for."""

from clocks import Clock
from grafu.completion.rule import complete_by_rule
from grafu.geometry.budget import Budget
from grafu.graph.parse import parse_graph
from grafu.refusal import Reason
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Drawer, Stack


def test_doors_and_drawers_that_come_too_late_are_refused() -> None:
    drawers = Stack(tuple(Drawer() for _ in range(6)), (1.0,) * 6)
    graph = parse_graph(make_cabinet(Cabinet("made", Case(0.5, 0.9), drawers)))
    with Budget.lasting(4.0, clock=Clock(step=1.0)).in_force():
        found = complete_by_rule(graph)
    moved, refused = {rail.child for rail in found.completed.rails}, {one.part for one in found.refused}
    assert moved
    assert refused
    assert moved | refused == {node.id for node in graph.nodes if node.label.is_movable}
    assert all(one.reason is Reason.TOO_COMPLEX for one in found.refused)
