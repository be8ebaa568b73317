"""The authors' checkpoints (`grafu_*.pt`) as weights of our network (`grafu.network.config.OFFICIAL`).

A checkpoint is read without running code of it. Its layers are recognised by the shapes of their weights, their number
and, where several are alike, by words of their names (`grafu.network.official_words`). A table beside the file,
`grafu_full.names.json`, may rename what is not: {"their prefix": "another prefix"}. Nothing is guessed: a layer that is
missing, one that two may be, and one that is left over, are errors.

What the file does not state is taken as the specification has it: pairs are [i | j | terms], from i to j; the second
stage of points is [feature | position]. Layers without biases get zeros.
"""

import json
import warnings
from collections.abc import Iterable, Mapping
from pathlib import Path
from pickle import UnpicklingError
from typing import Any, final

import torch
from torch import Tensor, nn

from grafu.dataclass import dataclass
from grafu.errors import WeightsError
from grafu.network.config import OFFICIAL, GraFuConfig
from grafu.network.grafu import GraFu
from grafu.network.layers import EdgeAttention, PairLinear
from grafu.network.official_words import LAYER, UNUSED, words_of
from grafu.network.points import SECOND_STAGE
from grafu.network.vocabulary import official_places

SUFFIX = ".pt"
_DAMAGES = (OSError, EOFError, RuntimeError, ValueError, LookupError, TypeError, AttributeError)
_PACKED = "in_proj_"  # torch's attention holds queries, keys and values in one


@final
@dataclass(frozen=True, eq=False)
class Layer:
    """One layer of the authors': its name, weight and bias, and in which place of the file it stands."""

    name: str
    weight: Tensor
    bias: Tensor | None
    place: int

    @property
    def number(self) -> int | None:
        """The number of the layer that its name states."""
        found = LAYER.search(self.name)
        return int(found[1]) if found else None


def table_beside(path: Path) -> Path:
    """Returns the file that may rename the layers of a checkpoint."""
    return path.with_suffix(".names.json")


def start_weights(path: Path, config: GraFuConfig) -> dict[str, Tensor]:
    """Returns the weights of an authors' checkpoint to start a run from, with the categories of its network.

    Of fewer categories than the authors' 17, what stands for the others is left out.

    Raises:
        WeightsError: if the file is no such checkpoint.
    """
    weights = official_network(path).state_dict()
    if config.vocabulary == "official":
        return weights
    rows = official_places()
    of_words = ("encoder.nodes.category.weight", "slot_heads.category.2.weight", "slot_heads.category.2.bias")
    return weights | {name: weights[name][rows] for name in of_words}


def official_network(path: Path, config: GraFuConfig = OFFICIAL) -> GraFu:
    """Returns our network with the weights of an authors' checkpoint, ready for use.

    Raises:
        WeightsError: if the file is missing, holds more than weights, or is of another network.
    """
    network = GraFu(config)
    network.load_state_dict(converted(read_weights(path), network, path))
    return network.eval()


def read_weights(path: Path) -> dict[str, Tensor]:
    """Returns the named weights of a checkpoint, renamed by the table beside it if there is one.

    Raises:
        WeightsError: if the file is missing or damaged, or holds objects that are no weights.
    """
    if not path.is_file():
        raise WeightsError(f"`{path}` must be a checkpoint of the authors' network: there is no such file")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of torch's, about how the file was written
            content = torch.load(path, map_location="cpu", weights_only=True)  # runs no code of the file
    except UnpicklingError as error:
        raise WeightsError(
            f"`{path}` holds more than weights, and nothing else is loaded from it: save its weights alone, with "
            f"`torch.save` of its state dict ({str(error).splitlines()[0]})"
        ) from error
    except _DAMAGES as error:
        raise WeightsError(f"`{path}` cannot be read as a checkpoint of torch ({type(error).__name__})") from error
    weights = _weights_in(content)
    if not weights:
        raise WeightsError(f"`{path}` must hold a state dict, alone or under a name: it holds no named weights")
    return _renamed(weights, table_beside(path))


def converted(weights: Mapping[str, Tensor], network: GraFu, path: Path) -> dict[str, Tensor]:
    """Returns the authors' weights by our names.

    Raises:
        WeightsError: if a layer is missing, is not told from another, or is left over.
    """
    theirs = layers_of(weights)
    wanted = dict(_wanted(network))
    chosen = _assigned({name: _fitting(name, shape, theirs) for name, shape in wanted.items()})
    absent = [f"{name} {shape}" for name, shape in wanted.items() if name not in chosen]
    used = {layer.name for layer in chosen.values()}
    spare = [layer for layer in theirs if layer.name not in used and not _counts_nothing(layer, network.config)]
    if absent or spare:
        raise WeightsError(_unrecognised(path, absent, [f"{one.name} {tuple(one.weight.shape)}" for one in spare]))
    state = {key: torch.zeros_like(value) for key, value in network.state_dict().items()}
    for name, layer in chosen.items():
        _fill(state, name, layer)
    return state


def layers_of(weights: Mapping[str, Tensor]) -> list[Layer]:
    """Returns the layers of a state dict in its order, packed attention unpacked."""
    found: dict[str, dict[str, Tensor]] = {}
    for name, value in _unpacked(weights).items():
        prefix, _, last = name.rpartition(".")
        prefix, last = (prefix, last) if last in ("weight", "bias") else (name, "weight")
        found.setdefault(prefix, {})[last] = value.float()
    return [
        Layer(prefix, parts["weight"], parts.get("bias"), place)
        for place, (prefix, parts) in enumerate(found.items())
        if "weight" in parts
    ]


def _weights_in(content: Any, depth: int = 0) -> dict[str, Tensor]:
    """Returns the largest state dict in what a file holds."""
    if not isinstance(content, dict) or depth > 2:
        return {}
    own = {key: value for key, value in content.items() if isinstance(key, str) and isinstance(value, Tensor)}
    inner = [_weights_in(value, depth + 1) for value in content.values()]
    return max([own, *inner], key=len)


def _renamed(weights: Mapping[str, Tensor], table: Path) -> dict[str, Tensor]:
    named = {name.removeprefix("module.").lower(): value for name, value in weights.items()}
    if not table.is_file():
        return named
    try:
        pairs = {
            str(theirs).lower(): str(ours).lower() for theirs, ours in json.loads(table.read_text("utf-8")).items()
        }
    except (ValueError, AttributeError) as error:
        raise WeightsError(f"`{table}` must be a JSON object of prefixes and what they are to be called") from error
    for theirs, ours in pairs.items():
        named = {ours + name.removeprefix(theirs) if name.startswith(theirs) else name: v for name, v in named.items()}
    return named


def _unpacked(weights: Mapping[str, Tensor]) -> dict[str, Tensor]:
    found: dict[str, Tensor] = {}
    for name, value in weights.items():
        prefix, _, last = name.rpartition(".")
        if not last.startswith(_PACKED):
            found[name] = value
            continue
        for which, part in zip("qkv", value.chunk(3), strict=True):
            found[f"{prefix}.{which}_proj.{last.removeprefix(_PACKED)}"] = part
    return found


def _wanted(network: GraFu) -> Iterable[tuple[str, tuple[int, ...]]]:
    """Yields our layers by name, each with the shape that its weight has with the authors."""
    inside = ""
    for name, module in network.named_modules():
        if inside and name.startswith(inside):
            continue
        if isinstance(module, PairLinear):
            inside = f"{name}."
            first, terms = module.of_first.weight, module.of_terms.weight
            yield name, (first.shape[0], 2 * first.shape[1] + terms.shape[1])
        elif isinstance(module, EdgeAttention):
            edge, hidden = module.value_of_edge.shape[1], module.out.weight.shape[0]
            yield f"{name}.value_of_edge", (hidden, edge)
        elif isinstance(module, nn.Linear | nn.LayerNorm | nn.Embedding):
            yield name, tuple(module.weight.shape)
    yield "decoder.free", tuple(network.decoder.free.shape)
    yield from ((f"pair_heads.{name}_abstain", ()) for name in ("parent", "hinge"))


def _fitting(name: str, shape: tuple[int, ...], theirs: Iterable[Layer]) -> list[Layer]:
    """Returns the authors' layers that one of ours may be: of its shape, number and, where that tells more, words."""
    found = [
        layer for layer in theirs if tuple(layer.weight.shape) == shape or (not shape and layer.weight.numel() == 1)
    ]
    found = [layer for layer in found if not UNUSED.search(layer.name)]
    number = LAYER.search(name.replace("updates", "layers"))
    found = [layer for layer in found if layer.number == (int(number[1]) if number else None)]
    for word in words_of(name):
        narrower = [layer for layer in found if word.search(layer.name)]
        found = narrower or found
    return found


def _assigned(fitting: Mapping[str, list[Layer]]) -> dict[str, Layer]:
    """Returns the layer of each name: those with one candidate first; then as many as are left, in their order."""
    chosen: dict[str, Layer] = {}
    left = {name: list(layers) for name, layers in fitting.items()}
    while True:
        taken = {layer.name for layer in chosen.values()}
        left = {n: [one for one in found if one.name not in taken] for n, found in left.items() if n not in chosen}
        sure = next(((name, found[0]) for name, found in left.items() if len(found) == 1), None)
        orders = ((n, min(f, key=lambda one: one.place)) for n, f in left.items() if _in_order(n, left))
        alike = sure or next(orders, None)
        if alike is None:
            return chosen
        chosen[alike[0]] = alike[1]


def _in_order(name: str, left: Mapping[str, list[Layer]]) -> bool:
    """Whether as many of ours as of theirs are alike: they are then in the order of the file."""
    own = {layer.name for layer in left[name]}
    same = [other for other, layers in left.items() if {layer.name for layer in layers} == own]
    return bool(own) and len(same) == len(own) and not _told_by_words(name)


def _told_by_words(name: str) -> bool:
    """Whether only a word tells it from its like: queries, keys and values stand in any order."""
    return name.endswith((".query", ".key", ".value", ".out")) or "heads" in name


def _counts_nothing(layer: Layer, config: GraFuConfig) -> bool:
    """Whether no score depends on a layer: an unused head, or what the last layer makes of the edges."""
    last = layer.number == config.encoder_layers - 1
    update = {(256, 2 * config.hidden + config.edge), (config.edge, 256), (config.edge,)}
    return bool(UNUSED.search(layer.name)) or (last and tuple(layer.weight.shape) in update)


def _unrecognised(path: Path, absent: list[str], spare: list[str]) -> str:
    said = f"`{path}` is not recognised as the authors' network"
    said += f"; not found: {', '.join(absent[:8])}" if absent else ""
    said += f"; not used: {', '.join(spare[:8])}" if spare else ""
    more = max(0, len(absent) - 8) + max(0, len(spare) - 8)
    said += f", and {more} more" if more else ""
    return f"{said}; `{path.stem}.names.json` beside it may rename them"


def _fill(state: dict[str, Tensor], name: str, layer: Layer) -> None:
    """Puts one of the authors' layers into a state of ours."""
    weight, bias = layer.weight, layer.bias
    if f"{name}.of_first.weight" in state:
        width = state[f"{name}.of_first.weight"].shape[1]
        parts = weight[:, :width], weight[:, width : 2 * width], weight[:, 2 * width :]
        for part, value in zip(("of_first", "of_second", "of_terms"), parts, strict=True):
            state[f"{name}.{part}.weight"] = value.clone()
        name = f"{name}.of_first"
    elif name.endswith(".value_of_edge"):
        heads, edge, width = state[name].shape
        state[name] = weight.T.reshape(edge, heads, width).permute(1, 0, 2).clone()
        if bias is not None:  # the weights of a node sum to 1: it is a bias of what is drawn
            values = f"{name.removesuffix('value_of_edge')}value.bias"
            state[values] = state[values] + bias
        return
    elif name == "encoder.nodes.points.second.0":  # theirs has the position last
        features = SECOND_STAGE[0] - 3
        state[f"{name}.weight"] = torch.cat([weight[:, features:], weight[:, :features]], dim=1)
    elif name in state:
        state[name] = weight.reshape(state[name].shape).clone()
    else:
        state[f"{name}.weight"] = weight.clone()
    if bias is not None and f"{name}.bias" in state:  # that of an edge's score moves all scores alike
        state[f"{name}.bias"] = state[f"{name}.bias"] + bias
