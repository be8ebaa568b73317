"""What touches parts behind a front: parts alone, for nodes that are only predicted hold nothing."""

from grafu.graph.parse import parse_graph
from grafu.joints.behind_fronts import touched_by
from small_scenes import box, scene


def test_predicted_nodes_of_the_graph_are_not_touched():
    bin_part = box("bin", (0.0, 0.0, 0.0), (0.2, 0.2, 0.2))
    floor = box("floor", (0.0, 0.0, -0.02), (0.4, 0.2, 0.0))
    shelf = box("shelf_added", (0.0, 0.0, 0.2), (0.2, 0.2, 0.22))
    graph = parse_graph(scene(bin_part, floor, shelf))
    assert touched_by(["bin"], scene(bin_part, floor, shelf), graph, ()) == {"floor", "shelf_added"}
    assert touched_by(["bin"], scene(bin_part, floor), graph, ()) == {"floor"}
    assert touched_by(["bin"], scene(bin_part, floor), graph, ["floor"]) == set()
