"""Judges how much of a closed piece of furniture looks other than it was drawn; hardware and additions are left out.

    python scripts/judge_closed.py INPUT ... [--motion auto] [--size 480] [--most 0.001] [--jobs 2] [--out DIR]

Each input is functionalized without additions. As it was drawn, and closed without hardware, it is drawn from six
sides, each picture framed by the furniture. Of each model it prints how much of all pixels of the six pictures differ
(a channel of eight bits by more than 16), and the parts that were trimmed or carved. Parts that were drawn open and
closed first differ as they should: these models are marked. With --out it writes the pictures of what differs.
"""

import argparse
import sys
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import final

import numpy as np
from PIL import Image

import grafu
from grafu.articulation.articulated_object import VisualRole
from grafu.asset.edit import as_static_object
from grafu.geometry.box import Box
from grafu.pipeline.report_schema import ClearanceRecord
from grafu.render.picture import box_of, posed_visuals
from grafu.render.ray_scene import RayScene

DIFFERENT = 16  # of 255
AMBIENT = 0.3  # light that reaches every surface
SIDES = [(axis, sign) for axis in range(3) for sign in (-1.0, 1.0)]


@final
@dataclass(frozen=True, slots=True)
class Judged:
    """What differs of one model: `changed` is the ratio of pixels; `closed` whether a part was drawn open."""

    name: str
    changed: float
    closed: bool
    cut: tuple[str, ...]
    error: str = ""


def main() -> int:
    """Judges, and prints one line for each model and the median; returns 1 if one has more than --most."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("inputs", nargs="+", type=Path, metavar="INPUT")
    parser.add_argument("--motion", default="auto", help="where motions come from (default: auto)")
    parser.add_argument("--size", type=int, default=480, help="pixels of the longer side of a picture (default: 480)")
    parser.add_argument("--most", type=float, default=0.001, help="the largest ratio that passes (default: 0.001)")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=Path, help="a folder for pictures of what differs")
    options = parser.parse_args()
    if options.out:
        options.out.mkdir(parents=True, exist_ok=True)
    with ProcessPoolExecutor(options.jobs) as pool:
        found = []
        for one in pool.map(partial(judge, options.motion, options.size, options.out), options.inputs):
            found.append(one)
            mark = " drawn open" if one.closed else ""
            print(f"{one.name:28} {one.changed:8.3%}{mark} {one.error or ', '.join(one.cut)}", flush=True)
    judged = [one for one in found if not one.error]
    closed = [one for one in judged if not one.closed]
    over = [one for one in closed if one.changed > options.most]
    median = float(np.median([one.changed for one in closed])) if closed else 0.0
    print(
        f"{len(judged)} models judged, {len(closed)} of them drawn closed: median {median:.3%}, "
        f"{len(over)} over {options.most:.3%}"
    )
    return 1 if over or len(judged) < len(found) else 0


def judge(motion: str, size: int, out: Path | None, path: Path) -> Judged:
    """Returns what differs of one model."""
    try:
        result = grafu.functionalize(
            path, motion=motion, top=False, handles=False, drawer_boxes=False, interior="none", carcass=False
        )
    except grafu.FunctionalizationError as error:
        print(f"{path}: {error}", file=sys.stderr)
        return Judged(path.name, 0.0, False, (), str(error))
    drawn = posed_visuals(as_static_object(result.asset))
    closed = [v for v in posed_visuals(result.object) if v.role is VisualRole.PART]
    box = box_of(drawn)
    pairs = [(pictured(drawn, box, side, size), pictured(closed, box, side, size)) for side in SIDES]
    changed = [differs(before, after) for before, after in pairs]
    if out is not None and any(mask.any() for mask in changed):
        Image.fromarray(sheet(pairs, changed)).save(out / f"{path.name}.png")
    ratio = sum(int(mask.sum()) for mask in changed) / sum(mask.size for mask in changed)
    cuts = cuts_of(result)
    return Judged(
        path.name,
        ratio,
        any(one.kind == "closed" for one in cuts),
        tuple(f"{one.part} {one.kind} {one.share:.0%}" for one in cuts),
    )


def pictured(visuals: Sequence[object], box: Box, side: tuple[int, float], size: int) -> np.ndarray:
    """Returns a picture without perspective, eight bits a channel, from one side; the light is at the viewer."""
    axis, sign = side
    across = [k for k in range(3) if k != axis]
    pixel = float(box.size[across].max()) / size
    counts = [max(int(np.ceil(box.size[k] / pixel)), 1) for k in across]
    grid = np.stack(np.meshgrid(*(np.arange(n) + 0.5 for n in counts), indexing="ij"), -1).reshape(-1, 2)
    origins = np.zeros((len(grid), 3), np.float32)
    origins[:, across] = box.low[across] + grid * pixel
    beyond = float(box.size.max())
    origins[:, axis] = (box.high if sign > 0 else box.low)[axis] + sign * beyond
    directions = np.zeros_like(origins)
    directions[:, axis] = -sign
    hits = RayScene(visuals).cast(origins, directions)  # type: ignore[arg-type]
    light = AMBIENT + (1 - AMBIENT) * np.abs(np.einsum("ij,ij->i", hits.flat_normal, directions[hits.ray]))
    picture = np.ones((len(grid), 3))
    picture[hits.ray] = np.clip(hits.color * light[:, None], 0.0, 1.0) ** (1 / 2.2)
    image = np.round(255 * picture).astype(np.uint8).reshape(*counts, 3)
    return image.transpose(1, 0, 2)[::-1]


def differs(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """Returns which pixels of two pictures differ."""
    return np.asarray((np.abs(before.astype(int) - after.astype(int)) > DIFFERENT).any(axis=2))


def sheet(pairs: Sequence[tuple[np.ndarray, np.ndarray]], changed: Sequence[np.ndarray]) -> np.ndarray:
    """Returns the six pictures as drawn, and below them closed, with red where they differ."""
    height = max(before.shape[0] for before, _ in pairs)
    rows = []
    for which in (0, 1):
        row = []
        for pair, mask in zip(pairs, changed, strict=True):
            picture = pair[which].copy()
            if which:
                picture[mask] = (255, 0, 0)
            row.append(np.pad(picture, ((0, height - len(picture)), (0, 4), (0, 0)), constant_values=255))
        rows.append(np.concatenate(row, axis=1))
    return np.concatenate(rows)


def cuts_of(result: grafu.Result) -> list[ClearanceRecord]:
    """Returns what was closed, trimmed or carved, the largest loss first."""
    cuts = [one for joint in result.report.joints for one in joint.clearances]
    return sorted(cuts, key=lambda one: -one.share)


if __name__ == "__main__":
    raise SystemExit(main())
