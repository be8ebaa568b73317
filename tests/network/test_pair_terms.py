"""What pairs of boxes have to do with each other, against numbers worked out by batch."""

import pytest
import torch

from grafu.network.config import PairFeatures
from grafu.network.encoder import edge_terms, face_scale, face_terms, pair_term_count, pair_terms

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


def test_faces_lie_to_each_other_as_they_do() -> None:
    lows, highs, gaps, gaps_behind = face_terms(BOXES)[0, 0, 1].split(3)
    expected = ([3.5, 4.0, 0.0], [2.5, 4.0, 0.0], [1.5, 2.0, -2.0], [-4.5, -6.0, -2.0])
    for found, distances in zip((lows, highs, gaps, gaps_behind), expected, strict=True):
        assert found.tolist() == pytest.approx(face_scale(torch.tensor(distances)).tolist())


def test_the_other_way_round_every_face_changes_sides() -> None:
    there, back = face_terms(BOXES)[0, 0, 1], face_terms(BOXES)[0, 1, 0]
    assert back[:6].tolist() == pytest.approx((-there[:6]).tolist())
    assert back[6:].tolist() == pytest.approx(torch.cat([there[9:], there[6:9]]).tolist())


def test_millimetres_are_told_apart_on_the_scale_of_faces() -> None:
    near, far, whole = face_scale(torch.tensor([0.001, 0.004, 1.0])).tolist()
    assert near == pytest.approx(0.0495, abs=1e-4)
    assert far == pytest.approx(0.1763, abs=1e-4)
    assert whole == pytest.approx(1.2429, abs=1e-4)


@pytest.mark.parametrize("features", ["faces", "signed", "unsigned"])
def test_there_are_as_many_terms_as_stated(features: PairFeatures) -> None:
    assert pair_terms(BOXES, features).shape[-1] == pair_term_count(features)
