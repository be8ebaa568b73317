"""Where the animations of a glTF scene take its nodes: their local transforms at the times of the keys.

Between keys of different channels of one node values are interpolated in a straight line, whatever the sampler states:
what a node turns about or slides along is the same. Scales and weights of morph targets are not read.
"""

from typing import Final, final

import numpy as np

from grafu.asset.gltf_buffers import GltfFile
from grafu.asset.json_files import JsonObject
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat4, Scalars
from grafu.geometry.transform import from_rotation, invert, quaternion_matrix
from grafu.shapes import Float

_WIDTHS: Final = {"translation": 3, "rotation": 4}
_LARGEST: Final = 1e12  # of a number of a key: products with transforms stay finite


@final
@dataclass(frozen=True)
class _Track:
    """The keys of one channel: times in seconds, and a row of values for each."""

    times: Scalars
    values: Float[np.ndarray, "keys _"]

    def at(self, times: Scalars) -> Float[np.ndarray, "times _"]:
        return np.stack([np.interp(times, self.times, column) for column in self.values.T], axis=1)


def moved_nodes(file: GltfFile) -> dict[int, list[list[Mat4]]]:
    """Returns for each node that animations move its turn and shift, in each of them, at each key.

    They are relative to where the node is drawn, in the coordinates of the node above it: that maps a point of the
    drawn node to where the animation takes it.

    Raises:
        UnreadableAsset: if an animation is damaged.
        AssetTooLarge: if it has more keys than the limits allow.
    """
    found: dict[int, list[list[Mat4]]] = {}
    for animation in file.document.objects("animations"):
        samplers = animation.objects("samplers")
        tracks: dict[int, dict[str, _Track]] = {}
        for channel in animation.objects("channels"):
            target = channel.member("target")
            node, path = target.whole("node"), target.text("path")
            if node is None or path not in _WIDTHS:
                continue
            number = channel.whole("sampler", 0)
            if number >= len(samplers):
                raise file.damaged(f"the sampler {number} of an animation is not there")
            track = _track(samplers[number], _WIDTHS[path], file)
            if len(track.times):
                tracks.setdefault(node, {})[path] = track
        for node, of_node in tracks.items():
            found.setdefault(node, []).append(_moves(file.item("nodes", node), of_node))
    return found


def _track(sampler: JsonObject, width: int, file: GltfFile) -> _Track:
    """Returns the keys of a sampler, of a cubic one without the tangents."""
    counts = [file.count(sampler.whole(key)) for key in ("input", "output")]
    file.files.limits.require("vertices", sum(counts), file.path)
    file.files.tally.add(file.path, vertices=sum(counts))
    times, values = (np.asarray(file.accessor(sampler.whole(key)), np.float64) for key in ("input", "output"))
    if sampler.text("interpolation") == "CUBICSPLINE":
        values = values[1::3]
    fits = times.shape[1:] == (1,) and values.shape == (len(times), width)
    if not fits or not np.abs(values).max(initial=0.0) < _LARGEST or not np.isfinite(times).all():
        raise file.damaged("the keys of an animation do not fit together")
    order = np.argsort(times[:, 0], kind="stable")
    return _Track(times[order, 0], values[order])


def _moves(node: JsonObject, tracks: dict[str, _Track]) -> list[Mat4]:
    """Returns where an animation takes a node at each of its keys, against where it is drawn."""
    if node.numbers("matrix", 16) is not None:
        return []  # the format lets no such node be animated
    times = np.unique(np.concatenate([track.times for track in tracks.values()]))
    drawn = node.numbers("rotation", 4, (0.0, 0.0, 0.0, 1.0)), node.numbers("translation", 3, (0.0, 0.0, 0.0))
    turns, shifts = (
        tracks[path].at(times) if path in tracks else np.tile(np.array(stated), (len(times), 1))
        for path, stated in zip(("rotation", "translation"), drawn, strict=True)
    )
    back = invert(_pose(np.array(drawn[0]), np.array(drawn[1])))
    return [_pose(turn, shift) @ back for turn, shift in zip(turns, shifts, strict=True)]


def _pose(turn: np.ndarray, shift: np.ndarray) -> Mat4:
    x, y, z, w = turn.tolist()
    return from_rotation(quaternion_matrix(w, x, y, z) if any((x, y, z, w)) else np.eye(3), shift)
