"""A process that keeps running while the user works on a model: `python -m grafu.pipeline.worker FOLDER`.

Every line on stdin is a JSON list of three paths: input, settings and where results go, as `interactive` takes them. It
answers on stdout with that module's lines, and then `done` or `error WHY`. What a change does not touch is not made
again; the answer is the same as a fresh process gives. When its input ends, it ends at once, whatever it is doing, and
takes FOLDER, which is the asker's for passing things, with it.
"""

import json
import os
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from queue import Queue
from threading import Thread

from grafu.errors import FunctionalizationError
from grafu.pipeline.interactive import run
from grafu.processes.cache import CACHED_VALUES, Cache
from grafu.visible import visible


def serve(lines: Iterator[str], cache: Cache) -> None:
    """Answers one line after another; an input or a setting at fault is an answer, too."""
    for line in lines:
        try:
            source, settings, folder = map(Path, json.loads(line))
            run(source, settings, folder, cache)
            _say("done")
        except FunctionalizationError as error:
            _say("error " + " ".join(str(error).split()))


def _lines(folder: Path) -> Iterator[str]:
    """Yields lines as they come; a thread reads them, so that their end ends the process even amid work."""
    lines: Queue[str] = Queue()

    def read() -> None:
        for line in sys.stdin:
            lines.put(line)
        shutil.rmtree(folder, ignore_errors=True)
        os._exit(0)

    Thread(target=read, daemon=True).start()
    while True:
        yield lines.get()


def _say(what: str) -> None:
    print(visible(what), flush=True)


if __name__ == "__main__":
    try:
        serve(_lines(Path(sys.argv[1])), Cache(CACHED_VALUES))
    except Exception as error:  # a fault of ours: one line, and the next line needs a new process
        _say(f"error internal fault: {type(error).__name__}: {' '.join(str(error).split())}")
        os._exit(1)
