"""The split files of a release, in and out (official.md 2.4). It divides nothing itself."""

from pathlib import Path

from grafu.asset.folders import is_within
from grafu.data.furfun.graph_files import load_graph_json
from grafu.data.split import Split
from grafu.errors import AssetError, GraphError
from grafu.graph.json_values import Json, read_list
from grafu.graph.serialize import dump_json

SPLIT_NAMES = ("full_split", "subset_split")
_KEYS = ("train_mids", "val_mids", "test_mids")


def read_split(folder: Path, name: str) -> Split:
    """Returns the split in `<name>.json`.

    Raises:
        AssetError: if there is none, or it names a model twice.
        GraphError: if it is no JSON object of lists.
    """
    path = folder / f"{name}.json"
    if Path(name).name != name or not path.is_file() or not is_within(path, folder):
        there = ", ".join(sorted(file.stem for file in folder.glob("*.json"))) or "none"
        raise AssetError(f"{folder} holds no split `{name}`: it has {there}")
    data = load_graph_json(path)
    try:
        return Split(*(_ids(data, key) for key in _KEYS))
    except (GraphError, ValueError) as error:
        raise AssetError(f"{path}: {error}") from error


def split_to_json(split: Split) -> str:
    """Returns the text of a split file."""
    return dump_json(dict(zip(_KEYS, (list(split.train), list(split.val), list(split.test)), strict=True)))


def _ids(data: Json, key: str) -> tuple[str, ...]:
    return tuple(str(model_id) for model_id in read_list(data, key, "a split"))
