"""Handles that are drawn in pieces: a bar and its posts, each attached where the handle was."""

from dataclasses import replace

import numpy as np

from grafu.geometry.components import connected_parts
from grafu.geometry.mesh import merge_meshes
from grafu.synth.noise.segmentation import with_handles_in_pieces
from grafu.synth.samples import dresser, kitchen_base
from grafu.vocabulary import PartLabel


def handles(asset):
    return [part for part in asset.parts if part.label is PartLabel.HANDLE]


def test_each_connected_piece_of_a_bar_becomes_a_part_where_the_bar_was() -> None:
    plain = kitchen_base()
    made = with_handles_in_pieces(plain)
    assert len(handles(made)) > len(handles(plain))
    for handle in handles(plain):
        pieces = [part for part in handles(made) if part.id == handle.id or part.id.startswith(f"{handle.id}_piece_")]
        assert len(pieces) == len(connected_parts(handle.mesh))
        assert {part.carried_by for part in pieces} == {handle.carried_by}
        whole = merge_meshes([part.mesh for part in pieces])
        assert np.isclose(whole.box.size, handle.box.size).all()
        assert len(whole.faces) == len(handle.mesh.faces)
    assert [p for p in made.parts if p.label is not PartLabel.HANDLE] == [
        p for p in plain.parts if p.label is not PartLabel.HANDLE
    ]


def test_a_handle_that_is_to_stay_whole_and_one_of_one_piece_stay_as_they_are() -> None:
    plain = kitchen_base()
    kept = [part.id for part in handles(plain)]
    assert with_handles_in_pieces(plain, kept).parts == plain.parts
    knobs = dresser()
    one = replace(
        knobs,
        parts=tuple(p for p in knobs.parts if len(connected_parts(p.mesh)) == 1 or p.label is not PartLabel.HANDLE),
    )
    assert len(handles(with_handles_in_pieces(one))) == len(handles(one))
