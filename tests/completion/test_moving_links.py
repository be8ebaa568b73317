"""Links of their own that plainly move are doors: plates with a handle, and what closes a hollow body from above."""

from dataclasses import replace

import pytest

from grafu.asset.part import Asset, Part, PartSource
from grafu.completion.moving_links import links_that_move
from grafu.graph.completion import GraphCompletion
from grafu.graph.parse import parse_graph
from grafu.vocabulary import PartLabel
from small_scenes import box

CHEST = [
    box("front", (0.0, 0.0, 0.0), (1.0, 0.02, 0.5)),
    box("back", (0.0, 0.48, 0.0), (1.0, 0.5, 0.5)),
    box("left", (0.0, 0.02, 0.0), (0.02, 0.48, 0.5)),
    box("right", (0.98, 0.02, 0.0), (1.0, 0.48, 0.5)),
    box("floor", (0.02, 0.02, 0.0), (0.98, 0.48, 0.02)),
]
LID = box("plate", (-0.01, -0.01, 0.501), (1.01, 0.5, 0.52))
PANEL = box("plate", (0.1, -0.02, 0.1), (0.5, -0.001, 0.45))
GRIP = replace(box("grip", (0.45, -0.05, 0.2), (0.47, -0.02, 0.35)), label=PartLabel.HANDLE)


def moving(body, *own: Part, kind: str = "urdf", link: str = "leaf") -> tuple[str, ...]:
    """Returns what plainly moves of parts on a link of their own, beside the body's."""
    parts = (
        *(replace(p, source=PartSource(p.id, link="body")) for p in body),
        *(replace(p, source=PartSource(p.id, link=link)) for p in own),
    )
    asset = Asset("made", "", kind, tuple(replace(p, label=_label(p)) for p in parts))
    graph = parse_graph(asset)
    return links_that_move(GraphCompletion(graph, graph, "network"), asset)


def _label(part: Part) -> PartLabel:
    return part.label if part.id in ("grip", "named") else PartLabel.UNKNOWN


def test_what_closes_a_hollow_body_moves():
    assert moving(CHEST, LID) == ("plate",)


def test_a_plate_with_a_handle_moves():
    assert moving(CHEST, PANEL, GRIP) == ("plate",)


TABLE = [box(f"leg_{x}{y}", (x, y, 0.0), (x + 0.05, y + 0.05, 0.5)) for x in (0.0, 0.95) for y in (0.0, 0.45)]
SHELF = box("shelf", (0.02, 0.02, 0.47), (0.98, 0.48, 0.49))
TOP = replace(replace(LID, id="named"), label=PartLabel.TOP_PANEL)
WIDE = box("plate", (-0.1, -0.1, 0.501), (1.1, 0.5, 0.52))


@pytest.mark.parametrize(
    ("body", "own", "more"),
    [
        (TABLE, [LID], {}),
        (CHEST[1:], [LID], {}),
        ([*CHEST, SHELF], [LID], {}),
        (CHEST, [WIDE], {}),
        (CHEST, [TOP], {}),
        (CHEST, [PANEL], {}),
        (CHEST, [LID], {"kind": "glb"}),
        (CHEST, [LID], {"link": "body"}),
        (CHEST, [LID, box("board", (0.0, 0.0, 0.52), (1.0, 0.5, 0.54))], {}),
    ],
    ids=[
        "table",
        "open front",
        "closed",
        "overhang",
        "named a top",
        "no handle",
        "no robot",
        "of the body",
        "two boards",
    ],
)
def test_other_links_stay(body, own, more):
    assert moving(body, *own, **more) == ()
