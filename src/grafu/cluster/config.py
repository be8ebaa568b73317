"""Settings of runs on several machines and of what is fetched from URLs."""

from typing import final

from grafu.dataclass import dataclass
from grafu.errors import OptionError


@final
@dataclass(frozen=True)
class ClusterConfig:
    """How many tasks wait at a cluster, how often one is tried, how long it is waited for."""

    in_flight_per_cpu: float = 2.0
    """Tasks that are given to the cluster at once, for each of its CPUs: one in work, one that waits."""
    tries: int = 2
    """How often a model may end its process, by a crash or for want of memory, before it is set aside."""
    losses: int = 10
    """How often a model may lose its node before it is given up: that is no fault of the model."""
    reserved_memory: int = 10**9
    """Bytes that Ray reserves for a model, at most its limit; after a death its whole limit is reserved."""
    reach_seconds: float = 15.0
    """Seconds until a cluster that does not answer is given up."""
    connections: int = 3
    """How often the server behind a `ray://` address is asked for a session: a busy one may be late with the first."""
    cancel_seconds: float = 5.0
    """Seconds that tasks have to end by themselves when a run is interrupted, before they are killed."""
    poll_seconds: float = 1.0
    """Seconds after which the cluster is asked again how many CPUs it has."""

    def __post_init__(self) -> None:
        if self.in_flight_per_cpu <= 0.0 or min(self.tries, self.losses, self.connections) < 1:
            raise OptionError("tasks in flight, tries, losses and connections must be above 0")
        if min(self.reserved_memory, self.reach_seconds, self.cancel_seconds, self.poll_seconds) < 0:
            raise OptionError("bytes and seconds of a cluster must not be negative")


@final
@dataclass(frozen=True)
class FetchConfig:
    """How much is fetched for one model: files beside it may belong to it."""

    files: int = 10_000
    """The most files of a model's folder."""
    bytes: int = 8 * 10**9
    """The most bytes of a model."""

    def __post_init__(self) -> None:
        if self.files < 1 or self.bytes < 1:
            raise OptionError("the limits of what is fetched must be above 0")
