"""The page of a model as a file: it parses, needs no network, escapes names, and holds what the report holds."""

import re
from importlib.resources import files

import numpy as np
from made_models import ATTACK, BLUE, GLASS
from page_reader import PageReader, buffer_of, normals_of, scene_of, triangles_of

from grafu.articulation.articulated_object import ArticulatedObject, Link
from grafu.export.shading import corner_normals
from grafu.viewer.model_page import model_page
from grafu.viewer.pictures import Stills
from grafu.viewer.report_tables import plain_rows

ADDRESS = re.compile(r"""(?:https?:)?//[a-z0-9.-]+\.[a-z]{2,}|url\(|@import|\bimport\(|fetch\(""", re.IGNORECASE)
XML_NAMES = ("http://www.w3.org/2000/svg",)


def test_the_page_parses_and_stands_alone(page):
    read = PageReader(page)

    assert page.startswith("<!DOCTYPE html>")
    assert [e for e in read.all("script") if "src" in e] == []
    assert [e for e in read.all("link") if e["href"] != "data:,"] == []
    assert all((image["src"] or "").startswith("data:image/webp;base64,") for image in read.all("img"))
    assert read.all("img")


def test_the_page_names_no_address_at_all(page):
    read = PageReader(page)
    text = page.replace(read.text_of("geometry"), "")
    for name in XML_NAMES:
        text = text.replace(name, "")

    assert ADDRESS.findall(re.sub(r"data:[a-z/]+;base64,[A-Za-z0-9+/=]+", "", text)) == []


def test_the_policy_lets_nothing_in(page):
    [policy] = PageReader(page).all("meta", http_equiv="Content-Security-Policy")

    assert "default-src 'none'" in policy["content"]
    assert "unsafe" not in policy["content"]


def test_a_name_that_is_markup_stays_a_name(page):
    read = PageReader(page)

    assert ATTACK not in page
    assert [e for e in read.all("img") if "onerror" in e] == []
    assert len(read.all("script")) == 3  # the data, the geometry, our own
    title = next(read.texts[k] for k, (tag, _) in enumerate(read.elements) if tag == "h1")
    assert title == ATTACK
    assert ATTACK in {item["source"] for item in scene_of(read)["items"]}


def test_every_joint_has_its_slider_with_its_limits(page, made):
    read = PageReader(page)
    joints = made.result.object.moving_joints
    sliders = read.all("input", type="range")

    assert [joint["id"] for joint in scene_of(read)["joints"]] == [joint.id for joint in joints]
    assert [slider["data-joint"] for slider in sliders] == [str(k) for k in range(len(joints))]
    labels = {e["for"] for e in read.all("label") if "for" in e}
    assert {slider["id"] for slider in sliders} <= labels


def test_ids_are_unique(page):
    ids = [found["id"] for _, found in PageReader(page).elements if "id" in found]
    assert len(set(ids)) == len(ids)


def test_the_meshes_come_back_within_the_quantisation(page, made):
    read = PageReader(page)
    scene, buffer = scene_of(read), buffer_of(read)
    links = made.result.object.links_from_root
    visuals = [(k, visual) for k, link in enumerate(links) for visual in link.visuals]

    assert [(item["link"], item["name"]) for item in scene["items"]] == [(k, v.name) for k, v in visuals]
    for item, (_, visual) in zip(scene["items"], visuals, strict=True):
        solid = [s for s in visual.surfaces if len(s.mesh.faces)]
        for piece, surface in zip(item["pieces"], solid, strict=True):
            off = np.abs(triangles_of(scene, buffer, piece) - surface.mesh.triangles)
            assert off.max() <= max(piece["size"]) / 65535
            shading = corner_normals(surface)
            expected = shading.normals[np.asarray(shading.corners)]
            assert np.einsum("fck,fck->fc", normals_of(scene, buffer, piece), expected).min() > 0.999


def test_looks_are_kept(page):
    read = PageReader(page)
    scene = scene_of(read)
    looks = {item["name"]: scene["materials"][item["pieces"][0]["material"]] for item in scene["items"]}
    doors = [look for name, look in looks.items() if name.startswith("door")]

    assert all(tuple(door["color"]) == BLUE for door in doors)
    assert doors
    glass = next(look for name, look in looks.items() if name.startswith("side_panel_right"))
    assert (glass["mode"], glass["color"][3]) == ("BLEND", GLASS.base_color[3])
    wood = next(look for name, look in looks.items() if name.startswith("side_panel_left"))
    assert scene["textures"][wood["texture"]].startswith("data:image/png;base64,")


def test_equal_hardware_is_stored_once(page):
    scene = scene_of(PageReader(page))
    pieces = [piece for item in scene["items"] if item["role"] == "hardware" for piece in item["pieces"]]

    assert len({piece["mesh"] for piece in pieces}) < len(pieces)


def test_the_page_says_what_the_report_says(page, made):
    text = " ".join(PageReader(page).texts.values())

    for joint in made.report.joints:
        assert f"{joint.count} × {joint.template}" in text
        assert joint.mount in text
    for added in made.report.added:
        assert added.why in text
    for assumed in made.report.frame.assumed:
        assert assumed in text


def test_cells_are_escaped():
    assert "<b>" not in plain_rows(("a",), [("<b>",)], "<b>")


def test_scripts_and_styles_stay_under_300_lines():
    folder = files("grafu.viewer") / "templates"
    lengths = {path.name: len(path.read_text(encoding="utf-8").splitlines()) for path in folder.iterdir()}

    assert len(lengths) > 10
    assert max(lengths.values()) < 300


def test_a_model_that_does_not_move_has_a_page(made):
    still = ArticulatedObject("still", "base", (Link("base", ()),))
    report = made.report.with_changes(joints=(), added=())
    stills = Stills(b"", b"", b"")

    read = PageReader(model_page(made.result.asset, still, made.result.completion, report, stills))

    assert read.all("input", type="range") == []
    assert scene_of(read)["items"] == []


def test_the_page_says_that_the_input_states_joints_which_nobody_read(page, made):
    motion = made.report.motion.with_changes(stated_joints=2, unused_joints=2)
    report = made.report.with_changes(motion=motion)
    stills = Stills(b"", b"", b"")
    said = model_page(made.result.asset, made.result.object, made.result.completion, report, stills)

    assert "states 2 joints; --motion annotation builds them" in " ".join(PageReader(said).texts.values())
    assert "--motion annotation" not in " ".join(PageReader(page).texts.values())
