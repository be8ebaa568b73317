"""A GLB of ours read back is the object that was written; any other file is refused in one line."""

import json
import struct
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual, VisualRole
from grafu.asset.options import Limits
from grafu.errors import ArticulationError, AssetTooLarge, UnreadableAsset
from grafu.export.glb import export_glb
from grafu.export.glb_object import read_glb_object
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.vocabulary import JointType, PartLabel


def written(articulated: ArticulatedObject, path: Path) -> ArticulatedObject:
    path.write_bytes(export_glb(articulated)["model.glb"])
    return read_glb_object(path)


def chunks(data: bytes) -> tuple[dict, bytes]:
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20 : 20 + length]), data[20 + length :]


def with_document(data: bytes, change) -> bytes:
    document, rest = chunks(data)
    change(document)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<II", len(text), 0x4E4F534A) + text + rest
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


def assert_same(read: ArticulatedObject, made: ArticulatedObject) -> None:
    assert (read.name, read.root) == (made.name, made.root)
    assert {link.id for link in read.links} == {link.id for link in made.links}
    for joint in made.joints:
        found = read.joint_of[joint.child]
        assert replace(found, axis=joint.axis) == joint
        assert found.axis.direction == pytest.approx(joint.axis.direction, abs=1e-12)
        assert np.linalg.norm(joint.axis.closest_point(found.axis.point) - found.axis.point) < 1e-6
    for link in made.links:
        visuals = read.link(link.id).visuals
        assert [(v.name, v.role, v.label) for v in visuals] == [(v.name, v.role, v.label) for v in link.visuals]
        for mine, theirs in zip(visuals, link.visuals, strict=True):
            if len(theirs.mesh.faces):
                assert mine.mesh.box.low == pytest.approx(theirs.mesh.box.low, abs=1e-5)
                assert mine.mesh.box.high == pytest.approx(theirs.mesh.box.high, abs=1e-5)
                assert mine.mesh.area == pytest.approx(theirs.mesh.area, rel=1e-4)
            materials = {surface.material for surface in theirs.surfaces if not surface.is_empty}
            assert {surface.material for surface in mine.surfaces} == materials


def test_what_was_written_comes_back(cabinet, tmp_path):
    assert_same(written(cabinet, tmp_path / "model.glb"), cabinet)


def test_a_second_writing_loses_nothing_more(cabinet, tmp_path):
    once = written(cabinet, tmp_path / "model.glb")
    twice = written(once, tmp_path / "again.glb")
    assert_same(twice, once)
    (first, _), (second, _) = (chunks((tmp_path / name).read_bytes()) for name in ("model.glb", "again.glb"))
    for name in ("materials", "meshes", "animations"):
        assert first[name] == second[name]


@pytest.mark.parametrize("type_", [JointType.REVOLUTE, JointType.PRISMATIC, JointType.FIXED])
def test_a_link_on_a_moving_link_with_a_slanted_axis(make_cube, tmp_path, type_):
    axis = Axis(vec3(0.3, -0.2, 0.7), np.array([1.0, 2.0, 2.0]) / 3.0)
    first = Joint("a", JointType.PRISMATIC, "root", "mid", axis, JointLimits(0.0, 0.3))
    second = Joint("b", type_, "mid", "tip", axis, JointLimits(0.0, 0.0 if type_ is JointType.FIXED else 1.0), ("a",))
    links = (
        Link("root", ()),
        Link("mid", (Visual("x", (), VisualRole.ADDED, PartLabel.SHELF),)),
        Link("tip", make_cube().link("body").visuals),
    )
    chain = ArticulatedObject("Größe 1", "root", links, (first, second))
    assert_same(written(chain, tmp_path / "chain.glb"), chain)


@pytest.mark.parametrize("data", [b"", b"glTF", b"\x89PNG" * 10])
def test_damaged_files_are_one_line(tmp_path, data):
    (tmp_path / "model.glb").write_bytes(data)
    with pytest.raises(UnreadableAsset) as caught:
        read_glb_object(tmp_path / "model.glb")
    assert "\n" not in str(caught.value)


def test_a_glb_of_somebody_else_is_refused():
    with pytest.raises(UnreadableAsset, match=r"is no model\.glb of grafu"):
        read_glb_object(Path(__file__).parents[2] / "samples" / "chest.glb")


@pytest.mark.parametrize(
    "change",
    [
        lambda d: d["nodes"][0]["extras"]["grafu"].update(link=None),
        lambda d: d["nodes"][-1]["extras"].update(grafu=7),
        lambda d: d["nodes"][0]["children"].append(0),
        lambda d: d["nodes"][0]["children"].append(99),
        lambda d: d["nodes"][0].update(children=3),
        lambda d: d.update(scenes=[]),
        *[
            lambda d, key=key: next(n for n in d["nodes"] if "joint" in n["extras"]["grafu"])["extras"]["grafu"][
                "joint"
            ].pop(key)
            for key in ("id", "axis", "upper", "after")
        ],
    ],
)
def test_a_file_that_was_tampered_with_is_one_line(cabinet, tmp_path, change):
    (tmp_path / "model.glb").write_bytes(with_document(export_glb(cabinet)["model.glb"], change))
    with pytest.raises((UnreadableAsset, ArticulationError)) as caught:
        read_glb_object(tmp_path / "model.glb")
    assert "\n" not in str(caught.value)


def test_a_file_that_is_too_large_is_refused(cabinet, tmp_path):
    (tmp_path / "model.glb").write_bytes(export_glb(cabinet)["model.glb"])
    with pytest.raises(AssetTooLarge):
        read_glb_object(tmp_path / "model.glb", Limits(max_faces=10))
