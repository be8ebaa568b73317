"""Draws the pictures of README and docs from our own samples and synthetic furniture: docs/images.

python scripts/pictures.py                              all of them
python scripts/pictures.py before_after --sample FILE   one, from a sample of one's own
python scripts/pictures.py sheets INPUT ... --out DIR   contact sheets of any models (pictures_sheets.py)
"""

import argparse
import sys
from pathlib import Path

import pictures_additions
import pictures_edit
import pictures_motions
import pictures_pages
import pictures_prepare
import pictures_results
import pictures_sheets
from PIL import Image

from grafu.asset.edit import as_static_object
from grafu.asset.load import load_asset
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.render.exposure import PictureStyle
from grafu.render.picture import Picture, before_after, encode_png, posed_visuals
from grafu.templates.gallery import builtin_gallery

ROOT = Path(__file__).parent.parent
COLOURS = 256  # a palette is a third of the bytes, and on plain wood the difference is invisible
BEFORE_AFTER = "before_after"
MODULES = pictures_additions, pictures_edit, pictures_motions, pictures_pages, pictures_prepare, pictures_results
SHEETS = {name: draw for module in MODULES for name, draw in module.SHEETS.items()}


def main() -> int:
    """Writes the pictures; returns the exit code."""
    if sys.argv[1:2] == ["sheets"]:
        return pictures_sheets.main(sys.argv[2:])
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("pictures", nargs="*", metavar="PICTURE", help=f"of {', '.join((BEFORE_AFTER, *SHEETS))}")
    parser.add_argument("--sample", type=Path, default=ROOT / "samples" / "kitchen_base.glb")
    parser.add_argument("--size", default="720x540", help="of each half of before_after")
    options = parser.parse_args()
    width, height = (int(side) for side in options.size.split("x"))
    for name in options.pictures or (BEFORE_AFTER, *SHEETS):
        if name == BEFORE_AFTER:
            write(name, opened(options.sample, (width, height)))
        elif name in SHEETS:
            write(name, SHEETS[name]())
        else:
            parser.error(f"there is no picture `{name}`: expected {', '.join((BEFORE_AFTER, *SHEETS))}")
    return 0


def opened(sample: Path, size: tuple[int, int]) -> Picture:
    """Returns a sample as it came beside what became of it, opened; `size` is that of each half."""
    asset = load_asset(sample)
    result = functionalize(asset, MotionSource.AUTO, builtin_gallery())
    return before_after(result.object, size, PictureStyle(), posed_visuals(as_static_object(asset)))


def write(name: str, picture: Picture) -> None:
    """Writes docs/images/NAME.png with a palette."""
    path = ROOT / "docs" / "images" / f"{name}.png"
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(encode_png(picture))
    Image.open(path).convert("RGB").quantize(COLOURS).save(path, optimize=True)
    print(f"{path.relative_to(ROOT)}: {path.stat().st_size // 1024} KiB")


if __name__ == "__main__":
    sys.exit(main())
