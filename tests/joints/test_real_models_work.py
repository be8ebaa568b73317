"""Real furniture, where it is at hand (GRAFU_MODELS, or beside the repository): joints that work, part by part."""

import os
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from grafu.asset.load import load_asset
from grafu.asset.part import Asset
from grafu.joints.realize import Realized
from grafu.metrics.collision import CollisionConfig, ConnectivityConfig, collision_shares, largest_gaps
from judging import installed, realized

MODELS = Path(os.environ.get("GRAFU_MODELS") or Path(__file__).parents[3] / "shared" / "models")
CHOSEN = ("pnm/46408", "pnm/41003", "pnm/45940", "pnm/22692", "other/sektion_cabinet", "other/calvin_table_A")
AT_HAND = [name for name in CHOSEN if (MODELS / name).exists()]
pytestmark = pytest.mark.skipif(not AT_HAND, reason="the development models are not at hand")
model = pytest.mark.parametrize("name", AT_HAND)


@cache
def loaded(name: str) -> Asset:
    return load_asset(MODELS / name).as_annotated()


@cache
def result_of(name: str) -> Realized:
    return realized(loaded(name))


@model
def test_each_stated_joint_is_built_or_skipped_with_a_reason(name):
    report = result_of(name).report
    answered = [o.moving for o in report.installed] + [s.part for s in report.skipped]
    assert sorted(answered) == sorted({j.part for j in loaded(name).joints})
    assert {s.part for s in report.skipped} <= {"slide_link"}  # a sliding panel


@model
def test_what_is_built_collides_with_nothing_and_stays_connected(name):
    asset, result = loaded(name), result_of(name)
    ratios = collision_shares(result.object, CollisionConfig(poses=20, tolerance=0.0005))
    gaps = largest_gaps(result.object, ConnectivityConfig(poses=4))
    for outcome in result.report.installed:
        assert ratios[outcome.joint] == 0.0, outcome.moving
        assert gaps[outcome.joint] <= 0.005 * asset.extent, outcome.moving


@model
def test_directions_are_those_of_the_annotation(name):
    stated = {j.part: j for j in loaded(name).joints}
    for part, outcome in installed(result_of(name)).items():
        assert outcome.type is stated[part].type
        off = np.degrees(outcome.axis.angle_to(outcome.initial_axis))
        assert off <= 10.0, part


@model
def test_openings_are_wide_or_the_report_says_they_are_not(name):
    for outcome in result_of(name).report.installed:
        assert outcome.opening > 0
        wide = outcome.reference is None or outcome.opening >= 0.7 * min(outcome.reference, np.radians(110))
        assert wide or outcome.restricted or outcome.type.value == "prismatic", outcome.moving


@model
def test_no_part_of_the_input_is_lost(name):
    names = {v.name for link in result_of(name).object.links for v in link.visuals}
    assert {p.id for p in loaded(name).parts if len(p.mesh.faces)} <= names
