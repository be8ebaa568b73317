"""The rule against the annotation of real furniture; skipped where the models are absent.

The models are found by the variable GRAFU_MODELS, else beside the repository.
"""

import os
from functools import cache
from pathlib import Path

import pytest

from grafu.asset.load import load_asset
from grafu.asset.part import Asset
from grafu.completion.rule import complete_by_rule
from grafu.graph.edit import relabelled
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import hinge_to_axis, rail_to_axis
from grafu.graph.parse import parse_graph
from grafu.metrics.motion import Motion, MotionAgreement, compare_motions
from grafu.vocabulary import JointType, PartLabel

MODELS = Path(os.environ.get("GRAFU_MODELS", Path(__file__).parents[2].parent / "shared" / "models")) / "pnm"
pytestmark = pytest.mark.skipif(not MODELS.is_dir(), reason="the real furniture is not here")


@cache
def loaded(name: str) -> tuple[Asset, FunctionalGraph]:
    asset = load_asset(MODELS / name).as_annotated()
    return asset, parse_graph(asset)


def true_motions(asset: Asset) -> dict[str, Motion]:
    """The annotated motions, each towards the farther of its two limits."""
    found = {}
    for joint in asset.joints:
        axis = joint.axis if abs(joint.upper) >= abs(joint.lower) else joint.axis.reversed()
        found[joint.part] = Motion(joint.type, axis, asset.part(joint.part).box.center)
    return found


def found_motions(graph: FunctionalGraph) -> dict[str, Motion]:
    found = {}
    for hinge in graph.hinges:
        box = graph.node(hinge.child).box
        found[hinge.child] = Motion(JointType.REVOLUTE, hinge_to_axis(box, hinge.border, hinge.sign), box.center)
    for rail in graph.rails:
        box = graph.node(rail.child).box
        found[rail.child] = Motion(JointType.PRISMATIC, rail_to_axis(box, rail.axis), box.center)
    return found


def agreements(masked: bool, ids: list[str]) -> list[MotionAgreement]:
    results: list[MotionAgreement] = []
    for name in ids:
        asset, graph = loaded(name)
        labels = {n.id: PartLabel.UNKNOWN for n in graph.nodes} if masked else {}
        completion = complete_by_rule(relabelled(graph, labels))
        results += compare_motions(found_motions(completion.completed), true_motions(asset))
    return results


STORAGE = ["41003", "41085", "44781", "45001", "45463", "45940", "45963", "46408", "46456", "46896", "47315", "49182"]
TABLES = ["20411", "22692", "26608", "32052"]


@pytest.mark.parametrize(
    ("masked", "ids", "least"), [(False, STORAGE, 0.95), (False, TABLES, 0.9), (True, STORAGE, 0.85)]
)
def test_the_rule_agrees_with_the_annotation(masked, ids, least):
    found = agreements(masked, [name for name in ids if (MODELS / name).is_dir()])
    if not found:
        pytest.skip("none of these models is here")
    assert sum(a.whole for a in found) / len(found) >= least
