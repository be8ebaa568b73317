"""The trained network as a function of features, run by ONNX Runtime on the CPU.

ONNX Runtime is imported when a file of weights is opened, so that runs without the network do not wait for it.

The one place that imports ONNX Runtime: late, for that takes 0.2 s, and with its telemetry off.
"""

import json
from collections.abc import Callable, Mapping
from functools import lru_cache
from pathlib import Path
from types import ModuleType
from typing import Any, final

import numpy as np

from grafu.completion.features import SCORE_NAMES, FeatureConfig, GraphFeatures, Scores
from grafu.errors import WeightsError
from grafu.graph.arrays import EDGE_CODES, LABELS, NULL
from grafu.processes.lifetime import keep_private
from grafu.shapes import Float
from grafu.vocabulary import PieceKind


def onnx_runtime() -> ModuleType:
    """Returns the module `onnxruntime`, which sends nothing and writes nothing of its own.

    If it was imported before, its events are off from now on.
    """
    keep_private()
    import onnxruntime

    onnxruntime.disable_telemetry_events()
    return onnxruntime


GraphNetwork = Callable[[GraphFeatures], Scores]

SHIPPED_WEIGHTS = Path(__file__).parent / "weights" / "grafu.onnx"
_INPUTS = ("labels", "boxes", "anchors", "groups", "edges", "visibility", "names", "transparent")
_SINCE = frozenset({"visibility", "names", "transparent"})  # inputs that older files do not read
_FACTS = ("body", "ajar", "piece")  # outputs that older files do not have


@final
class NetworkSession:
    """A network that is ready to be asked.

    `features` states how many points it wants to see: the file's word, the default number where an older file is
    silent. One thread by default, because inputs run in parallel.

    Raises:
        WeightsError: if the file is missing, damaged, or made for other inputs, outputs or labels.
    """

    def __init__(self, path: Path, threads: int = 1) -> None:
        if not path.is_file():
            raise WeightsError(f"there are no trained weights at `{path}`: use another motion source, such as rule")
        ort = onnx_runtime()
        options = ort.SessionOptions()
        options.intra_op_num_threads = threads
        options.inter_op_num_threads = 1
        options.log_severity_level = 3  # errors alone
        # rewriting the graph takes longer than it spares in a dozen passes; a model takes two to four
        options.graph_optimization_level = ort.GraphOptimizationLevel.ORT_DISABLE_ALL
        try:
            self._session: Any = ort.InferenceSession(str(path), options, providers=["CPUExecutionProvider"])
        except Exception as error:  # the runtime raises a class of its own for each kind of damage
            raise WeightsError(f"`{path}` must be a network in ONNX form: {error}") from error
        self.features = self._checked(path)
        self._inputs = tuple(item.name for item in self._session.get_inputs())
        known = {item.name for item in self._session.get_outputs()}
        self._outputs = tuple(name for name in SCORE_NAMES if name in known)

    def __call__(self, features: GraphFeatures) -> Scores:
        """Returns what the network states about a graph of at least one node."""
        found: list[Any] = self._session.run(
            list(self._outputs), {name: getattr(features, name) for name in self._inputs}
        )
        arrays = {name: np.asarray(array) for name, array in zip(self._outputs, found, strict=True)}
        slots = len(arrays["exists"])
        shapes = {"body": (slots, slots), "ajar": (slots,), "piece": (len(PieceKind),)}
        arrays |= {name: np.zeros(shape, np.float32) for name, shape in shapes.items() if name not in arrays}
        arrays["edge"] = with_all_kinds(arrays["edge"])
        values: dict[str, Any] = {name: array if array.ndim else float(array) for name, array in arrays.items()}
        return Scores(**values)

    def _checked(self, path: Path) -> FeatureConfig:
        names = {item.name for item in self._session.get_inputs()}, {item.name for item in self._session.get_outputs()}
        if names[0] | _SINCE != set(_INPUTS) or not set(SCORE_NAMES) <= names[1] | set(_FACTS):
            raise WeightsError(f"`{path}` must read {_INPUTS} and say {SCORE_NAMES}: got {names[0]} and {names[1]}")
        facts: Mapping[str, str] = self._session.get_modelmeta().custom_metadata_map
        if json.loads(facts.get("labels", "[]")) != [label.value for label in LABELS]:
            raise WeightsError(f"`{path}` was trained on other labels: train it again")
        try:
            if "features" in facts:
                return FeatureConfig(**({"kinds": "paper"} | json.loads(facts["features"])))  # older: the paper's kinds
            older = json.loads(facts["config"])  # it holds two of the three numbers
            return FeatureConfig(anchors=older["anchors"], neighbours=older["neighbours"], kinds="paper")
        except (KeyError, TypeError, ValueError) as error:
            raise WeightsError(f"`{path}` must state how many points of a part it sees: {error!r}") from error


_NEVER = -60.0  # the logit of a kind of edge that a network does not know


def with_all_kinds(edge: Float[np.ndarray, "s s kinds"]) -> Float[np.ndarray, "s s all"]:
    """Returns the logits of all kinds of edges: one that knows the paper's kinds alone never predicts another."""
    assert edge.shape[-1] > NULL
    return np.pad(edge, ((0, 0), (0, 0), (0, EDGE_CODES["all"] - edge.shape[-1])), constant_values=_NEVER)


def has_shipped_weights() -> bool:
    """Whether trained weights came with the package."""
    return SHIPPED_WEIGHTS.is_file()


def open_network(path: Path = SHIPPED_WEIGHTS, threads: int = 1) -> NetworkSession:
    """Returns the network in a file, opened once for each process, and again where the file has changed.

    Raises:
        WeightsError: if it cannot be used.
    """
    stamp = (path.stat().st_mtime_ns, path.stat().st_size) if path.is_file() else None
    return _opened(path, threads, stamp)


@lru_cache(maxsize=2)
def _opened(path: Path, threads: int, _: tuple[int, int] | None) -> NetworkSession:
    return NetworkSession(path, threads)
