"""Draws the pictures of docs/blender.md: the extension in a real Blender window, step by step.

It needs `blender` and `Xvfb`, and shows nothing on your own screen.

python scripts/pictures_blender.py                                   the sample, without its top and a handle
python scripts/pictures_blender.py --model FILE_OR_FOLDER --out DIR  another model, whole
python scripts/pictures_blender.py --only start result               some of the pictures
"""

import argparse
import json
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from PIL import Image

from grafu.asset.edit import as_static_object
from grafu.asset.load import load_asset
from grafu.export.glb import export_glb

ROOT = Path(__file__).parent.parent
SAMPLE = ROOT / "samples" / "sideboard.glb"
LEFT_OUT = ("top_panel", "handle_5", "shelf_3")
"""Parts of the sample that it must do without, so that there is something to add."""
SHEETS = {
    "panels": ("running", "joints", "show", "added", "categories"),
    "questions": ("hinges", "rails", "handle", "motion"),
    "added_questions": ("top", "furnish", "finalize"),
}
"""Pictures that stand side by side in one file."""
COLOURS = 128  # a palette is a third of the bytes
_SECONDS = 1200.0
_EDGE = 6  # pixels around what a picture is cut out to
_DARK = 40  # of 255: brighter than a question's ground, darker than everything behind it
_LEAST = 40  # pixels of a row or column that a question covers
_GAP = 12  # pixels between pictures on a sheet
_TABS = 26  # pixels that a sidebar's tabs take
_EVEN = 12  # of 255: how much the ground of a sidebar varies along a row


def main() -> int:
    """Writes the pictures; returns the exit code."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--model", type=Path, help="another model: a file or folder that grafu reads")
    parser.add_argument("--out", type=Path, default=ROOT / "docs" / "images" / "blender")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="the pictures to write, by their names")
    options = parser.parse_args()
    sys.path.insert(0, str(ROOT / "tests" / "blender_addon"))
    from real_window import missing, run_in_window

    why = missing()
    if why:
        print(f"no pictures: {why}", file=sys.stderr)
        return 1
    with TemporaryDirectory(prefix="grafu_pictures_") as name:
        folder = Path(name)
        source = parts_of(options.model or SAMPLE, folder)
        left_out = [] if options.model else LEFT_OUT
        script = ROOT / "tests" / "blender_addon" / "window_pictures.py"
        done = run_in_window(script, [str(source), *left_out], folder, _SECONDS)
        if done.returncode:
            print((done.stdout + done.stderr)[-3000:], file=sys.stderr)
            return 1
        options.out.mkdir(parents=True, exist_ok=True)
        for picture, seen in sheets(pictures(folder)).items():
            if not options.only or picture in options.only:
                write(options.out / f"{picture}.png", seen)
    return 0


def parts_of(model: Path, folder: Path) -> Path:
    """Writes a model's parts to a GLB, a mesh object each, and returns its path."""
    written = folder / "model.glb"
    written.write_bytes(export_glb(as_static_object(load_asset(model))).contents["model.glb"])
    return written


def pictures(folder: Path) -> dict[str, np.ndarray]:
    """Returns what the steps kept, each cut out to what matters."""
    from real_window import read_screen

    found = {}
    for about in sorted(folder.glob("*.json")):
        name, states = about.stem, json.loads(about.read_text())
        if not (folder / f"{name}.xwd").exists() or name.endswith("_before"):
            continue
        seen = read_screen(folder / f"{name}.xwd")
        before = folder / f"{name}_before.xwd"
        box = states["box"] or difference(seen, read_screen(before))
        found[name] = upper_part(cut(seen, box)) if states["whole"] else cut(seen, box)
    return found


def sheets(found: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Returns the pictures with those that belong together side by side."""
    together = {name for names in SHEETS.values() for name in names}
    alone = {name: picture for name, picture in found.items() if name not in together}
    return alone | {sheet: beside([found[name] for name in names]) for sheet, names in SHEETS.items()}


def beside(row: list[np.ndarray]) -> np.ndarray:
    """Returns pictures side by side on white."""
    height = max(len(picture) for picture in row)
    filled = [np.pad(one, ((0, height - len(one)), (0, _GAP), (0, 0)), constant_values=255) for one in row]
    return np.concatenate(filled, axis=1)[:, :-_GAP]


def difference(seen: np.ndarray, before: np.ndarray) -> list[int]:
    """Returns the rectangle of the question that one screen shows and the other does not: left, top, width, height."""
    asked = (seen != before).any(axis=2) & (seen.max(axis=2) < _DARK)
    rows, columns = np.flatnonzero(asked.sum(axis=1) > _LEAST), np.flatnonzero(asked.sum(axis=0) > _LEAST)
    left, top = int(columns.min()) - _EDGE, int(rows.min()) - _EDGE
    return [left, top, int(columns.max()) + _EDGE - left, int(rows.max()) + _EDGE - top]


def cut(seen: np.ndarray, box: list[int]) -> np.ndarray:
    """Returns a rectangle of a screen: left, top, width, height."""
    left, top, width, height = box
    return seen[max(top, 0) : top + height, max(left, 0) : left + width]


def upper_part(sidebar: np.ndarray) -> np.ndarray:
    """Returns a sidebar without its tabs and the empty rest below its last panel, where rows are of one colour."""
    body = sidebar[:, : sidebar.shape[1] - _TABS]
    filled = np.flatnonzero(np.ptp(body[:, 20:-20].astype(int), axis=1).max(axis=1) > _EVEN)
    filled = filled[filled < len(body) - _EDGE]  # the last rows are the region's edge
    return body[: int(filled.max()) + 3 * _EDGE] if len(filled) else body


def write(path: Path, picture: np.ndarray) -> None:
    """Writes a picture with a palette."""
    image = Image.fromarray(np.ascontiguousarray(picture))
    image.quantize(COLOURS, dither=Image.Dither.NONE).save(path, optimize=True)
    print(f"{path}: {picture.shape[1]}x{picture.shape[0]}, {path.stat().st_size // 1024} KiB")


if __name__ == "__main__":
    sys.exit(main())
