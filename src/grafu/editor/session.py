"""One model while it is edited: what is chosen, what was built of it, and what the page hears of both.

All of it runs on the server's event loop; only what the builder does runs in a thread.
"""

import asyncio
import json
from collections.abc import AsyncIterator, Callable, Mapping
from dataclasses import field
from pathlib import Path
from typing import Any, final

from grafu.dataclass import dataclass
from grafu.editor.builder import Answer, Builds
from grafu.editor.building import FILES, STATE, Order
from grafu.editor.choices import with_choice
from grafu.editor.decisions import Prediction, append_lines, decided, decision_lines, predictions_of
from grafu.editor.history import History
from grafu.editor.known import Known
from grafu.editor.last_build import LastBuild
from grafu.editor.workspace import Workspace
from grafu.errors import FunctionalizationError
from grafu.pipeline.decisions import DECISIONS, Key, decided_before
from grafu.pipeline.settings import Settings

Event = dict[str, Any]
WAITING = "wait"
"""The stage before the builder begins."""
JUDGING = "judge"
"""The stage after a build that is shown already."""
_STATED = ("report", "markup")  # of the state


@final
@dataclass
class Session:
    """A model that is edited; not a value.

    `folder` is where the builder puts what the page fetches. A choice is saved before it is built; one that cannot be
    built is taken back, and one line states why.
    """

    workspace: Workspace
    builder: Builds
    folder: Path
    history: History = field(init=False)
    built: LastBuild | None = None
    error: str = ""
    exported: dict[str, Any] | None = None
    _listeners: set["asyncio.Queue[Event]"] = field(default_factory=set)
    _predictions: dict[Key, Prediction] = field(default_factory=dict)
    _logged: dict[Key, Any] = field(init=False)
    _task: "asyncio.Task[None] | None" = None
    _stage: str = ""
    _version: int = 0

    def __post_init__(self) -> None:
        self.history = History(self.workspace.settings)
        self._logged = decided_before(self.workspace.folder / DECISIONS, self.workspace.name)

    @property
    def is_building(self) -> bool:
        """Whether something is being built."""
        return self._task is not None and not self._task.done()

    def choose(self, question: str, part: str, value: Any) -> None:
        """Answers a question and has the model built anew.

        Raises:
            OptionError: if there is no such question, part or answer.
            ExportError: if the settings cannot be saved.
        """
        known = self.built.known if self.built else Known(frozenset())
        self._go_to(self.history.then(with_choice(self.history.present, question, part, value, known)))

    def undo(self) -> None:
        """Goes one choice back. Raises ExportError if the settings cannot be saved."""
        self._go_to(self.history.undone())

    def redo(self) -> None:
        """Goes one choice on again. Raises ExportError if the settings cannot be saved."""
        self._go_to(self.history.redone())

    def start_anew(self) -> None:
        """Takes back every choice, as one step. Raises ExportError if the settings cannot be saved."""
        self._go_to(self.history.then(self.workspace.untouched))

    def _go_to(self, history: History) -> None:
        if history.present != self.history.present:
            self.workspace.save(history.present)
        self.history, self.error, self.exported = history, "", None
        self.tell()
        self.build()

    def build(self) -> None:
        """Has the model built as it is chosen, unless it is, or is at it; a last build is judged after that."""
        if self.is_building:
            if self._stage == JUDGING and not self._is_up_to_date:
                self.builder.give_way()
        elif not self._is_complete:
            self.error = ""
            self._task = asyncio.get_running_loop().create_task(self._build_all())

    def stop(self) -> None:
        """Stops what is being built; the choice that it was for is taken back."""
        if self.is_building and self._stage not in (WAITING, JUDGING):  # else it is at another model, or gives way
            self.builder.stop()

    async def finished(self) -> None:
        """Waits until nothing is being built."""
        if self._task is not None:
            await asyncio.wait([self._task])

    @property
    def _is_up_to_date(self) -> bool:
        return self.built is not None and self.built.settings == self.history.present

    @property
    def _is_complete(self) -> bool:
        return self._is_up_to_date and self.built is not None and self.built.is_judged

    async def _build_all(self) -> None:
        goes_on = True
        while goes_on and not self._is_complete:
            if self._is_up_to_date:
                goes_on = await self._judge()
            elif goes_on := not self.error:
                await self._build(self.history.present)

    async def _build(self, settings: Settings) -> None:
        try:
            answer = await self._ask("build", self.folder, settings)
            state = json.loads((self.folder / STATE).read_text(encoding="utf-8"))
            files = {name: (self.folder / file).read_bytes() for name, file in FILES.items()}
            number = self.built.number + 1 if self.built else 1
            self.built = LastBuild(number, settings, state, files, answer.seconds)
        except FunctionalizationError as error:
            self._take_back(settings, str(error))
            self._stage = ""
        else:
            self._log(self.built)
            self._stage = JUDGING
        self._tell_anew()

    async def _judge(self) -> bool:
        """Completes the report of the last build; where that fails, it stays as it is. Returns whether it did not."""
        built = self.built
        assert built is not None
        try:
            answer = await self._ask("judge", self.folder, built.settings)
        except FunctionalizationError:
            has_failed = True
        else:
            has_failed = False
            if answer.made:  # else it gave way
                self._learn(built, answer.made)
        self._stage = ""
        self._tell_anew()
        return not has_failed

    def _learn(self, built: LastBuild | None, made: Mapping[str, Any]) -> None:
        if built is not None and self.built is built:
            self.built = built.judged({name: made[name] for name in _STATED})

    def _take_back(self, settings: Settings, why: str) -> None:
        """States why a choice cannot be built, and goes back to what was; a later choice stays, and is built next."""
        if self.history.present != settings:
            return
        self.error = why
        if self.built is not None:
            self.history = self.history.back_to(self.built.settings)
            self._say_fault(lambda: self.workspace.save(self.history.present))

    def _say_fault(self, write: Callable[[], None]) -> None:
        """Writes something; where that fails, the page states why."""
        try:
            write()
        except FunctionalizationError as error:
            self.error = str(error)

    def _log(self, built: LastBuild) -> None:
        now = decided(built.settings)
        predicted = predictions_of(built.report, built.motions)
        self._predictions |= {key: one for key, one in predicted.items() if key not in now}
        lines = decision_lines(self.workspace.name, self._logged, now, self._predictions)
        if lines:
            self._say_fault(lambda: append_lines(self.workspace.folder / DECISIONS, lines))
        self._logged = now

    async def export(self) -> dict[str, Any]:
        """Writes every format that can be written here into the folder of results; returns what was written.

        Raises:
            FunctionalizationError: if it cannot be written.
        """
        await self.finished()
        built = self.built
        try:
            made = (await self._ask("export", self.workspace.folder, self.history.present)).made
            self._learn(built, made)
            self.exported = {name: value for name, value in made.items() if name not in _STATED}
            return self.exported
        finally:
            self._stage = ""
            self._tell_anew()

    async def _ask(self, do: Any, folder: Path, settings: Settings) -> Answer:
        source, name = self.workspace.source, self.workspace.name
        order = Order(do, source, name, folder, settings.to_json())
        loop = asyncio.get_running_loop()

        def on_stage(stage: str) -> None:
            loop.call_soon_threadsafe(self._at_stage, JUDGING if do == "judge" else stage)

        self._at_stage(JUDGING if do == "judge" else WAITING)
        return await asyncio.to_thread(self.builder.ask, order, on_stage)

    def _at_stage(self, stage: str) -> None:
        self._stage = stage
        self.tell()

    def _tell_anew(self) -> None:
        """Tells that what the page shows may be another now."""
        self._version += 1
        self.tell()

    def tell(self) -> None:
        """Tells every open page how things are."""
        event = self.status()
        for listener in self._listeners:
            listener.put_nowait(event)

    def status(self) -> Event:
        """Returns how things are, as JSON values."""
        return {
            "build": self.built.number if self.built else 0,
            "version": self._version,
            "seconds": self.built.seconds if self.built else 0,
            "stage": self._stage,
            "error": self.error,
            "exported": self.exported,
            "undo": len(self.history.past),
            "redo": len(self.history.future),
        }

    async def events(self) -> AsyncIterator[Event]:
        """Yields how things are now, and every time that they change."""
        queue: asyncio.Queue[Event] = asyncio.Queue()
        self._listeners.add(queue)
        try:
            yield self.status()
            while True:
                yield await queue.get()
        finally:
            self._listeners.discard(queue)

    def page_state(self) -> dict[str, Any]:
        """Returns all that the page shows of the last build, and what is chosen."""
        assert self.built is not None
        settings = self.history.present
        chosen = {**settings.to_json(), "words": [[*key, value] for key, value in decided(settings).items()]}
        numbers = {"build": self.built.number, "version": self._version}
        return {**self.built.state, **numbers, "settings": chosen}
