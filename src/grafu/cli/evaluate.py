"""The verb `evaluate`: the paper's tables on any data, for any method."""

import argparse
import os
import shlex
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING

from grafu.cli.input_options import positive_count
from grafu.cli.limit_options import add_limit_options, limits_of, why_stopped
from grafu.cli.run_page import RUN_PAGE, is_free_for_page
from grafu.cli.telling import add_telling_options, print_json
from grafu.cli.verb import complain, say
from grafu.errors import ExportError, OptionError

if TYPE_CHECKING:
    from grafu.evaluation.records import ResultRow
    from grafu.evaluation.results import Results
    from grafu.evaluation.table import ResultTable
    from grafu.evaluation.tasks import EvaluationPlan, Task


# As in `grafu.evaluation.tasks`; spelled again, so that `grafu --help` answers at once.
_TABLES = "motion,outcomes,masking,static,models,ood"
_METHODS = "annotation,rule,network"
_SECONDS = 900.0  # for a task: to make a model and to measure it

_DESCRIPTION = """\
Runs each method on each model, measures every part that counts, and writes tables to DIR/tables as Markdown, CSV,
JSON and LaTeX, with index.md that states how each figure was measured, and DIR/index.html to sort and look at.
Finished work is kept in DIR/rows.jsonl: after it was stopped or killed, the same command resumes.

data:    a folder of models whose joints are annotated (PartNet-Mobility, HSSD with S2O annotations, URDF, the authors'
         releases), results with decisions made in grafu edit, or synth:SEED:COUNT for synthetic furniture
methods: annotation, rule, network (network:FILE: of other weights), and what others predicted: particulate:DIR,
         singapo:DIR, grafu-pred:DIR, urdf:DIR, where DIR holds one entry per model id; particulate-run:FILE,
         singapo-run:FILE run an installed copy as a TOML file states; llm:MODEL (completed graphs) and llm-edit:MODEL
         (edits) ask a language model at OPENAI_BASE_URL with OPENAI_API_KEY, and keep its replies; what cannot be run
         is a row that states so
tables:  motion, outcomes (models that are aligned, reasonable, wrong), masking (labels hidden), static (tops,
         handles, interiors), models (worst first), ood (farthest from what the network was trained on)
"""
_EXAMPLES = """\
examples:
  grafu evaluate --data models --out results
  grafu evaluate --data models --methods network,particulate:predictions --tables motion,models --out results
  grafu evaluate --data synth:990002:100 --methods rule,network --out results
  grafu evaluate --data models more_models --tables masking,models,ood --rates 10,30,50,100 --pictures --out results
  grafu evaluate --data models --methods network,llm:MODEL --llm llm.toml --tables motion,models --out results
"""


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> argparse.ArgumentParser:
    """Adds the verb and returns its parser."""
    parser = verbs.add_parser(
        "evaluate", help="measure methods on annotated models: the paper's tables", description=_DESCRIPTION,
        epilog=_EXAMPLES,
    )  # fmt: skip
    parser.add_argument(
        "--data", nargs="+", required=True, metavar="DATA", help="the models: folders, or synth:SEED:COUNT"
    )
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="where rows and tables go")
    parser.add_argument(
        "--split", default="", metavar="NAME", help="of a FurFun release: the test models of this split alone"
    )
    parser.add_argument("--methods", default=_METHODS, metavar="LIST", help=f"what is compared (default: {_METHODS})")
    parser.add_argument("--tables", default=_TABLES, metavar="LIST", help=f"what is written (default: {_TABLES})")
    parser.add_argument(
        "--seeds", type=positive_count, default=5, metavar="N", help="draws of hidden labels at each rate (default: 5)"
    )
    parser.add_argument(
        "--weights",
        type=Path,
        metavar="FILE",
        help="of the method network: an ONNX file, or the authors' checkpoint (.pt)",
    )
    parser.add_argument(
        "--rates",
        type=_rates,
        metavar="LIST",
        help="how many labels are hidden, in per cent (default: 10,20,30,40,50,60,70,80,90,100)",
    )
    parser.add_argument(
        "--pictures",
        action="store_true",
        help="also draw the curves of hidden labels, the models farthest from training, and the worst ones",
    )
    parser.add_argument("--jobs", type=positive_count, metavar="J", help="processes (default: one per core)")
    parser.add_argument("--overwrite", action="store_true", help="measure everything anew")
    parser.add_argument(
        "--llm", type=Path, metavar="FILE", help="how language models are asked: a TOML file (default: as documented)"
    )
    parser.add_argument(
        "--replies", type=Path, metavar="DIR", help="where their replies are kept and read from (default: OUT/replies)"
    )
    add_limit_options(parser, _SECONDS)
    add_telling_options(parser, "each task")
    parser.set_defaults(run=run)
    return parser


def _rates(text: str) -> tuple[float, ...]:
    try:
        rates = tuple(float(word) / 100 for word in text.split(","))
    except ValueError:
        rates = ()
    if not rates or not all(0 < rate <= 1 for rate in rates):
        raise argparse.ArgumentTypeError(f"must be rates in per cent, above 0 and at most 100: got {text!r}")
    return rates


EXIT_DONE, EXIT_FAILED, EXIT_INTERRUPTED = 0, 1, 130
_SHOWN = ("aligned", "reasonable", "collision", "collision_fixed", "connected_fixed", "works", "works_fixed")


def run(options: argparse.Namespace) -> int:
    """Measures what is not measured yet and writes the tables; returns 1 where a task failed, 130 where it was stopped.

    Raises:
        FunctionalizationError: if the options are wrong, there is nothing to measure, or files cannot be written.
    """
    from grafu.cli.evaluation_page import evaluation_page
    from grafu.evaluation.output import build_tables, output_files
    from grafu.evaluation.pictures import picture_files
    from grafu.evaluation.records import NAME, begin_rows
    from grafu.evaluation.results import collect
    from grafu.export.files import ExportFiles, write_files
    from grafu.export.whole_file import write_whole

    plan = _plan(options)
    file = options.out / NAME
    _require_room(options.out)
    rows = begin_rows(file, anew=options.overwrite)
    jobs = options.jobs or os.cpu_count() or 1
    try:
        first = plan.first_tasks()
        _do(first, rows, file, jobs, options)
        pairs = plan.twin_tasks(rows)
        _do(pairs, rows, file, jobs, options)
    except KeyboardInterrupt:
        complain(f"interrupted; {len(rows)} rows stand in {file}, and the same command goes on")
        return EXIT_INTERRUPTED
    results = collect((*first, *pairs), rows)
    tables = build_tables(plan, results)
    pictures = picture_files(plan, results, tables) if options.pictures else {}
    files = ExportFiles({**output_files(plan, results, tables, _command(options), tuple(pictures)), **pictures})
    write_files(files, options.out / "tables", overwrite=True)
    write_whole(evaluation_page(f"Evaluation on {plan.data}", tables), options.out / RUN_PAGE)
    _say(tables, results, options.out)
    return EXIT_FAILED if results.failures else EXIT_DONE


def _require_room(out: Path) -> None:
    """Refuses a folder in which something that is not ours stands where tables or the page go, before any work."""
    from grafu.export.files import require_free

    require_free(out / "tables", overwrite=True)
    if not is_free_for_page(out / RUN_PAGE):
        raise ExportError(f"`{out / RUN_PAGE}` is no page of grafu's, so it is kept: choose another --out")


def _plan(options: argparse.Namespace) -> "EvaluationPlan":
    from grafu.cli.weights_option import usable_weights
    from grafu.evaluation.config_file import read_config
    from grafu.evaluation.dataset import find_all_models
    from grafu.evaluation.llm.config import LlmConfig
    from grafu.evaluation.methods import LEVELS, MethodOptions, parse_method
    from grafu.evaluation.tasks import EvaluationPlan

    llm = read_config(options.llm, LlmConfig) if options.llm else LlmConfig()
    weights = usable_weights(options.weights, options.out) if options.weights else None
    chosen = MethodOptions(llm, options.replies or options.out / "replies", options.out / "predictions", weights)
    methods = tuple(parse_method(word, chosen) for word in _words(options.methods))
    absent = next((method for method in methods if method.folder is not None and not method.folder.is_dir()), None)
    if absent is not None:
        raise OptionError(f"`{absent.folder}` of the method {absent.name} must be a folder with an entry per model id")
    untold = next((method.weights for method in methods if method.weights and not method.weights.is_file()), None)
    if untold is not None:
        raise OptionError(f"`{untold}` of the method network must be a file that `grafu train` exported")
    models, tables = find_all_models(options.data, options.split), _words(options.tables)
    rates = options.rates or LEVELS
    return EvaluationPlan(" ".join(options.data), models, methods, tables, options.seeds, levels=rates)


def _words(text: str) -> tuple[str, ...]:
    return tuple(word.strip() for word in text.split(",") if word.strip())


def _do(
    tasks: "Sequence[Task]", rows: "dict[str, ResultRow]", file: Path, jobs: int, options: argparse.Namespace
) -> None:
    """Does the tasks that have no row yet, keeps each row at once, and names those in work on a bar."""
    from grafu.cli.model_bar import model_bar
    from grafu.cli.pool import run_all
    from grafu.evaluation.perform import failed, perform
    from grafu.evaluation.records import append_rows, done
    from grafu.evaluation.tasks import key_of

    left = [task for task in tasks if not done(rows, key_of(task))]
    if not left:
        return
    limits, silent = limits_of(options), options.quiet or options.json_lines
    names = {key_of(task): _named(task) for task in left}
    made = run_all(
        left,
        jobs,
        perform,
        lambda task, how: failed(task, why_stopped(how, limits)),
        limits,
        lambda task: bar.begins(_named(task)),
    )
    with model_bar(len(left), "tasks", silent) as bar, closing(made):
        for row in made:
            append_rows(file, [row])
            rows[row.key] = row
            not_run = row.not_run and f"not run: {row.not_run}"
            bar.ends(names[row.key], f"{names[row.key]}: {row.error or not_run or f'{row.seconds:.1f} s'}")
            if options.json_lines:
                ended = {"error": row.error or None, "not_run": row.not_run or None}
                print_json({**row.task, "seconds": row.seconds, **ended})


def _named(task: "Task") -> str:
    """Returns the model of a task and the method, if any."""
    model, method = getattr(task, "model", None), getattr(task, "method", None)
    named = model.id if model else f"model {getattr(task, 'number', 0)} of the training data"
    return f"{named} by {method.name}" if method else named


def _command(options: argparse.Namespace) -> str:
    """Returns the command that gives these tables, whatever it was spelled like."""
    words = ["grafu", "evaluate", "--data", *options.data, "--methods", options.methods, "--tables", options.tables]
    rates = options.rates and ",".join(f"{100 * rate:g}" for rate in options.rates)
    given = [
        ("--split", options.split or None),
        ("--weights", options.weights),
        ("--rates", rates),
        ("--llm", options.llm),
        ("--replies", options.replies),
    ]
    more = [word for name, path in given if path is not None for word in (name, str(path))]
    more += ["--pictures"] if options.pictures else []
    return shlex.join([*words, "--seeds", str(options.seeds), *more, "--out", str(options.out)])


def _say(tables: "Sequence[ResultTable]", results: "Results", out: Path) -> None:
    from grafu.pipeline.words import counted

    motion = next((table for table in tables if table.name == "motion"), None)
    if motion is not None:
        _print_motion(motion)
    for method, reasons in results.not_run.items():
        complain(f"{method}: not run on {counted(len(reasons), 'model')}: {'; '.join(sorted(set(reasons.values())))}")
    for failure in results.failures:
        complain(f"{failure.model}: {failure.what}: {failure.error}")
    say(f"written to {out / 'tables' / 'index.md'}; to look at: {out / RUN_PAGE}")


def _print_motion(table: "ResultTable") -> None:
    from grafu.cli.terminal import plain_table, wide_console
    from grafu.evaluation.bootstrap import Figure
    from grafu.evaluation.table import shown

    names = [column.name for column in table.columns]
    kept = [column for column in table.columns if column.name in ("method", "data", *_SHOWN)]
    printed = plain_table(*(column.title for column in kept))
    for row in table.rows:
        if row[names.index("over")] == "objects":
            cells = ((row[names.index(column.name)], column) for column in kept)
            printed.add_row(*(shown(c.value if isinstance(c, Figure) else c, column) for c, column in cells))
    wide_console().print(printed)
