"""The files of a run from which it goes on, and the weights that it found best. Each appears whole, by one rename.

DIR/last.pt    everything that the next step depends on
DIR/best.pt    the weights that did best in validation, their config and figures
"""

from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from pickle import UnpicklingError
from typing import Any, TypeVar, final

import torch
from pydantic import BaseModel, ConfigDict, NonNegativeInt, TypeAdapter, ValidationError
from torch import Tensor
from torch.optim.swa_utils import AveragedModel

from grafu.asset.json_files import read_own_json
from grafu.dataclass import dataclass
from grafu.errors import AssetError, ExportError, UnreadableAsset
from grafu.export.whole_file import whole_file
from grafu.graph.arrays import EDGE_CODES
from grafu.network.config import OLDER
from grafu.network.grafu import GraFu
from grafu.training.config import TrainingConfig
from grafu.training.loss_config import LossConfig
from grafu.training.optimiser import Optimiser

SCHEMA = "grafu.training/1"
LAST, BEST = "last.pt", "best.pt"
_CONFIG = TypeAdapter(TrainingConfig)
_DAMAGES = (OSError, EOFError, UnpicklingError, RuntimeError, ValueError, LookupError, TypeError, AttributeError)


class _File(BaseModel):
    """The content of a checkpoint but its schema."""

    model_config = ConfigDict(strict=True, arbitrary_types_allowed=True, extra="forbid")
    config: dict[str, Any]
    step: NonNegativeInt


@final
class _AverageState(BaseModel):
    model_config = _File.model_config
    steps: NonNegativeInt
    weights: dict[str, Tensor]


@final
class _LastFile(_File):
    best: float
    network: dict[str, Tensor]
    optimiser: list[dict[str, Any]]
    average: _AverageState
    random: Tensor


@final
class _BestFile(_File):
    weights: dict[str, Tensor]
    figures: dict[str, float]


_F = TypeVar("_F", bound=_File)


@final
@dataclass
class Progress:
    """What changes while a network is trained.

    `best` is the highest score so far; `lost` counts the last steps in a row whose gradient was no number.
    """

    network: GraFu
    optimiser: Optimiser
    average: AveragedModel
    step: int = 0
    best: float = 0.0
    lost: int = 0


@final
@dataclass(frozen=True)
class BestWeights:
    """The weights of a run that did best: after `step` steps, with these figures in validation."""

    config: TrainingConfig
    weights: Mapping[str, Tensor]
    step: int
    figures: Mapping[str, float]

    def network(self) -> GraFu:
        """Returns the network with these weights, ready for use."""
        network = GraFu(self.config.network)
        network.load_state_dict(dict(self.weights))
        return network.eval()


def save_progress(progress: Progress, config: TrainingConfig, folder: Path) -> None:
    """Writes what a run goes on from.

    Raises:
        ExportError: if the folder cannot be written.
    """
    _write(
        {
            "schema": SCHEMA,
            "config": asdict(config),
            "step": progress.step,
            "best": progress.best,
            "network": progress.network.state_dict(),
            "optimiser": progress.optimiser.state(),
            "average": {
                "steps": int(progress.average.n_averaged),
                "weights": progress.average.module.state_dict(),
            },
            "random": torch.get_rng_state(),
        },
        folder / LAST,
    )


def load_progress(progress: Progress, config: TrainingConfig, folder: Path) -> None:
    """Goes on from what `save_progress` wrote. The number of steps may have changed, and how often is judged.

    Raises:
        UnreadableAsset: if there is nothing to go on from, the file is damaged, or it is of another config.
    """
    path = folder / LAST
    state = _read(path, _LastFile, next(progress.network.parameters()).device)
    _require_same(read_config(state.config, path), config, folder)
    for name, weights in (("network", state.network), ("average", state.average.weights)):
        _require_weights(weights, progress.network.state_dict(), name, path)
    progress.network.load_state_dict(state.network)
    progress.average.module.load_state_dict(state.average.weights)
    progress.average.n_averaged.fill_(state.average.steps)
    progress.step, progress.best = state.step, state.best
    name = "optimiser"
    try:
        progress.optimiser.restore(state.optimiser)
        name = "random"
        torch.set_rng_state(state.random.cpu())
    except _DAMAGES as error:
        raise _damaged(path, name, f"is of another network or config ({type(error).__name__})") from error


def has_progress(folder: Path) -> bool:
    """Whether a run was begun in a folder."""
    return (folder / LAST).is_file()


def require_own(folder: Path, *names: str) -> None:
    """Makes sure that a run may begin in a folder: files of these names, and weights, are there only of a run of ours.

    Raises:
        ExportError: if there are some, and no config of ours beside them.
    """
    config = folder / "config.json"
    held = [name for name in (config.name, BEST, *names) if (folder / name).exists()]
    try:
        if held:
            read_config(read_own_json(config, "the config of a run"), config)
    except AssetError:
        raise ExportError(f"`{folder}` holds `{held[0]}` and no run of grafu's: choose another --out") from None


def save_best(
    config: TrainingConfig, weights: Mapping[str, Tensor], step: int, figures: Mapping[str, float], folder: Path
) -> None:
    """Writes the best weights so far.

    Raises:
        ExportError: if the folder cannot be written.
    """
    state = {"schema": SCHEMA, "config": asdict(config), "step": step, "figures": dict(figures)}
    _write(state | {"weights": {name: value.cpu() for name, value in weights.items()}}, folder / BEST)


def load_best(folder: Path) -> BestWeights:
    """Returns the best weights of a run.

    Raises:
        UnreadableAsset: if there are none, or the file is damaged.
    """
    path = folder / BEST
    state = _read(path, _BestFile, torch.device("cpu"))
    config = read_config(state.config, path)
    with torch.device("meta"):  # names and shapes only
        expected = GraFu(config.network).state_dict()
    _require_weights(state.weights, expected, "weights", path)
    return BestWeights(config, state.weights, state.step, state.figures)


def read_config(stated: Any, path: Path) -> TrainingConfig:
    """Returns the config that a file states.

    Raises:
        UnreadableAsset: if it is none that this version knows.
    """
    try:
        return _CONFIG.validate_python(_renamed(stated))
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(str(step) for step in first["loc"])
        problem = f"`{where}`: {first['msg']}"
        raise UnreadableAsset(f"`{path}` was written by another version: {problem}; train again") from error


_OLDER = {"network": dict(OLDER), "features": {"kinds": OLDER["kinds"]}}


def _renamed(stated: Any) -> Any:
    """Returns a config with today's names: earlier versions called one field otherwise, and knew the paper's edges."""
    if not isinstance(stated, dict):
        return stated
    if "deal" in stated and "sampling" not in stated:
        stated = {"sampling" if name == "deal" else name: value for name, value in stated.items()}
    knows = {name: older | stated[name] for name, older in _OLDER.items() if _is_dict(stated, name)}
    weights = stated["loss"].get("edge_kinds") if _is_dict(stated, "loss") else None
    if isinstance(weights, list | tuple) and len(weights) == EDGE_CODES["paper"]:
        knows["loss"] = stated["loss"] | {"edge_kinds": (*weights, *LossConfig().edge_kinds[len(weights) :])}
    return stated | knows


def _is_dict(stated: dict[str, Any], name: str) -> bool:
    return isinstance(stated.get(name), dict)


def _require_same(stated: TrainingConfig, asked: TrainingConfig, folder: Path) -> None:
    for name, value in vars(asked).items():
        if name not in ("steps", "validation", "precision") and getattr(stated, name) != value:
            raise UnreadableAsset(
                f"`{folder}` holds a run with another `{name}`: choose another --out, or keep to its config"
            )


def _read(path: Path, form: type[_F], device: torch.device) -> _F:
    if not path.is_file():
        raise UnreadableAsset(f"`{path}` does not exist: train first")
    try:
        state = torch.load(path, map_location=device, weights_only=True)  # runs no code of the file
    except _DAMAGES as error:
        raise UnreadableAsset(f"`{path}` cannot be read as a checkpoint of grafu: remove it and train again") from error
    if not isinstance(state, dict) or state.get("schema") != SCHEMA:
        raise UnreadableAsset(f"`{path}` must be a checkpoint of the form `{SCHEMA}`: remove it and train again")
    try:
        return form.model_validate({key: value for key, value in state.items() if key != "schema"})
    except ValidationError as error:
        first = error.errors()[0]
        name = ".".join(str(step) for step in first["loc"])
        raise _damaged(path, name, first["msg"]) from error


def _require_weights(found: Mapping[str, Tensor], expected: Mapping[str, Tensor], name: str, path: Path) -> None:
    for key in sorted(found.keys() | expected.keys()):
        if key not in found or key not in expected:
            raise _damaged(path, f"{name}.{key}", "is missing" if key in expected else "is no weight of this network")
        shape, wanted = tuple(found[key].shape), tuple(expected[key].shape)
        if shape != wanted or found[key].dtype != expected[key].dtype:
            raise _damaged(
                path, f"{name}.{key}", f"is {found[key].dtype} {shape}, expected {expected[key].dtype} {wanted}"
            )


def _damaged(path: Path, name: str, problem: str) -> UnreadableAsset:
    return UnreadableAsset(f"`{path}` is damaged: `{name}`: {problem}; remove it and train again")


def _write(state: Mapping[str, Any], path: Path) -> None:
    with whole_file(path) as fresh:
        torch.save(state, fresh)
