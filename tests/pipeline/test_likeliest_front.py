"""A piece whose front nothing shows is turned so that what is taken for doors and drawers opens to the front."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.edit import moved
from grafu.asset.part import Asset
from grafu.geometry.transform import from_rotation, rotation_matrix
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Rail
from grafu.graph.edit import with_edges
from grafu.graph.parse import parse_graph
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.likeliest_front import LikeliestFrontConfig, with_likeliest_front
from grafu.pipeline.motion_source import MotionSource
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door, Drawer, Stack
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel

ASSUMED = ("up is +Z: stated", "front is -Y: assumed, as all sides look alike; --front changes it", "scale 1: stated")
BY_FORMAT = "front is -Y: stated by the format (glTF), where nothing shows another; --front changes it"
SHOWN = "front is -Y: stated by the format (glTF)"
SIDES = ("-Y", "-X", "+Y", "+X")  # where the front of the made cabinet is after so many quarter turns


@pytest.fixture(scope="module")
def nameless() -> Asset:
    made = make_cabinet(Cabinet("made", Case(0.5, 0.9), Stack((Drawer(), Door()), (1.0, 3.0))))
    bare = made.without_annotation()
    parts = (replace(part, label=PartLabel.UNKNOWN, labelled_by="hidden") for part in bare.parts)
    return replace(bare, parts=tuple(parts), frame=replace(bare.frame, assumed=ASSUMED))


def turned(asset: Asset, quarters: int) -> Asset:
    """The same piece as if it stood so in its file."""
    made = moved(asset, from_rotation(np.round(rotation_matrix(np.array([0.0, 0.0, 1.0]), -quarters * np.pi / 2))))
    return replace(made, frame=asset.frame)


def sliding(score: float, drawer: str):
    """A network that lets a front slide to -Y where it stands there, and anywhere else to the other side."""

    def complete(asset: Asset) -> GraphCompletion:
        graph = parse_graph(asset)
        nodes = tuple(replace(n, label=PartLabel.DRAWER) if n.id == drawer else n for n in graph.nodes)
        called, carrier = replace(graph, nodes=nodes), next(n.id for n in graph.nodes if n.id != drawer)
        is_in_front = graph.node(drawer).box.center[1] < -0.1
        slide = Decision(drawer, "slide", "2", score)
        edges = [Rail(carrier, drawer, 2 if is_in_front else 3)]
        return GraphCompletion(graph, with_edges(called, edges), "network", decisions=(slide,))

    return complete


@pytest.mark.parametrize("front_words", [ASSUMED[1], BY_FORMAT], ids=["assumed", "by the format alone"])
@pytest.mark.parametrize("quarters", range(4))
def test_the_side_to_which_fronts_open_comes_to_the_front(nameless, quarters, front_words):
    front = next(part.id for part in nameless.parts if "door" in part.id)
    nameless = replace(nameless, frame=replace(nameless.frame, assumed=(ASSUMED[0], front_words, ASSUMED[2])))
    given = turned(nameless, quarters)
    found = with_likeliest_front(given, sliding(0.9, front))
    assert found.frame.front == SIDES[quarters]
    assert found.part(front).box.center[1] < -0.1
    for before, after in zip(nameless.parts, found.parts, strict=True):
        np.testing.assert_allclose(after.box.center, before.box.center, atol=1e-9)
    back = np.linalg.inv(found.frame.input_to_output)
    assert found.frame.assumed[1].startswith(f"front is {SIDES[quarters]}: ") or not quarters
    np.testing.assert_allclose(moved(found, back).part(front).box.center, given.part(front).box.center, atol=1e-9)


@pytest.mark.parametrize(
    ("score", "assumed", "config"),
    [
        (0.4, ASSUMED, LikeliestFrontConfig()),  # not sure enough
        (0.9, (ASSUMED[0], "front is -Y: stated by the user", ASSUMED[2]), LikeliestFrontConfig()),
        (0.9, (ASSUMED[0], SHOWN, ASSUMED[2]), LikeliestFrontConfig()),
        (0.9, ASSUMED, LikeliestFrontConfig(most=2)),
    ],
)
def test_what_is_known_or_not_sure_stays(nameless, score, assumed, config):
    front = next(part.id for part in nameless.parts if "door" in part.id)
    given = turned(replace(nameless, frame=replace(nameless.frame, assumed=assumed)), 1)
    assert with_likeliest_front(given, sliding(score, front), config) is given


@pytest.mark.parametrize("quarters", [0, 1, 2])
def test_a_nameless_cabinet_works_however_it_stands_in_its_file(nameless, quarters):
    made = functionalize(turned(nameless, quarters), MotionSource.NETWORK, builtin_gallery())
    assert made.asset.frame.front == SIDES[quarters]
    assert sorted(joint.type.value for joint in made.object.joints) == ["prismatic", "revolute"]
