"""The page of a model in a real browser: the slider moves the door, in pixels and in the page's own state."""

from io import BytesIO
from math import pi

import numpy as np
import pytest
from PIL import Image

READY = "document.getElementById('stage').className"


@pytest.fixture
def shown(browser, page_file):
    browser.open(page_file, (900, 800))
    browser.wait_for(READY)
    if browser.run(READY) == "without":
        pytest.skip(f"no WebGL here: {browser.run('document.getElementById(`view-note`).textContent')}")
    return browser


def pixels(browser):
    browser.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    return np.asarray(Image.open(BytesIO(browser.screenshot())).convert("RGB")).astype(int)


def slide(browser, index, ratio):
    browser.run(
        f"{{const s = document.querySelector('[data-joint=\"{index}\"]'); s.value = {ratio} * s.max;"
        "s.dispatchEvent(new Event('input', {bubbles: true})); 1}"
    )


def door_of(made):
    joints = made.result.object.moving_joints
    index = next(k for k, joint in enumerate(joints) if joint.child.startswith("door"))
    return index, joints[index]


def test_the_slider_moves_the_door(shown, made):
    index, joint = door_of(made)
    before = pixels(shown)
    at_rest = shown.run(f"grafu.pose({joint.child!r})")
    slide(shown, index, 0.6)
    after = pixels(shown)
    pose = np.array(shown.run(f"grafu.pose({joint.child!r})")).reshape(4, 4).T

    assert np.allclose(np.array(at_rest).reshape(4, 4), np.eye(4))
    assert np.allclose(pose, joint.motion(0.6 * joint.limits.upper), atol=1e-9)
    canvas = shown.run("(({x, y, width, height}) => [x, y, width, height])(grafu.canvas.getBoundingClientRect())")
    x, y, w, h = (int(v) for v in canvas)
    changed = np.abs(after - before).max(axis=2)[y : y + h, x : x + w] > 24
    assert changed.mean() > 0.01
    assert f"{0.6 * joint.limits.upper * 180 / pi:.0f}°" in shown.run("document.querySelector('.panel').textContent")
    assert shown.complaints() == []


def test_the_door_is_seen_in_its_own_colour_and_the_switch_recolours(shown, made):
    blue = pixels(shown)
    shown.run("document.querySelector('[data-switch=categories]').click()")
    recoloured = pixels(shown)

    def is_blue(picture):
        return ((picture[..., 2] > 120) & (picture[..., 2] > 2 * picture[..., 0])).mean()

    assert is_blue(blue) > 0.02
    assert not np.array_equal(blue, recoloured)
    assert shown.complaints() == []


def test_open_all_and_close_all(shown, made):
    shown.run("document.querySelector('[data-action=open]').click()")
    shown.wait_for("grafu.joints.joints.every((_, k) => grafu.joints.fraction(k) === 1)")
    assert shown.run("grafu.joints.values") == pytest.approx([j.limits.upper for j in made.result.object.moving_joints])
    shown.run("document.querySelector('[data-action=close]').click()")
    shown.wait_for("grafu.joints.values.every((v) => v === 0)")
    assert shown.complaints() == []


def test_play_goes_on_until_it_is_paused(shown):
    shown.run("document.querySelector('[data-action=play]').click()")
    shown.wait_for("grafu.joints.values.some((v) => v > 0)")
    shown.run("document.querySelector('[data-action=play]').click()")
    values = shown.run("grafu.joints.values")
    pixels(shown)
    assert shown.run("grafu.joints.values") == values


def test_what_is_behind_a_door_waits_for_it(shown):
    values = shown.run("""(() => {
      const joints = grafu.joints;
      joints.joints[1].after = [0];
      joints.setFraction(1, 0.5);
      const opened = [joints.fraction(0), joints.fraction(1)];
      joints.setFraction(0, 0.2);
      return [...opened, joints.fraction(0), joints.fraction(1)];
    })()""")
    assert values == pytest.approx([1, 0.5, 0.2, 0])


def test_a_click_names_the_part_and_draws_its_axis(shown, made):
    _, joint = door_of(made)
    place = shown.run(f"""(() => {{
      const box = grafu.scene.items[grafu.itemNamed({joint.child!r})].box, r = grafu.canvas.getBoundingClientRect();
      const m = grafu.camera.matrix(), p = [0, 1, 2].map((k) => (box[0][k] + box[1][k]) / 2);
      const [x, y, , w] = [0, 1, 2, 3].map((row) => m[row]*p[0] + m[4+row]*p[1] + m[8+row]*p[2] + m[12+row]);
      return [r.x + (0.5 + x / w / 2) * r.width, r.y + (0.5 - y / w / 2) * r.height];
    }})()""")
    for kind, buttons in (("mouseMoved", 0), ("mousePressed", 1), ("mouseReleased", 0)):
        button = "none" if kind == "mouseMoved" else "left"
        shown.ask(
            "Input.dispatchMouseEvent", type=kind, x=place[0], y=place[1], button=button, clickCount=1, buttons=buttons
        )
    pixels(shown)

    said = shown.run("document.getElementById('chosen').textContent")
    assert said.startswith(joint.child)
    assert said.endswith("has its own joint")
    assert shown.run("document.querySelector('.label').textContent") == joint.child
    assert not shown.run("document.querySelector('svg.overlay').hasAttribute('hidden')")
    assert shown.complaints() == []


def test_keys_turn_and_reset_the_view(shown):
    shown.run("grafu.canvas.focus()")
    start = shown.run("[grafu.camera.azimuth, grafu.camera.distance]")
    for key in ("ArrowLeft", "+"):
        shown.ask("Input.dispatchKeyEvent", type="keyDown", key=key)
    moved = shown.run("[grafu.camera.azimuth, grafu.camera.distance]")
    shown.ask("Input.dispatchKeyEvent", type="keyDown", key="Home")

    assert moved[0] != start[0]
    assert moved[1] < start[1]
    assert shown.run("[grafu.camera.azimuth, grafu.camera.distance]") == pytest.approx(start)


def test_two_fingers_zoom(shown):
    x, y = shown.run(
        "(({x, y, width, height}) => [x + width / 2, y + height / 2])(grafu.canvas.getBoundingClientRect())"
    )
    before = shown.run("grafu.camera.distance")
    for kind, reach in (("touchStart", 30), ("touchMove", 60), ("touchMove", 90), ("touchEnd", None)):
        points = [{"x": x - reach, "y": y, "id": 1}, {"x": x + reach, "y": y, "id": 2}] if reach else []
        shown.ask("Input.dispatchTouchEvent", type=kind, touchPoints=points)

    assert shown.run("grafu.camera.distance") < 0.7 * before
    assert shown.run("grafu.gestures.pointers.size") == 0
    assert shown.complaints() == []


def test_the_wheel_scrolls_the_page_until_the_view_is_clicked(shown):
    def turned():
        before = shown.run("grafu.camera.distance")
        shown.run(
            "grafu.canvas.dispatchEvent(new WheelEvent('wheel', {deltaY: -100, cancelable: true, bubbles: true}))"
        )
        return shown.run("grafu.camera.distance") / before

    assert turned() == 1
    shown.run("grafu.canvas.focus()")
    assert turned() < 1


def test_a_lost_graphics_card_is_said(shown):
    shown.run("grafu.renderer.gl.getExtension('WEBGL_lose_context').loseContext()")
    shown.wait_for("document.getElementById('stage').className === 'without'")


def test_a_name_that_is_markup_is_never_run(shown):
    assert shown.run("window.hurt ?? null") is None


def test_the_layout_does_not_shift_and_fits_a_phone(browser, page_file):
    browser.open(page_file, (390, 844), dark=True, phone=True)
    browser.wait_for(READY)
    assert browser.run("document.documentElement.scrollWidth") <= 390
    shift = """new Promise((done) => new PerformanceObserver((list) => done(list.getEntries()
      .reduce((sum, entry) => sum + entry.value, 0))).observe({type: 'layout-shift', buffered: true})
      || setTimeout(() => done(0), 300))"""
    assert browser.run(shift) < 0.05


def test_without_webgl_the_pictures_stay_and_a_line_says_so(browser, page, tmp_path):
    script = browser.ask(
        "Page.addScriptToEvaluateOnNewDocument", source="HTMLCanvasElement.prototype.getContext = () => null;"
    )
    try:
        path = tmp_path / "report.html"
        path.write_text(page)
        browser.open(path)
        browser.wait_for(READY)
        assert browser.run(READY) == "without"
        assert "cannot show" in browser.run("document.getElementById('view-note').textContent")
        assert browser.run("document.querySelector('figure img').naturalWidth") > 0
        assert browser.run("getComputedStyle(document.querySelector('.panel')).display") == "none"
    finally:
        browser.ask("Page.removeScriptToEvaluateOnNewDocument", **script)
