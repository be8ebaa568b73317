"""`mobility.urdf` of the data set is Y up below its base joint; another maker's of that name is what it states."""

import pytest
import trimesh

from grafu.asset.load import load_asset

BOX = '<visual name="{name}"><origin xyz="{at}"/><geometry><box size="{size}"/></geometry></visual>'
MESH = '<visual name="{name}"><geometry><mesh filename="{name}.{suffix}"/></geometry></visual>'
URDF = """<robot name="made"><link name="base"/><link name="link_0">{visuals}</link>
<joint name="j" type="fixed"><origin rpy="{rpy}"/><parent link="base"/><child link="link_0"/></joint></robot>"""
OF_THE_SET = "1.5707963267948966 0 -1.5707963267948966"


def written(folder, visuals, rpy="0 0 0"):
    folder.mkdir()
    (folder / "mobility.urdf").write_text(URDF.format(visuals=visuals, rpy=rpy))
    return folder


def boxes(*sizes):
    placed = ((f"part_{k}", f"0 0 {0.3 + k}", size) for k, size in enumerate(sizes))
    return "".join(BOX.format(name=name, at=at, size=size) for name, at, size in placed)


@pytest.mark.parametrize(("rpy", "up", "unit"), [(OF_THE_SET, "+Y", False), ("0 0 0", "+Z", True)])
def test_the_base_joint_tells_the_data_set_from_others(tmp_path, rpy, up, unit):
    asset = load_asset(written(tmp_path / "m", boxes("1.2 0.5 0.6", "1.2 0.4 0.02"), rpy))
    assert asset.frame.up == up
    assert (asset.frame.scale == 1.0) is unit


def test_a_turned_base_of_another_maker_says_where_up_is(tmp_path):
    asset = load_asset(written(tmp_path / "m", boxes("1.2 0.5 0.6", "1.2 0.4 0.02"), "0 1.5707963267948966 0"))
    assert asset.frame.up == "-X"


@pytest.mark.parametrize(("suffix", "up"), [("glb", "+Y"), ("stl", "+Z")])
def test_gltf_meshes_that_stand_on_y_are_y_up(tmp_path, suffix, up):
    folder = written(tmp_path / "m", MESH.format(name="case", suffix=suffix) + MESH.format(name="leaf", suffix=suffix))
    for name, size, middle in (
        ("case", (1.0, 0.8, 0.4), (0.0, 0.4, 0.0)),
        ("leaf", (0.9, 0.7, 0.02), (0.0, 0.4, 0.21)),
    ):
        mesh = trimesh.creation.box(size)
        mesh.apply_translation(middle)
        mesh.export(folder / f"{name}.{suffix}")
    assert load_asset(folder).frame.up == up


PULL = """<robot name="made"><link name="case">{case}</link><link name="upper_tray">{tray}</link>
<joint name="j" type="fixed"><parent link="case"/><child link="upper_tray"/></joint></robot>"""


def test_a_urdf_of_boxes_is_a_robot_and_its_links_are_parts(tmp_path):
    folder = tmp_path / "m"
    folder.mkdir()
    tray = boxes("0.9 0.4 0.02", "0.9 0.02 0.2").replace("part_", "board_")
    (folder / "mobility.urdf").write_text(PULL.format(case=boxes("1.2 0.5 0.6", "1.2 0.4 0.02"), tray=tray))
    asset = load_asset(folder)
    assert (asset.kind, asset.name) == ("urdf", "m")
    assert [part.source.link for part in asset.parts].count("upper_tray") == 1
    (folder / "semantics.txt").write_text("")
    assert load_asset(folder).kind == "partnet-mobility"
