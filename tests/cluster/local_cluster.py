"""A Ray cluster of small nodes on this machine, for tests."""

import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from grafu.processes.lifetime import keep_private

STORE = 80 * 2**20  # bytes: the least that Ray takes
HERE = Path(__file__).parent


@contextmanager
def local_cluster(nodes: int) -> Iterator[Any]:
    """Gives a cluster of so many nodes, each with one CPU; its processes import from this folder, too."""
    keep_private()
    with pytest.MonkeyPatch.context() as patch:
        paths = [str(HERE), str(HERE.parent.parent / "src"), os.environ.get("PYTHONPATH", "")]
        patch.setenv("PYTHONPATH", os.pathsep.join(filter(None, paths)))
        patch.setenv("RAY_worker_niceness", "0")
        patch.setenv("RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO", "0")
        from ray.cluster_utils import Cluster

        with socket.socket() as found:
            found.bind(("127.0.0.1", 0))
            port = found.getsockname()[1]
        cluster = Cluster(
            initialize_head=True,
            head_node_args={
                "num_cpus": 1,
                "include_dashboard": False,
                "object_store_memory": STORE,
                "ray_client_server_port": port,
            },
        )
        cluster.client_address = f"ray://{cluster.address.partition(':')[0]}:{port}"
        try:
            for _ in range(nodes - 1):
                add_node(cluster)
            yield cluster
        finally:
            cluster.shutdown()


def add_node(cluster: Any) -> Any:
    """Returns a new node with one CPU."""
    return cluster.add_node(num_cpus=1, object_store_memory=STORE)
