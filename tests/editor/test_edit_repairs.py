"""What is wrong in a model, in the editor: a collision in red, parts that are shells of one, parts left out."""

import json
from collections.abc import Iterator

import numpy as np
import pytest
from edit_page import Server, opened, settled, shown, wait
from editing import DOOR, DRAWER, write_model

from grafu.asset.part import Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import PartLabel

pytestmark = pytest.mark.slow
PARTS = "Object.keys(grafuEditor.state.sides)"


def blocks(name: str, *boxes: tuple[tuple[float, ...], tuple[float, ...]]) -> Part:
    """Returns a part of some boxes, each a shell."""
    shells = [Surface(TriangleMesh.box_mesh(Box(np.array(low), np.array(high)))) for low, high in boxes]
    return Part(name, PartLabel.UNKNOWN, tuple(shells), PartSource(name, ""))


BEAM = blocks("beam", ((-0.3, -0.275, 0.5), (0.1, -0.26, 0.6)))  # sticks in the door
POST = blocks("post", ((-0.3, -0.4, 0.0), (-0.25, 0.3, 0.6)))
RACK = blocks("rack", ((-0.2, 0.0, 0.4), (0.2, 0.2, 0.42)), ((-0.2, 0.0, 0.6), (0.2, 0.15, 0.62)))


@pytest.fixture(scope="module")
def wrong(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    pytest.importorskip("starlette")
    folder = tmp_path_factory.mktemp("wrong")
    server = Server(str(write_model(folder / "wrong.glb", BEAM, POST, RACK)), "--out", str(folder / "out"))
    yield server
    server.kill()


@pytest.fixture
def page(browser, wrong):
    opened(browser, wrong)
    yield browser
    assert browser.complaints(wrong.address) == []


def click(page, button: str) -> None:
    """Clicks a button by the mouse, as it is seen."""
    box = f"document.querySelector({button!r}).scrollIntoView({{block: 'center'}})"
    place = (
        f"((b) => [b.x + b.width / 2, b.y + b.height / 2])(document.querySelector({button!r}).getBoundingClientRect())"
    )
    page.run(box)
    page.drag(tuple(page.run(place)))


def changed(page, act, *given) -> None:
    number = shown(page)
    act(page, *given)
    settled(page, number + 1)


def test_a_collision_is_seen_in_red_and_is_gone_once_the_door_is_fixed(page):
    assert page.run("grafuEditor.state.collisions") == {DOOR: {"value": 0, "others": ["beam"]}}
    page.run(f"grafuEditor.pick({DOOR!r})")
    click(page, "[data-do=collision]")
    clashing = "[...grafuEditor.view.view.clashing].map((k) => grafuEditor.view.scene.items[k].name)"
    assert {DOOR, "beam"} <= set(page.run(clashing))
    click(page, "[data-do=collision]")
    assert page.run(clashing) == []
    changed(page, click, "[data-do=reject]")
    assert page.run("document.querySelector('[data-do=collision]').hidden")
    assert page.run("grafuEditor.state.collisions") == {}
    changed(page, click, "[data-do=undo]")


def test_shells_become_parts_and_parts_are_joined_again(page):
    before = page.run(PARTS)
    page.run("grafuEditor.pick('rack')")
    changed(page, lambda page: page.press("s", "KeyS"))
    assert page.run(PARTS) == [*before, "rack_2"]
    for part in ("rack", "rack_2"):
        page.run(f"grafuEditor.pick({part!r})")
    assert page.run("document.querySelector('[data-do=join]').textContent") == "Join with rack"
    changed(page, click, "[data-do=join]")
    assert page.run(PARTS) == before
    assert page.run("grafuEditor.inspector.part") == "rack"
    changed(page, click, "[data-do=undo]")
    changed(page, click, "[data-do=undo]")


def test_a_chosen_handle_is_left_out_and_chosen_again(page):
    added = "grafuEditor.state.report.added.filter((one) => one.category === 'handle').map((one) => one.part)"
    chosen = "document.querySelector('[data-choice=handle]').value"
    page.run(f"grafuEditor.pick({DRAWER!r})")
    changed(page, lambda page: page.run(f"grafuEditor.choose('handle', {DRAWER!r}, 'knob-round')"))
    (handle,) = page.run(added)
    page.run(f"grafuEditor.pick({handle!r})")
    changed(page, click, "[data-do=reject]")
    assert page.run(f"[{added}, document.activeElement.id]") == [[], "pick"]
    page.run(f"grafuEditor.pick({DRAWER!r})")
    assert page.run(chosen) == "none"
    for style, handles in (("knob-round", [handle]), (None, [])):
        changed(
            page, lambda page, style=style: page.run(f"grafuEditor.choose('handle', {DRAWER!r}, {json.dumps(style)})")
        )
        assert page.run(f"[{added}, {chosen}]") == [handles, style or ""]
    for _ in range(4):
        changed(page, click, "[data-do=undo]")
    assert page.run(added) == []


def test_a_drawer_is_dragged_along_its_rails_where_it_is_seen(page):
    page.run(f"grafuEditor.view.camera.reset(); grafuEditor.view.closeAll(); grafuEditor.pick({DRAWER!r})")
    page.run("document.querySelector('canvas').scrollIntoView({block: 'center'})")
    index = f"grafuEditor.view.itemNamed({DRAWER!r})"
    seen = page.run(
        "((v, k) => {const b = v.canvas.getBoundingClientRect(), found = [];"
        "for (let y = 0.02; y < 1; y += 0.02) for (let x = 0.02; x < 1; x += 0.02)"
        " if (v.at(x, y) === k) found.push([x, y]);"
        "const [x, y] = found[found.length >> 1]; return [b.x + x * b.width, b.y + y * b.height, b.width, b.height];"
        f"}})(grafuEditor.view, {index})"
    )
    x, y, width, height = seen
    joint = f"grafuEditor.view.jointOf({index})"
    along = page.run(f"grafuEditor.view.screenMotion({index}, {joint})")
    fraction = f"grafuEditor.view.joints.fraction({joint})"
    steps = [(x + 0.1 * k * along[0] * width, y + 0.1 * k * along[1] * height) for k in range(6)]
    page.drag(*steps)
    assert 0.3 < page.run(fraction) < 0.7  # half of the way
    page.drag(*reversed(steps))
    assert page.run(fraction) < 0.1
    wait(page, "!grafuEditor.building")
