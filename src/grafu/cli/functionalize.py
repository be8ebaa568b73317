"""The verb `functionalize`: inputs and options in, one folder of results per input out."""

import argparse
import os
from pathlib import Path
from typing import TYPE_CHECKING

from grafu.asset.regular_files import read_head
from grafu.cli.cluster_option import add_cluster_option, is_remote, place_option
from grafu.cli.format_option import add_formats_option
from grafu.cli.input_options import add_input_options, add_limit_option, positive_count
from grafu.cli.limit_options import add_limit_options, limits_of
from grafu.cli.part_options import (
    add_addition_options,
    add_choices_of_parts,
    add_simulator_options,
    motion_choice,
    with_grasps,
    with_moves,
)
from grafu.cli.stated_settings import MOST_SETTINGS, stated_settings
from grafu.cli.telling import add_telling_options, clear_line, show_at_once
from grafu.cli.verb import complain
from grafu.errors import OptionError

if TYPE_CHECKING:
    from grafu.cli.job import Failed, Job, JobOptions, JobResult

_DESCRIPTION = """\
Reads part-segmented furniture (GLB, glTF, USD, FBX, COLLADA, URDF, SDF, MJCF, OBJ, a folder of meshes, a
PartNet-Mobility or HSSD folder) and writes for each input DIR/<name>/ with model.glb (animated), model.urdf with
meshes/, graph.json, report.json and report.html; of several inputs DIR/index.html shows all, worst first.
"""
_EXAMPLES = """\
examples:
  grafu functionalize cabinet.glb --out results
  grafu functionalize models/* --motion annotation --jobs 4 --out results
  grafu functionalize models/* --out results --resume
  grafu functionalize room.glb --pieces split --out results
  grafu functionalize cabinet.glb --move door_2=right --move board_7=fixed --out results --overwrite
  grafu functionalize scan.obj --height 0.72 --front -Y --out results --overwrite
  grafu functionalize cabinet.obj --motion particulate:eval/pred.npz --out results
  grafu functionalize cabinet.glb --handle knob-round --interior shelves=2 --out results
  grafu functionalize 's3://bucket/models/*' --cluster ray://HOST:10001 --out s3://bucket/results --resume
"""


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> argparse.ArgumentParser:
    """Adds the verb and returns its parser."""
    parser = verbs.add_parser(
        "functionalize", help="make furniture work: hinges, rails, limits", description=_DESCRIPTION, epilog=_EXAMPLES
    )
    parser.add_argument(
        "inputs", nargs="+", type=place_option, metavar="INPUT", help="a model: file or folder, or its URL (s3://...)"
    )
    parser.add_argument(
        "--out", required=True, type=place_option, metavar="DIR", help="where the results go: DIR/<name>/; also a URL"
    )
    parser.add_argument("--name", metavar="NAME", help="of one input, what its results are called: DIR/NAME/")
    parser.add_argument(
        "--motion",
        type=motion_choice,
        metavar="SOURCE",
        help="where motions come from: network (trained), rule (labels, boxes and handles), auto (the network, or the "
        "rule without weights), annotation: the input's own joints, which the others do not read, or another system's "
        "file: particulate:FILE, singapo:FILE, grafu-pred:FILE, urdf:FILE; for several inputs a folder with an entry "
        "for each name (default: auto)",
    )
    add_choices_of_parts(parser)
    add_formats_option(parser)
    parser.add_argument("--jobs", type=positive_count, metavar="N", help="inputs at once (default: one per core)")
    add_cluster_option(parser)
    parser.add_argument("--templates", type=Path, metavar="DIR", help="a folder of your own hinges, rails and handles")
    parser.add_argument(
        "--weights",
        type=Path,
        metavar="FILE",
        help="the network that you trained: a file in ONNX form (`grafu train`), or a checkpoint of the authors' (.pt)",
    )
    parser.add_argument(
        "--no-page", action="store_true", help="leave out report.html of each model, and index.html of several"
    )
    parser.add_argument(
        "--check", action="store_true", help="check each result as `grafu check` does; needs grafu[sim]"
    )
    parser.add_argument("--no-trim", action="store_true", help="never take material away to give a part clearance")
    parser.add_argument(
        "--settings",
        type=Path,
        metavar="FILE",
        help="settings.json, as every run and the Blender extension write it: how the input is read, what is added, "
        "what is decided of single parts and joints; other options of this command win over it",
    )
    again = parser.add_mutually_exclusive_group()
    again.add_argument("--overwrite", action="store_true", help="replace results that are there already")
    again.add_argument(
        "--resume",
        action="store_true",
        help="go on where a run was stopped: results that are there stay, and are shown with the new ones",
    )
    add_simulator_options(parser)
    add_addition_options(parser)
    add_input_options(parser)
    add_limit_option(parser)
    add_limit_options(parser)
    add_telling_options(parser, "each model", stages=True)
    parser.set_defaults(run=run, is_single=_is_single, on_begin=_show_begin, on_stopped=_tell_stopped)
    return parser


def _is_single(options: argparse.Namespace) -> bool:
    return not is_remote(options) and len(_distinct(options.inputs)) == 1 and not _may_split(options)


def _may_split(options: argparse.Namespace) -> bool:
    """Whether an input may be split into several models: each then has a process of its own."""
    if options.pieces is not None or options.settings is None:
        return bool(options.pieces == "split")
    try:
        return b'"split"' in read_head(options.settings, MOST_SETTINGS)
    except OSError:
        return False  # it is refused when it is read


def _distinct(inputs: list[Path]) -> list[Path]:
    return list({os.path.realpath(path): path for path in inputs}.values())


def run(options: argparse.Namespace) -> int:
    """Functionalizes every input and prints the summary; returns the exit code.

    Raises:
        FunctionalizationError: if the options are wrong; nothing has been written then.
    """
    from grafu.cli.check import check_results, require_simulator
    from grafu.cli.job import Succeeded, jobs_of
    from grafu.cli.run_page import write_index
    from grafu.cli.runs import pieces_apart, run_alone, run_several, tell
    from grafu.cli.summary import print_place, print_results
    from grafu.export.whole_file import clear_remains

    if is_remote(options):
        if options.name:
            raise OptionError("`--name` names results on this disk: leave it out")
        from grafu.cli.remote_run import run_remote

        return run_remote(options, _job_options(options, alone=len(options.inputs) == 1))
    if options.check:
        require_simulator(options.formats)
    inputs = _distinct(options.inputs)
    shared = _job_options(options, alone=len(inputs) == 1)
    jobs, refused = _named_job(inputs, shared, options.name) if options.name else jobs_of(inputs, shared)
    clear_remains(options.out)
    if shared.settings.reading.pieces == "split":
        jobs, unread = pieces_apart(jobs, inputs, options)
        refused += unread
    tell(options, *refused)
    done = [run_alone(job, options) for job in jobs] if _is_single(options) else run_several(jobs, options)
    order = {job.name: k for k, job in enumerate(jobs)}
    places = {path: k for k, path in enumerate(inputs)}
    results = sorted([*done, *refused], key=lambda r: (places[r.job.input], order.get(r.job.name, -1)))
    clear_line()
    print_results(results)
    if options.check:
        check_results([r.job.folder for r in results if isinstance(r, Succeeded)], options.json_lines)
    if not options.no_page and (page := write_index(results, options.out)):
        print_place("all on one page", page)
    return _exit_code(results)


def _named_job(inputs: list[Path], shared: "JobOptions", name: str) -> "tuple[list[Job], list[Failed]]":
    """Returns the job of the one input, whose results have a name that the user states."""
    from grafu.cli.job import Job, with_places_apart
    from grafu.export.output_names import name_that_is_safe

    if len(inputs) > 1 or shared.settings.reading.pieces == "split":
        what = f"{len(inputs)} inputs" if len(inputs) > 1 else "--pieces split"
        raise OptionError(f"`--name` names the results of one model: got {what}")
    return with_places_apart([Job(inputs[0], name_that_is_safe(name, str(inputs[0])), shared)], inputs)


def _job_options(options: argparse.Namespace, alone: bool) -> "JobOptions":
    """Returns the shared options; what is wrong with them is said here, before any input is read."""
    from grafu.cli.job import JobOptions
    from grafu.export.formats import exporter_for

    formats = tuple(dict.fromkeys(name.strip().lower() for name in options.formats.split(",") if name.strip()))
    for name in formats:
        exporter_for(name)
    from grafu.templates.gallery import open_gallery, open_handles

    _require_weights(options)
    settings = stated_settings(options)
    open_gallery(options.templates).preferring(settings.hinge)
    prediction = options.motion if options.motion and options.motion.source.is_foreign else None
    is_whole = settings.reading.pieces == "together" or settings.reading.piece is not None
    if options.grasp:
        settings = with_grasps(settings, options.grasp, alone and is_whole, open_handles(options.templates))
    if options.move:
        settings = with_moves(settings, options.move, alone and is_whole, prediction)
    return JobOptions(
        out=options.out if isinstance(options.out, Path) else Path(),  # at a URL each machine has a folder of its own
        settings=settings,
        prediction=prediction,
        formats=formats,
        templates=options.templates,
        page=not options.no_page,
        overwrite=options.overwrite,
        resume=options.resume,
        debug=options.debug,
        alone=alone,
        limits=limits_of(options),
    )


def _require_weights(options: argparse.Namespace) -> None:
    """Makes sure that `--weights` is a network that runs, and is not given for a source that is not the network."""
    from grafu.pipeline.motion_source import MotionSource

    if options.weights is None:
        return
    from grafu.cli.weights_option import usable_weights

    source = options.motion.source if options.motion else MotionSource.AUTO
    if source not in (MotionSource.AUTO, MotionSource.NETWORK):
        raise OptionError(f"`--weights` and `--motion {source}` exclude each other: leave one of them out")
    options.weights = usable_weights(options.weights, options.out if isinstance(options.out, Path) else Path())


def _show_begin(options: argparse.Namespace) -> None:
    """Names the inputs on a terminal before anything heavy is imported."""
    inputs = options.inputs if is_remote(options) else _distinct(options.inputs)
    more = f" and {len(inputs) - 1} more" if len(inputs) > 1 else ""
    if not (options.quiet or options.json_lines):
        show_at_once(f"{inputs[0].name}{more}")


def _tell_stopped(options: argparse.Namespace, why: str) -> None:
    """States that the one input was stopped, in the line of JSON that is wanted."""
    from grafu.cli.job import Failed, Job, JobOptions
    from grafu.cli.runs import tell
    from grafu.export.output_names import output_name

    path = options.inputs[0]
    tell(options, Failed(Job(path, options.name or output_name(path), JobOptions(options.out)), why, users_fault=True))


def _exit_code(results: "list[JobResult]") -> int:
    """Returns 0 where all is done, 2 where the one input is bad, 1 where some of several failed or we are at fault."""
    from grafu.cli.job import Failed

    failed = [result for result in results if isinstance(result, Failed)]
    for failure in failed:
        names_its_input = len(results) == 1 or failure.why.startswith(str(failure.job.input))
        complain(failure.why if names_its_input else f"{failure.job.input}: {failure.why}")
    if not failed:
        return 0
    return 2 if len(results) == 1 and failed[0].users_fault else 1
