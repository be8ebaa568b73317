"""One job for a program that shows how far it is: `python -m grafu.cli.finalize ORDER`.

ORDER is a JSON file: `source`, `settings` and `out` (paths), `formats` (a list), `overwrite`, and `object`, where the
object made goes for another process (`grafu.export.blend.process`). What `grafu functionalize` writes goes to
OUT/<the source's name>/. Every line on stdout is `stage NAME` as a stage begins, then `done` or `error WHY`; the exit
code is 0, or 2.
"""

import json
import sys
from pathlib import Path
from typing import final

from pydantic import TypeAdapter

from grafu.asset.json_files import read_own
from grafu.cli.job import Failed, Job, JobOptions, Listener, run_job
from grafu.cli.verb import one_line
from grafu.dataclass import dataclass
from grafu.errors import FunctionalizationError, OptionError
from grafu.export.blend.process import packed
from grafu.export.formats import exporter_for
from grafu.export.output_names import name_of_model, why_not_apart
from grafu.pipeline.settings import settings_from_bytes
from grafu.visible import visible


@final
@dataclass(frozen=True)
class BlendJob:
    """What the file holds."""

    source: Path
    settings: Path
    out: Path
    formats: tuple[str, ...]
    object: Path
    overwrite: bool = False
    piece: str = ""
    """The name of the model where it is one of several pieces of furniture in the source."""


def finalize(order_file: Path) -> str:
    """Does what an order states; returns why it could not be done, empty where it was."""
    try:
        order = _order(order_file)
        settings = settings_from_bytes(read_own(order.settings, "settings of grafu"), order.settings)
        for name in order.formats:
            exporter_for(name)
        name = name_of_model(order.source, order.piece)
    except FunctionalizationError as error:
        return one_line(str(error))
    options = JobOptions(
        out=order.out,
        formats=order.formats,
        settings=settings,
        overwrite=order.overwrite,
    )
    job = Job(order.source, name, options)
    if why := why_not_apart(job.folder, [order.source]):
        return why
    listener = Listener(lambda stage: _say(f"stage {stage}"), lambda made: _write(order.object, packed(made)))
    result = run_job(job, listener)
    return result.why if isinstance(result, Failed) else ""


def _order(path: Path) -> BlendJob:
    """Returns what a file orders.

    Raises:
        AssetError: if it cannot be read.
        OptionError: if it is damaged, or orders something else.
    """
    try:
        return TypeAdapter(BlendJob).validate_python(json.loads(read_own(path, "an order")))
    except (ValueError, RecursionError) as error:
        raise OptionError(f"{path} is no order of grafu: {' '.join(str(error).split())}") from None


def _write(path: Path, data: bytes) -> None:
    path.write_bytes(data)


def _say(what: str) -> None:
    print(visible(what), flush=True)


if __name__ == "__main__":
    why = finalize(Path(sys.argv[1]))
    _say(f"error {why}" if why else "done")
    sys.exit(2 if why else 0)
