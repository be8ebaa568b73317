"""Each way to move in the families that draw it: its truth states what its maker's joints state."""

from functools import cache

import numpy as np
import pytest

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import Asset
from grafu.geometry.intersection import MeshCollider
from grafu.graph.annotated import carrying_part
from grafu.graph.edges import Hinge, Rail, Slide, Turn
from grafu.graph.motion import axis_to_hinge, direction_to_code
from grafu.synth.families.table import FAMILIES, MAKERS, draw_blueprint
from grafu.synth.truth.check import faults_of
from grafu.synth.truth.true_graph import true_graph
from grafu.vocabulary import PartLabel

# A family, what the drawn spec holds, and the kind of edge and the label of what moves so
KINDS = {
    "sliding wardrobe": ("wardrobe", "Sliding(kind='bypass'", Slide, PartLabel.DOOR),
    "bi-fold wardrobe": ("wardrobe", "Folding(", Hinge, PartLabel.DOOR),
    "sliding sideboard": ("sideboard", "Sliding(kind='bypass'", Slide, PartLabel.DOOR),
    "sliding lowboard": ("lowboard", "Sliding(", Slide, PartLabel.DOOR),
    "barn door": ("TV stand", "kind='barn'", Slide, PartLabel.DOOR),
    "glass panes": ("display cabinet", "pane=True", Slide, PartLabel.DOOR),
    "bookcase": ("bookcase", "Sliding(", Slide, PartLabel.DOOR),
    "slim pull-out": ("base cabinet", "PullOut(load='trays'", Slide, PartLabel.DOOR),
    "pantry": ("tall cabinet", "PullOut(", Slide, PartLabel.DOOR),
    "bins on a front": ("base cabinet", "PullOut(load='bins'", Slide, PartLabel.DOOR),
    "bins behind a door": ("base cabinet", "WasteBins(", Slide, PartLabel.MISC),
    "fold-up flap": ("wall cabinet", "Folding(side='top'", Hinge, PartLabel.DOOR),
    "parallel lift": ("wall cabinet", "Lift(", Turn, PartLabel.MISC),
    "shutter": ("wall cabinet", "kind='shutter'", Slide, PartLabel.DOOR),
    "pocket door": ("sideboard", "kind='pocket'", Slide, PartLabel.DOOR),
    "carousel": ("corner cabinet", "trays=2", Turn, PartLabel.MISC),
    "folding corner": ("corner cabinet", "FoldingCorner(", Hinge, PartLabel.DOOR),
    "keyboard tray": ("writing desk", "box='tray'", Rail, PartLabel.DRAWER),
    "swivel mirror": ("vanity", "swivel=0.3", Turn, PartLabel.MISC),
    "drop leaves": ("drop-leaf table", "", Hinge, PartLabel.DOOR),
    "extension leaves": ("extending table", "", Slide, PartLabel.TOP_PANEL),
    "dishwasher": ("appliance", "kind='dishwasher'", Slide, PartLabel.SHELF),
    "oven": ("appliance", "kind='oven'", Turn, PartLabel.MISC),
    "microwave oven": ("appliance", "kind='microwave'", Turn, PartLabel.MISC),
    "washing machine": ("appliance", "WashingMachine(", Hinge, PartLabel.DOOR),
    "door of a building": ("building door", "", Hinge, PartLabel.DOOR),
    "window": ("window", "kind='pair'", Hinge, PartLabel.DOOR),
    "sash": ("window", "kind='sash'", Slide, PartLabel.DOOR),
}
NESTED = ("bi-fold wardrobe", "fold-up flap", "folding corner", "parallel lift")
FOLLOWING = {"bi-fold wardrobe": {2.0}, "fold-up flap": {2.0}, "parallel lift": {1.0}}


@cache
def drawn(name: str) -> Asset:
    """Returns the first sound piece of this kind that its family draws."""
    family, words, _, _ = KINDS[name]
    for k in range(2000):
        try:
            spec = FAMILIES[family][1](np.random.default_rng([31, k]))
            asset = MAKERS[type(spec)](spec) if words in repr(spec) else None
        except ValueError:
            continue
        if asset and not faults_of(asset):
            return asset
    raise AssertionError(f"no {name} in 2000 draws")


@pytest.mark.parametrize("name", list(KINDS))
def test_the_truth_states_what_the_joints_state(name: str) -> None:
    asset, (_, _, kind, label) = drawn(name), KINDS[name]
    truth = true_graph(asset, 8)
    joints = {joint.part: joint for joint in (*asset.joints, *asset.small_joints)}
    found = set()
    for part, joint in joints.items():
        if asset.part(part).label is PartLabel.HANDLE:
            continue
        edges, above = truth.motions_of(part), carrying_part(part, joints, asset)
        assert edges
        for edge in edges:
            assert edge.joint_type is joint.type or motion_kind(joint.type).turns
            assert edge.coupling == joint.coupling
            assert edge.parent == above if above else edge.parent not in joints
            if isinstance(edge, Hinge):
                assert (edge.border, edge.sign) == axis_to_hinge(asset.part(part).box, joint.axis)
            else:
                assert edge.axis == direction_to_code(joint.axis.direction)
            found.add((type(edge), asset.part(part).label))
    assert (kind, label) in found
    assert not [fault for fault in faults_of(asset, truth=truth) if fault.kind != "loose"]


@pytest.mark.parametrize("name", list(KINDS))
def test_only_what_folds_hangs_on_what_moves(name: str) -> None:
    asset = drawn(name)
    truth = true_graph(asset, 8)
    nested = [edge for edge in truth.motions if truth.carrier_of(edge.child) and isinstance(edge, Hinge)]
    assert bool(nested) == (name in NESTED)
    assert {edge.coupling.multiplier for edge in nested if edge.coupling} == FOLLOWING.get(name, set())


@pytest.mark.parametrize("family", sorted({family for family, *_ in KINDS.values()}))
def test_the_same_state_draws_the_same_piece(family: str) -> None:
    first, again = (draw_blueprint(np.random.default_rng([32, 5]), family) for _ in range(2))
    assert first == again


def test_sliding_leaves_open_most_of_their_width_and_pass_one_another() -> None:
    for name in ("sliding wardrobe", "sliding sideboard", "glass panes"):
        asset = drawn(name)
        for joint in asset.joints:
            part = asset.part(joint.part)
            if part.label is PartLabel.DOOR and abs(joint.axis.direction[0]) == 1.0:
                assert 0.5 * part.box.size[0] <= joint.upper < part.box.size[0]


def test_a_lifted_flap_stays_upright_and_rises_before_the_case() -> None:
    asset = drawn("parallel lift")
    joints = {joint.part: joint for joint in asset.joints}
    arms, flap = joints["lift_arms"], joints["door"]
    rotation = [motion_kind(joint.type).transform(joint.axis, joint.upper) for joint in (arms, flap)]
    T = rotation[0] @ rotation[1]
    np.testing.assert_allclose(T[:3, :3], np.eye(3), atol=1e-9)
    assert T[2, 3] >= 0.4 * asset.part("door").box.size[2]
    assert T[1, 3] <= 1e-9
    assert {p.id for p in asset.parts if p.carried_by == "door"} >= {"lift_bracket_1", "lift_bracket_2"}


@pytest.mark.parametrize(("name", "axis"), [("pocket door", 0), ("shutter", 2)])
def test_what_slides_behind_a_board_ends_within_the_piece(name: str, axis: int) -> None:
    asset = drawn(name)
    (joint,) = [joint for joint in asset.joints if abs(joint.axis.direction[axis]) == 1.0]
    leaf = asset.part(joint.part).box
    board = next(p for p in asset.parts if p.id.split("_")[0] in ("pocket", "shutter") and "guide" not in p.id).box
    moved = leaf.center + joint.axis.direction * joint.upper
    assert joint.upper >= 0.5 * leaf.size[axis]
    assert np.all(moved + leaf.size / 2 <= asset.box.high + 1e-9)
    assert np.all(moved - leaf.size / 2 >= asset.box.low - 1e-9)
    assert abs(moved[axis] - board.center[axis]) < 0.1 * leaf.size[axis] + 0.05
    assert leaf.low[1] > board.low[1]


def test_a_carousel_clears_the_cabinet_all_the_way_round() -> None:
    asset = drawn("carousel")
    trays = asset.part("carousel")
    (joint,) = [joint for joint in asset.small_joints if joint.part == "carousel"]
    turning = MeshCollider(trays.mesh)
    others = [MeshCollider(p.mesh) for p in asset.parts if p.id != "carousel"]
    for value in np.linspace(0.0, 2 * np.pi, 13):
        turning.place(motion_kind(joint.type).transform(joint.axis, float(value)))
        assert not any(turning.intersects(other) for other in others)


def test_all_storage_and_tables_stay_most_of_what_is_made() -> None:
    whole = sum(weight for weight, _ in FAMILIES.values())
    others = ("fridge", "oven", "appliance", "building door", "window")
    assert sum(FAMILIES[name][0] for name in others) <= 0.15 * whole
