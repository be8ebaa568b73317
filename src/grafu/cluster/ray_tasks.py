"""Items that tasks of a Ray cluster work on: a few more at once than it has CPUs, again where a node or process died.

In each task a process of its own, with limits, works on the item, as in a local run; it is used again for the next.
"""

import logging
import os
import signal
import socket
from collections import deque
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace
from math import ceil
from time import monotonic
from typing import Any, Final, Generic, TypeAlias, TypeVar, final

from grafu.cluster.config import ClusterConfig
from grafu.cluster.storage import without_secrets
from grafu.dataclass import dataclass
from grafu.errors import OptionError
from grafu.processes.lifetime import keep_private, started_by_main_thread
from grafu.processes.limits import Ending, Outcome, ProcessLimits
from grafu.processes.worker import ReusedWorker, ignore, nothing
from grafu.version import __version__

Item = TypeVar("Item")
Result = TypeVar("Result")
_Ray: TypeAlias = Any  # the module, and what it returns: it is imported where it is used
LOCAL, AUTO = "local", "auto"
_STORE: Final = 100 * 2**20  # bytes: results are small, and Ray would take a third of the memory for them


@final
@dataclass(frozen=True)
class Work(Generic[Item, Result]):
    """What is done with each item: `run`, a function of a module, within limits, after `prepare`."""

    run: Callable[[Item], Result]
    limits: ProcessLimits = ProcessLimits()
    prepare: Callable[[], None] = nothing


@final
@dataclass(frozen=True)
class _Attempt(Generic[Item]):
    """An item, how often its process died, and how often its node was lost."""

    item: Item
    deaths: int = 0
    losses: int = 0


@contextmanager
def cluster_at(address: str, cpus: int, config: ClusterConfig = ClusterConfig()) -> Iterator[_Ray]:
    """Gives Ray, connected to a cluster: `ray://HOST:PORT`, `HOST:PORT`, `auto`, or `local` with so many CPUs.

    `auto` is the cluster that runs on this machine or that `RAY_ADDRESS` names, else a local one.

    Raises:
        OptionError: if Ray is not installed, the address is none, or the cluster does not answer in time.
    """
    keep_private()
    try:
        import ray
    except ImportError:
        raise OptionError("`--cluster` needs Ray: pip install 'grafu[cluster]'") from None
    if address not in (LOCAL, AUTO):
        _require_answer(address, config.reach_seconds)
    handler = signal.getsignal(signal.SIGTERM)
    try:
        _connect(ray, address, cpus, config.connections)
        _silence()
        if started_by_main_thread():
            signal.signal(signal.SIGTERM, handler)  # Ray has put its own in its place
        yield ray
    finally:
        ray.shutdown()


def _connect(ray: _Ray, address: str, cpus: int, connections: int) -> None:
    quiet = {"log_to_driver": False, "logging_level": "ERROR"}
    local = {"num_cpus": cpus, "include_dashboard": False, "object_store_memory": _STORE}
    try:
        if address == AUTO:
            with suppress(ConnectionError):
                ray.init(address=AUTO, **quiet)
                return
        if address in (LOCAL, AUTO):
            ray.init(address=LOCAL, **local, **quiet)
        elif address.startswith("ray://"):
            _begin_session(ray, address, connections)
        else:
            ray.init(address=address, **quiet)
    except Exception as error:  # of another version, of another Python, not a cluster: Ray has no class for these
        raise OptionError(f"the cluster `{address}` cannot be used: {without_secrets(str(error))}") from None


def _begin_session(ray: _Ray, address: str, tries: int) -> None:
    """Connects to a client port; a server that does not begin a session in time is asked again."""
    logging.getLogger("ray.client_builder").setLevel(logging.ERROR)
    for left in reversed(range(tries)):
        try:
            ray.init(address=address, log_to_driver=False)  # it hands other options on to the cluster
        except ConnectionAbortedError:
            if not left:
                raise
            ray.shutdown()
        else:
            return


def _silence() -> None:
    """Keeps Ray from printing what its nodes report: stdout is for results, and what failed is stated there."""
    with suppress(ImportError, AttributeError, KeyError):
        from ray._private.ray_logging import global_worker_stdstream_dispatcher as dispatcher

        dispatcher.remove_handler("ray_print_logs")


def _require_answer(address: str, seconds: float) -> None:
    host, _, port = address.removeprefix("ray://").rpartition(":")
    if not host or not port.isdigit() or "/" in host:
        raise OptionError(f"`--cluster` must be ray://HOST:10001, HOST:6379, auto or local: got `{address}`")
    try:
        socket.create_connection((host.strip("[]"), int(port)), timeout=seconds).close()
    except (OSError, OverflowError) as error:
        why = getattr(error, "strerror", None) or str(error) or "no answer"
        raise OptionError(
            f"the cluster `{address}` cannot be reached within {seconds:g} s ({why}): does it run, is the port open?"
        ) from None


def run_on_cluster(
    ray: _Ray,
    items: Sequence[Item],
    work: Work[Item, Result],
    config: ClusterConfig = ClusterConfig(),
    on_begin: Callable[[Item], None] = ignore,
    again: Callable[[Item], Item] = lambda item: item,
) -> Generator[tuple[Item, Outcome[Result]], None, None]:
    """Yields each item, once, with how it ended, as it ends; `again` gives the item for a new try.

    An item whose node was lost is tried again; one whose process died, too, until it is set aside after
    `config.tries`. All tasks end with the generator: close it.

    Raises:
        OptionError: if the nodes cannot run grafu, or have another version of it.
    """
    waiting = deque(_Attempt(item) for item in items)
    flying: dict[Any, _Attempt[Item]] = {}
    nodes = _Nodes(ray, config)
    task = ray.remote(_serve)  # once: each call would send the function to the cluster again
    try:
        while waiting or flying:
            while waiting and len(flying) < nodes.most:
                attempt = waiting.popleft()
                if not attempt.deaths and not attempt.losses:
                    on_begin(attempt.item)
                flying[_submit(task, attempt, work, nodes)] = attempt
            ready, _ = ray.wait(list(flying), num_returns=1, timeout=config.poll_seconds)
            for reference in ready:
                outcome: Outcome[Result] | None
                attempt, outcome = _judged(ray, reference, flying.pop(reference), config)
                if outcome is None:
                    waiting.appendleft(replace(attempt, item=again(attempt.item)))
                else:
                    yield attempt.item, outcome
    finally:
        _cancel(ray, list(flying), config)


def _submit(task: _Ray, attempt: _Attempt[Item], work: Work[Item, Result], nodes: "_Nodes") -> Any:
    reserved = task.options(
        num_cpus=1, max_retries=0, memory=nodes.memory_for(attempt.deaths, work.limits), scheduling_strategy="SPREAD"
    )
    return reserved.remote(work, attempt.item, __version__)


def _judged(
    ray: _Ray, reference: Any, attempt: _Attempt[Item], config: ClusterConfig
) -> "tuple[_Attempt[Item], Outcome[Result] | None]":
    """Returns what a task returned; None, and the attempt with one more death or loss, where it is tried again."""
    errors = ray.exceptions
    try:
        outcome: Outcome[Result] = ray.get(reference)
        if outcome.ending is not Ending.DIED:
            return attempt, outcome
        attempt = replace(attempt, deaths=attempt.deaths + 1)
    except errors.RayTaskError as error:  # of the task itself: what a model does wrong comes back as a value
        raise OptionError(f"the nodes of the cluster cannot run grafu: {_cause(error)}") from None
    except (errors.WorkerCrashedError, errors.OutOfMemoryError):
        attempt = replace(attempt, deaths=attempt.deaths + 1)
    except errors.RayError:  # the node is gone, or took the result with it
        attempt = replace(attempt, losses=attempt.losses + 1)
    if attempt.deaths >= config.tries:
        return attempt, Outcome(Ending.SET_ASIDE)
    if attempt.losses >= config.losses:
        return attempt, Outcome(Ending.LOST)
    return attempt, None


def _cause(error: Exception) -> str:
    return without_secrets(str(getattr(error, "cause", None) or error).strip().splitlines()[-1])


def _cancel(ray: _Ray, references: Sequence[Any], config: ClusterConfig) -> None:
    """Ends the tasks: each is asked first, so that it removes what it made, and then killed."""
    if not references or not ray.is_initialized():
        return
    for force in (False, True):
        for reference in references:
            with suppress(Exception):  # it has ended, or its node is gone
                ray.cancel(reference, force=force)
        _, references = ray.wait(list(references), num_returns=len(references), timeout=config.cancel_seconds)
        if not references:
            return


@final
class _Nodes:
    """How much the cluster takes at once, asked again every few seconds, for nodes come and go; not a value."""

    def __init__(self, ray: _Ray, config: ClusterConfig) -> None:
        self._ray, self._config = ray, config
        self._asked, self._most, self._memory = -1.0, 1, 0

    @property
    def most(self) -> int:
        """The most tasks in flight."""
        self._ask()
        return self._most

    def memory_for(self, deaths: int, limits: ProcessLimits) -> int:
        """Returns the bytes to reserve for a try: all that it may take where it died before, if a node has so much."""
        self._ask()
        limit = self._memory if limits.memory is None else limits.memory
        return min(limit if deaths else self._config.reserved_memory, limit, self._memory)

    def _ask(self) -> None:
        if monotonic() - self._asked < self._config.poll_seconds and self._asked >= 0.0:
            return
        nodes = [node["Resources"] for node in self._ray.nodes() if node["Alive"]]
        cpus = sum(node.get("CPU", 0.0) for node in nodes)
        self._memory = int(max((node.get("memory", 0.0) for node in nodes if node.get("CPU", 0.0)), default=0))
        self._most = max(1, ceil(self._config.in_flight_per_cpu * cpus))
        self._asked = monotonic()


_workers: "dict[Any, ReusedWorker[Any, Any]]" = {}


def _serve(work: Work[Item, Result], item: Item, version: str) -> Outcome[Result]:
    """Runs in a process of Ray: has an item worked on by a process with limits, which is there for the next item.

    Raises:
        OptionError: if the node has another version of grafu.
    """
    if version != __version__:
        raise OptionError(f"a node has grafu {__version__}, and this machine {version}: install the same")
    beside = os.cpu_count() or 1  # Ray has a process for each core
    worker = _workers.setdefault(work, ReusedWorker(work.run, work.limits, work.prepare, beside))
    return worker.outcome_of(item)
