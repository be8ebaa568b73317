"""The files of a run from which it goes on, and the weights that it found best. Each appears whole, by one rename.

DIR/last.pt    everything that the next step depends on
DIR/best.pt    the weights that did best in validation, their config and figures
"""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from pickle import UnpicklingError
from typing import Any, final

import torch
from pydantic import TypeAdapter, ValidationError
from torch import Tensor

from grafu.asset.own_files import read_own_json
from grafu.errors import AssetError, ExportError, UnreadableAsset
from grafu.export.whole_file import whole_file
from grafu.network.grafu import GraFu
from grafu.training.config import TrainingConfig
from grafu.training.optimiser import AveragedWeights, Optimiser

SCHEMA = "grafu.training/1"
LAST, BEST = "last.pt", "best.pt"
_CONFIG = TypeAdapter(TrainingConfig)


@final
@dataclass
class Progress:
    """What changes while a network is trained.

    `best` is the highest score so far; `lost` counts the last steps in a row whose gradient was no number.
    """

    network: GraFu
    optimiser: Optimiser
    average: AveragedWeights
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
            "average": progress.average.state(),
            "random": torch.get_rng_state(),
        },
        folder / LAST,
    )


def load_progress(progress: Progress, config: TrainingConfig, folder: Path) -> None:
    """Goes on from what `save_progress` wrote. The number of steps may have changed, and how often is judged.

    Raises:
        UnreadableAsset: if there is nothing to go on from, the file is damaged, or it is of another config.
    """
    state = _read(folder / LAST, progress)
    _require_same(read_config(state["config"], folder / LAST), config, folder)
    progress.network.load_state_dict(state["network"])
    progress.optimiser.restore(state["optimiser"])
    progress.average.restore(state["average"])
    progress.step, progress.best = state["step"], state["best"]
    torch.set_rng_state(state["random"].cpu())


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
    state = _read(folder / BEST)
    return BestWeights(read_config(state["config"], folder / BEST), state["weights"], state["step"], state["figures"])


def read_config(stated: Any, path: Path) -> TrainingConfig:
    """Returns the config that a file states.

    Raises:
        UnreadableAsset: if it is none that this version knows.
    """
    try:
        return _CONFIG.validate_python(stated)
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(str(step) for step in first["loc"])
        raise UnreadableAsset(f"`{path}` was written by another version: `{where}`: {first['msg']}") from error


def _require_same(stated: TrainingConfig, asked: TrainingConfig, folder: Path) -> None:
    for name, value in vars(asked).items():
        if name not in ("steps", "validation", "precision") and getattr(stated, name) != value:
            raise UnreadableAsset(
                f"`{folder}` holds a run with another `{name}`: choose another --out, or keep to its config"
            )


def _read(path: Path, progress: Progress | None = None) -> dict[str, Any]:
    device = next(progress.network.parameters()).device if progress else "cpu"
    if not path.is_file():
        raise UnreadableAsset(f"`{path}` is not there: train first")
    try:
        state = torch.load(path, map_location=device, weights_only=True)
    except (OSError, RuntimeError, EOFError, UnpicklingError) as error:
        raise UnreadableAsset(f"`{path}` cannot be read: it is damaged, or of another program") from error
    if not isinstance(state, dict) or state.get("schema") != SCHEMA:
        raise UnreadableAsset(f"`{path}` must be of the form `{SCHEMA}`")
    return state


def _write(state: Mapping[str, Any], path: Path) -> None:
    with whole_file(path) as fresh:
        torch.save(state, fresh)
