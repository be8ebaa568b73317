"""Draws the pictures of README and docs from our own samples: docs/images/before_after.png.

The sample and the size of each half can be given: python scripts/pictures.py [SAMPLE] [--size 720x540].
"""

import argparse
import sys
from pathlib import Path

from PIL import Image

from grafu.asset.edit import as_static_object
from grafu.asset.load import load_asset
from grafu.export.picture import PictureStyle, before_after, encode_png, posed_visuals
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.templates.gallery import builtin_gallery

ROOT = Path(__file__).parent.parent
COLOURS = 256  # a palette is a third of the bytes, and nobody sees it on plain wood


def main() -> int:
    """Writes the picture; returns the exit code."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("sample", nargs="?", type=Path, default=ROOT / "samples" / "sideboard.glb")
    parser.add_argument("--size", default="720x540")
    options = parser.parse_args()
    width, height = (int(side) for side in options.size.split("x"))
    path = ROOT / "docs" / "images" / "before_after.png"
    path.parent.mkdir(exist_ok=True)
    asset = load_asset(options.sample)
    result = functionalize(asset, MotionSource.AUTO, builtin_gallery())
    before = posed_visuals(as_static_object(asset))
    picture = before_after(result.object, (width, height), PictureStyle(), before)
    path.write_bytes(encode_png(picture))
    Image.open(path).convert("RGB").quantize(COLOURS).save(path, optimize=True)
    print(f"{path.relative_to(ROOT)}: {path.stat().st_size // 1024} KiB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
