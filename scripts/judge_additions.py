"""Judges what `functionalize` adds to furniture: tops, grasps, handles, interiors, drawer boxes, and what it costs.

    python scripts/judge_additions.py [FOLDER] [--made 60] [--seed 990003] [--kinds] [--jobs 1] [--log FILE]

FOLDER holds pieces of furniture, one folder each; --made judges synthetic furniture with its true joints and all
hardware, --kinds the catalogue of hard kinds, its moving bodies' own handles taken away.
All is measured on the objects that come out, by `grafu.judging`, which shares nothing with what made them, as in the
table `static` of `grafu evaluate`; here also what additions cost, and what they replace. Prints a table
in Markdown, one line per piece (of random furniture only those with a fault), and sums it up. --log keeps each piece's
figures in a file as they come; started again with the same file, it goes on where it stopped. --only interior (or
top, grasp, handle, joint) looks at that alone, which is faster.
"""

import argparse
import json
import sys
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path

from judge_additions_body import DEFAULT, Inside, interior_faults, joint_faults, top_faults
from judge_additions_handles import grasp_faults, new_handles, worded_handle_faults
from judge_additions_table import INTERIORS, KINDS, Verdict, crashed, table

from grafu.additions.config import NO_ADDITIONS, AdditionConfig
from grafu.asset.load import load_asset
from grafu.asset.part import Asset
from grafu.pipeline.functionalize import Functionalized, functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.synth.generate import make_specimen
from grafu.synth.samples import NOISY, TIDY
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel

SEED = 990_003
ALL_KINDS = {**TIDY, **NOISY}


def main() -> int:
    """Judges, and prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, nargs="?", help="pieces of furniture, one folder each")
    parser.add_argument("--made", type=int, default=0, metavar="N", help="made pieces with their true joints")
    parser.add_argument("--kinds", action="store_true", help="the catalogue of hard kinds")
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--first", type=int, default=0, help="number of the first made piece")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--log", type=Path, help="JSON lines: what was judged before is read from here, the rest added")
    parser.add_argument("--only", choices=KINDS, nargs="+", default=list(KINDS), help="what is looked at (all)")
    options = parser.parse_args()
    if options.folder is None and not options.made and not options.kinds:
        parser.error("nothing to judge: name a folder, --made N or --kinds")
    paths = sorted(p for p in options.folder.iterdir() if p.is_dir()) if options.folder else []
    tasks = {str(path): partial(judge_path, path, options.only) for path in paths}
    numbers = range(options.first, options.first + options.made)
    tasks |= {f"{options.seed}/{number}": partial(judge_made, options.seed, number, options.only) for number in numbers}
    tasks |= {f"kind {kind}": partial(judge_kind, kind, options.only) for kind in (ALL_KINDS if options.kinds else ())}
    known = _logged(options.log)
    with ProcessPoolExecutor(options.jobs) as pool:
        waiting = {name: pool.submit(task) for name, task in tasks.items() if name not in known}
        for name, future in waiting.items():
            error = future.exception()
            known[name] = crashed(name, error) if error else future.result()
            if options.log and not error:
                with options.log.open("a") as file:
                    file.write(json.dumps([name, asdict(known[name])]) + "\n")
            print(f"  {len(known)}/{len(tasks)}", file=sys.stderr, end="\r")
    print(table([known[name] for name in tasks], whole=bool(paths or options.kinds)))
    return 0


def _logged(path: Path | None) -> dict[str, Verdict]:
    """Returns the figures that a log holds, by what was judged."""
    lines = path.read_text().splitlines() if path and path.exists() else []
    return {name: Verdict(**figures) for name, figures in map(json.loads, lines)}


def judge_path(path: Path, kinds: Sequence[str] = KINDS) -> Verdict:
    """Returns the figures of a piece of furniture in a folder, its motions from the default source."""
    return judge(load_asset(path), MotionSource.AUTO, kinds)


def judge_made(seed: int, number: int, kinds: Sequence[str] = KINDS) -> Verdict:
    """Returns the figures of a made piece, with its true joints, without the parts that were removed from it."""
    specimen = make_specimen(seed, number)
    whole = specimen.whole
    missing = set(specimen.missing)
    parts = tuple(p for p in whole.parts if p.id not in missing)
    return judge(replace(whole, parts=parts, name=f"{number} {specimen.family}"), MotionSource.ANNOTATION, kinds)


def judge_kind(kind: str, kinds: Sequence[str] = KINDS) -> Verdict:
    """Returns the figures of a piece of the catalogue, with its true joints, without its handles."""
    asset = ALL_KINDS[kind]()
    parts = tuple(part for part in asset.parts if part.label is not PartLabel.HANDLE)
    return judge(replace(asset, parts=parts, name=kind), MotionSource.ANNOTATION, kinds)


def judge(asset: Asset, source: MotionSource, kinds: Sequence[str] = KINDS) -> Verdict:
    """Returns the figures of one piece, of those kinds."""
    result = _run(asset, source)
    tops = sum(a.part.label is PartLabel.TOP_PANEL for a in result.additions)
    plain = _run(asset, source, NO_ADDITIONS) if {"top", "joint"} & {*kinds} else None
    covered, faults = top_faults(asset, source, plain, tops) if plain and "top" in kinds else (None, [])
    inside = interior_faults(result) if "interior" in kinds else Inside([0] * len(INTERIORS), [], [], [])
    timings = dict(result.timings)
    return Verdict(
        name=asset.name,
        kinds=list(kinds),
        tops=tops,
        covered=covered,
        top_faults=faults,
        moving_bodies=len(result.object.joints),
        handles=sum(a.part.label is PartLabel.HANDLE for a in result.additions),
        grips=len(result.fittings.changes.carved),
        grasp_faults=list(grasp_faults(result)) if "grasp" in kinds else [],
        handle_faults=list(worded_handle_faults(result)) if "handle" in kinds else [],
        panels=inside.panels,
        refusals=inside.refusals,
        rooms=inside.rooms,
        interior_faults=inside.faults,
        boards=sum(a.style == "drawer box" for a in result.body.additions),
        waiting=sum(bool(joint.after and new_handles(result.object, joint)) for joint in result.object.joints),
        joint_faults=list(joint_faults(plain, result)) if plain and "joint" in kinds else [],
        seconds=timings["body"] + timings["fittings"],
    )


def _run(asset: Asset, source: MotionSource, additions: AdditionConfig = DEFAULT) -> Functionalized:
    return functionalize(asset, source, builtin_gallery(), PipelineConfig(Settings(additions=additions)))


if __name__ == "__main__":
    sys.exit(main())
