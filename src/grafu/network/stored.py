"""The weights in an exported file by their names in the network, so that training can start from them. No files.

An exporter names what it multiplies by itself, transposed. Here such weights get the network's own names, with `.T`
behind where they are stored transposed.
"""

import json
from collections.abc import Mapping

import numpy as np
import onnx
import torch
from torch import Tensor, nn

from grafu.errors import WeightsError
from grafu.network.config import OLDER, GraFuConfig

TRANSPOSED = ".T"
HALF = ".half"
_PREFIX = "model."  # the exporter's module holds the network as `model`
_HEADS = "pair_heads."  # their two scalars are outputs of the file as they are, and named so
_FRESH_EDGE = -4.0  # the logit at which a kind of edge starts that the stored weights do not know


def name_weights(proto: onnx.ModelProto, network: nn.Module) -> None:
    """Gives each weight of an exported network the name that it has in the network, in place."""
    known = {name: value.detach().cpu().numpy() for name, value in network.state_dict().items()}
    taken = {weight.name.removeprefix(_PREFIX) for weight in proto.graph.initializer}
    renamed: dict[str, str] = {}
    for weight in proto.graph.initializer:
        if weight.name.removeprefix(_PREFIX) in known:
            continue
        stored = onnx.numpy_helper.to_array(weight)
        name = _name_of(stored, {n: v for n, v in known.items() if n not in taken}) if stored.ndim == 2 else None
        if name is not None:
            taken.add(name.removesuffix(TRANSPOSED))
            renamed[weight.name] = name
            weight.name = name
    for node in proto.graph.node:
        for k, used in enumerate(node.input):
            if used in renamed:
                node.input[k] = renamed[used]


def put_weights(proto: onnx.ModelProto, network: nn.Module) -> None:
    """Puts a network's weights into the exported file of another with the same config, by their names, in place.

    Raises:
        WeightsError: if the file lacks one of them.
    """
    state = {name: value.detach().cpu().numpy() for name, value in network.state_dict().items()}
    outputs = {output.name for output in proto.graph.output}
    put = set()
    for weight in proto.graph.initializer:
        name = _name_in_network(weight.name, is_output=weight.name in outputs)
        value = state.get(name.removesuffix(TRANSPOSED))
        if value is not None:
            put.add(name.removesuffix(TRANSPOSED))
            values = value.T if name.endswith(TRANSPOSED) else value
            weight.CopyFrom(onnx.numpy_helper.from_array(values, weight.name))
    if missing := sorted(set(state) - put):
        raise WeightsError(f"the exported file has no place for the weight `{missing[0]}` of this network")


def _name_in_network(stored: str, *, is_output: bool) -> str:
    """Returns the name of a stored weight in the network, with `TRANSPOSED` behind where it is stored so."""
    name = stored.removesuffix(HALF).removeprefix(_PREFIX)
    return _HEADS + name if is_output else name


def stored_weights(file: bytes) -> dict[str, Tensor]:
    """Returns the weights of an exported file by name, as 32-bit floats.

    Raises:
        WeightsError: if the file is no network, or its weights have no names, as those of earlier versions.
    """
    try:
        proto = onnx.load_from_string(file)
    except Exception as error:  # protobuf raises classes of its own
        raise WeightsError(
            "the weights to start from must be a network in ONNX form (`grafu train --export`)"
        ) from error
    found: dict[str, Tensor] = {}
    outputs = {output.name for output in proto.graph.output}
    for weight in proto.graph.initializer:
        name = _name_in_network(weight.name, is_output=weight.name in outputs)
        values = onnx.numpy_helper.to_array(weight)
        if not np.issubdtype(values.dtype, np.floating):
            continue
        values = values.astype(np.float32)
        found[name.removesuffix(TRANSPOSED)] = torch.tensor(values.T.copy() if name.endswith(TRANSPOSED) else values)
    return found


def stored_config(file: bytes) -> GraFuConfig:
    """Returns the config of the network in an exported file, of an earlier version or of this one.

    Raises:
        WeightsError: if the file states none that this version knows.
    """
    facts = {entry.key: entry.value for entry in onnx.load_from_string(file).metadata_props}
    try:
        return GraFuConfig(**(dict(OLDER) | json.loads(facts["config"])))
    except (KeyError, TypeError, ValueError) as error:
        raise WeightsError(f"the weights must state the config of their network: {error!r}") from error


def start_from(network: nn.Module, weights: Mapping[str, Tensor]) -> tuple[str, ...]:
    """Copies stored weights into a network, and returns the names of those that it has and the file has not.

    Where the network is larger than what is stored, the stored numbers come first: further inputs count nothing at
    first, further kinds of edges are unlikely at first.

    Raises:
        WeightsError: if hardly any weight fits: it is another network.
    """
    state = network.state_dict()
    fresh = [name for name, own in state.items() if name not in weights or not _fits(weights[name], own)]
    if len(fresh) > len(state) // 4:
        raise WeightsError(f"the weights to start from are of another network: {len(fresh)} of {len(state)} do not fit")
    with torch.no_grad():
        for name, own in state.items():
            if name not in fresh:
                _copy(weights[name].to(own.device, own.dtype), own, name)
    return tuple(fresh)


def _name_of(stored: np.ndarray, known: dict[str, np.ndarray]) -> str | None:
    for name, value in known.items():
        if value.shape == stored.shape and np.array_equal(value, stored):
            return name
        if value.shape == stored.shape[::-1] and np.array_equal(value.T, stored):
            return name + TRANSPOSED
    return None


def _fits(stored: Tensor, own: Tensor) -> bool:
    return stored.ndim == own.ndim and all(a <= b for a, b in zip(stored.shape, own.shape, strict=True))


def _copy(stored: Tensor, own: Tensor, name: str) -> None:
    if stored.ndim == 2 and stored.shape[1] < own.shape[1]:
        own[:, stored.shape[1] :] = 0.0
    if stored.ndim == 1 and len(stored) < len(own) and name.startswith("pair_heads.edge"):
        own[len(stored) :] = _FRESH_EDGE
    own[tuple(slice(size) for size in stored.shape)] = stored
