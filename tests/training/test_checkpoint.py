"""A damaged checkpoint is refused in one line, and no code of it runs."""

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import torch
from little_runs import FewModels, little

from grafu.errors import UnreadableAsset
from grafu.training.checkpoint import BEST, LAST, load_best, read_config
from grafu.training.loop import RunOptions, train
from grafu.training.workers import Workers

pytestmark = pytest.mark.usefixtures("one_thread")


def resume(folder: Path) -> None:
    for _ in train(little(3), FewModels(), folder, Workers(0, 1, torch.device("cpu")), RunOptions(resume=True)):
        pass


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    folder = tmp_path_factory.mktemp("run")
    for _ in train(little(2), FewModels(), folder, Workers(0, 1, torch.device("cpu")), RunOptions()):
        pass
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


@pytest.fixture
def folder(files: dict[str, bytes], tmp_path: Path) -> Path:
    for name, content in files.items():
        (tmp_path / name).write_bytes(content)
    return tmp_path


def refusal(folder: Path, name: str) -> str:
    with pytest.raises(UnreadableAsset) as caught:
        resume(folder) if name == LAST else load_best(folder)
    text = str(caught.value)
    assert str(folder / name) in text
    assert "\n" not in text
    assert "train again" in text
    return text


def changed(folder: Path, name: str, change: Callable[[dict[str, Any]], object]) -> str:
    state = torch.load(folder / name, weights_only=True)
    change(state)
    torch.save(state, folder / name)
    return refusal(folder, name)


LAST_KEYS = ["config", "step", "best", "network", "optimiser", "average", "random"]
BEST_KEYS = ["config", "step", "weights", "figures"]
ALL_KEYS = [*((LAST, key) for key in LAST_KEYS), *((BEST, key) for key in BEST_KEYS)]


def test_the_untouched_files_are_read(folder: Path) -> None:
    load_best(folder)
    resume(folder)


@pytest.mark.parametrize(("name", "key"), ALL_KEYS)
def test_a_missing_key_is_named(folder: Path, name: str, key: str) -> None:
    assert f"`{key}`" in changed(folder, name, lambda state: state.pop(key))


@pytest.mark.parametrize(("name", "key"), ALL_KEYS)
@pytest.mark.parametrize("value", [None, [1], {1: 2}])
def test_a_value_of_another_type_is_named(folder: Path, name: str, key: str, value: object) -> None:
    assert key in changed(folder, name, lambda state: state.update({key: value}))


@pytest.mark.parametrize(("name", "key"), [(LAST, "network"), (BEST, "weights")])
def test_weights_of_other_shapes_or_names_are_named(folder: Path, name: str, key: str) -> None:
    first = next(iter(torch.load(folder / name, weights_only=True)[key]))
    assert f"`{key}.{first}`: is missing" in changed(folder, name, lambda state: state[key].pop(first))
    assert "(3, 5)" in changed(folder, name, lambda state: state[key].update({first: torch.zeros(3, 5)}))


def test_a_weight_too_many_is_named(folder: Path) -> None:
    assert "more" in changed(folder, BEST, lambda state: state["weights"].update(more=torch.zeros(1)))


def test_a_config_of_another_version_is_refused(folder: Path) -> None:
    assert "another version: `seed`" in changed(folder, BEST, lambda state: state["config"].update(seed="red"))


def test_an_average_of_other_weights_is_refused(folder: Path) -> None:
    assert "average.weights" in changed(folder, LAST, lambda state: state["average"].pop("weights"))


def test_an_optimiser_of_another_network_is_refused(folder: Path) -> None:
    def widen(state: dict[str, Any]) -> None:
        moments = next(iter(state["optimiser"][0]["state"].values()))
        moments["exp_avg"] = torch.zeros(3, 5)

    assert "`optimiser`" in changed(folder, LAST, widen)


def test_an_optimiser_without_its_groups_is_refused(folder: Path) -> None:
    assert "`optimiser`" in changed(folder, LAST, lambda state: state["optimiser"][0].pop("param_groups"))


@pytest.mark.parametrize("name", [LAST, BEST])
@pytest.mark.parametrize("content", [[1, 2], "text", None, {}, {"schema": "of others"}, torch.zeros(3)])
def test_what_is_no_checkpoint_is_refused(folder: Path, name: str, content: object) -> None:
    torch.save(content, folder / name)
    assert "grafu.training/1" in refusal(folder, name)


@pytest.mark.parametrize("name", [LAST, BEST])
@pytest.mark.parametrize("length", [0, 1, 100, 5000, -1])
def test_a_truncated_file_is_refused(folder: Path, name: str, length: int) -> None:
    content = (folder / name).read_bytes()
    (folder / name).write_bytes(content[:length])
    assert "cannot be read" in refusal(folder, name)


class Code:
    """Makes a folder when it is unpickled with code allowed."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def __reduce__(self) -> tuple[Any, ...]:
        return os.mkdir, (str(self.path),)


@pytest.mark.parametrize("name", [LAST, BEST])
@pytest.mark.parametrize("is_zipped", [True, False])
def test_no_code_of_a_file_runs(folder: Path, name: str, is_zipped: bool) -> None:
    made = folder / "made"
    torch.save(
        {"schema": "grafu.training/1", "step": Code(made)},
        folder / name,
        _use_new_zipfile_serialization=is_zipped,
    )
    assert "cannot be read" in refusal(folder, name)
    assert not made.exists()


def test_a_config_with_the_name_that_a_field_had_is_read(folder: Path) -> None:
    stated = json.loads((folder / "config.json").read_text(encoding="utf-8"))
    old = {"deal" if name == "sampling" else name: value for name, value in stated.items()}

    assert read_config(old, folder) == read_config(stated, folder)
    assert "deal" in old


def test_a_config_of_the_first_network_is_one_of_the_paper_s_kinds_of_edges(folder: Path) -> None:
    stated = json.loads((folder / "config.json").read_text(encoding="utf-8"))
    loss = read_config(stated, folder).loss
    del stated["network"]["kinds"], stated["features"]["kinds"]
    stated["loss"]["edge_kinds"] = stated["loss"]["edge_kinds"][:5]

    config = read_config(stated, folder)
    assert (config.network.kinds, config.features.kinds) == ("paper", "paper")
    assert config.loss == loss
