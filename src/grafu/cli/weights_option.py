"""The option `--weights`: a network in ONNX form, or a checkpoint of the authors', which becomes one."""

from hashlib import sha256
from pathlib import Path

from grafu.cli.train import exported, training_packages
from grafu.cli.verb import say
from grafu.errors import WeightsError

FOLDER = "weights"


def usable_weights(weights: Path, out: Path) -> Path:
    """Returns the file of a network that runs: the one given or, of an authors' checkpoint, what it becomes.

    That is written to `out`/weights once, under a name that states its content. It needs `grafu[train]`.

    Raises:
        WeightsError: if there is no such file, or it is no such checkpoint.
        FunctionalizationError: if torch is not installed.
        ExportError: if the file cannot be written.
    """
    if not weights.is_file():
        raise WeightsError(f"`--weights` must be a file that `grafu train` exported: there is no {weights}")
    if weights.suffix.lower() != ".pt":
        return weights
    with training_packages():
        return _converted(weights, out / FOLDER)


def _converted(checkpoint: Path, folder: Path) -> Path:
    from grafu.export.whole_file import whole_file
    from grafu.network.official_weights import official_network, table_beside
    from grafu.training.config import PAPER

    table = table_beside(checkpoint)
    digest = sha256(checkpoint.read_bytes() + (table.read_bytes() if table.is_file() else b"")).hexdigest()[:8]
    target = folder / f"{checkpoint.stem}-{digest}.onnx"
    if not target.is_file():
        content = exported(official_network(checkpoint), PAPER.features, half=False)
        with whole_file(target) as fresh:
            fresh.write_bytes(content)
        say(f"the authors' checkpoint {checkpoint.name} was converted: {target}")
    return target
