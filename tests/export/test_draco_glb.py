"""GLBs compressed by Draco: what another decoder finds in them is the plain file to a twentieth of a millimetre."""

from dataclasses import fields

import numpy as np
import pytest
import trimesh
from draco_decoding import decoded
from glb_reader import Glb
from gltf_validation import issues_of
from scipy.spatial import cKDTree
from small_cabinet import WOOD, painted_cube

from grafu.asset.load import load_asset
from grafu.errors import ExportError
from grafu.export import gltf_packing
from grafu.export.files import write_files
from grafu.export.formats import export, exporter_for
from grafu.export.glb import export_glb, export_merged_glb
from grafu.export.glb_draco import export_draco_glb, export_merged_draco_glb
from grafu.export.gltf_packing import DracoConfig
from grafu.geometry.mesh import TriangleMesh
from grafu.graph.parse import parse_graph

pytest.importorskip("DracoPy")

AWAY = np.array([0.1234567, -0.7654321, 0.5])
NAME = "KHR_draco_mesh_compression"
HALF_STEP = 0.5 * DracoConfig().step + 1e-6  # metres; and what a float adds
PLAIN_AND_PACKED = [
    (export_glb, "model.glb", export_draco_glb, "model_draco.glb"),
    (export_merged_glb, "model_merged.glb", export_merged_draco_glb, "model_merged_draco.glb"),
]
EACH_KIND = pytest.mark.parametrize(
    ("plain", "name", "packed", "packed_name"), PLAIN_AND_PACKED, ids=["parts", "merged"]
)


def ball() -> TriangleMesh:
    made = trimesh.creation.icosphere(4, 0.2)
    return TriangleMesh(np.asarray(made.vertices) + AWAY, np.asarray(made.faces))


def painted_ball():
    mesh = ball()
    colors = np.column_stack([np.arange(len(mesh.vertices)) % 251, *[np.full(len(mesh.vertices), 200)] * 3])
    return painted_cube(mesh=mesh, material=WOOD, uv=mesh.vertices[:, :2] * 7.0, colors=colors.astype(np.uint8))


def triangles_of(arrays: dict, indices: np.ndarray, name: str) -> np.ndarray:
    return arrays[name][indices.reshape(-1, 3)]


def paired(before: np.ndarray, after: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns for each triangle of `after` the one of `before` that it was, and by how many corners it is rotated."""
    _, of = cKDTree(before.mean(axis=1)).query(after.mean(axis=1))
    turned = np.stack([np.abs(np.roll(after, k, axis=1) - before[of]).max(axis=(1, 2)) for k in range(3)])
    return of, turned.argmin(axis=0)


def matched(before: np.ndarray, after: np.ndarray, of: np.ndarray, turn: np.ndarray) -> np.ndarray:
    """Returns the greatest difference of each corner's attribute."""
    rolled = np.stack([np.roll(after, k, axis=1) for k in range(3)])[turn, np.arange(len(after))]
    return np.abs(rolled - before[of]).max(axis=-1)


@pytest.mark.parametrize("make", [None, painted_ball], ids=["cabinet", "ball"])
@EACH_KIND
def test_another_decoder_finds_each_triangle_with_all_attributes(
    cabinet, tmp_path, make, plain, name, packed, packed_name
):
    made = cabinet if make is None else make()
    before, data = Glb.parse(plain(made)[name]), packed(made)[packed_name]
    found = decoded(data, tmp_path)

    assert len(found) == len(before.tables["meshes"])
    for mesh, primitives in zip(before.tables["meshes"], found, strict=True):
        for primitive, one in zip(mesh["primitives"], primitives, strict=True):
            arrays = {key: before.array(at).astype(float) for key, at in primitive["attributes"].items()}
            corners = before.array(primitive["indices"])
            assert arrays.keys() == one.keys() - {"indices"}
            was, now = (triangles_of(a, i, "POSITION") for a, i in ((arrays, corners), (one, one["indices"])))
            of, turn = paired(was, now)
            assert sorted(of) == list(range(len(was)))
            limits = {
                "POSITION": HALF_STEP,
                "NORMAL": 0.01,
                "TEXCOORD_0": 1.0 / 16384,
                "COLOR_0": 0.01,
            }  # of 255 levels: what floats add
            for key in arrays:
                scale = 255.0 if key == "COLOR_0" and one[key].max() <= 1.0 else 1.0
                after = scale * triangles_of(one, one["indices"], key)
                assert matched(triangles_of(arrays, corners, key), after, of, turn).max() <= limits[key], key


@EACH_KIND
def test_all_but_meshes_is_as_in_the_plain_file(cabinet, plain, name, packed, packed_name):
    before, after = Glb.parse(plain(cabinet)[name]), Glb.parse(packed(cabinet)[packed_name])

    for table in ("asset", "scene", "scenes", "nodes", "materials", "textures", "samplers"):
        assert after.tables[table] == before.tables[table], table
    assert [m["name"] for m in after.tables["meshes"]] == [m["name"] for m in before.tables["meshes"]]
    for old, new in zip(before.tables["images"], after.tables["images"], strict=True):
        assert after.view(new["bufferView"]) == before.view(old["bufferView"])
    for old, new in zip(before.tables["animations"], after.tables["animations"], strict=True):
        assert (old["name"], old["channels"]) == (new["name"], new["channels"])
        for a, b in zip(old["samplers"], new["samplers"], strict=True):
            assert np.array_equal(before.array(a["input"]), after.array(b["input"]))
            assert np.array_equal(before.array(a["output"]), after.array(b["output"]))


@EACH_KIND
def test_the_extension_is_required_and_the_official_validator_finds_no_error(
    cabinet, tmp_path, plain, name, packed, packed_name
):
    data = packed(cabinet)[packed_name]
    tables, issues = Glb.parse(data).tables, issues_of(data, tmp_path)

    assert tables["extensionsUsed"] == tables["extensionsRequired"] == [NAME]
    assert "extensionsUsed" not in Glb.parse(plain(cabinet)[name]).tables
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]


def test_accessors_describe_what_is_decoded(cabinet, tmp_path):
    data = export_draco_glb(cabinet)["model_draco.glb"]
    tables, found = Glb.parse(data).tables, decoded(data, tmp_path)

    for mesh, primitives in zip(tables["meshes"], found, strict=True):
        for primitive, one in zip(mesh["primitives"], primitives, strict=True):
            position = tables["accessors"][primitive["attributes"]["POSITION"]]
            assert position["count"] == len(one["POSITION"])
            assert tables["accessors"][primitive["indices"]]["count"] == one["indices"].size
            assert np.allclose(position["min"], one["POSITION"].min(axis=0), atol=1e-7)
            assert np.allclose(position["max"], one["POSITION"].max(axis=0), atol=1e-7)


def test_the_same_object_gives_the_same_bytes_and_fewer_than_plain() -> None:
    made = painted_ball()
    first, again = (export_draco_glb(made)["model_draco.glb"] for _ in range(2))

    assert first == again
    assert len(first) < 0.3 * len(export_glb(made)["model.glb"])


def test_it_is_read_back_as_the_same_parts_joints_and_graph(cabinet, tmp_path):
    write_files(export(cabinet, ["glb", "glb-draco"]), tmp_path / "out")
    plain, packed = (load_asset(tmp_path / "out" / name) for name in ("model.glb", "model_draco.glb"))

    assert {p.id: p.label for p in packed.parts} == {p.id: p.label for p in plain.parts}
    graphs = [parse_graph(asset) for asset in (plain, packed)]
    assert len({frozenset((e.a, e.b, type(e)) for e in graph.edges) for graph in graphs}) == 1
    assert graphs[0].edges
    for part in packed.parts:
        assert np.allclose(part.box.low, plain.part(part.id).box.low, atol=HALF_STEP)
        assert np.allclose(part.box.high, plain.part(part.id).box.high, atol=HALF_STEP)


def test_without_the_library_it_is_refused_in_one_line(cabinet, monkeypatch):
    monkeypatch.setattr(gltf_packing, "find_spec", lambda _: None)

    for name in ("glb-draco", "glb-merged-draco"):
        with pytest.raises(ExportError, match=r"need DracoPy: pip install 'grafu\[formats\]'$"):
            exporter_for(name)
    with pytest.raises(ExportError, match="need DracoPy"):
        export_draco_glb(cabinet)


def test_a_mesh_that_the_library_refuses_is_written_as_it_is(cabinet, monkeypatch, tmp_path):
    import DracoPy

    def refuses(*_args, **_options):
        raise DracoPy.EncodingFailedException("no")

    monkeypatch.setattr(DracoPy, "encode", refuses)
    data = export_draco_glb(cabinet)["model_draco.glb"]

    assert data == export_glb(cabinet)["model.glb"]


@pytest.mark.parametrize("name", [f.name for f in fields(DracoConfig)])
def test_a_config_refuses_what_is_not_above_zero(name: str) -> None:
    with pytest.raises(ValueError, match=f"`DracoConfig.{name}` must be above 0"):
        DracoConfig(**{name: type(getattr(DracoConfig(), name))(0)})


def test_triangles_with_two_corners_in_one_place_are_left_out_and_a_mesh_of_them_is_written_as_it_is(tmp_path):
    points = np.array([[0.0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 0]])
    whole = painted_cube(mesh=TriangleMesh(points, np.array([[0, 1, 2], [0, 3, 1]])))
    flat = painted_cube(mesh=TriangleMesh(points, np.array([[0, 3, 1]])))
    both = [export_draco_glb(made)["model_draco.glb"] for made in (whole, flat)]

    assert [len(one["indices"]) for mesh in decoded(both[0], tmp_path) for one in mesh] == [1]
    assert both[1] == export_glb(flat)["model.glb"]
    assert issues_of(both[0], tmp_path)["numErrors"] == 0
