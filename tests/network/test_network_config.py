"""The sizes of the network: the paper's by default, refused where they make no sense."""

from dataclasses import asdict

import pytest

from grafu.network.config import LABEL_COUNT, PAPER, GraFuConfig
from grafu.network.grafu import GraFu

AUTHORS_PARAMETERS = 9_224_401  # of the authors' network, with 17 categories


def parameters(config: GraFuConfig) -> int:
    return sum(p.numel() for p in GraFu(config).parameters())


@pytest.mark.parametrize("config", [GraFuConfig(names=False, facts=False), PAPER])
def test_the_network_is_as_large_as_the_paper_s(config: GraFuConfig) -> None:
    assert parameters(config) == pytest.approx(AUTHORS_PARAMETERS, rel=0.05)


def test_a_node_s_latent_has_the_paper_s_width() -> None:
    config = GraFuConfig()
    assert config.category + config.points + config.geometry == 224
    assert (LABEL_COUNT, PAPER.edge_codes, config.edge_codes) == (14, 5, 7)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"hidden": 0}, "`hidden` must be at least 1: got 0"),
        ({"hidden": 20, "heads": 8}, "`hidden` must be a multiple of `heads`: got 20 and 8"),
        ({"free_slots": -1}, "`free_slots` must not be negative: got -1"),
        ({"dropout": 1.0}, "`dropout` must be at least 0 and below 1: got 1.0"),
    ],
)
def test_sizes_that_make_no_sense_are_refused(wrong: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        GraFuConfig(**wrong)


def test_a_configuration_can_be_stored_and_read() -> None:
    config = GraFuConfig(hidden=64, pair_edges=False)
    assert GraFuConfig(**asdict(config)) == config
