"""The network as one ONNX file, for any number of parts, so that it runs without torch. It writes no files.

Inputs are the arrays of one graph's features, by their names, without a batch: labels [n], boxes [n,6],
anchors [n,G,3], groups [n,G,S,3], edges [n,n], visibility [n,18], names [n,32], transparent [n]. Outputs are the
fields of `Predictions` but `mask` and `padding`, without a batch and without padding slots.
"""

import json
import warnings
from dataclasses import asdict, fields, replace
from functools import lru_cache
from typing import final

import numpy as np
import onnx
import torch
from torch import Tensor, nn
from torch.nn.functional import pad

from grafu.graph.arrays import LABELS, KindSet
from grafu.network.batch import Predictions, one_graph
from grafu.network.config import LABEL_COUNT, GraFuConfig
from grafu.network.encoder import NAME_CODES, VISIBILITY_NUMBERS
from grafu.network.grafu import GraFu
from grafu.network.stored import HALF, name_weights, put_weights
from grafu.shapes import Float32, Int64

OPSET = 18  # ONNX Runtime reads it since 1.14
INPUTS = ("labels", "boxes", "anchors", "groups", "edges", "visibility", "names", "transparent")
OUTPUTS = tuple(field.name for field in fields(Predictions) if field.name not in ("mask", "padding"))
PAIR_OUTPUTS = ("edge", "parent", "hinge_target", "border", "sign", "slide", "body")
GRAPH_OUTPUTS = ("piece",)
_SMALLEST = 64  # numbers; a weight with fewer is left as it is: nothing is saved


def onnx_bytes(
    model: GraFu,
    *,
    points: int,
    anchors: int,
    neighbours: int,
    kinds: KindSet = "all",
    radius: float | None = None,
    half_weights: bool,
) -> bytes:
    """Returns an ONNX file; its metadata hold the network's config, what it sees of points, and the labels in order.

    Of the `points` of a part, `anchors` groups of `neighbours` points each are seen, those within `radius` if there is
    one, and edges of these `kinds`: the `features` of the file. Weights have their names in the network
    (`grafu.network.stored`). With `half_weights` they are stored in 16 bits and widened when they are used: half the
    size, and all is computed in 32 bits as before.
    """
    proto = onnx.load_from_string(_structure(model.config, anchors, neighbours))
    put_weights(proto, model)
    facts = {
        "config": asdict(model.config),
        "features": {
            "points": points,
            "anchors": anchors,
            "neighbours": neighbours,
            "kinds": kinds,
            "radius": radius,
        },
        "labels": [label.value for label in LABELS],
    }
    onnx.helper.set_model_props(proto, {key: json.dumps(value) for key, value in facts.items()})
    onnx.checker.check_model(proto)
    file: bytes = proto.SerializeToString()
    return with_half_weights(file) if half_weights else file


def with_half_weights(file: bytes) -> bytes:
    """Returns an ONNX file with large 32-bit weights stored in 16, each widened by a cast in front of what uses it."""
    proto = onnx.load_from_string(file)
    casts = []
    for weight in proto.graph.initializer:
        if weight.data_type != onnx.TensorProto.FLOAT or np.prod(weight.dims) < _SMALLEST:
            continue
        wide, stored = weight.name, weight.name + HALF
        values = onnx.numpy_helper.to_array(weight).astype(np.float16)
        weight.CopyFrom(onnx.numpy_helper.from_array(values, stored))
        casts.append(onnx.helper.make_node("Cast", [stored], [wide], to=onnx.TensorProto.FLOAT))
    kept = list(proto.graph.node)
    del proto.graph.node[:]
    proto.graph.node.extend(casts + kept)
    onnx.checker.check_model(proto)
    return proto.SerializeToString()


@final
class _OneGraph(nn.Module):
    """The network on the arrays of one graph.

    A padding node is put after the graph's own, and its slot taken out again: it changes no answer, and spares ONNX
    Runtime the arrays without elements of an empty graph, of which it cannot take products.
    """

    def __init__(self, model: GraFu) -> None:
        super().__init__()
        self.model = model

    def forward(
        self,
        labels: Int64[Tensor, " n"],
        boxes: Float32[Tensor, "n 6"],
        anchors: Float32[Tensor, "n g 3"],
        groups: Float32[Tensor, "n g k 3"],
        edges: Int64[Tensor, "n n"],
        visibility: Float32[Tensor, "n v"],
        names: Int64[Tensor, "n c"],
        transparent: Float32[Tensor, " n"],
    ) -> tuple[Tensor, ...]:
        n = labels.shape[0]
        labels, boxes, edges = pad(labels, (0, 1)), pad(boxes, (0, 0, 0, 1)), pad(edges, (0, 1, 0, 1))
        anchors, groups = pad(anchors, (0, 0, 0, 0, 0, 1)), pad(groups, (0, 0, 0, 0, 0, 0, 0, 1))
        visibility, names, transparent = (
            pad(visibility, (0, 0, 0, 1)),
            pad(names, (0, 0, 0, 1)),
            pad(transparent, (0, 1)),
        )
        mask = torch.arange(n + 1)[None] < n
        graph = one_graph(labels, boxes, anchors, groups, edges, visibility, names, transparent)
        answers = self.model(replace(graph, mask=mask))
        slots = torch.arange(n + self.model.config.free_slots)
        kept = slots + (slots >= n)
        scores = {name: getattr(answers, name) for name in OUTPUTS}
        return tuple(
            score[0] if name in GRAPH_OUTPUTS else _without(score, kept, pairs=name in PAIR_OUTPUTS)
            for name, score in scores.items()
        )


def _without(score: Tensor, kept: Int64[Tensor, " s"], *, pairs: bool) -> Tensor:
    if score.ndim == 0:
        return score * 1.0  # an output of its own, not the weight itself
    return score[0, kept][:, kept] if pairs else score[0, kept]


@lru_cache(maxsize=4)
def _structure(config: GraFuConfig, anchors: int, neighbours: int) -> bytes:
    """Returns the ONNX file of a network of random weights: tracing takes seconds, and only weights differ later.

    No two of its weights are alike: the exporter makes one of those that are, as all biases of a new network are.
    """
    with torch.random.fork_rng():
        model = GraFu(config)
        for weight in model.parameters():
            nn.init.normal_(weight.data)
    proto = _exported(model, anchors, neighbours)
    _without_traces(proto)
    name_weights(proto, model)
    file: bytes = proto.SerializeToString()
    return file


def _exported(model: GraFu, anchors: int, neighbours: int) -> onnx.ModelProto:
    parts = 7  # any number that is no other size of the network
    example = (
        torch.arange(parts) % LABEL_COUNT,
        torch.zeros(parts, 6),
        torch.zeros(parts, anchors, 3),
        torch.zeros(parts, anchors, neighbours, 3),
        torch.zeros(parts, parts, dtype=torch.int64),
        torch.zeros(parts, VISIBILITY_NUMBERS),
        torch.zeros(parts, NAME_CODES, dtype=torch.int64),
        torch.zeros(parts),
    )
    n = torch.export.Dim("parts", min=1, max=4096)
    shapes = ({0: n}, {0: n}, {0: n}, {0: n}, {0: n, 1: n}, {0: n}, {0: n}, {0: n})
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the exporter's own, about itself
        program = torch.onnx.export(
            _OneGraph(model).eval(),
            example,
            input_names=INPUTS,
            output_names=OUTPUTS,
            dynamic_shapes=shapes,
            opset_version=OPSET,
            dynamo=True,
            external_data=False,
            verbose=False,
        )
    assert program is not None
    return program.model_proto


def _without_traces(proto: onnx.ModelProto) -> None:
    """Takes out what the exporter notes about where each node comes from: a megabyte, and paths of one machine."""
    for noted in (proto.graph, *proto.graph.node, *proto.graph.value_info, *proto.graph.initializer):
        del noted.metadata_props[:]
        noted.doc_string = ""
    del proto.graph.value_info[:]
