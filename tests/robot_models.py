"""The small cabinet as robots in formats other than URDF: SDF and MJCF, written by our own code."""

from pathlib import Path

import numpy as np
import pytest

from small_assets import CABINET, DOOR, DRAWER, HINGE, write_obj_folder

STATIC = [name for name in CABINET if name not in DOOR + DRAWER]


def _middle(name: str, at: tuple[float, ...] = (0, 0, 0)) -> str:
    low, high = CABINET[name]
    return " ".join(f"{(a + b) / 2 - o:.9g}" for a, b, o in zip(low, high, at, strict=True))


def _size(name: str, factor: float = 1.0) -> str:
    low, high = CABINET[name]
    return " ".join(f"{factor * (b - a):.9g}" for a, b in zip(low, high, strict=True))


def sdf_text(extra: str = "", looks: str = "", boxes: tuple[str, ...] = ()) -> str:
    """Returns an SDF of the cabinet; `boxes` are drawn as boxes, the others are meshes behind `model://`."""
    x, y, z = HINGE[0]

    def link(name: str, names: tuple[str, ...] | list[str], at: tuple[float, ...] = (0, 0, 0)) -> str:
        back = " ".join(str(-v) for v in at)
        visuals = "".join(
            f'<visual name="{n}"><pose relative_to="base">{_middle(n)} 0 0 0</pose>'
            f"<geometry><box><size>{_size(n)}</size></box></geometry>{looks}</visual>"
            if n in boxes
            else f'<visual name="{n}"><pose>{back} 0 0 0</pose><geometry><mesh>'
            f"<uri>model://cabinet/meshes/{n}.obj</uri></mesh></geometry>{looks}</visual>"
            for n in names
        )
        return f'<link name="{name}"><pose>{" ".join(map(str, at))} 0 0 0</pose>{visuals}</link>'

    return (
        '<?xml version="1.0"?><sdf version="1.7"><model name="cabinet"><pose>1 2 0 0 0 0</pose>'
        f"{link('base', STATIC)}{link('door_link', DOOR, (x, y, z))}{link('drawer_link', DRAWER)}"
        '<joint name="door_joint" type="revolute"><parent>base</parent><child>door_link</child>'
        "<axis><xyz>0 0 -1</xyz><limit><lower>0</lower><upper>1.5</upper></limit></axis></joint>"
        '<joint name="drawer_joint" type="prismatic"><parent>base</parent><child>drawer_link</child>'
        "<axis><xyz>0 -1 0</xyz><limit><lower>0</lower><upper>0.3</upper></limit></axis></joint>"
        f"{extra}</model></sdf>"
    )


def write_sdf(folder: Path, text: str | None = None) -> Path:
    write_obj_folder(folder / "meshes")
    (folder / "model.sdf").write_text(sdf_text() if text is None else text)
    return folder / "model.sdf"


def mjcf_text(extra: str = "", boxes: tuple[str, ...] = (), sections: str = "", within: str = "") -> str:
    """Returns an MJCF of the cabinet; `boxes` are drawn as boxes, the others are meshes in `meshes/`."""
    x, y, z = HINGE[0]

    def geoms(names: tuple[str, ...] | list[str], at: tuple[float, ...] = (0, 0, 0)) -> str:
        pos = " ".join(str(-v) for v in at)
        return "".join(
            f'<geom name="{n}" type="box" size="{_size(n, 0.5)}" pos="{_middle(n, at)}" material="oak"/>'
            if n in boxes
            else f'<geom name="{n}" class="visual" mesh="{n}" pos="{pos}"/>'
            for n in names
        )

    meshes = "".join(f'<mesh file="{name}.obj"/>' for name in CABINET if name not in boxes)
    return (
        '<mujoco model="cabinet"><compiler angle="degree" meshdir="meshes" autolimits="true"/>'
        '<default><geom rgba="0.5 0.4 0.3 1"/><mesh scale="1 1 1"/><default class="visual">'
        '<geom type="mesh" contype="0" conaffinity="0" group="2" mass="0"/></default></default>'
        f'<asset>{meshes}<material name="oak" rgba="0.6 0.4 0.2 1"/></asset>{sections}'
        f'<worldbody><light pos="0 0 3"/><geom name="floor" type="plane" size="5 5 1"/>'
        f'<body name="base" pos="1 2 0">{geoms(STATIC)}<site name="s"/>'
        '<geom name="collision_1" type="box" size="0.5 0.5 2" group="3"/>'
        f'<body name="door_link" pos="{x} {y} {z}"><joint name="door_joint" axis="0 0 -1" range="0 85.9436692696"/>'
        f"{geoms(DOOR, (x, y, z))}</body>"
        '<body name="drawer_link"><joint name="drawer_joint" type="slide" axis="0 -1 0" range="0 0.3"/>'
        f"{geoms(DRAWER)}</body>{within}</body></worldbody>{extra}</mujoco>"
    )


def write_mjcf(folder: Path, text: str | None = None) -> Path:
    write_obj_folder(folder / "meshes")
    (folder / "cabinet.xml").write_text(mjcf_text() if text is None else text)
    return folder / "cabinet.xml"


def assert_same_robot(asset, urdf):
    """Whether two assets that were read as annotated have the same parts and joints."""
    assert {p.id: (p.label, p.carried_by) for p in asset.parts} == {p.id: (p.label, p.carried_by) for p in urdf.parts}
    for part in asset.parts:
        np.testing.assert_allclose(part.box.low, urdf.part(part.id).box.low, atol=1e-6)
        np.testing.assert_allclose(part.box.high, urdf.part(part.id).box.high, atol=1e-6)
    assert len(asset.joints) == len(urdf.joints)
    for found, stated in zip(asset.joints, urdf.joints, strict=True):
        assert (found.part, found.type, found.limited) == (stated.part, stated.type, stated.limited)
        assert (found.lower, found.upper) == pytest.approx((stated.lower, stated.upper), abs=1e-6)
        np.testing.assert_allclose(found.axis.direction, stated.axis.direction, atol=1e-9)
        if found.type.value == "revolute":
            between = np.cross(found.axis.point - stated.axis.point, stated.axis.direction)
            np.testing.assert_allclose(between, np.zeros(3), atol=1e-6)
