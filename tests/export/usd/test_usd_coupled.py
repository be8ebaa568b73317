"""A coupled joint in OpenUSD: who reads the scene finds the leader, and PhysX its own terms."""

from dataclasses import replace
from math import degrees

import numpy as np
import pytest
from test_usd import opened, poses_in, require_valid

from bifold import LEAF_HINGE, make_bifold
from grafu.articulation.kinematics import link_origins, link_poses
from grafu.geometry.transform import translation

pytest.importorskip("pxr", reason="usd-core is not installed: pip install 'grafu[usd]'")
from pxr import Usd

from grafu.export.usd.config import UsdConfig
from grafu.export.usd.exporter import export_usd

BIFOLD = make_bifold()
LATE = replace(BIFOLD, joints=(BIFOLD.joints[0], LEAF_HINGE.following(BIFOLD.joints[0], 0.5, 0.25)))


def joint_prim(stage: Usd.Stage, name: str) -> Usd.Prim:
    return stage.GetPrimAtPath(stage.GetDefaultPrim().GetPath().AppendPath(f"joints/{name}"))


@pytest.fixture(scope="module")
def stage(tmp_path_factory) -> Usd.Stage:
    return opened(export_usd(BIFOLD), tmp_path_factory.mktemp("usd") / "bifold")


@pytest.mark.parametrize("angle", [0.0, 0.7, 1.4])
def test_by_what_the_scene_says_links_stand_where_the_kinematics_say(stage, angle):
    prim = joint_prim(stage, "leaf_2_hinge")
    leader = prim.GetRelationship("grafu:leader").GetTargets()
    multiplier, offset = (prim.GetAttribute(f"grafu:{name}").Get() for name in ("multiplier", "offset"))
    assert leader == [joint_prim(stage, "leaf_1_hinge").GetPath()]

    values = {"leaf_1_hinge": angle, "leaf_2_hinge": multiplier * angle + offset}
    found = poses_in(stage, BIFOLD, values)
    expected, origins = link_poses(BIFOLD, {"leaf_1_hinge": angle}), link_origins(BIFOLD)
    for link in BIFOLD.links:
        assert np.allclose(found[link.id], expected[link.id] @ translation(origins[link.id]), atol=1e-6)


@pytest.mark.parametrize("made", [BIFOLD, LATE], ids=["folding", "late"])
def test_physx_keeps_the_same_relation_in_degrees(made, tmp_path):
    stage = opened(export_usd(made), tmp_path / "made")
    prim, coupling = joint_prim(stage, "leaf_2_hinge"), made.joint_of["leaf_2"].coupling
    schemas = prim.GetMetadata("apiSchemas").GetAppliedItems()  # those of PhysX are not registered here
    (applied,) = (name for name in schemas if name.startswith("PhysxMimicJointAPI:"))
    said = f"physxMimicJoint:{applied.split(':')[1]}"
    assert applied == "PhysxMimicJointAPI:rotZ"
    assert prim.GetRelationship(f"{said}:referenceJoint").GetTargets() == [joint_prim(stage, "leaf_1_hinge").GetPath()]
    assert prim.GetAttribute(f"{said}:referenceJointAxis").Get() == "rotZ"
    gearing, offset = (prim.GetAttribute(f"{said}:{name}").Get() for name in ("gearing", "offset"))
    for leader in (0.0, 0.9):
        assert degrees(coupling.value(leader)) + gearing * degrees(leader) + offset == pytest.approx(0.0, abs=1e-4)


def test_the_scene_is_valid_and_physx_can_be_left_out(stage, tmp_path):
    require_valid(stage)
    plain = opened(export_usd(BIFOLD, UsdConfig(physx=False)), tmp_path / "plain")
    names = joint_prim(plain, "leaf_2_hinge").GetPropertyNames()
    assert "grafu:multiplier" in names
    assert not any("physx" in name for name in names)
