"""What pairs of boxes have to do with each other, against numbers worked out by hand."""

import pytest
import torch

from grafu.network.config import PairFeatures
from grafu.network.pair_terms import edge_terms, pair_term_count, pair_terms

# Half sizes 1, 1, 1 and .5, 1, 1; from the first centre to the second: 3, 4, 0; gaps 1.5, 2, 0
BOXES = torch.tensor([[[0.0, 0.0, 0.0, 1.0, 1.0, 1.0], [3.0, 4.0, 0.0, 0.5, 1.0, 1.0]]])


def test_edges_have_distances_direction_and_gaps() -> None:
    assert edge_terms(BOXES)[0, 0, 1].tolist() == pytest.approx([5.0, 2.5, 0.6, 0.8, 0.0, 1.5, 2.0, 0.0])
    assert edge_terms(BOXES)[0, 1, 0].tolist() == pytest.approx([5.0, 2.5, -0.6, -0.8, 0.0, 1.5, 2.0, 0.0])


def test_a_part_has_no_direction_to_itself() -> None:
    assert not edge_terms(BOXES)[0, 0, 0].any()


def test_pairs_have_a_direction_if_asked() -> None:
    assert pair_terms(BOXES, "signed")[0, 1, 0].tolist() == [3.0, 4.0, 0.0, 5.0, -3.0, -4.0, 0.0, 1.5, 2.0, 0.0]
    assert pair_terms(BOXES, "unsigned")[0, 1, 0].tolist() == [3.0, 4.0, 0.0, 5.0, 1.5, 2.0, 0.0]


@pytest.mark.parametrize("features", ["signed", "unsigned"])
def test_there_are_as_many_terms_as_stated(features: PairFeatures) -> None:
    assert pair_terms(BOXES, features).shape[-1] == pair_term_count(features)
