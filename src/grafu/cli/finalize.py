"""One job for a program that shows how far it is: `python -m grafu.cli.finalize ORDER`.

ORDER is a JSON file: `source`, `settings` and `out` (paths), `formats` (a list), `overwrite`, and `object`, where the
object made goes for another process (`grafu.export.blend.transport`). What `grafu functionalize` writes goes to
OUT/<the source's name>/. Every line on stdout is `stage NAME` as a stage begins, then `done` or `error WHY`; the exit
code is 0, or 2.
"""

import json
import sys
from pathlib import Path

from grafu.cli.job import Failed, Job, JobOptions, Listener, run_job
from grafu.cli.messages import one_line
from grafu.errors import FunctionalizationError
from grafu.export.blend.transport import packed
from grafu.export.formats import exporter_for
from grafu.export.output_names import output_name, why_not_apart
from grafu.pipeline.motion_source import MotionChoice
from grafu.pipeline.settings import settings_from_json
from grafu.visible import visible


def finalize(order_file: Path) -> str:
    """Does what an order says; returns why it could not be done, empty where it was."""
    order = json.loads(order_file.read_text(encoding="utf-8"))
    try:
        settings = settings_from_json(json.loads(Path(order["settings"]).read_text(encoding="utf-8")))
        for name in order["formats"]:
            exporter_for(name)
        source = Path(order["source"])
        name = output_name(source)
    except FunctionalizationError as error:
        return one_line(str(error))
    options = JobOptions(
        out=Path(order["out"]),
        motion=MotionChoice(settings.motion),
        load=settings.reading.options,
        formats=tuple(order["formats"]),
        settings=settings,
        overwrite=order["overwrite"],
    )
    job, target = Job(source, name, options), Path(order["object"])
    if why := why_not_apart(job.folder, [source]):
        return why
    listener = Listener(lambda stage: _say(f"stage {stage}"), lambda made: _write(target, packed(made)))
    result = run_job(job, listener)
    return result.why if isinstance(result, Failed) else ""


def _write(path: Path, data: bytes) -> None:
    path.write_bytes(data)


def _say(what: str) -> None:
    print(visible(what), flush=True)


if __name__ == "__main__":
    why = finalize(Path(sys.argv[1]))
    _say(f"error {why}" if why else "done")
    sys.exit(2 if why else 0)
