"""The process that builds for the editor: `python -m grafu.editor.building`. It stays warm from one choice to the next.

Every line on stdin is a JSON object, see `Order`. It answers on stdout with lines of JSON, `{"stage": NAME}` as a
stage begins, then `{"done": ...}` or `{"error": WHY}`, where `done` is what the order made. What a choice does not
touch comes from the cache. The line `GIVE_WAY` ends the order `judge`, if that is in work: then it made
nothing. When its input ends it ends at once, whatever it is doing.
"""

import json
import os
import signal
import sys
from _thread import interrupt_main
from collections.abc import Callable, Iterable, Iterator
from dataclasses import asdict, field
from hashlib import blake2b
from pathlib import Path
from queue import Queue
from threading import Thread
from time import perf_counter
from types import FrameType
from typing import Any, Literal, TextIO, final

from grafu.api.saving import files_of, report_before_saving
from grafu.articulation.motion_kind import motion_kind
from grafu.asset.load import load_asset
from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.editor.shown import Shown
from grafu.errors import ExportError, FunctionalizationError
from grafu.export.files import write_files
from grafu.export.formats import FORMATS, exporter_for
from grafu.pipeline.functionalize import Functionalized, functionalize
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.report import report_of
from grafu.pipeline.report_schema import Report
from grafu.pipeline.settings import Settings, settings_from_json
from grafu.processes.cache import CACHED_VALUES, Cache
from grafu.templates.gallery import builtin_gallery
from grafu.viewer.live import live_markup, live_page

Say = Callable[[dict[str, Any]], None]
STATE, GEOMETRY, TEXTURES = "state.json", "geometry.bin", "textures.json"
_KEPT = 8  # builds: most share their meshes
GIVE_WAY = "give way"
FILES = {"geometry": GEOMETRY, "textures": TEXTURES}


@final
@dataclass(frozen=True)
class Order:
    """What is asked for: `build` writes what the page shows into `folder`, `export` the results into it.

    `judge` returns what the page states once masses and collision shapes are known, too: that takes longer.

    `source` is the input, `name` that of the results, `settings` are as in `settings.json`.
    """

    do: Literal["build", "judge", "export"]
    source: Path
    name: str
    folder: Path
    settings: dict[str, Any]

    def line(self) -> str:
        """Returns the order as a line of JSON."""
        return json.dumps({**asdict(self), "source": str(self.source), "folder": str(self.folder)})


def order_of(line: str) -> Order:
    """Returns the order that a line of JSON states."""
    stated = json.loads(line)
    return Order(**{**stated, "source": Path(stated["source"]), "folder": Path(stated["folder"])})


@final
class GaveWay(KeyboardInterrupt):
    """What can wait was interrupted for what cannot."""


@final
class Interruptible:
    """Work that ends where `hear`, the handler of a signal, is called meanwhile; not a value."""

    def __init__(self) -> None:
        self._is_at_work = False

    def hear(self, _: int, __: FrameType | None) -> None:
        """Takes the signal; raises GaveWay if there is work."""
        if self._is_at_work:
            self._is_at_work = False
            raise GaveWay

    def made(self, make: Callable[[], dict[str, Any]]) -> dict[str, Any]:
        """Returns what is made; nothing where it was interrupted."""
        try:
            self._is_at_work = True
            return make()
        except GaveWay:
            return {}
        finally:
            self._is_at_work = False


CAN_WAIT = Interruptible()
"""Of this process: signals are the process's, too."""


@final
@dataclass
class Bench:
    """What stays from one order to the next: assets as they were read, what was made, and the cache; not a value."""

    say: Say
    cache: Cache = field(default_factory=lambda: Cache(CACHED_VALUES))
    _read: tuple[object, Asset] | None = None
    _made: list[tuple[object, Functionalized]] = field(default_factory=list)

    def carry_out(self, order: Order) -> dict[str, Any]:
        """Does what is asked for and returns what it made, as JSON values.

        Raises:
            FunctionalizationError: if the input, a setting or the folder is at fault.
        """
        settings = settings_from_json(order.settings)
        if order.do == "judge":
            return CAN_WAIT.made(lambda: self._judge(order, settings))
        made = self.made(order.source, settings)
        if order.do == "export":
            return self._export(order, made, settings)
        self._tell("write")
        return write_page(Shown(made, order.name, self.cache, settings), order.folder)

    def made(self, source: Path, settings: Settings) -> Functionalized:
        """Returns what the settings make of an input, which is read once; the last few are kept, for undo and redo."""
        key = (source, settings)
        for known, made in self._made:
            if known == key:
                return made
        asset, config = self._asset(source, settings), PipelineConfig(settings)
        made = functionalize(asset, settings.motion, builtin_gallery(), config, self._tell, self.cache)
        self._made = [(key, made), *self._made[: _KEPT - 1]]
        return made

    def _asset(self, source: Path, settings: Settings) -> Asset:
        key = (source, settings.reading)
        if self._read is None or self._read[0] != key:
            self._tell("load")
            self._read = (key, load_asset(source, settings.reading))
        return self._read[1]

    def _judge(self, order: Order, settings: Settings) -> dict[str, Any]:
        made = self.made(order.source, settings)
        self._tell("judge")
        return _stated(made, report_before_saving(made, order.name, formats_here()[0]))

    def _export(self, order: Order, made: Functionalized, settings: Settings) -> dict[str, Any]:
        self._tell("export")
        formats, left_out = formats_here()
        saved = files_of(made, order.name, formats, settings)
        self._tell("write")
        write_files(saved.files, order.folder, overwrite=True)
        told = {"folder": str(order.folder), "formats": list(formats), "left out": left_out}
        return told | _stated(made, saved.report)

    def _tell(self, stage: str) -> None:
        self.say({"stage": stage})


def _stated(made: Functionalized, report: Report) -> dict[str, Any]:
    """Returns what the page states of a build."""
    return {
        "report": report.to_json(),
        "markup": live_markup(made.asset, made.object, made.completion, report),
    }


def formats_here() -> tuple[tuple[str, ...], dict[str, str]]:
    """Returns the formats that can be written here, and why each of the others cannot."""
    left_out: dict[str, str] = {}
    for name in FORMATS:
        try:
            exporter_for(name)
        except ExportError as error:
            left_out[name] = str(error)
    return tuple(name for name in FORMATS if name not in left_out), left_out


def write_page(shown: Shown, folder: Path) -> dict[str, Any]:
    """Writes what the page shows into a folder; returns the digests of what it need not fetch again if it has it."""
    made = shown.made
    report = report_of(made, shown.name)
    page = live_page(made.asset, made.object, made.completion, report, shown.cache)
    textures = json.dumps(page.textures).encode()
    digests = {"geometry": _digest(page.buffer), "textures": _digest(textures)}
    state = {
        "markup": page.markup,
        "scene": page.scene,
        "report": report.to_json(),
        "motions": shown.motions,
        "sides": shown.sides,
        "compartments": shown.compartments,
        "collisions": shown.collisions,
        "upright": shown.upright,
        "rooms": shown.rooms(page.scene["items"], report),
        "sliding": [joint.part for joint in report.joints if motion_kind(joint.type).slides],
        **digests,
    }
    (folder / GEOMETRY).write_bytes(page.buffer)
    (folder / TEXTURES).write_bytes(textures)
    (folder / STATE).write_text(json.dumps(state, ensure_ascii=True, allow_nan=False), encoding="utf-8")
    return digests


def _digest(data: bytes) -> str:
    return blake2b(data, digest_size=16).hexdigest()


def serve(lines: Iterable[str], say: Say) -> None:
    """Carries out one order after another; what is at fault is an answer, too."""
    bench = Bench(say)
    for line in lines:
        started = perf_counter()
        try:
            done = bench.carry_out(order_of(line))
            say({"done": done, "seconds": round(perf_counter() - started, 3)})
        except FunctionalizationError as error:
            say({"error": " ".join(str(error).split())})


def _lines() -> Iterator[str]:
    """Yields lines as they come; a thread reads them, so that their end ends the process even amid work."""
    lines: Queue[str] = Queue()

    def read() -> None:
        for line in sys.stdin:
            if line.strip() == GIVE_WAY:
                interrupt_main(signal.SIGINT)
            else:
                lines.put(line)
        os._exit(0)

    Thread(target=read, daemon=True).start()
    while True:
        yield lines.get()


def _own_output() -> TextIO:
    """Returns what answers go to; whatever libraries print goes to stderr from then on."""
    own = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    return own


def main() -> None:
    """Serves until its input ends; a fault of ours is one line, and ends it."""
    output = _own_output()
    signal.signal(signal.SIGINT, CAN_WAIT.hear)  # Ctrl-C ends the server, which ends this

    def say(values: dict[str, Any]) -> None:
        output.write(json.dumps(values, ensure_ascii=True) + "\n")
        output.flush()

    try:
        serve(_lines(), say)
    except Exception as error:
        say({"error": f"internal fault: {type(error).__name__}: {' '.join(str(error).split())}"})
        os._exit(1)


if __name__ == "__main__":
    main()
