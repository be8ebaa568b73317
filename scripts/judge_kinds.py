"""Judges ways to move on furniture that is made of them: many pieces of each kind, whose true joints are known.

    python scripts/judge_kinds.py [KIND ...] [--count 200] [--motion annotation] [--seed 0] [--jobs 2] [--out DIR]

Of each kind it prints how many true joints of it there are (drawers of the same furniture and the like are not
judged) and, of these, how many were built with the right type and axis
(within 5 degrees, the same sense), open by at least 90 % of the true range, collide in no pose (tolerant, see
docs/metrics.md; other moving bodies count, unless one turns on another) and stay connected (small parts apart, which
stand off what they are pressed towards); then how many joints were built besides. With --out it writes truth and
results as URDF, which other judges read.
"""

import argparse
import sys
from collections.abc import Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import final

import numpy as np
from judge_kinds_makers import KINDS, OWN

import grafu
from grafu.articulation.articulated_object import ArticulatedObject
from grafu.asset.part import AnnotatedJoint, Asset
from grafu.export.files import write_files
from grafu.export.urdf import export_urdf
from grafu.metrics.collision import CollisionConfig, collision_shares, connected_joints
from grafu.synth.truth.clashes import articulated_of

ALIKE = np.cos(np.radians(5.0))  # of two axes
OPEN = 0.9  # of the true range
TOLERANCE = 0.0005  # the tolerant collision's


@final
@dataclass(frozen=True, slots=True)
class Judged:
    """One piece: for each true joint what holds of it, and how many joints were built besides."""

    name: str
    joints: tuple[tuple[str, frozenset[str]], ...]
    besides: int
    error: str = ""


def main() -> int:
    """Judges the kinds, and prints a line for each; returns 1 if a piece could not be made."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kinds", nargs="*", metavar="KIND", help=f"of {', '.join(KINDS)} (default: all)")
    parser.add_argument("--count", type=int, default=200, help="pieces of each kind (default: 200)")
    parser.add_argument("--motion", default="annotation", help="where motions come from (default: annotation)")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=Path, help="a folder for truth and results")
    parser.add_argument("--list", action="store_true", help="also print each joint for which something does not hold")
    options = parser.parse_args()
    unknown = sorted({*options.kinds} - {*KINDS})
    if unknown:
        parser.error(f"KIND must be one of {', '.join(KINDS)}: got {', '.join(unknown)}")
    print(f"{'kind':14} pieces joints  right  open  free  held  all besides")
    failed = 0
    with ProcessPoolExecutor(options.jobs) as pool:
        for kind in options.kinds or KINDS:
            work = partial(judge, kind, options.motion, options.seed, options.out)
            found = list(pool.map(work, range(options.count)))
            failed += sum(bool(one.error) for one in found)
            _print(kind, found, options.list)
    return 1 if failed else 0


def judge(kind: str, motion: str, seed: int, out: Path | None, number: int) -> Judged:
    """Returns what holds of one piece; the same numbers give the same piece."""
    name = f"{kind}_{number:03d}"
    asset = KINDS[kind](np.random.default_rng([seed, number]), name)
    try:
        result = grafu.functionalize(asset, motion=motion, small_parts=True)
    except grafu.FunctionalizationError as error:
        return Judged(name, (), 0, str(error))
    if out:
        write_files(out / "truth" / name, _as_mobility(asset))
        result.save(out / "results" / name, formats=("urdf",), page=False, overwrite=True)
    made = result.made.object
    stated = (*asset.joints, *asset.small_joints)
    truth = [joint for joint in stated if kind not in OWN or OWN[kind](asset, joint)]
    is_flat = all(joint.parent == made.root for joint in made.joints)
    colliding = collision_shares(made, CollisionConfig(tolerance=TOLERANCE, moving_bodies=is_flat))
    held = connected_joints(made)
    held |= dict.fromkeys((f"{joint.part}_joint" for joint in asset.small_joints), True)
    joints = tuple((joint.part, _holding(joint, made, colliding, held)) for joint in truth)
    besides = sum(joint.child not in {one.part for one in stated} for joint in made.moving_joints)
    return Judged(name, joints, besides)


def _as_mobility(asset: Asset) -> dict[str, bytes]:
    files = export_urdf(articulated_of(asset)).contents
    return {("mobility.urdf" if name.endswith(".urdf") else name): data for name, data in files.items()}


def _holding(
    joint: AnnotatedJoint, made: ArticulatedObject, colliding: Mapping[str, float], held: Mapping[str, bool]
) -> frozenset[str]:
    built = made.joint_of.get(joint.part)
    if built is None or built.type is not joint.type:
        return frozenset()
    upper = built.limits.upper if built.limits else joint.upper
    checks = {
        "right": float(built.axis.direction @ joint.axis.direction) >= ALIKE,
        "open": upper >= OPEN * joint.upper,
        "free": colliding.get(built.id, 0.0) == 0.0,
        "held": held.get(built.id, True),
    }
    return frozenset(word for word, holds in checks.items() if holds)


def _print(kind: str, found: list[Judged], in_full: bool) -> None:
    rows = [holding for one in found for _, holding in one.joints]
    words = ("right", "open", "free", "held")
    ratios = [sum(word in row for row in rows) / max(len(rows), 1) for word in words]
    whole = sum(row == set(words) for row in rows) / max(len(rows), 1)
    figures = " ".join(f"{ratio:5.1%}" for ratio in (*ratios, whole))
    print(f"{kind:14} {len(found):6} {len(rows):6} {figures} {sum(one.besides for one in found):7}", flush=True)
    for one in found:
        if one.error:
            print(f"  {one.name}: {one.error}")
        for part, holding in one.joints if in_full else ():
            if holding != set(words):
                print(f"  {one.name} {part}: not {', '.join(w for w in words if w not in holding)}")


if __name__ == "__main__":
    sys.exit(main())
