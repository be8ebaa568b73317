import shutil

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from grafu.asset.load import load_asset
from grafu.errors import AssetError
from small_assets import mesh_of, write_glb, write_grouped_obj, write_pnm, write_urdf

KINDS = ["a.obj", "a.glb", "a.ply", "a.stl", "cabinet.urdf", "m/mobility_v2.json", "m/result.json"]
DAMAGE = st.lists(
    st.tuples(
        st.floats(0, 1), st.integers(0, 12), st.sampled_from([b"", b"-1", b"nan", b"null", b"[]", b"\xff", b"9" * 9])
    ),
    min_size=1,
    max_size=3,
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("whole")
    write_grouped_obj(place / "a.obj")
    write_glb(place / "a.glb")
    write_urdf(place)
    write_pnm(place / "m")
    for suffix in ("ply", "stl"):
        mesh_of("shelf-6").to_trimesh().export(place / f"a.{suffix}")
    return place


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.sampled_from(KINDS), DAMAGE)
def test_damage_is_read_or_refused_in_one_line_and_never_crashes(folder, kind, damage):
    path = folder / kind
    whole = path.read_bytes()
    data = whole
    for place, cut, inserted in damage:
        at = int(place * len(data))
        data = data[:at] + inserted + data[at + cut :]
    path.write_bytes(data)
    said = ""
    try:
        load_asset(path.parent if "/" in kind else path)
    except AssetError as error:
        said = str(error)
    finally:
        path.write_bytes(whole)
    assert "\n" not in said


def test_an_input_that_cannot_be_opened_says_why(tmp_path):
    write_pnm(tmp_path / "m")
    shutil.rmtree(tmp_path / "m" / "textured_objs")
    with pytest.raises(AssetError, match="no part with faces"):
        load_asset(tmp_path / "m")
    (tmp_path / "dir.obj").mkdir()
    with pytest.raises(AssetError, match="is empty"):
        load_asset(tmp_path / "dir.obj")
