"""Checkpoints of the authors' layout become our network, with the same answers; whatever else a file is, is refused."""

import json
import pickle
from pathlib import Path

import pytest
import torch
from torch import Tensor

from authors_network import FREE, Authors, authors
from grafu.errors import WeightsError
from grafu.graph.arrays import LABELS, NULL
from grafu.network.batch import Predictions, one_graph
from grafu.network.config import OFFICIAL, PAPER
from grafu.network.official_weights import official_network
from grafu.network.vocabulary import OFFICIAL_WORDS

N, ANCHORS, NEIGHBOURS = 5, 8, 6


def saved(path: Path, network: Authors, **more: object) -> Path:
    torch.save({"epoch": 7, "model_state_dict": network.state_dict(), **more}, path)
    return path


@pytest.fixture(scope="module")
def theirs() -> Authors:
    return authors()


@pytest.fixture(scope="module")
def checkpoint(theirs: Authors, tmp_path_factory: pytest.TempPathFactory) -> Path:
    optimiser = torch.optim.Adam(theirs.parameters())
    sum(p.square().sum() for p in theirs.parameters()).backward()
    state = optimiser.state_dict()
    theirs.zero_grad()
    return saved(tmp_path_factory.mktemp("authors") / "grafu_full.pt", theirs, optimizer_state_dict=state)


def given(seed: int = 3) -> dict[str, Tensor]:
    draw = torch.Generator().manual_seed(seed)
    edges = torch.randint(0, 5, (N, N), generator=draw).triu(1)
    return {
        "labels": torch.randint(0, len(LABELS), (N,), generator=draw),
        "boxes": torch.rand(N, 6, generator=draw) * 0.4,
        "anchors": torch.rand(N, ANCHORS, 3, generator=draw),
        "groups": torch.rand(N, ANCHORS, NEIGHBOURS, 3, generator=draw) * 0.2,
        "edges": (edges + edges.T).fill_diagonal_(NULL),
    }


def answers(network: torch.nn.Module) -> Predictions:
    unseen = {
        "visibility": torch.zeros(N, 18),
        "names": torch.zeros(N, 32, dtype=torch.int64),
        "transparent": torch.zeros(N),
    }
    with torch.no_grad():
        return network(one_graph(**given(), **unseen))


def test_the_authors_network_has_as_many_weights_as_they_count(theirs: Authors) -> None:
    assert sum(p.numel() for p in theirs.parameters()) == 9_224_401


def test_the_network_that_is_read_answers_as_theirs(theirs: Authors, checkpoint: Path) -> None:
    ours, one = answers(official_network(checkpoint)), given()
    words = torch.tensor([OFFICIAL_WORDS.index(LABELS[k].value) for k in one.pop("labels")])
    with torch.no_grad():
        wanted = theirs(words, **one)
    slots = N + FREE
    both = {
        "exists": wanted["exist"],
        "centre": wanted["centre"],
        "half": wanted["half"],
        "edge": (wanted["edge"] + wanted["edge"].transpose(0, 1)) / 2,
        "parent": wanted["parent"][..., 0],
        "hinge_target": wanted["hinge_target"][..., 0],
        "border": wanted["hinge_border_4"],
        "sign": wanted["hinge_axis_sign"],
        "slide": wanted["rail_axis_signed"],
    }
    for name, value in both.items():
        found = getattr(ours, name)[0]
        assert torch.allclose(found[:slots], value[:slots], atol=2e-4), name
    leg = [label.value for label in LABELS].index("leg")
    assert torch.allclose(ours.category[0, :, leg], wanted["material"][:, OFFICIAL_WORDS.index("leg")], atol=2e-4)
    assert float(ours.parent_abstain) == float(theirs.heads.parent_abstain.detach())
    assert float(ours.hinge_abstain) == float(theirs.heads.hinge_target_abstain.detach())


def test_other_spellings_of_a_name_are_recognised(theirs: Authors, tmp_path: Path) -> None:
    spelt = {"w_q": "q_proj", "w_k": "k_proj", "w_v": "v_proj", "w_o": "out_proj", "material": "category_head"}
    weights = theirs.state_dict()
    for a, b in spelt.items():
        weights = {
            f"module.{name}".replace("module.module.", "module.").replace(a, b): v for name, v in weights.items()
        }
    torch.save(weights, tmp_path / "grafu_x.pt")
    assert torch.equal(answers(official_network(tmp_path / "grafu_x.pt")).exists, answers_of(theirs, tmp_path).exists)


def answers_of(theirs: Authors, folder: Path) -> Predictions:
    return answers(official_network(saved(folder / "same.pt", theirs)))


def test_a_table_beside_the_file_renames_what_is_not_recognised(theirs: Authors, tmp_path: Path) -> None:
    weights = {name.replace(".w_k.", ".two.").replace(".w_q.", ".one."): v for name, v in theirs.state_dict().items()}
    path = tmp_path / "grafu_x.pt"
    torch.save(weights, path)
    with pytest.raises(WeightsError, match=r"encoder\.layers\.0\.attention\.query .*grafu_x\.names\.json"):
        official_network(path)
    prefixes = {
        f"graph_encoder.layers.{k}.{a}": f"graph_encoder.layers.{k}.{b}"
        for k in range(4)
        for a, b in (("one", "q"), ("two", "k"))
    }
    path.with_suffix(".names.json").write_text(json.dumps(prefixes))
    assert torch.equal(answers(official_network(path)).exists, answers_of(theirs, tmp_path).exists)


def test_an_absent_layer_is_named(theirs: Authors, tmp_path: Path) -> None:
    weights = {name: v for name, v in theirs.state_dict().items() if "rail_axis" not in name}
    torch.save(weights, tmp_path / "grafu_x.pt")
    with pytest.raises(WeightsError, match=r"not found: motion_heads\.slide"):
        official_network(tmp_path / "grafu_x.pt")


def test_a_layer_that_is_left_over_is_named(theirs: Authors, tmp_path: Path) -> None:
    torch.save(theirs.state_dict() | {"heads.colour.0.weight": torch.zeros(7, 9)}, tmp_path / "grafu_x.pt")
    with pytest.raises(WeightsError, match=r"not used: heads\.colour\.0 \(7, 9\)"):
        official_network(tmp_path / "grafu_x.pt")


def test_our_vocabulary_refuses_theirs(checkpoint: Path) -> None:
    with pytest.raises(WeightsError, match=r"encoder\.nodes\.category \(14, 128\)"):
        official_network(checkpoint, PAPER)


class Evil:
    """Would run code where it is unpickled."""

    def __reduce__(self) -> tuple[object, tuple[str]]:
        return exec, ("import pathlib; pathlib.Path('ran').touch()",)


def test_code_of_a_file_is_never_run(theirs: Authors, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    saved(tmp_path / "grafu_x.pt", theirs, config=Evil())
    with pytest.raises(WeightsError, match="holds more than weights"):
        official_network(tmp_path / "grafu_x.pt")
    assert not (tmp_path / "ran").exists()


@pytest.mark.parametrize("content", [b"", b"no checkpoint", pickle.dumps({"a": 1})])
def test_what_is_no_checkpoint_is_refused(content: bytes, tmp_path: Path) -> None:
    (tmp_path / "grafu_x.pt").write_bytes(content)
    with pytest.raises(WeightsError, match=r"grafu_x\.pt"):
        official_network(tmp_path / "grafu_x.pt")


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(WeightsError, match="there is no such file"):
        official_network(tmp_path / "grafu_x.pt")


def test_the_authors_choices_are_a_configuration() -> None:
    assert (OFFICIAL.vocabulary, OFFICIAL.geometry_dropout, OFFICIAL.dropout) == ("official", 0.3, 0.1)
