"""Names that CAD programs give to bodies tell that Z is up; names that people give do not."""

from dataclasses import replace

import pytest

from grafu.asset.cad_names import are_of_cad
from grafu.asset.frame import settle_frame
from grafu.asset.options import LoadOptions
from grafu.asset.part import PartSource
from grafu.asset.reading import Convention, Reading
from grafu.vocabulary import PartLabel
from small_scenes import box

OBJ = Convention("what is usual for OBJ: Y up")
CAD = ("Solid1:3", "Body12", "Extrude3", "Component#4", "Part__Feature001")
OTHERS = ("Cube.003", "Mesh_12", "body", "part_4", "Bodyguard")


def _called(*names: str):
    """Boards that tell nothing: each is a cube."""
    cubes = (box(f"p{k}", (float(k), 0.0, 0.0), (k + 0.5, 0.5, 0.5)) for k in range(len(names)))
    return tuple(
        replace(cube, label=PartLabel.UNKNOWN, labelled_by="none", source=PartSource(name))
        for cube, name in zip(cubes, names, strict=True)
    )


@pytest.mark.parametrize("name", CAD)
def test_names_of_cad_programs(name: str) -> None:
    assert are_of_cad(_called(*[name] * 4))


@pytest.mark.parametrize("name", OTHERS)
def test_names_of_other_programs_and_of_people(name: str) -> None:
    assert not are_of_cad(_called(*[name] * 4))


def test_a_few_names_tell_nothing() -> None:
    assert not are_of_cad(_called("Body1", "Body2"))
    assert not are_of_cad(_called("Body1", "Body2", "Body3", *OTHERS))


def test_bodies_of_a_cad_program_have_z_up_where_the_format_states_nothing() -> None:
    frame = settle_frame(Reading("mesh file", _called(*CAD), OBJ), LoadOptions())
    usual = settle_frame(Reading("mesh file", _called(*OTHERS), OBJ), LoadOptions())

    assert frame.up == "+Z"
    assert "CAD" in frame.assumed[0]
    assert usual.up == "+Y"
