"""What tells the unit of something shallow, and how a piece stands whose names are hidden."""

import pytest
import trimesh

from grafu.asset import settling
from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.asset.scale import estimate_scale, likely_unit
from grafu.geometry.box import Box
from small_scenes import box


@pytest.mark.parametrize(
    ("size", "unit"),
    [
        ((100.0, 17.0, 212.0), "centimetres"),
        ((60.0, 14.0, 70.0), "centimetres"),
        ((36.0, 18.0, 40.0), "inches"),
        ((390.0, 26.0, 220.0), "centimetres"),
    ],
    ids=["door in its frame", "wall cabinet", "sideboard", "door of a garage"],
)
def test_how_deep_something_shallow_is_does_not_tell_its_unit(size, unit):
    """Depth tells the unit of what stands on a floor; a door or a cabinet on a wall is less deep than furniture is."""
    parts = (box("object_1", (0.0, 0.0, 0.0), size), box("object_2", (1.0, -1.0, 1.0), (2.0, 0.0, 2.0)))
    estimate = estimate_scale(parts, Box.enclosing(part.box for part in parts), 2, None)

    assert likely_unit(max(size), estimate)[0] == unit


def test_what_is_deep_keeps_the_unit_that_its_depth_tells():
    parts = (box("object_1", (0.0, 0.0, 0.0), (390.0, 120.0, 220.0)),)
    assert likely_unit(390.0, estimate_scale(parts, parts[0].box, 2, None)) is None


def test_hidden_names_do_not_tell_how_a_piece_stands_before_it_is_cut(tmp_path, monkeypatch):
    stood = []
    cut = settling.cut_where_fronts_appear
    monkeypatch.setattr(
        settling, "cut_where_fronts_appear", lambda r, f, n: stood.append((f.up, f.front)) or cut(r, f, n)
    )
    cabinet = trimesh.Scene()
    for name, low, high in (
        ("top_panel", (0, 0, 0.7), (0.4, 0.4, 0.72)),
        ("bottom_panel", (0, 0, 0), (0.4, 0.4, 0.02)),
        ("side_panel", (0, 0, 0.02), (0.02, 0.4, 0.7)),
        ("back_panel", (0.02, 0, 0.02), (0.4, 0.02, 0.7)),
    ):
        cabinet.add_geometry(trimesh.creation.box(bounds=[low, high]), node_name=name, geom_name=name)
    lines, start = [], 1
    for name, mesh in cabinet.geometry.items():
        lines += [f"o {name}", *(f"v {x} {y} {z}" for x, y, z in mesh.vertices)]
        lines += [f"f {a + start} {b + start} {c + start}" for a, b, c in mesh.faces]
        start += len(mesh.vertices)
    text = "\n".join(lines)
    (tmp_path / "named.obj").write_text(text)
    for k, name in enumerate(cabinet.geometry):
        text = text.replace(f"o {name}", f"o Object_{k}")
    (tmp_path / "nameless.obj").write_text(text)
    for file, labels in (("named", "input"), ("named", "none"), ("nameless", "input")):
        load_asset(tmp_path / f"{file}.obj", LoadOptions(labels=labels))
    shown, hidden, nameless = stood

    assert hidden == nameless
    assert shown != hidden
