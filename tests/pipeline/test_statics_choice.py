"""`--statics`: the completed graph, the geometry or both decide which tops, handles, boards and panels are made."""

import json
from collections.abc import Collection
from dataclasses import replace
from pathlib import Path

import pytest

from grafu.additions.config import NO_ADDITIONS, AdditionConfig
from grafu.additions.interior.request import NOTHING
from grafu.additions.statics import Statics
from grafu.api.functions import functionalize as functionalize_in_python
from grafu.asset.part import Asset
from grafu.cli.main import main
from grafu.errors import OptionError
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Attached
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.parse import parse_graph
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.realize import realize
from grafu.pipeline.additions import add_after_joints, add_before_joints
from grafu.pipeline.complete import complete_by_annotation
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel
from small_scenes import BASE_CASE, box, hinged, scene

CHEST = Path(__file__).parents[2] / "samples" / "chest.glb"
LEFT = Axis(vec3(0.0, -0.02, 0.4), vec3(0.0, 0.0, -1.0))
TOP = PartNode("new_top", PartLabel.TOP_PANEL, Box(vec3(0.0, 0.0, 0.82), vec3(0.6, 0.55, 0.84)))
BACK = PartNode("new_back", PartLabel.BACK_PANEL, Box(vec3(0.02, 0.53, 0.1), vec3(0.58, 0.55, 0.8)))
SHELF = PartNode("new_shelf", PartLabel.SHELF, Box(vec3(0.02, 0.02, 0.44), vec3(0.58, 0.5, 0.46)))
HANDLE = PartNode("new_handle", PartLabel.HANDLE, Box(vec3(0.55, -0.05, 0.4), vec3(0.57, -0.02, 0.5)))
ALL = (TOP, BACK, SHELF, HANDLE)


def open_case() -> Asset:
    """A case behind one overlay door without a handle, open above and behind."""
    kept = [part for part in BASE_CASE if part.id not in ("top", "back")]
    return scene(*kept, box("door", (0.0, -0.021, 0.0), (0.6, -0.001, 0.82)), joints=(hinged(axis=LEFT),))


def expecting(asset: Asset, nodes: Collection[PartNode]) -> GraphCompletion:
    """Returns the asset's completed graph with these nodes more, the handle on the door."""
    plain = complete_by_annotation(asset, parse_graph(asset))
    edges = (*plain.completed.edges, *(Attached("door", "new_handle") for node in nodes if node is HANDLE))
    grown = FunctionalGraph(plain.completed.model_id, (*plain.completed.nodes, *nodes), edges)
    return replace(plain, completed=grown, added=tuple(node.id for node in nodes))


def built(
    statics: Statics,
    nodes: Collection[PartNode],
    base: AdditionConfig | None = None,
    weighed: tuple[tuple[PartLabel, float], ...] = (),
    asset: Asset | None = None,
) -> list[PartLabel]:
    """Returns the categories of what is added, sorted."""
    asset, config = asset or open_case(), replace(base or AdditionConfig(), statics=statics)
    completion, plan = replace(expecting(asset, nodes), weighed=weighed), plan_from_annotation(asset)
    body = add_before_joints(asset, completion, plan, config.of_body)
    parts = (*asset.parts, *(addition.part for addition in body.additions))
    realized = realize(plan, replace(asset, parts=parts), builtin_gallery())
    fittings, _ = add_after_joints(realized.scene, completion, plan, config, {})
    return sorted(addition.part.label for addition in (*body.additions, *fittings.additions))


def test_geometry_finds_the_top_and_the_handle_whatever_is_predicted() -> None:
    found = [PartLabel.HANDLE, PartLabel.TOP_PANEL]
    assert built(Statics.GEOMETRY, ()) == found
    assert built(Statics.GEOMETRY, ALL) == found


def test_the_graph_alone_builds_what_it_expects_and_nothing_else() -> None:
    assert built(Statics.GRAPH, ()) == []
    assert built(Statics.GRAPH, ALL) == sorted(node.label for node in ALL)
    for nodes in ((TOP,), (BACK,), (TOP, HANDLE)):  # without a top the door can be grasped by its upper edge
        assert built(Statics.GRAPH, nodes) == sorted(node.label for node in nodes)


def test_both_build_what_either_finds() -> None:
    assert built(Statics.BOTH, ()) == [PartLabel.HANDLE, PartLabel.TOP_PANEL]
    assert built(Statics.BOTH, (BACK,)) == sorted([PartLabel.BACK_PANEL, PartLabel.HANDLE, PartLabel.TOP_PANEL])
    assert built(Statics.BOTH, ALL) == sorted(node.label for node in ALL)


@pytest.mark.parametrize(("probability", "builds"), [(0.049, False), (0.051, True), (0.49, True)])
def test_a_back_that_is_likely_is_built_where_rays_find_none(probability: float, builds: bool) -> None:
    weighed = ((PartLabel.BACK_PANEL, probability), (PartLabel.SHELF, 0.49))
    back = [PartLabel.BACK_PANEL] if builds else []
    assert built(Statics.GRAPH, (), weighed=weighed) == back
    assert built(Statics.BOTH, (), weighed=weighed) == sorted([*back, PartLabel.HANDLE, PartLabel.TOP_PANEL])
    assert built(Statics.GEOMETRY, (), weighed=weighed) == [PartLabel.HANDLE, PartLabel.TOP_PANEL]
    closed = replace(open_case(), parts=(*open_case().parts, *(part for part in BASE_CASE if part.id == "back")))
    assert built(Statics.GRAPH, (), weighed=weighed, asset=closed) == []


@pytest.mark.parametrize(
    ("name", "nodes", "tops"),
    [("washstand sink", (), 0), ("washstand sink", (TOP,), 1), ("captains bed", (TOP,), 0), ("crate", (TOP,), 0)],
)
def test_a_predicted_top_outweighs_the_name_of_a_sink_but_not_of_a_bed(
    name: str, nodes: Collection[PartNode], tops: int
) -> None:
    named = replace(open_case(), name=name)
    assert built(Statics.BOTH, nodes, asset=named).count(PartLabel.TOP_PANEL) == tops


@pytest.mark.parametrize("statics", Statics)
def test_what_is_refused_is_not_built_whoever_expects_it(statics: Statics) -> None:
    refused = AdditionConfig(top=None, handles=None, grips=None, interior=NOTHING)
    assert built(statics, (TOP, HANDLE, SHELF), refused) == []


def test_motions_alone_add_nothing_that_is_expected() -> None:
    assert built(NO_ADDITIONS.statics, ALL, NO_ADDITIONS) == []


@pytest.mark.parametrize("word", [*Statics, None])
def test_the_command_and_its_settings_state_it(word: Statics | None, tmp_path: Path) -> None:
    given = [] if word is None else ["--statics", word]
    args = ["functionalize", str(CHEST), "--motion", "rule", "--no-page", "--formats", "urdf", "--out", str(tmp_path)]
    assert main([*args, *given]) == 0
    settings = json.loads((tmp_path / "chest" / "settings.json").read_text())
    assert settings["additions"]["statics"] == (word or AdditionConfig().statics)
    again = [*args[:-1], str(tmp_path / "again"), "--settings", str(tmp_path / "chest" / "settings.json")]
    assert main(again) == 0
    assert json.loads((tmp_path / "again" / "chest" / "settings.json").read_text()) == settings


def test_another_word_is_refused() -> None:
    with pytest.raises(OptionError, match="`statics` must be one of graph, geometry, both: got 'grph'; did you mean"):
        functionalize_in_python(CHEST, statics="grph")
