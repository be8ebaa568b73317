"""Where a release keeps what, told from the folder alone. It opens no file.

    furfun      graphs_functional/<mid>/<mid>.json, graphs_unfunctional/<mid>/<mid>.json,
                part_geometries/<mid>/<node>.npy, splits/<split>.json
    pnm_clean   graphs_unfunctional/<mid>/<mid>.json, part_geometries/<mid>/<node>.npy
    hssd_test   graph_unfunc/<mid>/<mid>.json, part_geometries/<mid>/<node>.npy

Instead of a folder of its own, a graph may be `<mid>_input.json`. A graph file in a model's folder may have any name
where it is the only one.
"""

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Literal, final

from grafu.asset.regular_files import is_within
from grafu.dataclass import dataclass
from grafu.errors import UnreadableAsset

LayoutKind = Literal["furfun", "pnm_clean", "hssd_test"]
FUNCTIONAL, UNFUNCTIONAL, UNFUNCTIONAL_HSSD = "graphs_functional", "graphs_unfunctional", "graph_unfunc"
GEOMETRY, SPLITS = "part_geometries", "splits"
_FLAT = "_input.json"


@final
@dataclass(frozen=True)
class FurFunLayout:
    """The graph files of a release by model id, sorted; `functional` is empty where there are only inputs."""

    kind: LayoutKind
    inputs: Mapping[str, Path]
    functional: Mapping[str, Path]
    geometry: Path
    splits: Path

    def geometry_of(self, *names: str) -> Path:
        """Returns the folder of the point files of a model: of the first name that has one here, else of the last.

        A name that is a path, and a link that leads out of the release, are passed over.
        """
        named = [self.geometry / name for name in names if Path(name).name == name]
        found = (folder for folder in named if folder.is_dir() and is_within(folder, self.geometry))
        return next(found, self.geometry / names[-1])


def find_layout(path: Path) -> FurFunLayout:
    """Returns what lies in the folder of a release.

    Raises:
        UnreadableAsset: if the folder is not laid out in one of the three ways, holds no graph, or a folder in it is a
            link that leads out.
    """
    if not path.is_dir():
        raise UnreadableAsset(f"{path} is no folder: expected one with `{UNFUNCTIONAL}` in it")
    for name in (FUNCTIONAL, UNFUNCTIONAL, UNFUNCTIONAL_HSSD, GEOMETRY, SPLITS):
        if not is_within(path / name, path):
            raise UnreadableAsset(f"{path / name} leads out of the release: copy it into {path}")
    has_functional, has_plain, has_hssd = ((path / n).is_dir() for n in (FUNCTIONAL, UNFUNCTIONAL, UNFUNCTIONAL_HSSD))
    if not (has_plain or has_hssd):
        raise UnreadableAsset(f"{path} is no FurFun folder: expected `{UNFUNCTIONAL}` or `{UNFUNCTIONAL_HSSD}` in it")
    kind: LayoutKind = "furfun" if has_functional and has_plain else "pnm_clean" if has_plain else "hssd_test"
    inputs = _graph_files(path / (UNFUNCTIONAL if has_plain else UNFUNCTIONAL_HSSD))
    if not inputs:
        raise UnreadableAsset(f"{path} holds no input graph: expected <model>/<model>.json or <model>{_FLAT}")
    functional = _graph_files(path / FUNCTIONAL) if has_functional else MappingProxyType[str, Path]({})
    return FurFunLayout(kind, inputs, functional, path / GEOMETRY, path / SPLITS)


def _graph_files(folder: Path) -> Mapping[str, Path]:
    """Returns the graph file of each model; names that begin with a dot are leftovers of an archiver."""
    found: dict[str, Path] = {}
    for entry in folder.iterdir():
        if entry.name.startswith(".") or not is_within(entry, folder):
            continue
        if entry.is_dir():
            file = _graph_file(entry)
            if file is not None:
                found[entry.name] = file
        elif entry.name.endswith(_FLAT) and entry.name != _FLAT:
            found.setdefault(entry.name.removesuffix(_FLAT), entry)
    return MappingProxyType(dict(sorted(found.items())))


def _graph_file(folder: Path) -> Path | None:
    """Returns the graph file in a model's folder: the one named after it, else the only one, else None."""
    named = folder / f"{folder.name}.json"
    if named.is_file() and is_within(named, folder):
        return named
    others = [file for file in folder.glob("*.json") if not file.name.startswith(".") and is_within(file, folder)]
    return others[0] if len(others) == 1 else None
