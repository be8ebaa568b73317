"""The authors' predicted graphs as predictions about an asset: slots in order, regressed boxes, codes on true boxes."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from grafu.asset.foreign.attach import attach_motions
from grafu.asset.part import Asset
from grafu.errors import UnreadableAsset
from grafu.geometry.transform import from_rotation
from grafu.graph.edges import Hinge, Rail
from grafu.graph.motion import hinge_to_axis, rail_to_axis
from grafu.graph.official_json import functional_to_official, input_to_official
from grafu.graph.official_prediction import read_prediction
from grafu.graph.parse import parse_graph
from grafu.joints.make_plan import plan_from_annotation
from grafu.pipeline.complete import complete_by_annotation
from grafu.vocabulary import JointType, PartLabel
from predictions import cabinet, unlabelled

CABINET = cabinet()
COMPLETED = complete_by_annotation(CABINET, parse_graph(CABINET)).completed


def prediction(noise: float = 0.0, scale: float = 1.0, seed: int = 0) -> dict[str, Any]:
    """Returns what the authors' code would write, boxes off by up to `noise`, with a handle that is new."""
    rng = np.random.default_rng(seed)
    stated = functional_to_official(COMPLETED)
    names = {
        key: f"slot{k:02d}_{n['material'].replace(' ', '_')}" for k, (key, n) in enumerate(stated["nodes"].items())
    }
    nodes: dict[str, Any] = {}
    for slot, (key, node) in enumerate(stated["nodes"].items()):
        center, half = (scale * (np.array(node["obb"][k]) + rng.uniform(-noise, noise, 3)) for k in ("center", "half"))
        obb = {"center": center.tolist(), "half": np.maximum(half, 0.005).tolist(), "quat": [1, 0, 0, 0]}
        nodes[names[key]] = {"id": names[key], "slot": slot, "material": node["material"], "obb": obb}
    new = f"slot{len(nodes):02d}_handle"
    obb = {"center": [scale * 0.1, scale * -0.2, scale * 0.9], "half": [scale * 0.05, scale * 0.01, 0.005]}
    nodes[new] = {"id": new, "slot": len(nodes), "type": "dynamic", "material": "handle", "obb": obb}
    edges = [edge | {end: names[edge[end]] for end in ("src", "dst")} for edge in stated["edges"]]
    return {"model_id": "m", "nodes": nodes, "edges": edges}


def write(folder: Path, data: Any) -> Path:
    path = folder / "m_pred.json"
    path.write_text(json.dumps(data))
    return path


def require_decoded_on(asset: Asset, found: Asset) -> None:
    """Fails unless every joint is its code on the true box of its part."""
    joints = {joint.part: joint for joint in found.joints}
    assert set(joints) == {joint.part for joint in CABINET.joints}
    for edge in (*COMPLETED.hinges, *COMPLETED.rails):
        assert isinstance(edge, Hinge | Rail)
        box = asset.part(edge.child).box
        axis = hinge_to_axis(box, edge.border, edge.sign) if isinstance(edge, Hinge) else rail_to_axis(box, edge.axis)
        np.testing.assert_allclose(joints[edge.child].axis.direction, axis.direction, atol=1e-9)
        assert axis.distance_to(joints[edge.child].axis.point) < 1e-6 or isinstance(edge, Rail)
        assert joints[edge.child].type is (JointType.REVOLUTE if isinstance(edge, Hinge) else JointType.PRISMATIC)
        assert not joints[edge.child].limited


@pytest.mark.parametrize("noise", [0.0, 0.02, 0.06])
@pytest.mark.parametrize("scale", [1.0, 0.4])
def test_codes_are_read_on_the_true_boxes_though_predicted_ones_are_off(
    noise: float, scale: float, tmp_path: Path
) -> None:
    for seed in range(3):
        found = attach_motions(CABINET, read_prediction(write(tmp_path, prediction(noise, scale, seed))))

        require_decoded_on(CABINET, found)


def test_slots_count_even_where_parts_lie_too_close_to_be_told_apart(tmp_path: Path) -> None:
    found = attach_motions(unlabelled(CABINET), read_prediction(write(tmp_path, prediction(0.05))))

    require_decoded_on(CABINET, found)
    assert {p.id: p.label for p in found.parts} == {p.id: p.label for p in CABINET.parts}
    assert {p.labelled_by for p in found.parts} == {"prediction"}
    assert {p.id: p.carried_by for p in found.parts} == {p.id: p.carried_by for p in CABINET.parts}


def test_parts_in_another_order_are_told_by_their_boxes(tmp_path: Path) -> None:
    from dataclasses import replace

    order = np.random.default_rng(1).permutation(len(CABINET.parts))
    shuffled = replace(CABINET, parts=tuple(CABINET.parts[k] for k in order))
    found = attach_motions(shuffled, read_prediction(write(tmp_path, prediction())))

    require_decoded_on(CABINET, found)


def test_the_graph_that_was_predicted_from_gives_true_boxes(tmp_path: Path) -> None:
    path = write(tmp_path, prediction(0.06))
    (tmp_path / "m_input.json").write_text(json.dumps(input_to_official(parse_graph(CABINET))))
    read = read_prediction(path)

    assert len(read.parts) == len(CABINET.parts)  # what is new is not of the input
    for part, true in zip(read.parts, CABINET.parts, strict=True):
        np.testing.assert_allclose(part.mesh.box.low, true.box.low, atol=1e-6)
    require_decoded_on(CABINET, attach_motions(CABINET, read))


def test_the_object_may_be_turned(tmp_path: Path) -> None:
    from dataclasses import replace

    from grafu.asset.part import Frame

    R = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    T = from_rotation(2.0 * R, np.array([1.0, 2.0, 3.0]))  # from the input, in which was predicted, to the object frame
    parts = tuple(replace(p, surfaces=tuple(s.transformed(T) for s in p.surfaces)) for p in CABINET.parts)
    turned = replace(CABINET, parts=parts, joints=(), frame=Frame(T, "+Z", "+X", 2.0))
    found = attach_motions(turned, read_prediction(write(tmp_path, prediction(0.01))))

    for joint in found.joints:
        hinge = next((h for h in COMPLETED.hinges if h.child == joint.part), None)
        if hinge is not None:
            there = hinge_to_axis(CABINET.part(joint.part).box, hinge.border, hinge.sign).transformed(T)
            np.testing.assert_allclose(joint.axis.direction, there.direction, atol=1e-9)
            assert there.distance_to(joint.axis.point) < 1e-6


def test_a_drawer_comes_out_as_far_as_it_goes_and_a_door_a_quarter_turn(tmp_path: Path) -> None:
    found = attach_motions(CABINET, read_prediction(write(tmp_path, prediction())))
    asked = {request.moving: request.reference for request in plan_from_annotation(found).joints}

    assert asked == {"door_left": pytest.approx(np.pi / 2), "door_right": pytest.approx(np.pi / 2), "drawer": None}
    assert found.part("drawer").label is PartLabel.DRAWER


@pytest.mark.parametrize(
    ("damage", "why"),
    [
        (lambda d: d.pop("edges"), "holds no predicted nodes: expected the authors' <model>_pred.json"),
        (lambda d: d.update(nodes=[]), "holds no predicted nodes"),
        (lambda d: d["nodes"]["slot00_side_panel"].update(slot=1), "each slot must be used once"),
        (
            lambda d: d["nodes"]["slot00_side_panel"].update(slot=-1),
            "`slot` of node `slot00_side_panel` must be an integer",
        ),
        (lambda d: d["nodes"]["slot00_side_panel"].pop("obb"), "`obb`"),
        (lambda d: d["nodes"].update(slot99_x=3), "slot"),
        (lambda d: d["edges"].append(3), "an edge"),
        (lambda d: d["edges"][0].update(hinge_border_4=9, kind="hinge", hinge_axis_sign=0), "hinge_border_4"),
    ],
)
def test_damaged_predictions_are_refused_in_one_line(damage: Any, why: str, tmp_path: Path) -> None:
    data = prediction()
    damage(data)
    with pytest.raises(UnreadableAsset, match=why) as error:
        read_prediction(write(tmp_path, data))
    assert "\n" not in str(error.value)


def test_what_is_not_json_is_refused(tmp_path: Path) -> None:
    (tmp_path / "m_pred.json").write_text("nodes")
    with pytest.raises(UnreadableAsset, match="is not JSON"):
        read_prediction(tmp_path / "m_pred.json")
