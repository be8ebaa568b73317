import numpy as np

from grafu.asset.loose import with_split_handles
from grafu.asset.part import Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.vocabulary import PartLabel


def part(name, label, *boxes):
    meshes = [TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float))) for low, high in boxes]
    return Part(name, label, (Surface(merge_meshes(meshes)),), PartSource(name), "name")


LEFT = part("left", PartLabel.DOOR, ((0, 0, 0), (0.5, 0.02, 1)))
RIGHT = part("right", PartLabel.DOOR, ((0.5, 0, 0), (1, 0.02, 1)))
BARS = [((x, -0.03, 0.4), (x + 0.02, 0, 0.6)) for x in (0.44, 0.54)]


def test_handles_in_one_mesh_are_split_between_their_fronts():
    found, notes = with_split_handles((LEFT, RIGHT, part("handles", PartLabel.HANDLE, *BARS)))
    assert [(p.id, p.carried_by) for p in found[2:]] == [("handles_1", "left"), ("handles_2", "right")]
    assert [p.label for p in found[2:]] == [PartLabel.HANDLE] * 2
    np.testing.assert_allclose(found[2].box.low, BARS[0][0])
    np.testing.assert_allclose(found[3].box.high, BARS[1][1])
    assert len(notes) == 1


def test_ids_that_are_taken_are_passed_over():
    other = part("handles_1", PartLabel.MISC, ((2, 0, 0), (2.1, 0.1, 0.1)))
    found, _ = with_split_handles((LEFT, RIGHT, other, part("handles", PartLabel.HANDLE, *BARS)))
    assert [p.id for p in found[3:]] == ["handles_2", "handles_3"]


def test_two_posts_on_one_front_and_a_bar_across_both_stay_whole():
    posts = part("handle", PartLabel.HANDLE, BARS[0], ((0.3, -0.03, 0.4), (0.32, 0, 0.6)))
    bar = part("handle_2", PartLabel.HANDLE, ((0.4, -0.03, 0.4), (0.6, 0, 0.42)))
    parts = (LEFT, RIGHT, posts, bar)
    assert with_split_handles(parts) == (parts, [])
