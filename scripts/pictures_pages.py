"""A picture of a model's page as a browser shows it; it needs Chromium, which is driven as the tests drive it."""

import sys
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from PIL import Image

from grafu.asset.load import load_asset
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.report import report_of
from grafu.render.picture import Picture
from grafu.templates.gallery import builtin_gallery
from grafu.viewer.model_page import model_page
from grafu.viewer.pictures import take_stills

ROOT = Path(__file__).parent.parent
SAMPLE = ROOT / "samples" / "sideboard.glb"
SIZE = (1280, 790)
OPENED = "[0.8, 1, 1, 0.55, 0].forEach((fraction, k) => grafu.joints.setFraction(k, fraction))"


def page_sheet() -> Picture:
    """Returns the top of the sample's page, its doors and drawers ajar, one of them chosen.

    Raises:
        RuntimeError: if there is no Chromium.
    """
    sys.path.insert(0, str(ROOT / "tests"))
    from chromium import Chromium, chromium_path

    path = chromium_path()
    if path is None:
        raise RuntimeError("the picture of a page needs Chromium: install it, or name the other pictures")
    browser = Chromium(path)
    try:
        with TemporaryDirectory() as folder:
            page = Path(folder) / "report.html"
            page.write_text(sample_page(), encoding="utf-8")
            browser.open(page, SIZE)
            browser.wait_for("document.getElementById('stage').className === 'ready'")
            browser.run(f"{OPENED}; grafu.chooseItem(grafu.itemNamed('door_1'))")
            browser.run("new Promise((done) => setTimeout(done, 1500))")
            return np.asarray(Image.open(BytesIO(browser.screenshot())).convert("RGBA"))
    finally:
        browser.close()


def sample_page() -> str:
    """Returns the page of the sample."""
    result = functionalize(load_asset(SAMPLE), MotionSource.AUTO, builtin_gallery())
    report = report_of(result, SAMPLE.stem)
    return model_page(result.asset, result.object, result.completion, report, take_stills(result.asset, result.object))


SHEETS = {"page": page_sheet}
