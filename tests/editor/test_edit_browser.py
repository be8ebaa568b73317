"""`grafu edit` in a real browser: a wrong hinge is set right, undone, the server is killed, opened again, exported."""

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from edit_page import Server, opened, place_of, settled, shown, side, wait
from editing import DOOR

from grafu.export.files import ExportFiles, write_files
from grafu.graph.serialize import dump_json
from grafu.joints.motion_choice import FIXED
from grafu.pipeline.settings import Settings, settings_from_bytes

pytestmark = pytest.mark.slow
ROOT = Path(__file__).parents[2]
AXE = ROOT / "node_modules" / "axe-core" / "axe.min.js"


@pytest.fixture
def out(tmp_path: Path) -> Path:
    return tmp_path / "out"


@pytest.fixture
def server(model: Path, out: Path) -> Iterator[Server]:
    """A server that the test may kill."""
    server = Server(str(model), "--out", str(out))
    yield server
    server.kill()


def saved(out: Path):
    return settings_from_bytes((out / "cabinet" / "settings.json").read_bytes(), "settings")


def test_a_wrong_hinge_is_set_right_undone_and_survives_the_server(browser, server, model, out):
    opened(browser, server)
    before = side(browser)
    other = "right" if before == "left" else "left"
    browser.drag(place_of(browser, DOOR))
    wait(browser, f"document.getElementById('pick').value === {DOOR!r}")
    wait(browser, "grafuEditor.view.joints.fraction(grafuEditor.view.jointOf(grafuEditor.view.view.chosen)) > 0.99")

    number = shown(browser)
    browser.run(f"document.querySelector('[data-motion={other}]').click()")
    settled(browser, number + 1)
    assert side(browser) == other
    assert browser.run(f"document.querySelector('[data-motion={other}]').getAttribute('aria-pressed')") == "true"
    browser.press("z", "KeyZ", control=True)
    settled(browser, number + 2)
    assert side(browser) == before
    assert saved(out).motions == {}
    browser.press("y", "KeyY", control=True)
    settled(browser, number + 3)
    assert str(saved(out).motions[DOOR].side) == other
    assert browser.complaints(server.address) == []

    server.kill()
    again = Server(str(model), "--out", str(out))
    try:
        opened(browser, again)
        assert side(browser) == other
        browser.run("document.querySelector('[data-do=export]').click()")
        wait(browser, "document.getElementById('progress').textContent.startsWith('exported')")
        assert (out / "cabinet" / "model.urdf").is_file()
        assert browser.run("window.hurt ?? null") is None
        assert browser.complaints(again.address) == []
    finally:
        again.kill()


def test_all_can_be_done_by_keys_and_dragging_moves_the_front(browser, lasting):
    opened(browser, lasting)
    browser.press("n", "KeyN")
    part = browser.run("grafuEditor.inspector.part")
    assert part
    number = shown(browser)
    browser.press("a", "KeyA")
    settled(browser, number + 1)
    assert browser.run(f"{part!r} in grafuEditor.state.settings.motions")
    loaded = (
        "[...document.querySelectorAll('[data-handle] img')].every((image) => image.complete && image.naturalWidth)"
    )
    browser.run("document.querySelectorAll('details').forEach((one) => (one.open = true))")
    browser.run("document.querySelector('.handles').scrollIntoView()")
    wait(browser, loaded)
    browser.run("document.querySelector('[data-handle=\"knob-round\"]').click()")
    settled(browser, number + 2)
    fronts = "grafuEditor.state.settings.additions.fronts"
    assert browser.run(f"{fronts}[{part!r}].style") == "knob-round"
    assert browser.run("document.querySelector('[data-handle=\"knob-round\"]').getAttribute('aria-pressed')") == "true"
    browser.press("z", "KeyZ", control=True)
    settled(browser, number + 3)
    assert browser.run(f"{part!r} in {fronts}") is False
    number += 2
    browser.press("Escape")
    assert browser.run("grafuEditor.inspector.part") == ""
    names = browser.run("Object.keys(grafuEditor.state.sides)")
    still = [name for name in names if not browser.run(f"{name!r} in grafuEditor.state.motions")]
    for one in still[:2]:
        browser.run(f"grafuEditor.pick({one!r})")
    browser.press("g", "KeyG")
    settled(browser, number + 2)
    joined = {"do": "join", "parts": still[:2], "lasso": None, "category": None}
    assert browser.run("grafuEditor.state.settings.regrouped") == [joined]
    assert browser.run("grafuEditor.inspector.part") == still[0]
    browser.press("z", "KeyZ", control=True)
    settled(browser, number + 3)
    assert browser.run("grafuEditor.state.settings.regrouped") == []

    browser.run(f"grafuEditor.pick({DOOR!r})")
    x, y = place_of(browser, DOOR)
    fraction = "grafuEditor.view.joints.fraction(grafuEditor.view.jointOf(grafuEditor.view.view.chosen))"
    assert browser.run(fraction) == 0
    along = browser.run(
        "((view) => view.screenMotion(view.view.chosen, view.jointOf(view.view.chosen)))(grafuEditor.view)"
    )
    length = (along[0] ** 2 + along[1] ** 2) ** 0.5
    step = [60 * component / length for component in along]
    browser.drag((x, y), *((x + k / 6 * step[0], y + k / 6 * step[1]) for k in range(1, 7)))
    assert 0 < browser.run(fraction) < 1
    browser.press("o", "KeyO")
    wait(browser, f"[0, 1].includes({fraction})")
    assert browser.complaints(lasting.address) == []


def test_a_line_around_a_piece_of_a_part_cuts_it_out(browser, lasting):
    opened(browser, lasting)
    browser.run(f"grafuEditor.pick({DOOR!r})")
    browser.press("o", "KeyO")
    wait(browser, "grafuEditor.view.joints.fraction(grafuEditor.view.jointOf(grafuEditor.view.view.chosen)) > 0.99")
    number = shown(browser)
    browser.press("c", "KeyC")  # what stands open closes: the line is drawn around parts at rest
    wait(browser, "grafuEditor.view.joints.fraction(grafuEditor.view.jointOf(grafuEditor.view.view.chosen)) === 0")
    x, y = place_of(browser, DOOR)
    square = [(-25, -25), (25, -25), (25, 25), (-25, 25)]
    browser.drag(*((x + aside, y + up) for aside, up in square))
    settled(browser, number + 1)
    change = browser.run("grafuEditor.state.settings.regrouped.at(-1)")
    assert (change["do"], change["parts"], change["lasso"]["through"]) == ("cut", [DOOR], False)
    assert len(change["lasso"]["corners"]) == 4
    assert browser.run(f"{DOOR + '_2'!r} in grafuEditor.state.sides")
    seen = place_of(browser, f"{DOOR}_2")
    assert abs(seen[0] - x) < 15
    assert abs(seen[1] - y) < 15
    browser.press("z", "KeyZ", control=True)
    settled(browser, number + 2)
    browser.run(f"grafuEditor.pick({DOOR!r})")
    browser.press("c", "KeyC")
    assert browser.run("grafuEditor.view.lasso.active")
    browser.press("Escape")
    assert not browser.run("grafuEditor.view.lasso.active")
    assert browser.complaints(lasting.address) == []


def test_a_first_build_that_fails_is_stated_and_can_be_started_anew(browser, model, out):
    (out / "cabinet").mkdir(parents=True)
    settings = dump_json(Settings().with_motion("gate", FIXED).to_json())
    write_files(ExportFiles({"settings.json": settings.encode()}), out / "cabinet")
    server = Server(str(model), "--out", str(out))
    try:
        browser.go(server.address)
        wait(browser, "document.getElementById('stage').className === 'failed'")
        assert "gate" in browser.run("document.getElementById('fault').textContent")
        before = "getComputedStyle(document.querySelector('.view'), '::before').content"
        assert browser.run(before) == "none"  # nothing is read any more
        assert browser.run("document.querySelector('[data-do=export]').disabled")
        browser.run("document.querySelector('[data-do=anew]').click()")
        settled(browser)
        assert browser.run("document.getElementById('stage').className") == "ready"
        assert browser.complaints(server.address) == []
    finally:
        server.kill()


def test_without_the_token_a_browser_sees_nothing(browser, lasting):
    host = lasting.address.split("/")[2]
    browser.go(f"http://{host}/")
    assert "403" in browser.run("document.body.textContent")


def test_the_ring_of_the_focus_is_within_its_card_on_the_wall(browser, model, tmp_path):
    second = tmp_path / "second.glb"
    shutil.copyfile(model, second)
    server = Server(str(model), str(second), "--out", str(tmp_path / "out"))
    try:
        browser.go(server.address)
        for key in "jj":
            browser.press(key)
        assert browser.run("document.activeElement.getAttribute('href')") == "m/1/"
        style = "((s) => [s.outlineStyle, parseFloat(s.outlineOffset) + parseFloat(s.outlineWidth)])"
        shape, beyond = browser.run(f"{style}(getComputedStyle(document.activeElement))")
        assert (shape, beyond <= 0) == ("solid", True)  # a card paints nothing outside of itself
    finally:
        server.kill()


@pytest.mark.skipif(not AXE.is_file(), reason="axe-core comes by npm install")
def test_axe_finds_nothing(browser, lasting):
    opened(browser, lasting)
    browser.run(f"grafuEditor.pick({DOOR!r})")
    browser.run("document.querySelectorAll('details').forEach((one) => (one.open = true))")
    browser.run(AXE.read_text() + ";1")
    found = browser.run("axe.run().then((r) => r.violations.map((v) => [v.id, v.nodes.map((n) => n.html)]))")
    assert found == []


def test_a_handle_on_the_chosen_front_is_dragged_and_stays_on_it(browser, lasting):
    opened(browser, lasting)
    browser.run(f"grafuEditor.choose('handle', {DOOR!r}, 'knob-round')")
    settled(browser, shown(browser) + 1)
    handle = browser.run(f"grafuEditor.state.report.added.find((one) => one.link === {DOOR!r}).part")
    browser.run(f"grafuEditor.pick({DOOR!r})")
    assert browser.run("[...document.querySelectorAll('[data-offset]')].map((one) => one.value)") == ["0", "0"]
    fronts = f"grafuEditor.state.settings.additions.fronts[{DOOR!r}].offset"
    number, (x, y) = shown(browser), place_of(browser, handle)
    browser.drag((x, y), (x, y - 10), (x, y - 20), (x, y - 30))
    settled(browser, number + 1)
    assert browser.run(f"{fronts}[1]") > 0.01
    assert abs(place_of(browser, handle)[1] - (y - 30)) < 4
    browser.drag((x, y - 30), (x, y - 300), (x, y - 400))  # far beyond the top of the door
    settled(browser, number + 2)
    assert browser.run(f"{fronts}[1]") < 0.7
    browser.run(
        "{const field = document.querySelector('[data-offset=\"1\"]');"
        "field.value = '-5'; field.dispatchEvent(new Event('change'))}"
    )
    settled(browser, number + 3)
    assert abs(browser.run(f"{fronts}[1]") + 0.05) < 1e-9
    assert browser.complaints(lasting.address) == []


def test_each_compartment_behind_a_door_has_its_own_shelves(browser, lasting):
    opened(browser, lasting)
    made = f"[0.5, 0.1].map((z) => ({{behind: [{DOOR!r}], corners: [[0, 0, z]]}}))"
    browser.run(f"grafuEditor.state.compartments = {made}; grafuEditor.pick({DOOR!r})")
    fields = "[...document.querySelectorAll('[data-shelves]')].map((one) => one.dataset.shelves)"
    assert browser.run(fields) == ["1", "0"]  # the lowest first
    long = "Object.assign(document.querySelector('[data-do=join]'), {textContent: 'x'.repeat(60)})"
    assert browser.run(f"{long}.scrollWidth <= document.getElementById('inspector').clientWidth")
    assert browser.run("document.querySelector('[data-do=split]').offsetHeight") < 60  # its words are on one line
