"""What is typed, pressed and focused on the page of `grafu edit`, in a real browser."""

import pytest
from edit_page import enter, opened, settled, shown, wait
from editing import DOOR, DRAWER

pytestmark = pytest.mark.slow
OPENING = "[data-choice=opening]"
VALUE = f"document.querySelector('{OPENING}').value"
REFUSED = "[...document.querySelectorAll('.refused')].map((one) => one.textContent)"
HELD = "document.activeElement"


@pytest.fixture
def page(browser, lasting):
    """The page with nothing decided and the door chosen; nothing was complained of once the test ends."""
    opened(browser, lasting)
    if browser.run("grafuEditor.state.settings.words.length"):
        number = shown(browser)
        browser.run("grafuEditor.server.act('anew')")
        settled(browser, number + 1)
    browser.run(f"grafuEditor.pick({DOOR!r})")
    yield browser
    assert browser.complaints(lasting.address) == []


def choose(page, question: str, value) -> None:
    number = shown(page)
    page.run(f"grafuEditor.choose({question!r}, {DOOR!r}, {value!r})")
    settled(page, number + 1)


def undo(page) -> None:
    number = shown(page)
    page.run("document.querySelector('[data-do=undo]').click()")
    settled(page, number + 1)


@pytest.mark.parametrize("typed", ["0", "400"])
def test_an_opening_that_cannot_be_is_refused_beside_its_field(page, typed):
    number = shown(page)
    enter(page, OPENING, typed)
    assert page.run(REFUSED) == ["from 1 to 360 degrees"]
    said = f"document.getElementById(document.querySelector('{OPENING}').getAttribute('aria-describedby')).textContent"
    assert page.run(said) == "from 1 to 360 degrees"
    enter(page, OPENING, "45")
    settled(page, number + 1)
    assert page.run(REFUSED) == []
    assert page.run(f"grafuEditor.state.settings.joints[{DOOR!r}].opening") == pytest.approx(0.7854, abs=1e-4)
    undo(page)


def test_what_is_typed_stays_while_a_build_ends_and_undo_is_the_browsers_until_it_is_sent(page):
    enter(page, OPENING, "4", leave=False)
    choose(page, "handle", "knob-round")
    assert page.run(f"[{VALUE}, {HELD}.dataset.choice]") == ["4", "opening"]
    number = shown(page)
    page.press("z", "KeyZ", control=True)
    assert page.run("grafuEditor.building") is False
    page.run(f"{HELD}.value = ''; {HELD}.blur()")
    page.run("document.querySelector('[data-choice=handle]').focus()")
    page.press("z", "KeyZ", control=True)  # a list has the focus
    settled(page, number + 1)
    assert page.run(f"{DOOR!r} in grafuEditor.state.settings.additions.fronts") is False
    assert page.run(f"{HELD}.dataset.choice") == "handle"


def test_a_value_that_cannot_be_built_does_not_stay_in_its_field(page):
    choose(page, "accept", "")
    number, version = shown(page), page.run("grafuEditor.version")
    label = "document.querySelector('[data-choice=label]')"
    page.run(f"{label}.value = 'drawer'; {label}.dispatchEvent(new Event('change'))")
    wait(page, f"grafuEditor.version > {version} && !grafuEditor.building")
    assert "its category must not be drawer" in page.run("document.getElementById('fault').textContent")
    assert page.run(f"[grafuEditor.shown, {label}.value]") == [number, ""]
    undo(page)


def test_the_focus_stays_on_its_control_when_the_panel_is_made_anew(page):
    sliders = "[...document.querySelectorAll('#joint-panel input')]"
    slider = f"{sliders}.find((one) => one.labels[0].textContent === {DOOR!r})"
    page.run(f"{slider}.focus()")
    choose(page, "handle", "knob-round")
    assert page.run(f"{HELD} === {slider}")
    page.run("document.querySelector('#joint-panel [data-action=play]').focus()")
    choose(page, "handle", "bar-round")
    assert page.run(f"{HELD}.dataset.action") == "play"
    undo(page)
    number = shown(page)
    page.run("document.querySelector('[data-do=redo]').focus()")
    page.run(f"{HELD}.click()")
    settled(page, number + 1)
    assert page.run("document.querySelector('[data-do=redo]').disabled")
    assert page.run(f"{HELD}.closest('.toolbar') !== null")  # beside the button that is no more


def test_a_handle_is_not_moved_beyond_its_front(page):
    choose(page, "handle", "knob-round")
    enter(page, "[data-offset='1']", "500")
    (why,) = page.run(REFUSED)
    assert "it is not on its front" in why
    most = float(page.run("document.querySelector('[data-offset=\"1\"]').max"))
    number = shown(page)
    enter(page, "[data-offset='1']", str(most))
    settled(page, number + 1)
    handle = "grafuEditor.view.scene.items.find((one) => one.label === 'handle' && one.role === 'added')"
    top = f"grafuEditor.view.scene.items[grafuEditor.view.itemNamed({DOOR!r})].box[1][2]"
    assert 0 <= page.run(f"{top} - {handle}.box[1][2]") < 0.02
    undo(page)
    undo(page)


def test_a_handle_on_a_drawer_has_the_room_of_its_front(page):
    number = shown(page)
    page.run(f"grafuEditor.choose('handle', {DRAWER!r}, 'knob-round')")
    settled(page, number + 1)
    added = "grafuEditor.state.report.added.find((one) => one.category === 'handle' && one.link ==="
    handle = page.run(f"{added} {DRAWER!r}).part")
    assert page.run(f"grafuEditor.isOnUprightFront({handle!r})")  # so that it can be dragged, too
    box = f"grafuEditor.view.scene.items[grafuEditor.view.itemNamed({DRAWER!r})].box"
    low, high = page.run(f"{box}.map((one) => one[2])")
    least, most = page.run(f"grafuEditor.state.rooms[{DRAWER!r}][1]")
    assert 0.5 * (high - low) < most - least < high - low


def test_fewer_shelves_than_wanted_are_stated_with_the_reason(page):
    assert page.run("grafuEditor.state.compartments.length") > 0
    number = shown(page)
    enter(page, "[data-shelves]", "20")
    settled(page, number + 1)
    said = page.run("document.querySelector('.fewer').textContent")
    built = page.run("grafuEditor.state.report.added.filter((one) => one.category === 'shelf').length")
    assert 0 < built < 20
    assert said.startswith(f"{built} of 20 built: ")
    undo(page)
    assert page.run("document.querySelector('.fewer').hidden")


def test_a_lasso_is_drawn_by_keys(page):
    said = "document.getElementById('chosen').textContent"
    number = shown(page)
    page.press("c", "KeyC")
    assert "Enter sets a corner" in page.run(said)
    camera = page.run("grafuEditor.view.camera.azimuth")
    for key in ("ArrowLeft", "ArrowUp", "Enter", "ArrowRight", "ArrowRight", "Enter", "ArrowUp", "Enter", "Backspace"):
        page.press(key)
    assert page.run(said) == "Taken back: 2 corners left."
    for key in ("ArrowDown", "ArrowDown", "Enter"):
        page.press(key)
    assert DOOR in page.run(said)
    assert "Enter again closes the lasso" in page.run(said)
    page.press("Enter")
    settled(page, number + 1)
    change = page.run("grafuEditor.state.settings.regrouped.at(-1)")
    assert (change["do"], change["parts"], len(change["lasso"]["corners"])) == ("cut", [DOOR], 3)
    assert page.run("grafuEditor.view.camera.azimuth") == camera
    undo(page)
    page.run(f"grafuEditor.pick({DOOR!r})")
    page.press("c", "KeyC")
    page.press("Escape")
    assert page.run(f"[grafuEditor.view.lasso.active, {said}, grafuEditor.inspector.part]") == [
        False, "Left without a cut.", DOOR,
    ]  # fmt: skip


def test_the_page_states_what_it_does_before_the_view_is_there(page):
    first = "performance.getEntriesByName('first-contentful-paint')[0].startTime"
    assert page.run(f"{first} < performance.getEntriesByName('view')[0].startTime")
    page.run("window.words = fetch('').then((answer) => answer.text())")
    assert ">Reading cabinet ...<" in page.run("window.words")


def test_what_was_not_built_is_not_exported_and_what_lacks_is_named(page):
    status = {"stage": "", "error": "it cannot be read", "undo": 0, "redo": 0, "build": 0, "seconds": 0}
    disabled = "['export', 'anew'].map((name) => document.querySelector(`[data-do=${name}]`).disabled)"
    page.run(f"grafuEditor.toolbar.show({{...{status}, exported: null}})")
    assert page.run(disabled) == [True, False]
    exported = {"folder": "out", "formats": ["glb"], "left out": {"blend": "no Blender"}}
    page.run(f"grafuEditor.toolbar.show({{...{status}, error: '', build: 1, exported: {exported}}})")
    words = "exported to out: glb; without blend: more must be installed for it"
    assert page.run("document.getElementById('progress').textContent") == words
